// How points of contact share what sticking friction does.
//
// Several points that stick can do the same in many ways: belts may pull against each other, or a belt's ends against
// its middle, without any effect on the motion. Coulomb's law leaves that open, and sweeps over the contacts leave in
// it what they happened to pass through. Belts and soil yield a little, and what yields shares by load: this finds the
// impulses that do the same at the least sum(|impulse|^2 / limit), in which nothing pulls against anything.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bullet/mass_matrix.h"

namespace limphome {

// A point of contact that sticks.
struct Grip {
    std::size_t contact;                          // whose it is
    Eigen::Matrix<double, max_dofs, 2> response;  // velocities per unit impulse along each tangent
    double limit;                                 // of the impulse: coefficient times normal impulse [N s]
    Eigen::Vector2d impulse;                      // [N s]
    Eigen::Vector2d relief;                       // room for share_grip()
};

// Changes the impulses, none beyond its limit, and reorders `grips`. Only the first `dofs` velocities respond; what the
// impulses make of them stays, but for what is less than 1e-5 of what they could.
template <int dofs>
void share_grip(std::vector<Grip> &grips);

}  // namespace limphome
