#include "bullet/level_touch.h"

namespace limphome {
namespace {

constexpr double lying_flat = 1e-12;  // squared sine of the angle between a rim's axis and the vertical

void add_if_near(int shape, const Eigen::Vector3d &lowest, std::vector<Touch> &touches) {
    if (lowest.z() < touch_reach) {
        const Eigen::Vector3d middle(lowest.x(), lowest.y(), 0.5 * lowest.z());
        touches.push_back({shape, middle, Eigen::Vector3d::UnitZ(), -lowest.z()});
    }
}

void touch_rim(int shape, const PlacedBody &base, const Rim &rim, std::vector<Touch> &touches) {
    const Eigen::Vector3d centre = base.point(rim.centre);
    if (centre.z() - rim.radius > touch_reach) {
        return;
    }
    const Eigen::Vector3d axis = base.axes.lazyProduct(rim.axis);
    Eigen::Vector3d down = axis.z() * axis - Eigen::Vector3d::UnitZ();
    if (down.squaredNorm() < lying_flat) {
        down = axis.unitOrthogonal();  // all are as low
    }
    add_if_near(shape, centre + rim.radius * down.normalized(), touches);
}

}  // namespace

void level_touches(const Robot &robot, std::vector<Touch> &touches) {
    touches.clear();
    int shape = 0;
    for (const Rim &rim : robot.rims()) {
        touch_rim(shape++, robot.bodies()[0], rim, touches);
    }
    for (; shape < robot.first_solid(); shape++) {
        const auto [centre, radius] = robot.ball(shape);
        add_if_near(shape, centre - radius * Eigen::Vector3d::UnitZ(), touches);
    }
}

}  // namespace limphome
