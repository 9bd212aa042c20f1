#include "bullet/bias_force.h"

#include <array>

namespace limphome {
namespace {

// Motion of a body and of its centre of mass; first and, with all rates of the robot constant, second derivatives.
struct Motion {
    Eigen::Vector3d spin, turning;  // angular velocity and acceleration [rad/s, rad/s^2]
    Eigen::Vector3d acceleration;   // less gravity [m/s^2]

    // Acceleration of a point of the body that lies `arm` away from its centre of mass.
    Eigen::Vector3d at(const Eigen::Vector3d &arm) const {
        return acceleration + turning.cross(arm) + spin.cross(spin.cross(arm));
    }
};

}  // namespace

GeneralVector bias_force(const std::vector<PlacedBody> &bodies, const GeneralVector &velocity,
                         const Eigen::Vector3d &gravity) {
    const Eigen::Vector3d reference = bodies[0].centre;
    std::array<Motion, 1 + max_actuators> motions;
    std::array<Eigen::Vector3d, 1 + max_actuators> force, torque;  // on each body and what hangs on it; about reference
    for (std::size_t i = 0; i < bodies.size(); i++) {
        const PlacedBody &body = bodies[i];
        Motion &motion = motions[i];
        if (body.parent < 0) {
            motion = {velocity.head<3>(), Eigen::Vector3d::Zero(), -gravity};
        } else {
            const auto parent = static_cast<std::size_t>(body.parent);
            const Motion &carrier = motions[parent];
            const Eigen::Vector3d turn = velocity[joint_dof(i)] * body.axis;
            motion.spin = carrier.spin + turn;
            motion.turning = carrier.turning + carrier.spin.cross(turn);
            motion.acceleration = carrier.at(body.origin - bodies[parent].centre);
            motion.acceleration = motion.at(body.centre - body.origin);
        }
        force[i] = body.mass * motion.acceleration;
        torque[i] = body.inertia * motion.turning + motion.spin.cross(body.inertia * motion.spin) +
                    (body.centre - reference).cross(force[i]);
    }

    GeneralVector bias = GeneralVector::Zero();
    for (std::size_t i = bodies.size() - 1; i > 0; i--) {  // children come after their parents
        const PlacedBody &body = bodies[i];
        const auto parent = static_cast<std::size_t>(body.parent);
        bias[joint_dof(i)] = body.axis.dot(torque[i] - (body.origin - reference).cross(force[i]));
        force[parent] += force[i];
        torque[parent] += torque[i];
    }
    bias.head<3>() = torque[0];
    bias.segment<3>(3) = force[0];
    return bias;
}

}  // namespace limphome
