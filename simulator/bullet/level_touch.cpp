#include "bullet/level_touch.h"

namespace limphome {
namespace {

constexpr double lying_flat = 1e-12;  // squared sine of the angle between a rim's axis and the vertical

void touch_ball(int shape, const PlacedBody &body, const Ball &ball, std::vector<Touch> &touches) {
    const double lowest = body.origin.z() + body.axes.row(2).dot(ball.centre) - ball.radius;
    if (lowest < touch_reach) {  // most are too high, which their height alone tells
        Eigen::Vector3d middle = body.point(ball.centre);
        middle.z() = 0.5 * lowest;
        touches.push_back({shape, middle, Eigen::Vector3d::UnitZ(), -lowest});
    }
}

// The lowest point of a circle.
void touch_rim(int shape, const PlacedBody &base, const Rim &rim, std::vector<Touch> &touches) {
    const Eigen::Vector3d axis = base.axes * rim.axis;
    Eigen::Vector3d down = axis.z() * axis - Eigen::Vector3d::UnitZ();
    if (down.squaredNorm() < lying_flat) {
        down = axis.unitOrthogonal();  // all are as low
    }
    Eigen::Vector3d point = base.point(rim.centre) + rim.radius * down.normalized();
    const double lowest = point.z();
    if (lowest < touch_reach) {
        point.z() = 0.5 * lowest;
        touches.push_back({shape, point, Eigen::Vector3d::UnitZ(), -lowest});
    }
}

}  // namespace

void level_touches(const Robot &robot, std::vector<Touch> &touches) {
    touches.clear();
    const std::vector<PlacedBody> &bodies = robot.bodies();
    int shape = 0;
    for (const Rim &rim : robot.rims()) {
        touch_rim(shape++, bodies[0], rim, touches);
    }
    for (const Ball &ball : robot.balls()) {
        const int part = robot.shapes()[static_cast<std::size_t>(shape)].part;
        touch_ball(shape++, bodies[static_cast<std::size_t>(part + 1)], ball, touches);
    }
}

}  // namespace limphome
