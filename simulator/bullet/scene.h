// All that has a state in the simulation: robot, drives and contacts. A new one resets the world.
#pragma once

#include <settings.h>

#include <vector>

#include "bullet/dynamics.h"
#include "bullet/robot.h"
#include "model/drive.h"
#include "model/failure.h"
#include "model/ground.h"
#include "model/randomisation.h"

namespace limphome {

class Scene {
   public:
    // The robot stands on `ground` at `start`, at rest, its arm at its home angles; what fails at time 0 has failed.
    // `ground` must outlive the scene.
    Scene(const RobotModel &model, const settings &configuration, const Ground &ground,
          const std::vector<Failure> &failures, const Start &start);

    void fail(const Failure &failure);
    void set_gravity(const Eigen::Vector3d &gravity);
    void step();

    const std::vector<Contact> &contacts() const { return dynamics_.contacts; }

    Robot robot;
    std::vector<Drive> drives;

   private:
    Eigen::Vector3d at_start(double height) const;
    void place();
    void settle();
    void sink_in(double duration);
    Eigen::Vector3d centre_of_pressure() const;
    void hold_in_place();

    const Ground &ground_;
    const Start start_;
    Dynamics dynamics_;
    double time_step_;
};

}  // namespace limphome
