#include "model/failure.h"

#include <stdexcept>
#include <string>

namespace limphome {
namespace {

DriveCondition condition(settings_failure_mode mode) {
    switch (mode) {
        case SETTINGS_LOCKED:
            return DriveCondition::locked;
        case SETTINGS_FREE:
            return DriveCondition::free;
        case SETTINGS_SLIPPING:
            return DriveCondition::slipping;
        case SETTINGS_WEAK:
            return DriveCondition::weak;
    }
    throw std::logic_error("[failure] mode = " + std::to_string(mode) + " is not known");
}

// Crawlers come first among the actuators, then the arm joints.
int actuator_index(int64_t failed, const RobotModel &model) {
    if (failed < SETTINGS_FAILED_JOINT) {
        return static_cast<int>(failed);
    }
    const auto joint = static_cast<std::size_t>(failed - SETTINGS_FAILED_JOINT);
    if (model.crawlers.size() + joint >= model.actuators.size()) {
        throw std::runtime_error("[failure] actuator = joint_" + std::to_string(joint + 1) + ": robot " + model.name +
                                 " has " + std::to_string(model.actuators.size() - model.crawlers.size()) +
                                 " arm joints");
    }
    return static_cast<int>(model.crawlers.size() + joint);
}

}  // namespace

std::vector<Failure> planned_failures(const settings &configuration, const RobotModel &model) {
    std::vector<Failure> failures;
    for (const settings_failure &f : {configuration.failure, configuration.second_failure}) {
        if (f.actuator != SETTINGS_FAILED_NONE) {
            failures.push_back({actuator_index(f.actuator, model),
                                condition(static_cast<settings_failure_mode>(f.mode)), f.weak_factor, f.slip_factor,
                                f.at_s});
        }
    }
    return failures;
}

}  // namespace limphome
