// A robot whose motor controllers and IMU are nodes on a CAN bus, as a machine. The frames: README.md beside this file.
#pragma once

#include <plant/machine.h>

#include <array>
#include <csignal>
#include <string>

#include "can_bus.h"

class CanRobot final : public limphome::Machine {
   public:
    // Motors are nodes 1 to num_actuators, in the order of the robot's actuators. A node that says nothing for
    // `silence` [s] is lost. Waits until all have spoken, or *stop.
    CanRobot(CanBus &bus, int num_actuators, double silence, const volatile std::sig_atomic_t *stop);

    int num_actuators() const override { return num_actuators_; }
    // It stands where it is: a reset comes only after a fault, and waits until all nodes are there, with power.
    bool can_be_carried_back() const override { return false; }
    void reset(int64_t episode) override;
    // Called each 10 ms: also where the bus is heard.
    void command(const double velocity[limphome::max_actuators]) override;
    void sense(limphome::robot_state_t &state) override;
    // The newest readings, for who looks on, 30 times a second.
    bool exact(limphome::robot_state_t &state) const override;
    limphome::Health health(int actuator) const override;
    // A node was lost, or has no power: the emergency stop is pressed.
    bool diverged() const override { return lost_; }

   private:
    struct Node {
        double measured = 0;  // when it told its newest measurement [s, monotonic]; 0: never
        double alive = 0;     // when its newest heartbeat came
        uint8_t condition = 0;
    };
    struct Motor : Node {
        double position = 0, velocity = 0, torque = 0;  // [m, m/s, N*m] or [rad, rad/s, N*m]
    };
    struct Imu : Node {
        double orientation[4] = {1, 0, 0, 0};  // body to world: w, x, y, z
    };

    void listen();
    void take(const Frame &frame);
    void take_measurement(int node, const Frame &frame);
    Node *node(int number);
    // The first that is lost or without power, in words; empty: all is well.
    std::string missing() const;
    void await();
    void reckon();
    void fill(limphome::robot_state_t &state) const;

    CanBus &bus_;
    const int num_actuators_;
    const double silence_;
    const volatile std::sig_atomic_t *stop_;
    std::array<Motor, limphome::max_actuators> motors_{};
    Imu imu_;
    std::array<double, limphome::max_actuators> commanded_{};
    double place_[2] = {0, 0};     // where it is by dead reckoning [m]
    double reckoned_[2] = {0, 0};  // travel of the crawlers up to there [m]
    double sent_ = 0;              // when all commands went out last [s, monotonic]
    bool lost_ = false;
};
