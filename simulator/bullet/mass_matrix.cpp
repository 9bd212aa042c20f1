#include "bullet/mass_matrix.h"

#include <Eigen/LU>
#include <array>

namespace limphome {
namespace {

// Inertia of one or more rigid bodies about a common point, axes of the world.
struct RigidInertia {
    double mass = 0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();   // mass times centre of mass
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the point

    RigidInertia &operator+=(const RigidInertia &other) {
        mass += other.mass;
        moment += other.moment;
        inertia += other.inertia;
        return *this;
    }
};

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d &v) {
    Eigen::Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

RigidInertia about(const Eigen::Vector3d &point, const PlacedBody &body) {
    const Eigen::Vector3d r = body.centre - point;
    RigidInertia result{body.mass, body.mass * r, body.inertia - result.moment * r.transpose()};
    result.inertia.diagonal().array() += result.moment.dot(r);
    return result;
}

}  // namespace

GeneralMatrix mass_matrix(const std::vector<PlacedBody> &bodies) {
    const Eigen::Vector3d point = bodies[0].centre;
    std::array<RigidInertia, 1 + max_actuators> carried;  // by each joint
    for (std::size_t i = 0; i < bodies.size(); i++) {
        carried[i] = about(point, bodies[i]);
    }
    for (std::size_t i = bodies.size() - 1; i > 0; i--) {  // children come after their parents
        carried[static_cast<std::size_t>(bodies[i].parent)] += carried[i];
    }
    const RigidInertia &whole = carried[0];

    GeneralMatrix mass = GeneralMatrix::Zero();
    mass.topLeftCorner<3, 3>() = whole.inertia;
    mass.block<3, 3>(0, 3) = cross_matrix(whole.moment);
    mass.block<3, 3>(3, 0) = -cross_matrix(whole.moment);
    mass.block<3, 3>(3, 3).diagonal().setConstant(whole.mass);

    std::array<Eigen::Matrix<double, base_dofs, 1>, 1 + max_actuators> motion;  // of what is carried, per unit rate
    for (std::size_t i = 1; i < bodies.size(); i++) {
        const RigidInertia &moved = carried[i];
        const Eigen::Vector3d &axis = bodies[i].axis;
        const Eigen::Vector3d linear = (bodies[i].origin - point).cross(axis);
        motion[i] << axis, linear;
        Eigen::Matrix<double, base_dofs, 1> momentum;
        momentum << moved.inertia * axis + moved.moment.cross(linear), moved.mass * linear + axis.cross(moved.moment);
        const int dof = joint_dof(i);
        mass.block<base_dofs, 1>(0, dof) = momentum;
        mass.block<1, base_dofs>(dof, 0) = momentum.transpose();
        for (std::size_t k = i; k > 0; k = static_cast<std::size_t>(bodies[k].parent)) {
            const double shared = motion[k].dot(momentum);
            mass(dof, joint_dof(k)) = shared;
            mass(joint_dof(k), dof) = shared;
        }
    }
    return mass;
}

// About the centre of mass turning and moving are independent; r leads there from the base's point.
GeneralMatrix rigid_inverse(const GeneralMatrix &mass) {
    const double total = mass(3, 3);
    const Eigen::Matrix3d r = mass.block<3, 3>(0, 3) / total;  // as cross product
    const Eigen::Matrix3d turning = (mass.topLeftCorner<3, 3>() + total * r * r).inverse();
    GeneralMatrix inverse = GeneralMatrix::Zero();
    inverse.topLeftCorner<3, 3>() = turning;
    inverse.block<3, 3>(0, 3) = -turning * r;
    inverse.block<3, 3>(3, 0) = r * turning;
    inverse.block<3, 3>(3, 3) = -r * turning * r;
    inverse.block<3, 3>(3, 3).diagonal().array() += 1 / total;
    return inverse;
}

}  // namespace limphome
