/* The controller: one call per decision. It learns from the step that has just ended and chooses the next action.
 *
 *     lh_controller_init(&controller, &config, &robot, &controlled);
 *     put the robot into its initial pose;
 *     for (;;) {
 *         read the sensors into state;
 *         lh_controller_step(&controller, &state, &decision);
 *         if (decision.reset) { put the robot into its initial pose; continue; }
 *         drive the actuators with decision.velocity for one decision period;
 *     }
 *
 * The caller owns the struct; there is no other state. About 44 KiB with the default capacities. */
#ifndef LIMPHOME_CONTROLLER_H
#define LIMPHOME_CONTROLLER_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/learning/boltzmann.h"
#include "limphome/task/episode.h"
#include "limphome/body/kinematics.h"
#include "limphome/learning/learner.h"
#include "limphome/task/observation.h"
#include "limphome/task/reward.h"
#include "limphome/body/robot.h"
#include "limphome/body/stability.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lh_config {
    uint64_t seed;             /* of all random numbers */
    bool learn;                /* false: the network stays as it is */
    bool greedy;               /* true: always a best action; false: Boltzmann selection */
    float crawler_speed;       /* of the forward and reverse levels, 0.01 to 2 m/s; paper: 0.3 */
    float joint_speed;         /* of the forward and reverse levels, 0.01 to 2 rad/s; paper: 0.3 */
    float temperature_floor;   /* least T of (4), 1e-4 to 10; default 0.01 */
    float support_tolerance;   /* see lh_kinematics_posture, 0.001 to 1 m; default 0.03 */
    lh_learner_config learner; /* learner.network.inputs is set by init from the controlled actuators */
    lh_reward_config reward;
    lh_episode_config episode;
} lh_config;

/* An episode that has ended. */
typedef struct lh_summary {
    int32_t number; /* from 1 */
    lh_outcome outcome;
    int32_t steps;
    lh_reward total;
    float lateral_error;  /* positive to the left [m] */
    float heading_change; /* end minus start, (-pi, pi] [rad] */
    float temperature;    /* T of (4) */
    lh_pose2 start;
    float goal_distance; /* from start to goal line [m] */
} lh_summary;

/* What one call saw, learned and chose. */
typedef struct lh_decision {
    /* the step that has just ended; reward and td_error are 0 where there was none */
    bool stepped;       /* false on the first call, after a reset, and after lh_controller_begin */
    bool learned;       /* stepped, and the network was changed */
    lh_reward reward;   /* of that step */
    float td_error;     /* delta of (1) */
    bool ended;         /* that step ended an episode, told in `summary` */
    lh_summary summary; /* valid if ended */

    /* this state */
    int32_t episode;        /* running episode, from 1; with `reset`, the one that has just ended */
    int32_t step;           /* decisions before this one in the running episode */
    float stability_margin; /* S_NE of (11) [m] */
    float goal_distance;    /* to the goal line of the running episode [m] */
    float lateral_error;    /* from the straight line of the running episode, positive to the left [m] */
    int32_t num_inputs;
    float inputs[LH_MAX_INPUTS]; /* of the network: states, roll, pitch, then (unless `reset`) the action */

    /* what to do now */
    bool reset; /* put the robot into its initial pose; nothing below is set */
    lh_choice choice;
    float temperature;                /* T of (4) */
    float velocity[LH_MAX_ACTUATORS]; /* [robot.num_actuators], m/s or rad/s; 0 where not controlled */
} lh_decision;

/* How often a limit acted. */
typedef struct lh_clamped {
    uint64_t inputs;       /* sensor values limited to their range */
    uint64_t temperatures; /* decisions with the temperature at its floor */
    uint64_t margins;      /* stability margins taken to be LH_LEAST_MARGIN */
} lh_clamped;

typedef struct lh_controller {
    lh_config config;
    lh_robot robot;
    lh_controlled controlled;
    lh_learner learner;
    lh_episode episode;
    /* the step under way */
    bool acting;                       /* an action was chosen and its result is awaited; false: episode.number begins
                                          at the next state */
    int32_t action;                    /* chosen joint action */
    lh_pose2 pose;                     /* where it was chosen */
    float inputs[LH_MAX_STATE_INPUTS]; /* state inputs there */
    lh_clamped clamped;                /* so far; what was held in learning is counted in learner.held */
} lh_controller;

/* The paper's values, learning, with Boltzmann selection. */
lh_config lh_config_default(void);

/* LH_OK, or the error of the first bad field. */
lh_error lh_config_validate(const lh_config *config);

/* Sets up a learner that knows nothing, before episode 1. `controlled` must list 1 or more ascending actuator indices.
 * On an error nothing is changed. */
lh_error lh_controller_init(lh_controller *controller, const lh_config *config, const lh_robot *robot,
                            const lh_controlled *controlled);

/* Goes on from what was learned before: takes over network and random state, and begins with episode `episode`
 * (1 to 1000000000) at the next state. Restored where a reset was asked for, it goes on bit by bit as if unbroken.
 * On an error nothing is changed. */
lh_error lh_controller_restore(lh_controller *controller, const lh_network *network, const uint32_t random_state[4],
                               int32_t episode);

/* One decision. LH_ERROR_STATE, and nothing changed, if the state is not valid: hold still and call again.
 * An episode that ends on the goal line or by the time limit is followed by the next from where the robot is, unless
 * its number is a multiple of config.episode.reset_every; then, and after a tumble, `reset` is asked for. Episode
 * 1000000000 is followed by others of the same number.
 * Learning, max over a of Q(s, a) in (1) is that of the network before it learns; the choice is made by the network
 * after. */
lh_error lh_controller_step(lh_controller *controller, const lh_state *state, lh_decision *decision);

/* The robot has been put into its initial pose without being asked to (a plant that restarted, say): the step under
 * way is forgotten, and the running episode begins anew at the next state. */
void lh_controller_begin(lh_controller *controller);

#ifdef __cplusplus
}
#endif
#endif
