#include "can_robot.h"

#include <plant/link.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

// Identifiers: what it is, plus the node.
enum : unsigned { measurement = 0x180, velocity_command = 0x200, heartbeat = 0x700, of_node = 0x7F };
constexpr int imu_node = 16;
constexpr int crawlers = 2;
enum Condition : uint8_t { obeys = 0, failed = 1, weak = 2, no_power = 3 };

constexpr double milli = 1e-3;        // velocity: mm/s, mrad/s
constexpr double tenth_milli = 1e-4;  // position: 0.1 mm, 0.1 mrad
constexpr double unit_turn = 1.0 / 32767;
constexpr double command_each = 0.02;  // [s]
constexpr double tell_each = 5;        // what it waits for [s]

int16_t int16_at(const Frame &frame, int byte) {
    return static_cast<int16_t>(frame.data[byte] | frame.data[byte + 1] << 8);
}

int32_t int32_at(const Frame &frame, int byte) {
    uint32_t value = 0;
    for (int i = 3; i >= 0; i--) {
        value = value << 8 | frame.data[byte + i];
    }
    return static_cast<int32_t>(value);
}

}  // namespace

CanRobot::CanRobot(CanBus &bus, int num_actuators, double silence, const volatile std::sig_atomic_t *stop)
    : bus_(bus), num_actuators_(num_actuators), silence_(silence), stop_(stop) {
    await();
}

CanRobot::Node *CanRobot::node(int number) {
    if (number == imu_node) {
        return &imu_;
    }
    return number >= 1 && number <= num_actuators_ ? &motors_[static_cast<size_t>(number - 1)] : nullptr;
}

void CanRobot::take_measurement(int number, const Frame &frame) {
    if (number == imu_node) {
        for (int i = 0; i < 4; i++) {
            imu_.orientation[i] = int16_at(frame, 2 * i) * unit_turn;
        }
    } else {
        Motor &motor = motors_[static_cast<size_t>(number - 1)];
        motor.position = int32_at(frame, 0) * tenth_milli;
        motor.velocity = int16_at(frame, 4) * milli;
        motor.torque = int16_at(frame, 6);
    }
}

// What is of no known node or of another length is somebody else's.
void CanRobot::take(const Frame &frame) {
    const int number = static_cast<int>(frame.id & of_node);
    Node *from = node(number);
    const unsigned kind = frame.id & ~of_node;
    if (from == nullptr) {
        return;
    }
    if (kind == measurement && frame.size == 8) {
        take_measurement(number, frame);
        from->measured = limphome::monotonic_now();
    } else if (kind == heartbeat && frame.size == 1) {
        from->condition = frame.data[0];
        from->alive = limphome::monotonic_now();
    }
}

void CanRobot::listen() {
    Frame frame{};
    for (int most = 256; most > 0 && bus_.receive(frame); most--) {
        take(frame);
    }
}

std::string CanRobot::missing() const {
    const double now = limphome::monotonic_now();
    const auto lacks = [&](const Node &node) -> const char * {
        if (now - node.measured > silence_ || now - node.alive > 5 * silence_) {  // heartbeats are a fifth as many
            return "is silent";
        }
        return node.condition == no_power ? "has no power" : nullptr;
    };
    for (int a = 0; a < num_actuators_; a++) {
        if (const char *what = lacks(motors_[static_cast<size_t>(a)])) {
            return "motor " + std::to_string(a + 1) + " " + what;
        }
    }
    const char *what = lacks(imu_);
    return what != nullptr ? std::string("the IMU ") + what : "";
}

// A person may be needed: it says what it waits for.
void CanRobot::await() {
    double told = 0;
    for (std::string what; *stop_ == 0; listen()) {
        what = missing();
        if (what.empty()) {
            break;
        }
        if (limphome::monotonic_now() - told >= tell_each) {
            told = limphome::monotonic_now();
            std::fprintf(stderr, "waiting: %s\n", what.c_str());
        }
        const timespec pause{0, 5'000'000};
        nanosleep(&pause, nullptr);
    }
    lost_ = false;
    for (int c = 0; c < crawlers; c++) {  // a node that starts anew counts from 0
        reckoned_[c] = motors_[static_cast<size_t>(c)].position;
    }
}

void CanRobot::reset(int64_t /*episode*/) {
    await();
}

// Where something is lost the others stop at once; the loop learns of it at the end of its period.
void CanRobot::command(const double velocity[limphome::max_actuators]) {
    listen();
    reckon();
    const std::string what = lost_ ? "" : missing();
    if (!what.empty()) {
        std::fprintf(stderr, "%s: all motors stop\n", what.c_str());
        lost_ = true;
    }
    std::array<double, limphome::max_actuators> wanted{};
    if (!lost_) {
        std::copy(velocity, velocity + num_actuators_, wanted.begin());
    }
    const double now = limphome::monotonic_now();
    if (wanted == commanded_ && now - sent_ < command_each) {
        return;
    }
    for (int a = 0; a < num_actuators_; a++) {
        const double most = 32767 * milli;
        const auto units =
            static_cast<int16_t>(std::lround(std::clamp(wanted[static_cast<size_t>(a)], -most, most) / milli));
        const auto bits = static_cast<uint16_t>(units);
        bus_.send(Frame{static_cast<uint16_t>(velocity_command + static_cast<unsigned>(a) + 1),
                        2,
                        {static_cast<uint8_t>(bits & 0xFF), static_cast<uint8_t>(bits >> 8)}});
    }
    commanded_ = wanted;
    sent_ = now;
}

// Nothing measures where the robot is. It is taken to go where it faces, as far as the belts of the crawlers that obey:
// good enough to steer by and to see that it gets on (docs/real_robot.md).
void CanRobot::reckon() {
    double ahead = 0;
    int obeying = 0;
    for (int c = 0; c < crawlers; c++) {
        const Motor &motor = motors_[static_cast<size_t>(c)];
        if (health(c) != limphome::Health::failed) {
            ahead += motor.position - reckoned_[c];
            obeying++;
        }
        reckoned_[c] = motor.position;
    }
    const auto &[w, x, y, z] = imu_.orientation;
    const double heading = std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
    place_[0] += ahead / std::max(obeying, 1) * std::cos(heading);
    place_[1] += ahead / std::max(obeying, 1) * std::sin(heading);
}

void CanRobot::fill(limphome::robot_state_t &state) const {
    state.utime = std::llround(limphome::monotonic_now() * 1e6);
    state.num_actuators = num_actuators_;
    std::copy(place_, place_ + 2, state.position);
    std::copy(imu_.orientation, imu_.orientation + 4, state.orientation);
    for (int a = 0; a < num_actuators_; a++) {
        const Motor &motor = motors_[static_cast<size_t>(a)];
        state.actuator_position[a] = motor.position;
        state.actuator_velocity[a] = motor.velocity;
        state.actuator_effort[a] = motor.torque;
    }
}

void CanRobot::sense(limphome::robot_state_t &state) {
    listen();
    reckon();
    fill(state);
}

bool CanRobot::exact(limphome::robot_state_t &state) const {
    fill(state);
    return true;
}

limphome::Health CanRobot::health(int actuator) const {
    switch (motors_[static_cast<size_t>(actuator)].condition) {
        case obeys:
            return limphome::Health::obeys;
        case weak:
            return limphome::Health::weak;
        default:
            return limphome::Health::failed;
    }
}
