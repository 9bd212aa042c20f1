#include "model/sensor_errors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/robot_model.h"

namespace limphome {
namespace {

std::size_t steps(double delay, const settings &s) {
    return static_cast<std::size_t>(std::lround(delay / s.simulator.time_step_s));
}

std::size_t longest_delay(const settings &s) {
    const auto &sensors = s.sensors;
    return steps(
        std::max({sensors.attitude.delay_s, sensors.position.delay_s, sensors.joint.delay_s, sensors.torque.delay_s}),
        s);
}

std::vector<double> draw(RandomStream &stream, double bias, std::size_t count) {
    std::vector<double> values(count);
    std::generate(values.begin(), values.end(), [&] { return bias * stream.uniform(-1, 1); });
    return values;
}

}  // namespace

SensorErrors::SensorErrors(const settings &configuration)
    : settings_(configuration),
      noise_(configuration.learning.seed, Purpose::sensor_noise),
      history_(longest_delay(configuration) + 1) {
    begin(0, robot_state_t{});
}

void SensorErrors::begin(int64_t episode, const robot_state_t &exact) {
    noise_ = RandomStream(settings_.learning.seed, Purpose::sensor_noise, episode);
    RandomStream stream(settings_.learning.seed, Purpose::sensor_bias, episode);
    position_bias_ = draw(stream, settings_.sensors.position.bias, 3);
    attitude_bias_ = draw(stream, settings_.sensors.attitude.bias, 3);
    joint_bias_ = draw(stream, settings_.sensors.joint.bias, max_actuators);
    torque_bias_ = draw(stream, settings_.sensors.torque.bias, max_actuators);
    recorded_ = 0;
    record(exact);
}

void SensorErrors::record(const robot_state_t &exact) {
    newest_ = (newest_ + 1) % history_.size();
    history_[newest_] = exact;
    recorded_ = std::min(recorded_ + 1, history_.size());
}

// Before the first state there is nothing: that one is read until it is old enough.
const robot_state_t &SensorErrors::earlier(double delay, const robot_state_t &now) const {
    const std::size_t age = std::min(steps(delay, settings_), recorded_ - 1);
    return age == 0 ? now : history_[(newest_ + history_.size() - age) % history_.size()];
}

double SensorErrors::read(double value, const settings_sensor &sensor, double bias) {
    value += bias;
    if (sensor.noise > 0) {
        value += sensor.noise * noise_.normal();
    }
    return sensor.quantum > 0 ? sensor.quantum * std::round(value / sensor.quantum) : value;
}

void SensorErrors::read_attitude(double orientation[4]) {
    const settings_sensor &sensor = settings_.sensors.attitude;
    if (sensor.noise == 0 && sensor.bias == 0 && sensor.quantum == 0) {
        return;
    }
    const Eigen::Matrix3d axes =
        Eigen::Quaterniond(orientation[0], orientation[1], orientation[2], orientation[3]).toRotationMatrix();
    const double roll = read(std::atan2(axes(2, 1), axes(2, 2)), sensor, attitude_bias_[0]);
    const double pitch = read(std::asin(std::clamp(-axes(2, 0), -1.0, 1.0)), sensor, attitude_bias_[1]);
    const double heading = read(std::atan2(axes(1, 0), axes(0, 0)), sensor, attitude_bias_[2]);
    const Eigen::Quaterniond read = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
    orientation[0] = read.w();
    orientation[1] = read.x();
    orientation[2] = read.y();
    orientation[3] = read.z();
}

void SensorErrors::apply(robot_state_t &state) {
    const auto &sensors = settings_.sensors;
    const robot_state_t now = state;
    const robot_state_t &position = earlier(sensors.position.delay_s, now);
    const robot_state_t &attitude = earlier(sensors.attitude.delay_s, now);
    const robot_state_t &joints = earlier(sensors.joint.delay_s, now);
    const robot_state_t &torques = earlier(sensors.torque.delay_s, now);
    for (std::size_t i = 0; i < 3; i++) {
        state.position[i] = read(position.position[i], sensors.position, position_bias_[i]);
    }
    std::copy(attitude.orientation, attitude.orientation + 4, state.orientation);
    read_attitude(state.orientation);
    for (std::size_t a = 0; a < static_cast<std::size_t>(state.num_actuators); a++) {
        const bool crawler = a < num_crawlers;
        state.actuator_position[a] =
            crawler ? joints.actuator_position[a] : read(joints.actuator_position[a], sensors.joint, joint_bias_[a]);
        state.actuator_velocity[a] = joints.actuator_velocity[a];
        state.actuator_effort[a] = read(torques.actuator_effort[a], sensors.torque, torque_bias_[a]);
    }
}

}  // namespace limphome
