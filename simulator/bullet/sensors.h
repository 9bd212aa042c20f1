// What the robot's own sensors would tell if they were exact.
#pragma once

#include <limphome/robot_state_t.hpp>
#include <vector>

#include "bullet/robot.h"
#include "model/drive.h"

namespace limphome {

// Fills in num_actuators and all from position to actuator_effort.
void read_sensors(const Robot &robot, const std::vector<Drive> &drives, robot_state_t &state);

}  // namespace limphome
