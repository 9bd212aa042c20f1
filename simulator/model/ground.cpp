#include "model/ground.h"

#include <cmath>

#include "model/random_stream.h"

namespace limphome {
namespace {

constexpr double edge_radius = 0.03;  // of steps [m]
// Largest norm that the second derivatives of the spline can have, per size of its values and spacing^2; at a node,
// where the sums of its weights' second derivatives are 4 and those of the first are 1.
constexpr double most_bend = 5;
// Largest gradient that it can have, per size of its values and spacing: along each axis the sum of the weights' first
// derivatives is 1.5 at most.
constexpr double steepest = 1.5 * M_SQRT2;

// A bijection in which each bit of the input changes each bit of the output as often as not (Stafford 2011, variant
// 13).
uint64_t scatter(uint64_t x) {
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
    x = (x ^ x >> 27) * 0x94d049bb133111ebU;
    return x ^ x >> 31;
}

// The largest whole number that is not above x; std::floor is a call.
int64_t whole(double x) {
    const auto towards_zero = static_cast<int64_t>(x);
    return towards_zero - (static_cast<double>(towards_zero) > x ? 1 : 0);
}

// Factors of u^i in the weights of four nodes in a row, one a column, at the share u of the way from the second to the
// third.
Eigen::Matrix4d spline_factors() {
    Eigen::Matrix4d factors;
    factors << 1, 4, 1, 0, -3, 0, 3, 0, 3, -6, 3, 0, -1, 3, -3, 1;
    return factors / 6;
}

}  // namespace

// Large odd factors give each node a word of its own.
double Lattice::at(int64_t column, int64_t row) const {
    const uint64_t node =
        0x9e3779b97f4a7c15U * static_cast<uint64_t>(column) + 0xd1342543de82ef95U * static_cast<uint64_t>(row);
    return low_ + step_ * static_cast<double>(scatter(key_ ^ node) >> 11);
}

const Eigen::Matrix4d &Lattice::factors(int64_t column, int64_t row) const {
    Window &window = windows_[static_cast<std::size_t>((row & (side - 1)) * side + (column & (side - 1)))];
    if (window.column != column || window.row != row) {
        static const Eigen::Matrix4d spline = spline_factors();
        window.column = column;
        window.row = row;
        Eigen::Matrix4d nodes;
        for (int j = 0; j < 4; j++) {
            for (int i = 0; i < 4; i++) {
                nodes(i, j) = at(column + i - 1, row + j - 1);
            }
        }
        window.factors = spline * nodes * spline.transpose();
    }
    return window.factors;
}

Eigen::Vector3d Lattice::smooth(double x, double y) const {
    const double across_nodes = x / spacing_, along_nodes = y / spacing_;
    const int64_t column = whole(across_nodes), row = whole(along_nodes);
    const double u = across_nodes - static_cast<double>(column), v = along_nodes - static_cast<double>(row);
    const Eigen::Matrix4d &f = factors(column, row);
    // polynomials in u of which the value and its derivative along v are made
    const Eigen::Vector4d value = f.col(0) + v * (f.col(1) + v * (f.col(2) + v * f.col(3)));
    const Eigen::Vector4d rate = f.col(1) + v * (2 * f.col(2) + (3 * v) * f.col(3));
    return {value[0] + u * (value[1] + u * (value[2] + u * value[3])),
            (value[1] + u * (2 * value[2] + 3 * u * value[3])) / spacing_,
            (rate[0] + u * (rate[1] + u * (rate[2] + u * rate[3]))) / spacing_};
}

double Lattice::cell(double x, double y) const {
    return at(static_cast<int64_t>(std::floor(x / spacing_)), static_cast<int64_t>(std::floor(y / spacing_)));
}

Ground::Ground(const settings &s)
    : level_(s.ground.incline_along_rad == 0 && s.ground.incline_across_rad == 0 && s.ground.rough_amplitude_m == 0 &&
             s.ground.step_height_m == 0),
      slope_(std::tan(s.ground.incline_across_rad), std::tan(s.ground.incline_along_rad)),
      amplitude_(s.ground.rough_amplitude_m),
      highest_(s.ground.rough_amplitude_m + s.ground.step_height_m),
      bend_(most_bend * s.ground.rough_amplitude_m / std::pow(0.5 * s.ground.rough_wavelength_m, 2)),
      longest_normal_(
          std::hypot(1, slope_.norm() + steepest * s.ground.rough_amplitude_m / (0.5 * s.ground.rough_wavelength_m))),
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
    const Clearance over = over_base(point);
    return piece == base_piece ? over : over_strips(point, over);
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
