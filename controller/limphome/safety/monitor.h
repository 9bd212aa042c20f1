/* The monitor: between learner and wire, last. It may only take away, stilling single actuators or the whole robot, and
 * so needs no trust in the learner: what is executed is one of the learner's actions, and is learned as that.
 *
 * It looks at the state before the learner does (lh_monitor_believes) and at the action after it (lh_monitor_check). It
 * is begun anew where the robot is put elsewhere, so a run that goes on from there is that which was never broken. */
#ifndef LIMPHOME_MONITOR_H
#define LIMPHOME_MONITOR_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/safety/collision.h"
#include "limphome/safety/interlock.h"
#include "limphome/safety/plausibility.h"
#include "limphome/safety/stuck.h"
#include "limphome/task/task.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Ranges of lh_monitor_config. */
#define LH_MONITOR_PERIOD_MIN 0.01f     /* [s] */
#define LH_MONITOR_PERIOD_MAX 10.0f     /* [s] */
#define LH_SPEED_LIMIT_MAX 10.0f        /* [m/s or rad/s] */
#define LH_ACCELERATION_LIMIT_MAX 1e4f  /* [m/s^2 or rad/s^2] */
#define LH_STOP_CLEARANCE_MAX 1.0f      /* [rad] */
#define LH_MARGIN_FLOOR_MIN (-1.0f)     /* [m]; the forecast is never below it */
#define LH_MARGIN_FLOOR_MAX 1.0f        /* [m] */
#define LH_COLLISION_CLEARANCE_MAX 1.0f /* [m] */
#define LH_TILT_LIMIT_MIN 0.1f          /* [rad] */
#define LH_TILT_LIMIT_MAX 3.15f         /* [rad]; above pi: none */
#define LH_JUMP_MAX 1e7f                /* [m or rad]; above all that is valid: none */

/* Of crawlers and of joints. */
typedef struct lh_motion_limit {
    float speed;        /* largest, 0 to LH_SPEED_LIMIT_MAX [m/s or rad/s] */
    float acceleration; /* largest change from one decision to the next over the period, 0 to LH_ACCELERATION_LIMIT_MAX
                           [m/s^2 or rad/s^2]; to stop is always allowed */
} lh_motion_limit;

typedef struct lh_monitor_config {
    bool active;               /* false: only invalid and stale states still the robot. Default false */
    float period;              /* of a decision, LH_MONITOR_PERIOD_MIN to _MAX [s]; default 0.5 */
    lh_motion_limit crawler;   /* default 0.5 m/s and 2 m/s^2 */
    lh_motion_limit joint;     /* default 0.5 rad/s and 2 rad/s^2 */
    float stop_clearance;      /* no joint is driven nearer to its stop, 0 to LH_STOP_CLEARANCE_MAX [rad]; default 0 */
    float margin_floor;        /* the margin (11) is not lowered below it, LH_MARGIN_FLOOR_MIN to _MAX [m]; default 0 */
    float collision_clearance; /* parts of the robot are not brought nearer to each other, 0 to
                                  LH_COLLISION_CLEARANCE_MAX [m]; default 0.02 */
    float tilt; /* of the body, beyond which nothing moves, LH_TILT_LIMIT_MIN to _MAX [rad]; default pi/3, which is a
                   tumble: a robot that is put back then is not held for ever */
    lh_jump_limits slack; /* what a state may differ from the one before more than the fastest motion explains, each 0
                             to LH_JUMP_MAX; default 1 m, 1 rad, 0.5 rad */
} lh_monitor_config;

/* So far. */
typedef struct lh_monitor_counts {
    uint64_t decisions;           /* in which something was found */
    uint64_t actuators;           /* stilled, summed over them */
    uint64_t hazards[LH_HAZARDS]; /* decisions in which bit i of lh_hazard was among them */
} lh_monitor_counts;

typedef struct lh_monitor {
    lh_monitor_config config;
    lh_shapes shapes; /* that are kept apart, of the task's robot; none from the start */
    lh_plausibility plausibility;
    lh_stuck stuck;
    bool moving;                      /* `executed` led to the next state, from `plausibility.believed` */
    float executed[LH_MAX_ACTUATORS]; /* velocities of the newest decision [m/s or rad/s] */
    lh_monitor_counts counts;
} lh_monitor;

/* What the monitor made of one decision. */
typedef struct lh_intervention {
    int32_t action;   /* joint action that is executed */
    uint32_t hazards; /* bits of lh_hazard: why it is another than proposed; 0: it is not */
    uint32_t stilled; /* bit k: actuator k of the robot was to move, or might have, and is still */
} lh_intervention;

lh_monitor_config lh_monitor_config_default(void);

/* LH_OK or LH_ERROR_MONITOR. */
lh_error lh_monitor_config_validate(const lh_monitor_config *config);

void lh_monitor_init(lh_monitor *monitor, const lh_monitor_config *config);

/* The robot is put elsewhere: what was sensed and executed before tells nothing of what comes. */
void lh_monitor_begin(lh_monitor *monitor);

/* Something else than the executed action leads to the next state. */
void lh_monitor_gap(lh_monitor *monitor);

/* Whether a valid state is plausible. What it is not to be taken for is then not asked for a second time. */
bool lh_monitor_believes(lh_monitor *monitor, const lh_robot *robot, const lh_state *state);

/* Holds the whole robot for that hazard, velocity[LH_MAX_ACTUATORS] 0. */
void lh_monitor_hold(lh_monitor *monitor, const lh_task *task, lh_hazard hazard, lh_intervention *intervention,
                     float *velocity);

/* What is to be executed instead of joint action `action`, which is proposed on a state that was believed, with its
 * velocity[LH_MAX_ACTUATORS]. `attitude` is that of the body, of unit length. */
void lh_monitor_check(lh_monitor *monitor, const lh_task *task, const lh_state *state, lh_quat attitude, int32_t action,
                      lh_intervention *intervention, float *velocity);

#ifdef __cplusplus
}
#endif
#endif
