/* Quasi-static motion on the ground. At walking pace friction alone decides how the body moves: so that the power lost
 * by sliding, the sum over the supports of friction times load times speed of the slip, less the power that gravity
 * gives on a slope, is least (Coulomb friction, no inertia). Where all supports have the same friction its coefficient
 * drops out on level ground: the answer follows from geometry and masses alone. */
#ifndef LIMPHOME_QUASI_STATIC_H
#define LIMPHOME_QUASI_STATIC_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/body/rest.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the robot stands on while it rests: points on the ground in the frame of the ground (x along the heading, y to
 * the left, origin under that of the body), and how each actuator moves them against the body. */
typedef struct lh_footing {
    int32_t count;               /* supports that carry; 0: the robot rests nowhere, and nothing is predicted */
    float x[LH_MAX_SUPPORTS];    /* [count], [m] */
    float y[LH_MAX_SUPPORTS];    /* [count], [m] */
    float load[LH_MAX_SUPPORTS]; /* [count] share of the weight, sum 1 */
    float shift_x[LH_MAX_ACTUATORS][LH_MAX_SUPPORTS]; /* [num_actuators][count] by the actuator's whole travel [m] */
    float shift_y[LH_MAX_ACTUATORS][LH_MAX_SUPPORTS]; /* likewise [m] */
    bool level;           /* no gravity along the ground: the opposite of an action does the opposite */
    float pull_x, pull_y; /* gravity along the ground over friction times weight */
    float travel;         /* the longest of any actuator [m or rad] */
} lh_footing;

/* A planar motion of the body in its own frame at the start. */
typedef struct lh_twist {
    float forward;  /* [m] */
    float sideways; /* positive to the left [m] */
    float turn;     /* positive to the left [rad] */
} lh_twist;

/* `rest` is that of joint_angle[robot->num_actuators] with `up` (rest.h). travel[robot->num_actuators]: how far each
 * actuator goes in the time in question, above 0 [m of belt or rad]. Crawlers are actuators 0, left, and 1, right;
 * supports of the base on its left are the left crawler's. `friction` is a guess, of use on slopes only. */
void lh_footing_find(const lh_robot *robot, const float *joint_angle, const lh_rest *rest, lh_vec3 up,
                     const float *travel, float friction, lh_footing *footing);

#define LH_MOTIONS 4 /* found at a time */

/* How far each actuator goes, of its travel: of[num_actuators], -1 to 1. */
typedef struct lh_shares {
    float of[LH_MAX_ACTUATORS];
} lh_shares;

/* Where the body goes by share[m] of each of `count` motions, 1 to LH_MOTIONS, into twist[count]. Several at a time
 * take little longer than one on processors with vectors. */
void lh_quasi_static_motions(const lh_footing *footing, int32_t num_actuators, int32_t count, const lh_shares *share,
                             lh_twist *twist);

/* One of them, by share[num_actuators]. */
lh_twist lh_quasi_static_motion(const lh_footing *footing, int32_t num_actuators, const float *share);

#ifdef __cplusplus
}
#endif
#endif
