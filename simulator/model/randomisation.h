// Robots, grounds and initial poses that differ a little from reset to reset.
#pragma once

#include <settings.h>

#include <cstdint>

#include "model/robot_model.h"

namespace limphome {

// Draws friction (for crawlers and for all else), the mass of each body and the torque limit of each drive, uniformly
// from the ranges that the settings give about what `model` and `configuration` hold. Depends on seed and episode
// alone.
void randomise(RobotModel &model, settings &configuration, int64_t episode);

// Where the robot is put.
struct Start {
    double x, y;     // [m]
    double heading;  // from the world's x axis [rad]
};

// Draws where the robot is put, uniformly about the origin and +y, and how it holds its arm: the home angles of
// `model`. Depends on seed and episode alone.
Start draw_start(RobotModel &model, const settings &configuration, int64_t episode);

}  // namespace limphome
