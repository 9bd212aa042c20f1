#include "solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limphome {
namespace {

// Sweeps end early once none of them changes a velocity by more than this [m/s, rad/s].
constexpr double velocity_tolerance = 1e-7;

}  // namespace

void Solver::solve(btMultiBody &multibody, std::vector<JointConstraint> &joints, std::vector<Contact> &contacts,
                   double time_step) {
    dofs_ = 6 + multibody.getNumDofs();
    free_.setZero();
    free_.head(dofs_) = Eigen::Map<const Eigen::VectorXd>(multibody.getVelocityVector(), dofs_);
    // Implicit in time: the spring is taken at the depth that the end of the step will have.
    compliance_ = 1 / (time_step * (ground_.stiffness * time_step + ground_.damping));
    invert_mass(multibody);
    do {
        hold_joints(joints);
        prepare_contacts(contacts, time_step);
        apply_initial_impulses(joints, contacts);
        iterate(joints, contacts);
    } while (release_overloaded(joints, contacts));

    const GeneralVector change = velocity_ - free_;
    multibody.applyDeltaVeeMultiDof(change.data(), 1);
}

void Solver::invert_mass(const btMultiBody &multibody) {
    inverse_mass_.setZero();
    for (int dof = 0; dof < dofs_; dof++) {
        const GeneralVector unit = GeneralVector::Unit(dof);
        multibody.calcAccelerationDeltasMultiDof(unit.data(), inverse_mass_.col(dof).data(), scratch_numbers_,
                                                 scratch_vectors_);
    }
}

// With E picking the held joints and W the inverse mass: S = E^T W E, and what is left of W once their drives react to
// every impulse is W - W E S^-1 E^T W.
void Solver::hold_joints(const std::vector<JointConstraint> &joints) {
    held_.clear();
    for (std::size_t j = 0; j < joints.size(); j++) {
        if (joints[j].held) {
            held_.push_back(static_cast<int>(j));
        }
    }
    const auto count = static_cast<Eigen::Index>(held_.size());
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_actuators, max_actuators> mass(count, count);
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_actuators, 1> missing(count);
    held_response_.resize(Eigen::NoChange, count);
    for (Eigen::Index k = 0; k < count; k++) {
        const int joint = held_[static_cast<std::size_t>(k)];
        held_response_.col(k) = inverse_mass_.col(6 + joint);
        missing[k] = joints[static_cast<std::size_t>(joint)].target - free_[6 + joint];
    }
    for (Eigen::Index k = 0; k < count; k++) {
        mass.row(k) = held_response_.row(6 + held_[static_cast<std::size_t>(k)]);
    }
    held_mass_.compute(mass);
    held_inverse_ = inverse_mass_ - held_response_ * held_mass_.solve(held_response_.transpose());
    velocity_ = free_ + held_response_ * held_mass_.solve(missing);
    for (const int joint : held_) {  // exactly, not just to rounding
        held_inverse_.row(6 + joint).setZero();
        held_inverse_.col(6 + joint).setZero();
    }
}

void Solver::prepare_contacts(const std::vector<Contact> &contacts, double time_step) {
    const double share = ground_.stiffness / (ground_.stiffness * time_step + ground_.damping);
    rows_.resize(contacts.size());
    for (std::size_t i = 0; i < contacts.size(); i++) {
        const Contact &contact = contacts[i];
        ContactRow &row = rows_[i];
        row.response.noalias() = held_inverse_ * contact.jacobian;
        row.effect.noalias() = contact.jacobian.transpose() * row.response;
        row.push = contact.depth > 0 ? share * contact.depth : contact.depth / time_step;
        const Eigen::Matrix2d tangential = row.effect.bottomRightCorner<2, 2>();
        row.sticking = tangential.inverse();
        const double mean = 0.5 * tangential.trace();
        row.slip_step = 1 / (mean + std::hypot(0.5 * (tangential(0, 0) - tangential(1, 1)), tangential(0, 1)));
    }
}

void Solver::apply_initial_impulses(const std::vector<JointConstraint> &joints, const std::vector<Contact> &contacts) {
    for (std::size_t i = 0; i < contacts.size(); i++) {
        velocity_ += rows_[i].response * contacts[i].impulse;
    }
    for (std::size_t j = 0; j < joints.size(); j++) {
        if (!joints[j].held) {
            velocity_ += held_inverse_.col(6 + static_cast<Eigen::Index>(j)) * joints[j].impulse;
        }
    }
}

void Solver::iterate(std::vector<JointConstraint> &joints, std::vector<Contact> &contacts) {
    for (int iteration = 0; iteration < iterations_; iteration++) {
        double largest = 0;
        for (std::size_t j = 0; j < joints.size(); j++) {
            if (!joints[j].held) {
                largest = std::max(largest, relax(joints[j], 6 + static_cast<int>(j)));
            }
        }
        for (std::size_t i = 0; i < contacts.size(); i++) {
            largest = std::max(largest, relax(contacts[i], rows_[i]));
        }
        if (largest < velocity_tolerance) {
            return;
        }
    }
}

// Returns the change of the joint's rate.
double Solver::relax(JointConstraint &joint, int dof) {
    const double response = held_inverse_(dof, dof);
    const double others = velocity_[dof] - response * joint.impulse;  // rate without this impulse
    double impulse = std::clamp((joint.target - others) / response, -joint.limit, joint.limit);
    const double rate = others + response * impulse;
    const double stopped = std::clamp(rate, joint.lowest, joint.highest);
    if (stopped != rate) {
        impulse = (stopped - others) / response;
    }
    const double change = impulse - joint.impulse;
    velocity_ += held_inverse_.col(dof) * change;
    joint.impulse = impulse;
    return std::abs(change) * response;
}

// Returns the largest change of the contact's relative velocity.
double Solver::relax(Contact &contact, const ContactRow &row) {
    Eigen::Vector3d relative = contact.jacobian.transpose() * velocity_;
    Eigen::Vector3d change;
    const double normal = contact.impulse[0] + (row.push - relative[0] - compliance_ * contact.impulse[0]) /
                                                   (row.effect(0, 0) + compliance_);
    change[0] = std::max(normal, 0.0) - contact.impulse[0];
    const Eigen::Vector2d slip = relative.tail<2>() + row.effect.block<2, 1>(1, 0) * change[0];

    // Stick if friction is able to hold. Else project onto its limit: with the same step for all directions this is at
    // rest only where friction opposes the slip, which clamping each direction by its own effective mass is not.
    const Eigen::Vector2d friction = contact.impulse.tail<2>();
    const double limit = contact.friction * std::max(normal, 0.0);
    Eigen::Vector2d wanted = friction - row.sticking * slip;
    if (wanted.squaredNorm() > limit * limit) {
        wanted = friction - row.slip_step * slip;
        const double size = wanted.norm();
        if (size > limit) {
            wanted *= limit / size;
        }
    }
    change.tail<2>() = wanted - friction;
    velocity_ += row.response * change;
    contact.impulse += change;
    return row.effect.diagonal().cwiseProduct(change).cwiseAbs().maxCoeff();
}

// Finds the impulses of the held joints. Those that ask too much of their drive are released, and true is returned: the
// step has to be solved again. Others that came to their target are held in the next step.
bool Solver::release_overloaded(std::vector<JointConstraint> &joints, const std::vector<Contact> &contacts) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    GeneralVector impulse = GeneralVector::Zero();
    for (const Contact &contact : contacts) {
        impulse += contact.jacobian * contact.impulse;
    }
    for (std::size_t j = 0; j < joints.size(); j++) {
        if (!joints[j].held) {
            impulse[6 + static_cast<Eigen::Index>(j)] += joints[j].impulse;
        }
    }
    const GeneralVector undriven = free_ + inverse_mass_ * impulse;
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_actuators, 1> missing(static_cast<Eigen::Index>(held_.size()));
    for (std::size_t k = 0; k < held_.size(); k++) {
        const int joint = held_[k];
        missing[static_cast<Eigen::Index>(k)] = joints[static_cast<std::size_t>(joint)].target - undriven[6 + joint];
    }
    held_mass_.solveInPlace(missing);

    bool released = false;
    for (std::size_t k = 0; k < held_.size(); k++) {
        JointConstraint &joint = joints[static_cast<std::size_t>(held_[k])];
        joint.impulse = missing[static_cast<Eigen::Index>(k)];
        const double most = joint.target <= joint.lowest ? infinity : joint.limit;
        const double least = joint.target >= joint.highest ? -infinity : -joint.limit;
        if (joint.impulse > most || joint.impulse < least) {
            joint.impulse = std::clamp(joint.impulse, -joint.limit, joint.limit);
            joint.held = false;
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
