// The law of friction at a contact.
#pragma once

#include <Eigen/Core>

namespace limphome {

// What the law knows of the two tangents of a contact.
struct Tangents {
    Eigen::Matrix2d sticking;  // impulse per velocity that ends it: inverse of the tangential block
    double slip_step;          // impulse per slip velocity in the projection, the same for all directions [kg]
};

// Coulomb's law: the impulse is at most `limit`, the coefficient times the normal impulse; while it is less there is no
// slip, and where there is slip it opposes it. From the impulse so far and the slip that it leaves, the next one.
//
// Stick if friction is able to hold. Else project onto its limit: with the same step for all directions this is at rest
// only where friction opposes the slip, which clamping each direction by its own effective mass is not.
inline Eigen::Vector2d friction_impulse(const Tangents &tangents, const Eigen::Vector2d &friction,
                                        const Eigen::Vector2d &slip, double limit) {
    Eigen::Vector2d wanted = friction - tangents.sticking * slip;
    if (wanted.squaredNorm() > limit * limit) {
        wanted = friction - tangents.slip_step * slip;
        const double size = wanted.norm();
        if (size > limit) {
            wanted *= limit / size;
        }
    }
    return wanted;
}

}  // namespace limphome
