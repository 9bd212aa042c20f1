#include "bullet/level_touch.h"

namespace limphome {
namespace {

constexpr double lying_flat = 1e-12;  // squared sine of the angle between a rim's axis and the vertical

void touch_balls(const BodyBalls &own, const PlacedBody &body, std::vector<Touch> &touches) {
    if (body.origin.z() - own.farthest >= touch_reach) {
        return;
    }
    int shape = own.first_shape;
    for (const Ball &ball : own.balls) {
        const double lowest = body.origin.z() + body.axes.row(2).dot(ball.centre) - ball.radius;
        if (lowest < touch_reach) {
            Eigen::Vector3d middle = body.point(ball.centre);
            middle.z() = 0.5 * lowest;
            touches.push_back({shape, middle, Eigen::Vector3d::UnitZ(), -lowest});
        }
        shape++;
    }
}

// From the middle of a circle about `axis` towards its lowest point, unit.
Eigen::Vector3d downwards(const Eigen::Vector3d &axis) {
    const Eigen::Vector3d down = axis.z() * axis - Eigen::Vector3d::UnitZ();
    return down.squaredNorm() > lying_flat ? down.normalized() : axis.unitOrthogonal();  // if flat all are as low
}

void touch_rims(const Robot &robot, std::vector<Touch> &touches) {
    const PlacedBody &base = robot.bodies()[0];
    const Eigen::Vector3d *axis = nullptr;
    Eigen::Vector3d down(0, 0, 0);
    int shape = 0;
    for (const Rim &rim : robot.rims()) {
        if (axis == nullptr || rim.axis != *axis) {  // those of a crawler have one in common
            axis = &rim.axis;
            down = downwards(base.axes * rim.axis);
        }
        Eigen::Vector3d point = base.point(rim.centre) + rim.radius * down;
        const double lowest = point.z();
        if (lowest < touch_reach) {
            point.z() = 0.5 * lowest;
            touches.push_back({shape, point, Eigen::Vector3d::UnitZ(), -lowest});
        }
        shape++;
    }
}

}  // namespace

void level_touches(const Robot &robot, std::vector<Touch> &touches) {
    touches.clear();
    touch_rims(robot, touches);
    for (const BodyBalls &own : robot.balls()) {
        touch_balls(own, robot.bodies()[static_cast<std::size_t>(own.body)], touches);
    }
}

}  // namespace limphome
