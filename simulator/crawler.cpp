#include "crawler.h"

namespace limphome {

Eigen::Vector3d belt_direction(const Robot &robot, int crawler, const Eigen::Vector3d &normal) {
    return joint_axis(robot.multibody(), crawler).direction.cross(normal);
}

void add_belt(const Robot &robot, int crawler, Contact &contact) {
    const Eigen::Vector3d direction = belt_direction(robot, crawler, contact.frame.col(0));
    const double radius = robot.model().crawlers[static_cast<std::size_t>(crawler)].radius;
    contact.jacobian.row(6 + crawler) -= radius * (contact.frame.transpose() * direction).transpose();
}

}  // namespace limphome
