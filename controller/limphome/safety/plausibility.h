/* Plausibility of the sensors: whether a state can follow on the one before. A robot has no more than some speed, so a
 * state further away than that leads within the time is a misreading, or the robot has been carried. Such a state is
 * not believed before others have agreed with it. */
#ifndef LIMPHOME_PLAUSIBILITY_H
#define LIMPHOME_PLAUSIBILITY_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/task/observation.h"

#ifdef __cplusplus
extern "C" {
#endif

#define LH_AGREEING_STATES 3 /* in a row, for a place that was not plausible to be believed */

/* How far two states that follow on each other may be apart. */
typedef struct lh_jump_limits {
    float position; /* [m] */
    float attitude; /* angle of the rotation from one to the other [rad] */
    float joint;    /* [rad] */
} lh_jump_limits;

/* What of a state is compared. */
typedef struct lh_place {
    float position[3];             /* [m] */
    lh_quat attitude;              /* unit length */
    float joint[LH_MAX_ACTUATORS]; /* [rad]; 0 for crawlers */
} lh_place;

typedef struct lh_plausibility {
    bool known;        /* `believed` is */
    uint32_t agreeing; /* states that followed on each other since, but not on `believed` */
    lh_place believed; /* newest that was */
    lh_place doubtful; /* newest of those */
} lh_plausibility;

/* What a valid state of `robot` says. Joints that have failed may swing: they are taken to be where they were `before`.
 */
void lh_place_of(const lh_robot *robot, const lh_state *state, const lh_place *before, lh_place *place);

/* Whether b can follow on a. */
bool lh_place_follows(const lh_robot *robot, const lh_jump_limits *limits, const lh_place *a, const lh_place *b);

/* The robot is put elsewhere: any next state is plausible. */
void lh_plausibility_begin(lh_plausibility *plausibility);

/* Whether the state is to be believed: it follows on the one believed before, or is the last of LH_AGREEING_STATES that
 * follow on each other. */
bool lh_plausibility_check(lh_plausibility *plausibility, const lh_robot *robot, const lh_jump_limits *limits,
                           const lh_state *state);

#ifdef __cplusplus
}
#endif
#endif
