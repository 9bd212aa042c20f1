#include "model/ground.h"

#include <cmath>

#include "model/random_stream.h"

namespace limphome {
namespace {

constexpr double edge_radius = 0.03;  // of steps [m]

// A bijection in which each bit of the input changes each bit of the output as often as not (Stafford 2011, variant
// 13).
uint64_t scatter(uint64_t x) {
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
    x = (x ^ x >> 27) * 0x94d049bb133111ebU;
    return x ^ x >> 31;
}

// Weights of four nodes in a row, and their derivatives, at the share `t` of the way from the second to the third.
Eigen::Vector4d weights(double t) {
    const double u = 1 - t;
    return Eigen::Vector4d(u * u * u, 3 * t * t * t - 6 * t * t + 4, 3 * u * u * u - 6 * u * u + 4, t * t * t) / 6;
}
Eigen::Vector4d weight_rates(double t) {
    const double u = 1 - t;
    return Eigen::Vector4d(-u * u, 3 * t * t - 4 * t, 4 * u - 3 * u * u, t * t) / 2;
}

}  // namespace

// Large odd factors give each node a word of its own.
double Lattice::at(int64_t column, int64_t row) const {
    const uint64_t node =
        0x9e3779b97f4a7c15U * static_cast<uint64_t>(column) + 0xd1342543de82ef95U * static_cast<uint64_t>(row);
    return low_ + step_ * static_cast<double>(scatter(key_ ^ node) >> 11);
}

const Eigen::Matrix4d &Lattice::around(int64_t column, int64_t row) const {
    Window &window = windows_[static_cast<std::size_t>((row & (side - 1)) * side + (column & (side - 1)))];
    if (window.column != column || window.row != row) {
        window.column = column;
        window.row = row;
        for (int j = 0; j < 4; j++) {
            for (int i = 0; i < 4; i++) {
                window.nodes(i, j) = at(column + i - 1, row + j - 1);
            }
        }
    }
    return window.nodes;
}

Eigen::Vector3d Lattice::smooth(double x, double y) const {
    const double column = std::floor(x / spacing_), row = std::floor(y / spacing_);
    const double tx = x / spacing_ - column, ty = y / spacing_ - row;
    const Eigen::Matrix4d &nodes = around(static_cast<int64_t>(column), static_cast<int64_t>(row));
    const Eigen::Vector4d along = weights(ty), sums = nodes * along;
    const Eigen::Vector4d across = weights(tx);
    return {across.dot(sums), weight_rates(tx).dot(sums) / spacing_, across.dot(nodes * weight_rates(ty)) / spacing_};
}

double Lattice::cell(double x, double y) const {
    return at(static_cast<int64_t>(std::floor(x / spacing_)), static_cast<int64_t>(std::floor(y / spacing_)));
}

Ground::Ground(const settings &s)
    : level_(s.ground.incline_along_rad == 0 && s.ground.incline_across_rad == 0 && s.ground.rough_amplitude_m == 0 &&
             s.ground.step_height_m == 0),
      slope_(std::tan(s.ground.incline_across_rad), std::tan(s.ground.incline_along_rad)),
      highest_(s.ground.rough_amplitude_m + s.ground.step_height_m),
      step_height_(s.ground.step_height_m),
      step_spacing_(s.ground.step_spacing_m),
      rough_(s.ground.rough_amplitude_m > 0),
      patched_(s.ground.patch_share > 0),
      patch_share_(s.ground.patch_share),
      patch_friction_(s.ground.patch_friction),
      bumps_(RandomStream(s.ground.seed, Purpose::rough_ground).bits(), -s.ground.rough_amplitude_m,
             s.ground.rough_amplitude_m, 0.5 * s.ground.rough_wavelength_m),
      patches_(RandomStream(s.ground.seed, Purpose::patches).bits(), 0, 1, s.ground.patch_size_m) {}

Eigen::Vector3d Ground::incline() const {
    return Eigen::Vector3d(-slope_.x(), -slope_.y(), 1).normalized();
}

// Incline and rough ground: the height above it, taken along its normal.
Clearance Ground::over_base(const Eigen::Vector3d &point) const {
    Eigen::Vector3d surface(slope_.dot(point.head<2>()), slope_.x(), slope_.y());
    if (rough_) {
        surface += bumps_.smooth(point.x(), point.y());
    }
    const Eigen::Vector3d upright(-surface[1], -surface[2], 1);
    const double length = upright.norm();
    return {(point.z() - surface[0]) / length, upright / length};
}

// Every other strip across the way is raised, the one at the origin is not. In the plane of y and the base's normal, a
// raised strip is a box with rounded edges.
Clearance Ground::over_strips(const Eigen::Vector3d &point, const Clearance &base) const {
    const double place = std::remainder(point.y(), 2 * step_spacing_);  // from the middle of the nearest low strip
    const Eigen::Vector3d forward = Eigen::Vector3d::UnitY() - base.normal.y() * base.normal;  // uphill or not
    const double outside = (0.5 * step_spacing_ - std::abs(place)) / forward.norm();  // of the riser, along the base
    const Eigen::Vector3d outward = (place > 0 ? -1 : 1) * forward.normalized();

    const double radius = std::min(edge_radius, step_height_);
    const Eigen::Vector2d from_edge(outside + radius, base.distance - step_height_ + radius);
    const double inside = std::min(from_edge.maxCoeff(), 0.0);
    const double distance = from_edge.cwiseMax(0).norm() + inside - radius;
    if (from_edge.minCoeff() > 0) {
        return {distance, (from_edge[0] * outward + from_edge[1] * base.normal).normalized()};
    }
    return {distance, from_edge[0] > from_edge[1] ? outward : base.normal};
}

Clearance Ground::clearance(const Eigen::Vector3d &point, int piece) const {
    const Clearance base = over_base(point);
    return piece == 0 ? base : over_strips(point, base);
}

Clearance Ground::clearance(const Eigen::Vector3d &point) const {
    Clearance base = over_base(point);
    if (pieces() == 1) {
        return base;
    }
    const Clearance strips = over_strips(point, base);
    return base.distance < strips.distance ? base : strips;
}

// Down from above all ground, each time as far as it is free.
double Ground::height(double x, double y) const {
    constexpr double near = 1e-9;  // [m]
    constexpr int most_steps = 1000;
    Eigen::Vector3d point(x, y, slope_.dot(Eigen::Vector2d(x, y)) + highest_ / incline().z() + 1);
    for (int i = 0; i < most_steps; i++) {
        const double distance = clearance(point).distance;
        point.z() -= distance;
        if (std::abs(distance) < near) {
            break;
        }
    }
    return point.z();
}

double Ground::friction(const Eigen::Vector3d &point) const {
    return patched_ && patches_.cell(point.x(), point.y()) < patch_share_ ? patch_friction_ : 1;
}

}  // namespace limphome
