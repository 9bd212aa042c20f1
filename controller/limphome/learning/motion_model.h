/* Motion model: by how much the motions that the robot measures differ from what is expected of them, by action and
 * posture of the arm. A pool of samples, and two kernels round the posture asked for: a wide one that generalises and a
 * narrow one that is exact. */
#ifndef LIMPHOME_MOTION_MODEL_H
#define LIMPHOME_MOTION_MODEL_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/base/capacity.h"
#include "limphome/base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What one action does within a decision. The path between two poses is taken to be along and across the heading
 * midway. */
typedef struct lh_motion {
    float forward;  /* [m] */
    float sideways; /* positive to the left [m] */
    float turn;     /* positive to the left [rad] */
    float moved;    /* joint motion that happened as a share of that commanded, 0 to 1; 1 where none was commanded */
} lh_motion;

#define LH_MOTION_PARTS 4     /* of lh_motion */
#define LH_SAMPLE_COUNT_MAX 8 /* more measurements do not make a sample stiffer: it follows a robot that changes */

typedef struct lh_motion_model {
    int32_t num_actions;            /* 1 to LH_PLANNED_ACTIONS */
    int32_t num_joints;             /* of a posture, 0 to LH_PLANNED_JOINTS */
    float low[LH_PLANNED_JOINTS];   /* [num_joints] least angle [rad] */
    float width[LH_PLANNED_JOINTS]; /* [num_joints] of the narrow kernel [rad]; the wide one has twice that */
    float prior_weight;             /* of "as expected" against the measurements under the wide kernel [measurements] */
    int32_t num_samples;
    /* [num_samples] */
    int16_t posture[LH_PLANNED_JOINTS][LH_MAX_SAMPLES]; /* angles above `low` in kernel widths / 512 */
    int16_t motion[LH_MOTION_PARTS][LH_MAX_SAMPLES];    /* measured less expected, in 2^-14 m, rad or 1 */
    int16_t action[LH_MAX_SAMPLES];
    int16_t count[LH_MAX_SAMPLES];   /* measurements in it, 1 to LH_SAMPLE_COUNT_MAX */
    int32_t updated[LH_MAX_SAMPLES]; /* when the newest came in */
} lh_motion_model;

/* What the samples round a posture say of one action. */
typedef struct lh_motion_sums {
    float wide_weight, wide[LH_MOTION_PARTS];
    float narrow_weight; /* 0: nothing is known here; 1: as if measured once just here */
    float narrow[LH_MOTION_PARTS];
} lh_motion_sums;

/* Empties the model. Arguments as in the struct; `width` above 0. */
void lh_motion_model_init(lh_motion_model *model, int32_t num_actions, int32_t num_joints, const float *low,
                          const float *width, float prior_weight);

/* Takes in a measurement: `action`, with the arm at angle[num_joints] [rad], differed by `difference` from what was
 * expected. Close to a sample of the same action, that one is moved towards it; else it is a new one, for which the one
 * gives way that was updated longest ago where there is no room. `now` never falls from call to call. */
void lh_motion_model_insert(lh_motion_model *model, int32_t action, const float *angle, const lh_motion *difference,
                            int32_t now);

/* Sums over the samples round angle[num_joints], into sums[num_actions]. */
void lh_motion_model_gather(const lh_motion_model *model, const float *angle, lh_motion_sums *sums);

/* The motion of an action that was expected to be *motion, by the sums of that action. */
void lh_motion_model_correct(const lh_motion_model *model, const lh_motion_sums *sums, lh_motion *motion);

/* Whether `saved` is of the actions and postures of `model` and its samples, also those that are not used, are in
 * range. */
bool lh_motion_model_fits(const lh_motion_model *saved, const lh_motion_model *model);

#ifdef __cplusplus
}
#endif
#endif
