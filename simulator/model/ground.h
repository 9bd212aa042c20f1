// The ground: level, or an incline with rough ground, steps and loose patches on it, as far as the settings ask for
// them.
#pragma once

#include <settings.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>

namespace limphome {

constexpr double standard_gravity = 9.81;  // [m/s^2]

// Random values, uniform from `low` to below `high`, at the nodes of a square lattice without end. Each follows from
// the key and its node alone, so none is kept and nothing repeats itself.
class Lattice {
   public:
    Lattice(uint64_t key, double low, double high, double spacing)
        : key_(key), low_(low), step_((high - low) * 0x1p-53), spacing_(spacing) {}

    // Value and its derivatives along x and y, of the uniform cubic B-spline of the values: smooth, and within them.
    Eigen::Vector3d smooth(double x, double y) const;
    // Value of the cell that (x, y) lies in.
    double cell(double x, double y) const;

   private:
    // The spline from (column, row) to the next nodes: sum(factors(i, j) u^i v^j) at the shares u and v of the way.
    struct Window {
        int64_t column = std::numeric_limits<int64_t>::min(), row = 0;
        Eigen::Matrix4d factors;
    };
    static constexpr int64_t side = 8;

    double at(int64_t column, int64_t row) const;
    const Eigen::Matrix4d &factors(int64_t column, int64_t row) const;

    uint64_t key_;
    double low_, step_;
    double spacing_;                                   // [m]
    mutable std::array<Window, side * side> windows_;  // looked at last, to be quick; not for two threads at once
};

// A point against the ground.
struct Clearance {
    double distance;         // to the nearest point of the ground; below 0 inside it [m]
    Eigen::Vector3d normal;  // out of the ground there, unit
};

// It is the union of pieces, each without inner corners: incline and rough ground, and, if there are any, the raised
// strips between steps.
class Ground {
   public:
    explicit Ground(const settings &configuration);

    static constexpr int base_piece = 0;  // incline and rough ground

    int pieces() const { return step_height_ > 0 ? 2 : 1; }
    // Against one piece. Exact for inclines and steps, to first order over rough ground. Edges of steps are rounded.
    Clearance clearance(const Eigen::Vector3d &point, int piece) const;
    // Against all.
    Clearance clearance(const Eigen::Vector3d &point) const;

    // z = 0 everywhere; friction may still differ.
    bool level() const { return level_; }
    // Told at a glance: no piece is within `distance` of the point.
    bool is_far(const Eigen::Vector3d &point, double distance) const {
        return point.z() - slope_.dot(point.head<2>()) - amplitude_ > (step_height_ + distance) * longest_normal_;
    }
    // Height of the surface, seen from above [m].
    double height(double x, double y) const;
    // No point of the ground is higher above the incline [m].
    double highest() const { return highest_; }
    // The gradient of the base's height changes by no more than this per metre [1/m].
    double bend() const { return bend_; }
    // Unit normal of the incline.
    Eigen::Vector3d incline() const;
    // Share of the friction that is left.
    double friction(const Eigen::Vector3d &point) const;

   private:
    Clearance over_base(const Eigen::Vector3d &point) const;
    Clearance over_strips(const Eigen::Vector3d &point, const Clearance &base) const;

    bool level_;
    Eigen::Vector2d slope_;  // rise per metre along x and y
    double amplitude_, highest_, bend_;
    double longest_normal_;  // per its part upwards
    double step_height_, step_spacing_;
    bool rough_, patched_;
    double patch_share_, patch_friction_;
    Lattice bumps_;    // heights [m]
    Lattice patches_;  // loose where below the share
};

}  // namespace limphome
