#include "model/failure.h"

#include <stdexcept>
#include <string>

namespace limphome {
namespace {

// Crawlers come first among the actuators, then the arm joints.
int actuator_index(const std::string &section, int64_t failed, const RobotModel &model) {
    if (failed < SETTINGS_FAILED_JOINT) {
        return static_cast<int>(failed);
    }
    const auto joint = static_cast<std::size_t>(failed - SETTINGS_FAILED_JOINT);
    if (model.crawlers.size() + joint >= model.actuators.size()) {
        throw std::runtime_error("[" + section + "] actuator = joint_" + std::to_string(joint + 1) + ": robot " +
                                 model.name + " has " + std::to_string(model.actuators.size() - model.crawlers.size()) +
                                 " arm joints");
    }
    return static_cast<int>(model.crawlers.size() + joint);
}

Failure planned(const settings_failure &f, int actuator) {
    switch (static_cast<settings_failure_mode>(f.mode)) {
        case SETTINGS_LOCKED:
            return {actuator, DriveCondition::locked, 0, f.at_s, f.at_episode};
        case SETTINGS_FREE:
            return {actuator, DriveCondition::free, 0, f.at_s, f.at_episode};
        case SETTINGS_SLIPPING:
            return {actuator, DriveCondition::slipping, f.slip_factor, f.at_s, f.at_episode};
        case SETTINGS_WEAK:
            return {actuator, DriveCondition::weak, f.weak_factor, f.at_s, f.at_episode};
    }
    throw std::logic_error("mode " + std::to_string(f.mode) + " of failure is not known");
}

}  // namespace

std::vector<Failure> planned_failures(const settings &configuration, const RobotModel &model) {
    std::vector<Failure> failures;
    const auto add = [&](const std::string &section, const settings_failure &f) {
        if (f.actuator != SETTINGS_FAILED_NONE) {
            failures.push_back(planned(f, actuator_index(section, f.actuator, model)));
        }
    };
    add("failure", configuration.failure);
    add("second_failure", configuration.second_failure);
    return failures;
}

}  // namespace limphome
