// Where the robot touches level ground, the plane z = 0, or is about to.
#pragma once

#include <vector>

#include "bullet/robot.h"
#include "bullet/touch.h"

namespace limphome {

// Fills `touches` ordered by shape: the lowest point of every ball and of every rim that is near.
void level_touches(const Robot &robot, std::vector<Touch> &touches);

}  // namespace limphome
