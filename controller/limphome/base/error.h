/* Errors: what a caller did wrong. What the robot does (tumbling, reaching the goal) is a status, not an error. */
#ifndef LIMPHOME_ERROR_H
#define LIMPHOME_ERROR_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lh_error {
    LH_OK = 0,
    LH_ERROR_UNITS,     /* number of units outside 1 to LH_MAX_UNITS */
    LH_ERROR_INPUTS,    /* number of inputs outside 1 to LH_MAX_INPUTS */
    LH_ERROR_RATE,      /* a learning rate or the discount rate is negative, too large or not finite */
    LH_ERROR_INITIAL,   /* an initial weight or width is out of range */
    LH_ERROR_LIMIT,     /* width floor, weight limit, temperature floor or support tolerance is out of range */
    LH_ERROR_REWARD,    /* a reward coefficient has the wrong sign or is not finite */
    LH_ERROR_EPISODE,   /* episode number below 1: T of (4) is not defined; or an episode setting is out of range */
    LH_ERROR_PATH,      /* the kind of path is unknown, or there are no waypoints, too many, or one is out of range */
    LH_ERROR_SPEED,     /* a speed of the action levels is not positive or not finite */
    LH_ERROR_ACTUATORS, /* number of actuators outside the capacity, or none of them is controlled */
    LH_ERROR_ROBOT,     /* links, supports, masses or ranges of the robot are inconsistent */
    LH_ERROR_STATE,     /* a state holds NaN, infinity, a quaternion far from unit length, or another robot's size */
    LH_ERROR_NETWORK,   /* a network to be restored has other dimensions or values out of range */
    LH_ERROR_RANDOM_STATE, /* a random state to be restored is all zero */
    LH_ERROR_LEARNER,      /* the kind of learner is unknown, or what is to be restored is of another kind */
    LH_ERROR_PLANNER, /* a setting of the planner, or of a planner to be restored, is out of range or does not fit */
    LH_ERROR_MONITOR, /* a setting of the monitor is out of range */
    LH_ERROR_COUNT    /* number of entries above, not an error */
} lh_error;

/* One English sentence without a full stop, for any value; never NULL. */
const char *lh_error_text(lh_error error);

#ifdef __cplusplus
}
#endif
#endif
