#include "bullet/sensors.h"

namespace limphome {

void read_sensors(const Robot &robot, const std::vector<Drive> &drives, robot_state_t &state) {
    const Eigen::Isometry3d pose = robot.pose();
    const Eigen::Quaterniond attitude(pose.linear());
    Eigen::Map<Eigen::Vector3d>(state.position) = pose.translation();
    state.orientation[0] = attitude.w();
    state.orientation[1] = attitude.x();
    state.orientation[2] = attitude.y();
    state.orientation[3] = attitude.z();

    state.num_actuators = static_cast<int32_t>(drives.size());
    for (std::size_t a = 0; a < max_actuators; a++) {
        const bool used = a < drives.size();
        const int actuator = static_cast<int>(a);
        state.actuator_position[a] = used ? robot.actuator_position(actuator) : 0;
        state.actuator_velocity[a] = used ? robot.actuator_velocity(actuator) : 0;
        state.actuator_effort[a] = used ? drives[a].effort() : 0;
    }
}

}  // namespace limphome
