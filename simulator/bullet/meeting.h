// Where two solids that reach into each other touch.
#pragma once

#include <robot_solid.h>

#include <Eigen/Core>
#include <array>

namespace limphome {

struct MeetingPoint {
    Eigen::Vector3d point;  // halfway between the two surfaces [m]
    double depth;           // of penetration; below 0: gap [m]
};

// Up to 8 points that carry: two faces, or a face and an edge, touch over an area or a line, of which these are the
// corners; all else touches in one point.
struct Meeting {
    Eigen::Vector3d normal;  // from b into a
    int count = 0;
    std::array<MeetingPoint, 8> points;
};

// `gap` is that of a and b; its distance should be below 0, or little above.
Meeting meet(const robot_solid &a, const robot_solid &b, const robot_gap &gap);

}  // namespace limphome
