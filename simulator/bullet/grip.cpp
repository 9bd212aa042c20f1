#include "bullet/grip.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace limphome {
namespace {

// Points that differ in height by a millimetre could tip the robot by pulling against each other, hard and to no avail.
// Effects this small beside those of all impulses do not count [-].
constexpr double negligible = 1e-5;

// Sets the reliefs of the first `count`: what leads them to their share.
template <int dofs>
void find_reliefs(std::vector<Grip> &grips, std::size_t count) {
    using Square = Eigen::Matrix<double, dofs, dofs>;
    using Vector = Eigen::Matrix<double, dofs, 1>;
    Square mobility = Square::Zero();
    Vector wanted = Vector::Zero();
    for (std::size_t i = 0; i < count; i++) {
        const Eigen::Matrix<double, dofs, 2> response = grips[i].response.template topRows<dofs>();
        mobility += grips[i].limit * response.lazyProduct(response.transpose());
        wanted += response.lazyProduct(grips[i].impulse);
    }
    Square bounded = mobility;
    // above 0 even if nothing moves
    bounded.diagonal().array() += negligible * mobility.trace() + std::numeric_limits<double>::min();
    const Eigen::LLT<Square> inverse(bounded);
    Vector pull = inverse.solve(wanted);                         // of all points per limit, seen from each velocity
    const Vector missing = wanted - mobility.lazyProduct(pull);  // of the effects that do count
    pull += inverse.solve(missing);
    for (std::size_t i = 0; i < count; i++) {
        Grip &grip = grips[i];
        grip.relief = grip.limit * grip.response.template topRows<dofs>().transpose().lazyProduct(pull) - grip.impulse;
    }
}

// The part of its relief that a grip may take before it is at its limit.
double largest_part(const Grip &grip) {
    const double room = grip.limit * grip.limit - grip.impulse.squaredNorm();
    const double along = grip.impulse.dot(grip.relief), size = grip.relief.squaredNorm();
    if (size + 2 * along <= room) {
        return 1;
    }
    return std::max(0.0, (std::sqrt(std::max(0.0, along * along + size * room)) - along) / size);
}

}  // namespace

// All move towards their share until one is at its limit, and then those without it.
template <int dofs>
void share_grip(std::vector<Grip> &grips) {
    for (std::size_t count = grips.size(); count > 0;) {
        find_reliefs<dofs>(grips, count);
        double part = 1;
        std::size_t blocked = count;
        for (std::size_t i = 0; i < count; i++) {
            const double own = largest_part(grips[i]);
            if (own < part) {
                part = own;
                blocked = i;
            }
        }
        for (std::size_t i = 0; i < count; i++) {
            grips[i].impulse += part * grips[i].relief;
        }
        if (blocked == count) {
            return;
        }
        count--;
        std::swap(grips[blocked], grips[count]);
    }
}

template void share_grip<base_dofs>(std::vector<Grip> &);
template void share_grip<base_dofs + num_crawlers>(std::vector<Grip> &);
template void share_grip<max_dofs>(std::vector<Grip> &);

}  // namespace limphome
