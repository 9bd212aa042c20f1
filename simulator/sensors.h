// What the robot's own sensors would tell if they were exact.
#pragma once

#include <limphome/robot_state_t.hpp>

#include "world.h"

namespace limphome {

// Fills all fields but utime, session, seq and lockstep.
void read_sensors(const World &world, robot_state_t &state);

}  // namespace limphome
