// Finds the impulses of drives, stops and contacts of one time step.
//
// Drives that reach their wanted rate are taken out of the equations exactly; what is left, the base with a few
// contacts, is solved by projected Gauss-Seidel: each contact in turn is brought to a state that fulfils the law of its
// ground spring and the law of friction (friction.h). What that leaves open, the contacts then share (grip.h).
#pragma once

#include <vector>

#include "bullet/contact.h"
#include "bullet/friction.h"
#include "bullet/grip.h"
#include "bullet/mass_matrix.h"
#include "model/drive.h"

namespace limphome {

class Solver {
   public:
    Solver(int iterations, const GroundStiffness &ground) : iterations_(iterations), ground_(ground) {}

    // Returns the velocities at the end of the step and fills in the impulses. `momentum`, mass times velocity, is what
    // the robot would have then without drives, stops and contacts.
    const GeneralVector &solve(const GeneralMatrix &mass, const GeneralVector &momentum,
                               std::vector<JointConstraint> &joints, std::vector<Contact> &contacts, double time_step);

   private:
    // What relaxing one contact needs. Normal law: velocity + compliance * impulse = push while the impulse is above 0.
    struct ContactRow {
        Eigen::Matrix<double, max_dofs, 3> response;  // velocities per unit impulse along each axis
        Eigen::Matrix3d effect;                       // relative velocity per unit impulse
        Eigen::Vector3d steady;                       // relative velocity from joints that keep their rates [m/s]
        double push;                                  // [m/s]
        double compliance;                            // [1/kg]
        double normal_step;                           // impulse per lack of velocity along the normal [kg]
        Tangents tangents;
    };

    void hold_joints(const std::vector<JointConstraint> &joints);
    void release(int joint);
    // Only the first `dofs` velocities change: those of the base while all joints are held, of base and crawlers while
    // those of the arm are; else max_dofs.
    template <int dofs>
    void try_to_solve(std::vector<JointConstraint> &joints, std::vector<Contact> &contacts, double time_step);
    template <int dofs>
    void prepare_contacts(const std::vector<Contact> &contacts, double time_step);
    template <int dofs>
    void apply_known_impulses(const std::vector<JointConstraint> &joints, const std::vector<Contact> &contacts);
    template <int dofs>
    void iterate(std::vector<JointConstraint> &joints, std::vector<Contact> &contacts);
    double relax(JointConstraint &joint, int dof);
    template <int dofs>
    double relax(Contact &contact, const ContactRow &row);
    template <int dofs>
    bool sticks(const Contact &contact, const ContactRow &row) const;
    template <int dofs>
    void relieve(std::vector<Contact> &contacts);
    bool release_overloaded(std::vector<JointConstraint> &joints, const std::vector<Contact> &contacts);

    int iterations_;
    GroundStiffness ground_;
    double compliance_ = 0;  // of the ground over one step [1/kg]
    GeneralMatrix mass_;
    GeneralMatrix inverse_;   // velocities per impulse while the held joints keep their rates
    GeneralVector momentum_;  // momentum without drives, stops and contacts
    GeneralVector velocity_;  // velocities so far
    std::vector<ContactRow> rows_;
    std::vector<Grip> grips_;
};

}  // namespace limphome
