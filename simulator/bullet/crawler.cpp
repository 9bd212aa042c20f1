#include "bullet/crawler.h"

namespace limphome {
namespace {

constexpr double lying_flat = 1e-6;  // squared sine of the angle between sprocket and normal

}  // namespace

Eigen::Vector3d belt_direction(const Robot &robot, int crawler, const Eigen::Vector3d &normal) {
    const PlacedBody &sprocket = robot.bodies()[static_cast<std::size_t>(crawler) + 1];
    const Eigen::Vector3d along = sprocket.axis.cross(normal);
    // However the crawler is tilted, its belt keeps its speed.
    return along.squaredNorm() > lying_flat ? along.normalized() : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

Eigen::Vector3d belt_velocity(const Robot &robot, int crawler, const Eigen::Vector3d &direction,
                              const Eigen::Matrix3d &frame) {
    const double radius = robot.model().crawlers[static_cast<std::size_t>(crawler)].radius;
    return -radius * (frame.transpose() * direction);
}

}  // namespace limphome
