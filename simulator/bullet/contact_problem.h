// What contacts and drives at their limits do in one time step: the impulses with which all their laws hold at once.
//
// Sweeps bring each contact in turn to a state that fulfils the law of its ground spring and the law of friction
// (friction.h). Between sweeps all of them jump at once to where they would be if each kept on doing what it does:
// nothing, sticking, or slipping in its direction (Newton's method). A jump that does not make things far better is
// taken back.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "bullet/contact.h"
#include "bullet/friction.h"
#include "bullet/grip.h"
#include "bullet/mass_matrix.h"
#include "model/drive.h"

namespace limphome {

// Only the first `dofs` velocities change. They are scaled by a root of the inverse mass matrix, so that a unit of each
// has the same energy: the column by which an impulse changes them is then the one by which they move its contact.
template <int dofs>
class ContactProblem {
   public:
    using Velocity = Eigen::Matrix<double, dofs, 1>;

    // Gets memory for so many contacts, which then may come and go without.
    void reserve(std::size_t contacts);
    // `inverse`: velocities per impulse while the held joints keep their rates; `velocity`: without the impulses of
    // joints that are not held and of contacts. `compliance`: of the ground over one step [1/kg].
    void prepare(const GeneralMatrix &inverse, const GeneralVector &velocity, const GroundStiffness &ground,
                 double time_step, const std::vector<JointConstraint> &joints, const std::vector<Contact> &contacts);
    // Finds the impulses in at most so many sweeps, beginning with those that are there.
    void solve(int sweeps, std::vector<JointConstraint> &joints, std::vector<Contact> &contacts);
    // Takes out of the friction that sticks what has no effect, so that no drive bears it.
    void relieve(std::vector<Contact> &contacts);

    // What the impulses make of the velocities.
    Velocity change() const { return root_.lazyProduct(velocity_); }

   private:
    using Square = Eigen::Matrix<double, dofs, dofs>;

    // Normal law: velocity + compliance * impulse = push while the impulse is above 0.
    struct ContactRow {
        Eigen::Matrix<double, dofs, 3> columns;  // scaled velocities per unit impulse along each axis
        Eigen::Matrix3d effect;                  // relative velocity per unit impulse
        Eigen::Vector3d steady;                  // relative velocity without any impulse [m/s]
        double push;                             // [m/s]
        double compliance;                       // [1/kg]
        double normal_step;                      // impulse per lack of velocity along the normal [kg]
        Tangents tangents;
    };
    // A joint that is not held.
    struct JointRow {
        std::size_t joint;
        Velocity column;  // scaled velocities per unit impulse
        double effect;    // rate per unit impulse
        double steady;    // rate without any impulse [rad/s]
    };
    // Impulse = constant - stiffness * relative velocity, as long as a contact goes on doing what it does.
    struct ContactLaw {
        Eigen::Matrix3d stiffness;
        Eigen::Vector3d constant;
    };
    struct JointLaw {
        double stiffness;
        double constant;
    };
    // What a joint is brought to.
    struct JointStep {
        double impulse;
        double rate;   // [rad/s]
        bool reached;  // its target or a stop, not the limit of its drive
    };
    struct State {
        Velocity velocity;
        std::vector<Eigen::Vector3d> contacts;  // impulses
        std::array<double, max_actuators> joints;
    };

    void prepare_contact(const Contact &contact, const GroundStiffness &ground, double time_step, ContactRow &row);
    Eigen::Vector3d relative(const ContactRow &row) const {
        return row.steady + row.columns.transpose().lazyProduct(velocity_);
    }
    double sweep(std::vector<JointConstraint> &joints, std::vector<Contact> &contacts);
    JointStep next(const JointConstraint &joint, const JointRow &row) const;
    double relax(JointConstraint &joint, const JointRow &row);
    double relax(Contact &contact, const ContactRow &row);
    bool sticks(const Contact &contact, const ContactRow &row) const;

    // contact_jump.cpp
    bool jump(double &largest, std::vector<JointConstraint> &joints, std::vector<Contact> &contacts);
    bool find_target(const std::vector<JointConstraint> &joints, const std::vector<Contact> &contacts);
    JointLaw law(const JointConstraint &joint, const JointRow &row) const;
    ContactLaw law(const Contact &contact, const ContactRow &row) const;
    void go(const State &state, std::vector<JointConstraint> &joints, std::vector<Contact> &contacts);

    Square root_;
    Velocity velocity_;  // scaled, what all impulses so far make of it
    std::vector<ContactRow> rows_;
    std::vector<JointRow> joint_rows_;
    std::vector<ContactLaw> laws_;
    State start_, target_;  // of a jump
    std::vector<Grip> grips_;
};

}  // namespace limphome
