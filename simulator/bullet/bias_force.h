// What moves the robot without drives, stops and contacts: gravity and what its own motion does.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bullet/mass_matrix.h"
#include "bullet/placed_body.h"

namespace limphome {

// The generalised force that would keep all velocities as they are: against gyroscopic and Coriolis forces, and against
// gravity [N, N m]. Acceleration without any other force: mass matrix^-1 * -bias_force. Recursive Newton-Euler
// algorithm (Featherstone 2008, 5.3), along the world's axes, each body about its own centre of mass.
GeneralVector bias_force(const std::vector<PlacedBody> &bodies, const GeneralVector &velocity,
                         const Eigen::Vector3d &gravity);

}  // namespace limphome
