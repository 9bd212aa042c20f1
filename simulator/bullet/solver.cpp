#include "bullet/solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limphome {
namespace {

// A joint that lacks less than this of its target has come to it [rad/s].
constexpr double reached = 1e-5;

}  // namespace

const GeneralVector &Solver::solve(const GeneralMatrix &mass, const GeneralVector &momentum,
                                   std::vector<JointConstraint> &joints, std::vector<Contact> &contacts,
                                   double time_step) {
    held_.reserve(contacts.capacity());  // there may be more in a later step
    arm_held_.reserve(contacts.capacity());
    released_.reserve(contacts.capacity());
    mass_ = mass;
    momentum_ = momentum;
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
        try_to_solve(held_, joints, contacts, time_step);
        all_held = !release_overloaded(joints, contacts);
    }
    if (!all_held) {
        do {
            hold_joints(joints);
            const bool arm_held = std::all_of(joints.begin() + num_crawlers, joints.end(),
                                              [](const JointConstraint &joint) { return joint.held; });
            if (arm_held) {
                try_to_solve(arm_held_, joints, contacts, time_step);
            } else {
                try_to_solve(released_, joints, contacts, time_step);
            }
        } while (release_overloaded(joints, contacts));
    }
    return velocity_;
}

template <int dofs>
void Solver::try_to_solve(ContactProblem<dofs> &problem, std::vector<JointConstraint> &joints,
                          std::vector<Contact> &contacts, double time_step) {
    problem.prepare(inverse_, velocity_, ground_, time_step, joints, contacts);
    problem.solve(iterations_, joints, contacts);
    velocity_.head<dofs>() += problem.change();
    problem.relieve(contacts);
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
        for (std::size_t j = 0; j < joints.size(); j++) {
            JointConstraint &joint = joints[j];
            const double missing = joint.target - velocity_[base_dofs + static_cast<Eigen::Index>(j)];
            joint.held = joint.held || std::abs(joint.impulse) < joint.limit || std::abs(missing) < reached;
        }
    }
    return released;
}

}  // namespace limphome
