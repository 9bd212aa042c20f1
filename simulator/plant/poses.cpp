#include "plant/poses.h"

#include <algorithm>

namespace limphome {

namespace {

constexpr double interval = 1.0 / 30;  // [s]

void copy(const robot_state_t &state, pose_t &pose) {
    pose.utime = state.utime;
    pose.num_actuators = state.num_actuators;
    std::copy(std::begin(state.position), std::end(state.position), pose.position);
    std::copy(std::begin(state.orientation), std::end(state.orientation), pose.orientation);
    std::copy(std::begin(state.actuator_position), std::end(state.actuator_position), pose.actuator_position);
    std::copy(std::begin(state.actuator_velocity), std::end(state.actuator_velocity), pose.actuator_velocity);
    std::copy(std::begin(state.actuator_effort), std::end(state.actuator_effort), pose.actuator_effort);
}

}  // namespace

void Poses::show(double now, int32_t episode) {
    if (now < due_) {
        return;
    }
    due_ = now + interval;
    if (machine_.diverged()) {
        return;
    }
    robot_state_t exact{};
    const bool known = machine_.exact(exact);
    pose_t pose{};
    copy(known ? exact : link_.newest(), pose);
    for (int a = 0; a < machine_.num_actuators(); a++) {
        pose.actuator_health[a] = static_cast<int8_t>(machine_.health(a));
    }
    pose.has_truth = known && machine_.truth(pose.truth) ? 1 : 0;
    pose.episode = episode;
    link_.send_pose(pose);
}

}  // namespace limphome
