// The machine: a robot with its sensors and drives, simulated or real, as the plant's loop sees it.
//
// A plant is a machine behind a loop (loop.h) and a link (link.h). The driver of a real robot links limphome_plant,
// which needs neither Bullet nor Eigen, derives a class from Machine and hands it to the loop:
//
//   MyRobot robot;
//   limphome::Link link(url, settings, robot.num_actuators());
//   limphome::Loop(robot, link, settings).run(&stop);
//
// What every machine has to do is pure; what only some of them can has a default that claims nothing. All calls come
// from the thread that runs the loop, one at a time. Frames, units and the order of the actuators are those of
// lcmtypes/limphome_robot_state.lcm. A machine that cannot go on throws std::exception; the loop passes it on.
#pragma once

#include <cstdint>
#include <functional>
#include <limphome/ground_truth_t.hpp>
#include <limphome/robot_state_t.hpp>

#include "plant/capacity.h"

namespace limphome {

// Whether an actuator does what it is told: robot_state_t.actuator_health.
enum class Health : int8_t {
    obeys = robot_state_t::OBEYS,
    failed = robot_state_t::FAILED,  // does not obey: locked, free or slipping
    weak = robot_state_t::WEAK       // obeys, with less than its rated torque
};

class Machine {
   public:
    virtual ~Machine() = default;

    // 1 to max_actuators; the same for ever.
    virtual int num_actuators() const = 0;

    // Puts the robot into its initial pose, at rest, and returns once it is there: on hardware that may take a while
    // and a person. Called when a controller takes the machine up, between episodes and after a fault; not when the
    // loop begins, the machine is where it is. What is drawn at random follows from `episode`, the number of the one
    // that begins, 0 before the first.
    virtual void reset(int64_t episode) = 0;

    // Whether reset() does so. A machine out in the field is not carried back: it stays where it is when a controller
    // takes it up, and reset() is called after a fault alone, to make it fit to go on from there.
    virtual bool can_be_carried_back() const { return true; }

    // Wanted rates from now on: belt speeds of the crawlers [m/s], then rates of the arm joints [rad/s]; entries from
    // num_actuators() on are 0. All are 0 when a session begins or ends and when the loop ends, whatever ends it.
    virtual void command(const double velocity[max_actuators]) = 0;

    // Reads the sensors: fills in utime, by the machine's own clock, num_actuators, and all from position to
    // actuator_effort. The loop and the link see to the rest.
    virtual void sense(robot_state_t &state) = 0;

    // The same as an onlooker sees it: as it is now, without the errors of the sensors and without drawing any; viewers
    // are shown that. False: the machine knows no more than its sensors tell.
    virtual bool exact(robot_state_t & /*state*/) const { return false; }

    // Of each actuator, 0 to num_actuators() - 1; what fails is told with the next state.
    virtual Health health(int actuator) const = 0;

    // The next `seconds` of the machine's time, above 0. A simulator integrates that far. The time of a real machine
    // passes by itself: there is nothing to do, and the loop, which follows the clock, waits until they are over.
    virtual void advance(double /*seconds*/) {}

    // The same, asking before each time step, of so many seconds, whether to do it; what is left after the first no is
    // not done. So a person may look closer at what happens within a decision period. A machine that does not ask is
    // held up between two of them.
    virtual void advance_asking(double seconds, const std::function<bool(double)> &may_step) {
        if (may_step(seconds)) {
            advance(seconds);
        }
    }

    // Whether time stands still until one of the two is called, so that the loop may run in lockstep with the
    // controller.
    virtual bool can_pause() const { return false; }

    // Whether the last advance() ended in a state that is of no use: a simulation that left all bounds, a real machine
    // whose readings cannot be trusted. The loop reports a fault, publishes no such state and resets the machine.
    virtual bool diverged() const { return false; }

    // What only a simulator knows of the machine as it is now: fills in all but utime, session and seq and returns
    // true. False: there is nothing to tell, and nothing is published.
    virtual bool truth(ground_truth_t & /*truth*/) const { return false; }

    // Since the machine was made, over all resets: simulated time [s], and drives at their torque limit, counted per
    // time step and actuator. 0: nothing is simulated, or counted.
    virtual double simulated_time() const { return 0; }
    virtual int64_t saturated() const { return 0; }
};

}  // namespace limphome
