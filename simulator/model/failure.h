// What fails, how and when.
#pragma once

#include <settings.h>

#include <vector>

#include "model/drive.h"
#include "model/robot_model.h"

namespace limphome {

struct Failure {
    int actuator;
    DriveCondition condition;
    double weak_factor;  // of a weak drive: share of its torque limit that is left
    double slip_factor;  // of a slipping crawler: share of its friction that is left
    double time;         // since the reset [s]
};

// Throws std::runtime_error if the robot does not have that joint.
std::vector<Failure> planned_failures(const settings &configuration, const RobotModel &model);

}  // namespace limphome
