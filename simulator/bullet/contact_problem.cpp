#include "bullet/contact_problem.h"

#include <algorithm>
#include <cmath>

namespace limphome {
namespace {

// Sweeps end early once none of them changes a velocity by more than this [m/s, rad/s].
constexpr double velocity_tolerance = 1e-7;
// After a jump that was taken back, so many sweeps come before the next one.
constexpr int sweeps_between = 8;
// What a contact between two bodies gives way along its tangents at the least, as a share of what the ground does.
constexpr double least_effect = 1e-6;
// What moves against the ground by less than this sticks to it [m/s].
constexpr double slowest_slip = 1e-5;

// Root L of A = L L^T, lower triangular. Rows of A that are 0, of what does not move, are so in L, too.
template <typename Square>
Square cholesky(const Square &a) {
    constexpr int size = Square::RowsAtCompileTime;
    Square root = Square::Zero();
    for (int j = 0; j < size; j++) {
        const double pivot = a(j, j) - root.row(j).head(j).squaredNorm();
        if (pivot <= 0) {
            continue;
        }
        root(j, j) = std::sqrt(pivot);
        for (int i = j + 1; i < size; i++) {
            root(i, j) = (a(i, j) - root.row(i).head(j).dot(root.row(j).head(j))) / root(j, j);
        }
    }
    return root;
}

}  // namespace

template <int dofs>
void ContactProblem<dofs>::reserve(std::size_t contacts) {
    joint_rows_.reserve(max_actuators);
    rows_.reserve(contacts);
    laws_.reserve(contacts);
    start_.contacts.reserve(contacts);
    target_.contacts.reserve(contacts);
    grips_.reserve(contacts);
}

template <int dofs>
void ContactProblem<dofs>::prepare(const GeneralMatrix &inverse, const GeneralVector &velocity,
                                   const GroundStiffness &ground, double time_step,
                                   const std::vector<JointConstraint> &joints, const std::vector<Contact> &contacts) {
    root_ = cholesky<Square>(inverse.topLeftCorner<dofs, dofs>());
    velocity_.setZero();
    joint_rows_.clear();
    for (std::size_t j = 0; j < joints.size(); j++) {
        const int dof = base_dofs + static_cast<int>(j);
        if (!joints[j].held && dof < dofs) {
            const Velocity column = root_.row(dof).transpose();
            joint_rows_.push_back({j, column, column.squaredNorm(), velocity[dof]});
            velocity_ += column * joints[j].impulse;
        }
    }
    rows_.resize(contacts.size());
    for (std::size_t i = 0; i < contacts.size(); i++) {
        rows_[i].steady = contacts[i].jacobian.transpose().lazyProduct(velocity);
        prepare_contact(contacts[i], ground, time_step, rows_[i]);
        velocity_ += rows_[i].columns.lazyProduct(contacts[i].impulse);
    }
}

template <int dofs>
void ContactProblem<dofs>::prepare_contact(const Contact &contact, const GroundStiffness &ground, double time_step,
                                           ContactRow &row) {
    // Implicit in time: the spring is taken at the depth in the middle of the step, as velocities of its end leave it.
    const double resistance = ground.stiffness * 0.5 * time_step + ground.damping;
    const double compliance = 1 / (time_step * resistance);
    row.columns = root_.transpose().lazyProduct(contact.jacobian.template topRows<dofs>());
    row.effect = row.columns.transpose().lazyProduct(row.columns);
    row.push = contact.depth > 0 ? ground.stiffness / resistance * contact.depth : contact.depth / time_step;
    row.compliance = compliance / contact.firmness;
    row.normal_step = 1 / (row.effect(0, 0) + row.compliance);
    Eigen::Matrix2d tangential = row.effect.template bottomRightCorner<2, 2>();
    if (contact.other != Touch::ground) {  // two bodies may have no joint that moves them along each other
        tangential.diagonal().array() += least_effect * compliance;
    }
    row.tangents.sticking = tangential.inverse();
    const double mean = 0.5 * tangential.trace(), half = 0.5 * (tangential(0, 0) - tangential(1, 1));
    row.tangents.slip_step = 1 / (mean + std::sqrt(half * half + tangential(0, 1) * tangential(0, 1)));
}

template <int dofs>
void ContactProblem<dofs>::solve(int sweeps, std::vector<JointConstraint> &joints, std::vector<Contact> &contacts) {
    double largest = sweep(joints, contacts);
    int next_jump = 1;
    for (int done = 1; done < sweeps && largest >= velocity_tolerance; done++) {
        if (done >= next_jump) {
            if (jump(largest, joints, contacts)) {
                continue;
            }
            next_jump = done + sweeps_between;
        }
        largest = sweep(joints, contacts);
    }
}

// Returns the largest change of a velocity.
template <int dofs>
double ContactProblem<dofs>::sweep(std::vector<JointConstraint> &joints, std::vector<Contact> &contacts) {
    double largest = 0;
    for (const JointRow &row : joint_rows_) {
        largest = std::max(largest, relax(joints[row.joint], row));
    }
    for (std::size_t i = 0; i < contacts.size(); i++) {
        largest = std::max(largest, relax(contacts[i], rows_[i]));
    }
    return largest;
}

template <int dofs>
typename ContactProblem<dofs>::JointStep ContactProblem<dofs>::next(const JointConstraint &joint,
                                                                    const JointRow &row) const {
    // rate without this impulse
    const double others = row.steady + row.column.dot(velocity_) - row.effect * joint.impulse;
    const double wanted = (joint.target - others) / row.effect;
    const double impulse = std::clamp(wanted, -joint.limit, joint.limit);
    const double rate = others + row.effect * impulse;
    const double stopped = std::clamp(rate, joint.lowest, joint.highest);
    if (stopped != rate) {
        return {(stopped - others) / row.effect, stopped, true};
    }
    return {impulse, rate, impulse == wanted};
}

// Returns the change of the joint's rate.
template <int dofs>
double ContactProblem<dofs>::relax(JointConstraint &joint, const JointRow &row) {
    const double change = next(joint, row).impulse - joint.impulse;
    velocity_ += row.column * change;
    joint.impulse += change;
    return std::abs(change) * row.effect;
}

// Returns the largest change of the contact's relative velocity.
template <int dofs>
double ContactProblem<dofs>::relax(Contact &contact, const ContactRow &row) {
    const Eigen::Vector3d before = relative(row);
    Eigen::Vector3d change;
    const double normal = std::max(
        contact.impulse[0] + row.normal_step * (row.push - before[0] - row.compliance * contact.impulse[0]), 0.0);
    change[0] = normal - contact.impulse[0];
    const Eigen::Vector2d slip = before.tail<2>() + row.effect.template block<2, 1>(1, 0) * change[0];
    const Eigen::Vector2d friction = contact.impulse.tail<2>();
    change.tail<2>() = friction_impulse(row.tangents, friction, slip, contact.friction * normal) - friction;
    velocity_ += row.columns.lazyProduct(change);
    contact.impulse += change;
    return row.effect.diagonal().cwiseProduct(change).cwiseAbs().maxCoeff();
}

template <int dofs>
bool ContactProblem<dofs>::sticks(const Contact &contact, const ContactRow &row) const {
    constexpr double at_limit = 1 - 1e-6;
    const double limit = contact.friction * contact.impulse[0];
    if (contact.impulse.tail<2>().norm() < at_limit * limit) {
        return true;
    }
    return limit > 0 && relative(row).template tail<2>().norm() < slowest_slip;
}

template <int dofs>
void ContactProblem<dofs>::relieve(std::vector<Contact> &contacts) {
    grips_.clear();
    for (std::size_t i = 0; i < contacts.size(); i++) {
        const Contact &contact = contacts[i];
        if (sticks(contact, rows_[i])) {
            Grip &grip = grips_.emplace_back();
            grip.contact = i;
            grip.response.template topRows<dofs>() = root_.lazyProduct(rows_[i].columns.template rightCols<2>());
            grip.limit = contact.friction * contact.impulse[0];
            grip.impulse = contact.impulse.tail<2>();
        }
    }
    share_grip<dofs>(grips_);
    for (const Grip &grip : grips_) {
        contacts[grip.contact].impulse.tail<2>() = grip.impulse;
    }
}

template class ContactProblem<base_dofs>;
template class ContactProblem<base_dofs + num_crawlers>;
template class ContactProblem<max_dofs>;

}  // namespace limphome
