// The jumps of a ContactProblem.
#include <algorithm>
#include <cmath>

#include "bullet/contact_problem.h"

namespace limphome {
namespace {

// What sticks is held against its slip this much stiffer than a sweep brings it to rest; the sweep then does the rest.
constexpr double stiff = 1e5;
// A jump is good if the sweep after it changes no more than this share of what the one before it did. What it only made
// a little better may have led away from where sweeps would have come to.
constexpr double good = 0.1;
// Of the matrix below; those of one that is not sheer friction are 1 and above.
constexpr double least_pivot = 0.1;

// Solves A x = b for b in its place, by elimination without pivoting; false where that is not possible.
template <typename Square, typename Vector>
bool eliminate(Square &a, Vector &b) {
    constexpr int size = Square::RowsAtCompileTime;
    for (int k = 0; k < size; k++) {
        if (!(a(k, k) > least_pivot)) {
            return false;
        }
        for (int i = k + 1; i < size; i++) {
            const double factor = a(i, k) / a(k, k);
            for (int j = k + 1; j < size; j++) {
                a(i, j) -= factor * a(k, j);
            }
            b[i] -= factor * b[k];
        }
    }
    for (int k = size - 1; k >= 0; k--) {
        for (int j = k + 1; j < size; j++) {
            b[k] -= a(k, j) * b[j];
        }
        b[k] /= a(k, k);
    }
    return true;
}

}  // namespace

template <int dofs>
typename ContactProblem<dofs>::JointLaw ContactProblem<dofs>::law(const JointConstraint &joint,
                                                                  const JointRow &row) const {
    const JointStep step = next(joint, row);
    const double stiffness = step.reached ? stiff / row.effect : 0;
    return {stiffness, (step.reached ? joint.impulse : step.impulse) + stiffness * step.rate};
}

// Slip changes its direction, but for the force across it no more than the friction does that turns with it.
template <int dofs>
typename ContactProblem<dofs>::ContactLaw ContactProblem<dofs>::law(const Contact &contact,
                                                                    const ContactRow &row) const {
    Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
    Eigen::Vector3d constant = Eigen::Vector3d::Zero();
    const Eigen::Vector3d velocity = relative(row);
    const double normal =
        contact.impulse[0] + row.normal_step * (row.push - velocity[0] - row.compliance * contact.impulse[0]);
    if (normal <= 0) {
        return {stiffness, constant};
    }
    stiffness(0, 0) = 1 / row.compliance;
    constant[0] = row.push / row.compliance;
    const double limit = contact.friction * normal, step = row.tangents.slip_step;
    const Eigen::Vector2d friction = contact.impulse.tail<2>(), slip = velocity.tail<2>();
    const Eigen::Vector2d wanted = friction - step * slip;
    const double size = wanted.norm();
    if (size <= limit || (friction - row.tangents.sticking * slip).squaredNorm() <= limit * limit) {
        stiffness.diagonal().tail<2>().setConstant(stiff * step);
        constant.tail<2>() = friction;
        return {stiffness, constant};
    }
    const Eigen::Vector2d along = wanted / size, across(-along.y(), along.x());
    const double turning = step * std::min(stiff, limit / (size - limit));
    stiffness.block<2, 1>(1, 0) = contact.friction * stiffness(0, 0) * along;
    stiffness.bottomRightCorner<2, 2>() = turning * across * across.transpose();
    constant.tail<2>() = contact.friction * constant[0] * along;
    return {stiffness, constant};
}

// The velocities v with which all laws hold: v = sum(C (constant - K (steady + C^T v))) with columns C, stiffness K.
template <int dofs>
bool ContactProblem<dofs>::find_target(const std::vector<JointConstraint> &joints,
                                       const std::vector<Contact> &contacts) {
    Square matrix = Square::Identity();
    Velocity &target = target_.velocity;
    target.setZero();
    std::array<JointLaw, max_actuators> joint_laws;
    for (std::size_t i = 0; i < joint_rows_.size(); i++) {
        const JointRow &row = joint_rows_[i];
        joint_laws[i] = law(joints[row.joint], row);
        matrix += (joint_laws[i].stiffness * row.column) * row.column.transpose();
        target += (joint_laws[i].constant - joint_laws[i].stiffness * row.steady) * row.column;
    }
    laws_.resize(contacts.size());
    for (std::size_t i = 0; i < contacts.size(); i++) {
        const ContactRow &row = rows_[i];
        laws_[i] = law(contacts[i], row);
        const Eigen::Matrix<double, dofs, 3> pull = row.columns.lazyProduct(laws_[i].stiffness);
        matrix += pull.lazyProduct(row.columns.transpose());
        target += row.columns.lazyProduct(laws_[i].constant) - pull.lazyProduct(row.steady);
    }
    if (!eliminate(matrix, target)) {
        return false;
    }

    const Velocity changed = target;
    target.setZero();
    for (std::size_t i = 0; i < joint_rows_.size(); i++) {
        const JointRow &row = joint_rows_[i];
        const double rate = row.steady + row.column.dot(changed);
        double &impulse = target_.joints[row.joint];
        impulse = joint_laws[i].constant - joint_laws[i].stiffness * rate;
        target += row.column * impulse;
    }
    target_.contacts.resize(contacts.size());
    for (std::size_t i = 0; i < contacts.size(); i++) {
        const ContactRow &row = rows_[i];
        const Eigen::Vector3d velocity = row.steady + row.columns.transpose().lazyProduct(changed);
        Eigen::Vector3d &impulse = target_.contacts[i];
        impulse = laws_[i].constant - laws_[i].stiffness.lazyProduct(velocity);
        if (impulse[0] <= 0) {
            impulse.setZero();
            continue;
        }
        const double limit = contacts[i].friction * impulse[0], size = impulse.tail<2>().norm();
        if (size > limit) {
            impulse.tail<2>() *= limit / size;
        }
        target += row.columns.lazyProduct(impulse);
    }
    return true;
}

template <int dofs>
void ContactProblem<dofs>::go(const State &state, std::vector<JointConstraint> &joints,
                              std::vector<Contact> &contacts) {
    velocity_ = state.velocity;
    for (const JointRow &row : joint_rows_) {
        joints[row.joint].impulse = state.joints[row.joint];
    }
    for (std::size_t i = 0; i < contacts.size(); i++) {
        contacts[i].impulse = state.contacts[i];
    }
}

// Jumps and sweeps. Returns whether that sweep has changed far less than the one before it, `largest`; else all is as
// it was.
template <int dofs>
bool ContactProblem<dofs>::jump(double &largest, std::vector<JointConstraint> &joints, std::vector<Contact> &contacts) {
    if (!find_target(joints, contacts)) {
        return false;
    }
    start_.velocity = velocity_;
    for (const JointRow &row : joint_rows_) {
        start_.joints[row.joint] = joints[row.joint].impulse;
    }
    start_.contacts.resize(contacts.size());
    for (std::size_t i = 0; i < contacts.size(); i++) {
        start_.contacts[i] = contacts[i].impulse;
    }
    go(target_, joints, contacts);
    const double change = sweep(joints, contacts);
    if (change < good * largest) {
        largest = change;
        return true;
    }
    go(start_, joints, contacts);
    return false;
}

template bool ContactProblem<base_dofs>::jump(double &, std::vector<JointConstraint> &, std::vector<Contact> &);
template bool ContactProblem<base_dofs + num_crawlers>::jump(double &, std::vector<JointConstraint> &,
                                                             std::vector<Contact> &);
template bool ContactProblem<max_dofs>::jump(double &, std::vector<JointConstraint> &, std::vector<Contact> &);

}  // namespace limphome
