// What is wrong with the robot's sensors: delay, bias, noise, and then the steps in which they read.
//
// Bias and noise are drawn from streams that depend on seed and episode alone. Speeds are read as late as angles, and
// so is the travel of the belts; they have no error of their own.
#pragma once

#include <settings.h>

#include <cstdint>
#include <limphome/robot_state_t.hpp>
#include <vector>

#include "model/random_stream.h"

namespace limphome {

class SensorErrors {
   public:
    explicit SensorErrors(const settings &configuration);

    // The robot has been reset, and its state is `exact`.
    void begin(int64_t episode, const robot_state_t &exact);
    // Whether every time step must be recorded.
    bool delayed() const { return history_.size() > 1; }
    void record(const robot_state_t &exact);
    // Turns the newest exact state into a reading. Every call draws new noise.
    void apply(robot_state_t &state);

   private:
    const robot_state_t &earlier(double delay, const robot_state_t &now) const;
    double read(double value, const settings_sensor &sensor, double bias);
    void read_attitude(double orientation[4]);

    settings settings_;
    RandomStream noise_;
    std::vector<double> position_bias_, attitude_bias_, joint_bias_, torque_bias_;
    std::vector<robot_state_t> history_;  // of the last time steps, as a ring; a single one if nothing is delayed
    std::size_t newest_ = 0;
    std::size_t recorded_ = 0;  // entries of the ring that are of this session
};

}  // namespace limphome
