// Inertia of the robot in generalised coordinates.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <Eigen/Core>

#include "model/robot_model.h"

namespace limphome {

// Velocities of the robot in Bullet's order: base angular, base linear (of its centre of mass), both along the world's
// axes, then joint rates. Unused entries are 0; the fixed size lets the compiler use vector instructions.
constexpr int base_dofs = 6;
constexpr int max_dofs = base_dofs + max_actuators;
using GeneralVector = Eigen::Matrix<double, max_dofs, 1>;
using GeneralMatrix = Eigen::Matrix<double, max_dofs, max_dofs>;

// Axis of a revolute joint and a point on it, in the world.
struct JointAxis {
    Eigen::Vector3d direction;
    Eigen::Vector3d pivot;  // [m]
};
JointAxis joint_axis(const btMultiBody &multibody, int joint);

// Maps velocities to momenta. Link frames must be up to date. Composite rigid body algorithm (Featherstone 2008, 6.2).
GeneralMatrix mass_matrix(const btMultiBody &multibody);

// Inverse of the base block of a mass matrix: velocities of the base per impulse on it while all joints are rigid.
// All other entries are 0.
GeneralMatrix rigid_inverse(const GeneralMatrix &mass);

// Those of a multibody; 0 for degrees of freedom that it has not.
GeneralVector velocities(const btMultiBody &multibody);

// [J]
double kinetic_energy(const btMultiBody &multibody);

}  // namespace limphome
