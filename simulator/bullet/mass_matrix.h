// Inertia of the robot in generalised coordinates.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bullet/placed_body.h"

namespace limphome {

// Velocities of the robot: base angular, base linear (of its centre of mass), both along the world's
// axes, then joint rates. Unused entries are 0; the fixed size lets the compiler use vector instructions.
constexpr int base_dofs = 6;
constexpr int max_dofs = base_dofs + max_actuators;
using GeneralVector = Eigen::Matrix<double, max_dofs, 1>;
using GeneralMatrix = Eigen::Matrix<double, max_dofs, max_dofs>;

// Index of the rate of the joint that a body hangs on.
inline int joint_dof(std::size_t body) {
    return base_dofs + static_cast<int>(body) - 1;
}

// Maps velocities to momenta. Composite rigid body algorithm (Featherstone 2008, 6.2).
GeneralMatrix mass_matrix(const std::vector<PlacedBody> &bodies);

// Inverse of the base block of a mass matrix: velocities of the base per impulse on it while all joints are rigid.
// All other entries are 0.
GeneralMatrix rigid_inverse(const GeneralMatrix &mass);

}  // namespace limphome
