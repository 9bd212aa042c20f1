// Belts: how the turning of a sprocket shows in the contacts of its crawler.
#pragma once

#include <Eigen/Core>

#include "bullet/robot.h"

namespace limphome {

// Unit vector along the ground in which the robot travels when the belt runs forward without slip; 0 for a crawler that
// lies on its side, whose belt moves nothing. `normal` points into the belt.
Eigen::Vector3d belt_direction(const Robot &robot, int crawler, const Eigen::Vector3d &normal);

// Velocity of the belt's surface against the body per unit of the sprocket's rate, along the columns of a contact's
// frame: the sprocket's column of the contact's Jacobian. `direction` is that of the belt. The surface that touches the
// ground runs backwards. By the same column the friction on the belt turns the sprocket, so that a locked, free, weak
// or stalled drive needs no case of its own.
Eigen::Vector3d belt_velocity(const Robot &robot, int crawler, const Eigen::Vector3d &direction,
                              const Eigen::Matrix3d &frame);

}  // namespace limphome
