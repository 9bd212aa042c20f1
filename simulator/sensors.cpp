#include "sensors.h"

#include <algorithm>

namespace limphome {
namespace {

int8_t health(DriveCondition condition) {
    switch (condition) {
        case DriveCondition::sound:
            return 0;
        case DriveCondition::weak:
            return 2;
        default:
            return 1;
    }
}

}  // namespace

void read_sensors(const World &world, robot_state_t &state) {
    const Eigen::Isometry3d pose = world.robot().pose();
    const Eigen::Quaterniond attitude(pose.linear());
    Eigen::Map<Eigen::Vector3d>(state.position) = pose.translation();
    state.orientation[0] = attitude.w();
    state.orientation[1] = attitude.x();
    state.orientation[2] = attitude.y();
    state.orientation[3] = attitude.z();

    const std::vector<Drive> &drives = world.drives();
    state.num_actuators = static_cast<int32_t>(drives.size());
    for (std::size_t a = 0; a < max_actuators; a++) {
        const bool used = a < drives.size();
        const int actuator = static_cast<int>(a);
        state.actuator_position[a] = used ? world.robot().actuator_position(actuator) : 0;
        state.actuator_velocity[a] = used ? world.robot().actuator_velocity(actuator) : 0;
        state.actuator_effort[a] = used ? drives[a].effort() : 0;
        state.actuator_health[a] = used ? health(drives[a].condition()) : int8_t{0};
    }
}

}  // namespace limphome
