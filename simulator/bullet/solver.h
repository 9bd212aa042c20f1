// Finds the impulses of drives, stops and contacts of one time step.
//
// Drives that reach their wanted rate are taken out of the equations exactly; what is left, the base with a few
// contacts, is solved by iteration (contact_problem.h). What that leaves open, the contacts then share (grip.h).
#pragma once

#include <vector>

#include "bullet/contact_problem.h"
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
    void hold_joints(const std::vector<JointConstraint> &joints);
    void release(int joint);
    // Only the first `dofs` velocities change: those of the base while all joints are held, of base and crawlers while
    // those of the arm are; else max_dofs.
    template <int dofs>
    void try_to_solve(ContactProblem<dofs> &problem, std::vector<JointConstraint> &joints,
                      std::vector<Contact> &contacts, double time_step);
    bool release_overloaded(std::vector<JointConstraint> &joints, const std::vector<Contact> &contacts);

    int iterations_;
    GroundStiffness ground_;
    GeneralMatrix mass_;
    GeneralMatrix inverse_;   // velocities per impulse while the held joints keep their rates
    GeneralVector momentum_;  // momentum without drives, stops and contacts
    GeneralVector velocity_;  // velocities so far
    ContactProblem<base_dofs> held_;
    ContactProblem<base_dofs + num_crawlers> arm_held_;
    ContactProblem<max_dofs> released_;
};

}  // namespace limphome
