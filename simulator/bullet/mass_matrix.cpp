#include "bullet/mass_matrix.h"

#include <Eigen/LU>
#include <array>

#include "bullet/convert.h"

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

RigidInertia rigid_inertia(double mass, const btVector3 &principal, const btTransform &frame,
                           const Eigen::Vector3d &point) {
    const Eigen::Matrix3d axes = to_eigen(frame.getBasis());
    const Eigen::Vector3d r = to_eigen(frame.getOrigin()) - point;
    RigidInertia result;
    result.mass = mass;
    result.moment = mass * r;
    result.inertia = axes * to_eigen(principal).asDiagonal() * axes.transpose();
    result.inertia += mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
    return result;
}

}  // namespace

JointAxis joint_axis(const btMultiBody &multibody, int joint) {
    const btMultibodyLink &link = multibody.getLink(joint);
    const btTransform &frame = link.m_cachedWorldTransform;
    return {to_eigen(frame.getBasis() * link.getAxisTop(0)), to_eigen(frame * -link.m_dVector)};
}

GeneralMatrix mass_matrix(const btMultiBody &multibody) {
    const int joints = multibody.getNumLinks();
    const Eigen::Vector3d point = to_eigen(multibody.getBasePos());
    std::array<RigidInertia, max_actuators> carried;  // by each joint
    RigidInertia whole =
        rigid_inertia(multibody.getBaseMass(), multibody.getBaseInertia(), multibody.getBaseWorldTransform(), point);
    for (int j = joints - 1; j >= 0; j--) {  // children come after their parents
        const btMultibodyLink &link = multibody.getLink(j);
        const auto index = static_cast<std::size_t>(j);
        carried[index] += rigid_inertia(link.m_mass, link.m_inertiaLocal, link.m_cachedWorldTransform, point);
        (link.m_parent >= 0 ? carried[static_cast<std::size_t>(link.m_parent)] : whole) += carried[index];
    }

    GeneralMatrix mass = GeneralMatrix::Zero();
    mass.topLeftCorner<3, 3>() = whole.inertia;
    mass.block<3, 3>(0, 3) = cross_matrix(whole.moment);
    mass.block<3, 3>(3, 0) = -cross_matrix(whole.moment);
    mass.block<3, 3>(3, 3).diagonal().setConstant(whole.mass);

    std::array<Eigen::Matrix<double, base_dofs, 1>, max_actuators> motion;  // of what each joint carries, per unit rate
    for (int j = 0; j < joints; j++) {
        const RigidInertia &moved = carried[static_cast<std::size_t>(j)];
        const JointAxis axis = joint_axis(multibody, j);
        const Eigen::Vector3d linear = (axis.pivot - point).cross(axis.direction);
        motion[static_cast<std::size_t>(j)] << axis.direction, linear;
        Eigen::Matrix<double, base_dofs, 1> momentum;
        momentum << moved.inertia * axis.direction + moved.moment.cross(linear),
            moved.mass * linear + axis.direction.cross(moved.moment);
        mass.block<base_dofs, 1>(0, base_dofs + j) = momentum;
        mass.block<1, base_dofs>(base_dofs + j, 0) = momentum.transpose();
        for (int k = j; k >= 0; k = multibody.getParent(k)) {
            const double shared = motion[static_cast<std::size_t>(k)].dot(momentum);
            mass(base_dofs + j, base_dofs + k) = shared;
            mass(base_dofs + k, base_dofs + j) = shared;
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

GeneralVector velocities(const btMultiBody &multibody) {
    GeneralVector velocity = GeneralVector::Zero();
    const int dofs = base_dofs + multibody.getNumDofs();
    velocity.head(dofs) = Eigen::Map<const Eigen::VectorXd>(multibody.getVelocityVector(), dofs);
    return velocity;
}

double kinetic_energy(const btMultiBody &multibody) {
    const GeneralVector velocity = velocities(multibody);
    return 0.5 * velocity.dot(mass_matrix(multibody) * velocity);
}

}  // namespace limphome
