// Robots, settings and measurements that the tests of the simulator share.
#pragma once

#include <robot_file.h>
#include <settings.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "bullet/sensors.h"
#include "bullet/truth.h"
#include "bullet/world.h"
#include "model/robot_model.h"

namespace limphome::laboratory {

enum { left, right, swing, boom, arm };

inline std::string robot_file() {
    return CONFIG_DIR "/crawler.urdf";
}

// Throws what reading found fault with, a line each.
inline RobotModel read_robot(const std::string &path) {
    robot_description robot;
    robot_report report;
    const bool good = robot_file_read(path.c_str(), nullptr, &robot, &report);
    std::string faults;
    for (int i = 0; i < report.num_faults; i++) {
        faults += std::string(report.faults[i]) + "\n";
    }
    robot_report_free(&report);
    return good ? make_model(robot) : throw std::runtime_error(faults);
}

inline RobotModel paper_robot() {
    return read_robot(robot_file());
}

inline settings with_failure(int64_t actuator, int64_t mode) {
    settings s = settings_default();
    s.failure.actuator = actuator;
    s.failure.mode = mode;
    return s;
}
inline settings left_locked() {
    return with_failure(SETTINGS_FAILED_LEFT, SETTINGS_LOCKED);
}
inline settings left_free() {
    return with_failure(SETTINGS_FAILED_LEFT, SETTINGS_FREE);
}
inline settings sound() {
    return with_failure(SETTINGS_FAILED_NONE, SETTINGS_LOCKED);
}

using Rates = std::array<double, max_actuators>;  // belt speeds [m/s], joint rates [rad/s]

inline void run(World &world, const Rates &rates, double seconds) {
    world.command(rates.data());
    const long steps = std::lround(seconds / world.time_step());
    for (long i = 0; i < steps; i++) {
        world.step();
    }
}

inline double heading(const World &world) {
    const Eigen::Matrix3d axes = world.robot().pose().linear();
    return std::atan2(axes(1, 0), axes(0, 0));
}

// Above 0 with the left side up.
inline double roll(const World &world) {
    const Eigen::Matrix3d axes = world.robot().pose().linear();
    return std::atan2(axes(2, 1), axes(2, 2));
}

inline Eigen::Vector3d position(const World &world) {
    return world.robot().pose().translation();
}

inline ground_truth_t truth(const World &world) {
    ground_truth_t t{};
    world.truth(t);
    return t;
}

// What exact sensors read.
inline robot_state_t state(const World &world) {
    robot_state_t s{};
    read_sensors(world.robot(), world.drives(), s);
    return s;
}

// Turning rate over some seconds under steady commands [rad/s].
inline double turning_rate(World &world, const Rates &rates, double seconds) {
    const double before = heading(world);
    run(world, rates, seconds);
    return (heading(world) - before) / seconds;
}

// Level ground seen from a robot that faces down a slope of this angle.
inline Eigen::Vector3d downhill(double angle) {
    return standard_gravity * Eigen::Vector3d(0, std::sin(angle), -std::cos(angle));
}

constexpr double degree = 0.017453292519943295;
constexpr double decision_period = 0.5;  // of the default settings [s]

}  // namespace limphome::laboratory
