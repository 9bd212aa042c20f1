// Where the robot touches the ground, or is about to; what tells of touches between its bodies, too (body_touch.h).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bullet/robot.h"
#include "model/ground.h"

namespace limphome {

struct Touch {
    int shape;               // index into Robot::shapes()
    Eigen::Vector3d point;   // halfway between the shape and what it touches [m]
    Eigen::Vector3d normal;  // from there into the shape
    double depth;            // of penetration; below 0: gap [m]
    int other = ground;      // what it touches: index into Robot::shapes(), or `ground`

    static constexpr int ground = -1;
};

constexpr double touch_reach = 0.02;  // what is farther from the ground than this does not touch [m]

// Fills `touches` with those on any ground, piece by piece of it, ordered by shape so that nothing depends on the order
// in which they were found; memory that it has is used again. Balls touch in one point, edges of belts where their
// rounded ends are nearest to the ground and wherever it bulges towards the flat run between them.
void ground_touches(const Robot &robot, const Ground &ground, std::vector<Touch> &touches);

}  // namespace limphome
