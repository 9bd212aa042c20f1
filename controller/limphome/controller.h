/* The controller: one call per decision. It learns from the step that has just ended and chooses the next action.
 *
 *     lh_controller_init(&controller, &config, &robot, &controlled);
 *     put the robot into its initial pose;
 *     for (;;) {
 *         read the sensors into state;
 *         lh_controller_step(&controller, &state, &decision);
 *         if (decision.observed.reset) { put the robot into its initial pose; continue; }
 *         drive the actuators with decision.velocity for one decision period;
 *     }
 *
 * The caller owns the struct; there is no other state. About 64 KiB with the default capacities. */
#ifndef LIMPHOME_CONTROLLER_H
#define LIMPHOME_CONTROLLER_H

#include <stdint.h>

#include "limphome/learning/learner.h"
#include "limphome/safety/monitor.h"
#include "limphome/task/task.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lh_config {
    lh_task_config task;
    lh_learner_config learner;
    lh_monitor_config monitor;
} lh_config;

/* What one call saw, learned, chose and executes. */
typedef struct lh_decision {
    lh_observed observed;             /* by the task; where the robot is held for its state, episode and step alone */
    lh_choice choice;                 /* of the learner, as it was proposed */
    lh_intervention intervention;     /* of the monitor, and the action that is executed; all 0 with reset */
    float velocity[LH_MAX_ACTUATORS]; /* [robot.num_actuators], m/s or rad/s; 0 where not controlled, and with reset */
} lh_decision;

typedef struct lh_controller {
    lh_task task;
    lh_learner learner;
    lh_monitor monitor;
} lh_controller;

/* The paper's values, learning, with Boltzmann selection, without the monitor. */
lh_config lh_config_default(void);

/* LH_OK, or the error of the first bad field. */
lh_error lh_config_validate(const lh_config *config);

/* Sets up a learner that knows nothing, before episode 1. `controlled` must list 1 or more ascending actuator indices.
 * On an error nothing is changed. */
lh_error lh_controller_init(lh_controller *controller, const lh_config *config, const lh_robot *robot,
                            const lh_controlled *controlled);

/* Parts of the robot that the monitor keeps apart, where it is on: none before this call. LH_OK, or LH_ERROR_ROBOT, and
 * nothing is changed. */
lh_error lh_controller_keep_apart(lh_controller *controller, const lh_shapes *shapes);

/* Goes on from what was learned before (lh_learner_save), and begins with episode `episode` (1 to LH_LAST_EPISODE) at
 * the next state. Saved where a reset was asked for, it goes on bit by bit as if unbroken. On an error nothing is
 * changed. */
lh_error lh_controller_restore(lh_controller *controller, const lh_learned *learned, int32_t episode);

/* One decision. With LH_ERROR_STATE the state is not valid: the decision holds the robot still, and the step under way
 * is forgotten, as with a state that the monitor does not believe. */
lh_error lh_controller_step(lh_controller *controller, const lh_state *state, lh_decision *decision);

/* One decision of a person who drives by hand, in place of the learner's: direction[robot.num_actuators] is -1 for
 * reverse, 1 for forward, at the speeds of the task, and anything else for still; entries of actuators that are not
 * controlled are not looked at. The monitor checks it even where it is off for the learner, so that nothing that has
 * failed is commanded. The choice is the action that is wanted, all else in it 0.
 *
 * The episode under way is forgotten, and nothing is rewarded, learned or drawn: what the learner knows does not depend
 * on what a person did. It begins anew at each state, and so at the next lh_controller_step, where the robot stands
 * then, as after lh_controller_resume. A robot that has tumbled asks for its initial pose (observed.reset). Error as of
 * lh_controller_step. */
lh_error lh_controller_drive(lh_controller *controller, const lh_state *state, const int8_t *direction,
                             lh_decision *decision);

/* The decision where there is no state, or one too old to act on: the robot is held, and the step forgotten. */
void lh_controller_hold(lh_controller *controller, lh_decision *decision);

/* Switches the monitor on, for good: for a robot that is real. */
void lh_controller_guard(lh_controller *controller);

/* The robot has been put into its initial pose without being asked to (a plant that restarted, say): the step under
 * way is forgotten, and the running episode begins anew at the next state. */
void lh_controller_begin(lh_controller *controller);

/* The robot stands where it was left and is not carried back, as a machine that a controller finds after a restart: the
 * step under way is forgotten, and `episode` (1 to LH_LAST_EPISODE) begins at the next state, on the leg of the path
 * that is nearest (lh_path_resume). */
void lh_controller_resume(lh_controller *controller, int32_t episode);

/* Something else than the action under way leads to the next state, such as a hold, a pause or states that were missed:
 * that step is forgotten, nothing is rewarded or learned, while the episode goes on. */
void lh_controller_gap(lh_controller *controller);

#ifdef __cplusplus
}
#endif
#endif
