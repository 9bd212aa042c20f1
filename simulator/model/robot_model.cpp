#include "model/robot_model.h"

#include <algorithm>
#include <limits>

namespace limphome {
namespace {

Eigen::Vector3d to_eigen(const double (&v)[3]) {
    return Eigen::Vector3d(v);
}

Eigen::Isometry3d to_eigen(const robot_pose &pose) {
    const double *q = pose.rotation;
    return Eigen::Translation3d(to_eigen(pose.position)) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

Body make_body(const robot_body &from) {
    Body body;
    body.name = from.name;
    body.parent = from.parent;
    body.joint = to_eigen(from.joint);
    body.axis = to_eigen(from.axis);
    body.mass = from.mass;
    body.centre = to_eigen(from.centre);
    for (int i = 0; i < 3; i++) {
        body.inertia.row(i) = to_eigen(from.inertia[i]);
    }
    return body;
}

Actuator make_actuator(const robot_actuator &from, bool crawler) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    return {from.name, crawler ? -infinite : from.lower, crawler ? infinite : from.upper, from.effort, from.speed,
            from.home};
}

}  // namespace

double RobotModel::mass() const {
    double sum = 0;
    for (const Body &body : bodies) {
        sum += body.mass;
    }
    return sum;
}

RobotModel make_model(const robot_description &robot) {
    RobotModel model;
    model.name = robot.name;
    for (int i = 0; i < robot.num_bodies; i++) {
        model.bodies.push_back(make_body(robot.bodies[i]));
    }
    for (int i = 0; i < robot.num_actuators; i++) {
        model.actuators.push_back(make_actuator(robot.actuators[i], i < num_crawlers));
    }
    for (const robot_crawler &c : robot.crawlers) {
        model.crawlers.push_back({to_eigen(c.centre), to_eigen(c.axis), c.length, c.width, c.radius});
    }
    for (int i = 0; i < robot.num_shapes; i++) {
        const robot_shape &s = robot.shapes[i];
        model.bodies[static_cast<std::size_t>(s.body)].shapes.push_back(
            {s.kind, to_eigen(s.pose), to_eigen(s.half_size)});
    }
    for (int i = 0; i < robot.num_shapes; i++) {
        model.solids.push_back({robot.shapes[i].body, -1, robot_solid_of_shape(&robot.shapes[i])});
    }
    for (int c = 0; c < num_crawlers; c++) {
        model.solids.push_back({0, c, robot_solid_of_belt(&robot.crawlers[c])});
    }
    std::copy(&robot.may_meet[0][0], &robot.may_meet[0][0] + sizeof robot.may_meet, &model.may_meet[0][0]);
    return model;
}

}  // namespace limphome
