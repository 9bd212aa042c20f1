// What fails, how and when.
#pragma once

#include <settings.h>

#include <cstdint>
#include <vector>

#include "model/drive.h"
#include "model/robot_model.h"

namespace limphome {

struct Failure {
    int actuator;
    DriveCondition condition;
    double left;      // share of what it takes away: of a weak drive's torque limit, a slipping crawler's friction
    double time;      // since the reset [s]
    int64_t episode;  // resets before this one leave it out

    // Told with the first state; what fails later, be it in the first step, is an actuator that the controller counts
    // on.
    bool from_the_start() const { return time == 0 && episode == 0; }
};

// Throws std::runtime_error if the robot does not have that joint.
std::vector<Failure> planned_failures(const settings &configuration, const RobotModel &model);

}  // namespace limphome
