// Where the bodies of the robot are.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "model/robot_model.h"

namespace limphome {

// A body in the world, along the world's axes.
struct PlacedBody {
    int parent;               // body it hangs on; -1 for the base
    double mass;              // [kg]
    double angle;             // of its joint [rad]
    Eigen::Matrix3d axes;     // of its frame, one a column
    Eigen::Vector3d origin;   // of its frame, which the axis of its joint leads through [m]
    Eigen::Vector3d axis;     // of its joint
    Eigen::Vector3d centre;   // of mass [m]
    Eigen::Matrix3d inertia;  // about the centre of mass [kg m^2]

    // A point of the body, from its own frame [m].
    Eigen::Vector3d point(const Eigen::Vector3d &own) const { return origin + axes.lazyProduct(own); }
};

// Puts the bodies of `model` where they are while the base's frame is at `base` and the joints are at `angles`. In
// `bodies` there is one for each already.
void place_bodies(const RobotModel &model, const Eigen::Isometry3d &base, const double *angles,
                  std::vector<PlacedBody> &bodies);

}  // namespace limphome
