#include "bullet/solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limphome {
namespace {

// Sweeps end early once none of them changes a velocity by more than this [m/s, rad/s].
constexpr double velocity_tolerance = 1e-7;
// What a contact between two bodies gives way along its tangents at the least, as a share of what the ground does.
constexpr double least_effect = 1e-6;

// What moves against the ground by less than this sticks to it [m/s].
constexpr double slowest_slip = 1e-5;

}  // namespace

const GeneralVector &Solver::solve(const GeneralMatrix &mass, const GeneralVector &momentum,
                                   std::vector<JointConstraint> &joints, std::vector<Contact> &contacts,
                                   double time_step) {
    mass_ = mass;
    momentum_ = momentum;
    // Implicit in time: the spring is taken at the depth in the middle of the step, as velocities of its end leave it.
    compliance_ = 1 / (time_step * (ground_.stiffness * 0.5 * time_step + ground_.damping));
    inverse_ = rigid_inverse(mass_);
    bool all_held = true;
    for (std::size_t j = 0; j < joints.size(); j++) {
        if (!joints[j].held) {
            release(static_cast<int>(j));
            all_held = false;
        }
    }
    if (all_held) {  // the usual case
        hold_joints(joints);
        try_to_solve<base_dofs>(joints, contacts, time_step);
        all_held = !release_overloaded(joints, contacts);
    }
    if (!all_held) {
        do {
            hold_joints(joints);
            const bool arm_held = std::all_of(joints.begin() + num_crawlers, joints.end(),
                                              [](const JointConstraint &joint) { return joint.held; });
            if (arm_held) {
                try_to_solve<base_dofs + num_crawlers>(joints, contacts, time_step);
            } else {
                try_to_solve<max_dofs>(joints, contacts, time_step);
            }
        } while (release_overloaded(joints, contacts));
    }
    return velocity_;
}

template <int dofs>
void Solver::try_to_solve(std::vector<JointConstraint> &joints, std::vector<Contact> &contacts, double time_step) {
    prepare_contacts<dofs>(contacts, time_step);
    apply_known_impulses<dofs>(joints, contacts);
    iterate<dofs>(joints, contacts);
    relieve<dofs>(contacts);
}

// Lets a joint give way that inverse_ has taken for rigid: inversion by bordering, which adds one rank.
void Solver::release(int joint) {
    const GeneralVector column = mass_.col(base_dofs + joint);
    GeneralVector direction = -inverse_.lazyProduct(column);  // how all else moves with the joint
    direction[base_dofs + joint] = 1;
    inverse_ += direction * (direction / direction.dot(column)).transpose();
}

// Velocities with the held joints at their targets: their drives change no momentum but their own.
void Solver::hold_joints(const std::vector<JointConstraint> &joints) {
    velocity_.setZero();
    for (std::size_t j = 0; j < joints.size(); j++) {
        if (joints[j].held) {
            velocity_[base_dofs + static_cast<Eigen::Index>(j)] = joints[j].target;
        }
    }
    const GeneralVector missing = momentum_ - mass_.lazyProduct(velocity_);
    velocity_ += inverse_.lazyProduct(missing);
}

template <int dofs>
void Solver::prepare_contacts(const std::vector<Contact> &contacts, double time_step) {
    const double share = ground_.stiffness / (ground_.stiffness * 0.5 * time_step + ground_.damping);
    rows_.reserve(contacts.capacity());  // there may be more in a later step
    rows_.resize(contacts.size());
    grips_.reserve(contacts.capacity());
    for (std::size_t i = 0; i < contacts.size(); i++) {
        const Contact &contact = contacts[i];
        const auto jacobian = contact.jacobian.topRows<dofs>();
        ContactRow &row = rows_[i];
        row.response.topRows<dofs>() = inverse_.topLeftCorner<dofs, dofs>().lazyProduct(jacobian);
        row.effect = jacobian.transpose().lazyProduct(row.response.topRows<dofs>());
        row.steady =
            contact.jacobian.bottomRows<max_dofs - dofs>().transpose().lazyProduct(velocity_.tail<max_dofs - dofs>());
        row.push = contact.depth > 0 ? share * contact.depth : contact.depth / time_step;
        row.compliance = compliance_ / contact.firmness;
        row.normal_step = 1 / (row.effect(0, 0) + row.compliance);
        Eigen::Matrix2d tangential = row.effect.bottomRightCorner<2, 2>();
        if (contact.other != Touch::ground) {  // two bodies may have no joint that moves them along each other
            tangential.diagonal().array() += least_effect * compliance_;
        }
        row.tangents.sticking = tangential.inverse();
        const double mean = 0.5 * tangential.trace(), half = 0.5 * (tangential(0, 0) - tangential(1, 1));
        row.tangents.slip_step = 1 / (mean + std::sqrt(half * half + tangential(0, 1) * tangential(0, 1)));
    }
}

template <int dofs>
void Solver::apply_known_impulses(const std::vector<JointConstraint> &joints, const std::vector<Contact> &contacts) {
    for (std::size_t i = 0; i < contacts.size(); i++) {
        velocity_.head<dofs>() += rows_[i].response.topRows<dofs>().lazyProduct(contacts[i].impulse);
    }
    for (std::size_t j = 0; j < joints.size(); j++) {
        if (!joints[j].held) {
            velocity_ += inverse_.col(base_dofs + static_cast<Eigen::Index>(j)) * joints[j].impulse;
        }
    }
}

template <int dofs>
void Solver::iterate(std::vector<JointConstraint> &joints, std::vector<Contact> &contacts) {
    for (int iteration = 0; iteration < iterations_; iteration++) {
        double largest = 0;
        for (std::size_t j = 0; j < joints.size(); j++) {
            if (!joints[j].held) {
                largest = std::max(largest, relax(joints[j], base_dofs + static_cast<int>(j)));
            }
        }
        for (std::size_t i = 0; i < contacts.size(); i++) {
            largest = std::max(largest, relax<dofs>(contacts[i], rows_[i]));
        }
        if (largest < velocity_tolerance) {
            return;
        }
    }
}

// Returns the change of the joint's rate.
double Solver::relax(JointConstraint &joint, int dof) {
    const double response = inverse_(dof, dof);
    const double others = velocity_[dof] - response * joint.impulse;  // rate without this impulse
    double impulse = std::clamp((joint.target - others) / response, -joint.limit, joint.limit);
    const double rate = others + response * impulse;
    const double stopped = std::clamp(rate, joint.lowest, joint.highest);
    if (stopped != rate) {
        impulse = (stopped - others) / response;
    }
    const double change = impulse - joint.impulse;
    velocity_ += inverse_.col(dof) * change;
    joint.impulse = impulse;
    return std::abs(change) * response;
}

// Returns the largest change of the contact's relative velocity.
template <int dofs>
double Solver::relax(Contact &contact, const ContactRow &row) {
    Eigen::Vector3d relative = row.steady;
    relative += contact.jacobian.topRows<dofs>().transpose().lazyProduct(velocity_.head<dofs>());
    Eigen::Vector3d change;
    const double normal = std::max(
        contact.impulse[0] + row.normal_step * (row.push - relative[0] - row.compliance * contact.impulse[0]), 0.0);
    change[0] = normal - contact.impulse[0];
    const Eigen::Vector2d slip = relative.tail<2>() + row.effect.block<2, 1>(1, 0) * change[0];
    const Eigen::Vector2d friction = contact.impulse.tail<2>();
    change.tail<2>() = friction_impulse(row.tangents, friction, slip, contact.friction * normal) - friction;
    velocity_.head<dofs>() += row.response.topRows<dofs>().lazyProduct(change);
    contact.impulse += change;
    return row.effect.diagonal().cwiseProduct(change).cwiseAbs().maxCoeff();
}

template <int dofs>
bool Solver::sticks(const Contact &contact, const ContactRow &row) const {
    constexpr double at_limit = 1 - 1e-6;
    const double limit = contact.friction * contact.impulse[0];
    if (contact.impulse.tail<2>().norm() < at_limit * limit) {
        return true;
    }
    Eigen::Vector2d slip = row.steady.tail<2>();
    slip += contact.jacobian.block<dofs, 2>(0, 1).transpose().lazyProduct(velocity_.head<dofs>());
    return limit > 0 && slip.norm() < slowest_slip;
}

// Takes out of the friction that sticks what has no effect, so that no drive bears it.
template <int dofs>
void Solver::relieve(std::vector<Contact> &contacts) {
    grips_.clear();
    for (std::size_t i = 0; i < contacts.size(); i++) {
        const Contact &contact = contacts[i];
        if (sticks<dofs>(contact, rows_[i])) {
            Grip &grip = grips_.emplace_back();
            grip.contact = i;
            grip.response.topRows<dofs>() = rows_[i].response.block<dofs, 2>(0, 1);
            grip.limit = contact.friction * contact.impulse[0];
            grip.impulse = contact.impulse.tail<2>();
        }
    }
    share_grip<dofs>(grips_);
    for (const Grip &grip : grips_) {
        contacts[grip.contact].impulse.tail<2>() = grip.impulse;
    }
}

// Finds the impulses of the held joints. Those that ask too much of their drive are released, and true is returned: the
// step has to be solved again. Others that came to their target are held in the next step.
bool Solver::release_overloaded(std::vector<JointConstraint> &joints, const std::vector<Contact> &contacts) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    GeneralVector impulse = GeneralVector::Zero();
    for (const Contact &contact : contacts) {
        impulse += contact.jacobian.lazyProduct(contact.impulse);
    }
    for (std::size_t j = 0; j < joints.size(); j++) {
        if (!joints[j].held) {
            impulse[base_dofs + static_cast<Eigen::Index>(j)] += joints[j].impulse;
        }
    }
    const GeneralVector drives = mass_.lazyProduct(velocity_) - momentum_ - impulse;

    bool released = false;
    for (std::size_t j = 0; j < joints.size(); j++) {
        JointConstraint &joint = joints[j];
        if (!joint.held) {
            continue;
        }
        joint.impulse = drives[base_dofs + static_cast<Eigen::Index>(j)];
        const double most = joint.target <= joint.lowest ? infinity : joint.limit;
        const double least = joint.target >= joint.highest ? -infinity : -joint.limit;
        if (joint.impulse > most || joint.impulse < least) {
            joint.impulse = std::clamp(joint.impulse, -joint.limit, joint.limit);
            joint.held = false;
            release(static_cast<int>(j));
            released = true;
        }
    }
    if (!released) {
        for (JointConstraint &joint : joints) {
            joint.held = joint.held || std::abs(joint.impulse) < joint.limit;
        }
    }
    return released;
}

}  // namespace limphome
