/* Model-based learner. It expects of each joint action what quasi-static mechanics says (quasi_static.h), learns from
 * its own measurements by how much that is wrong (motion_model.h), and plans on the two between decisions: value
 * iteration over postures and steering errors (posture_values.h), and a search of two steps from where the robot is.
 *
 * Steering error: heading error + LH_STEERING_GAIN times lateral error against the line of the episode.
 *
 * The planning reward of a decision that goes p along the line and d across the robot is
 *     forward p - sideways |d| - steering h(steering error) - cost(posture),
 * with h(x) = x^2/0.1 up to 0.1 rad and 2 |x| - 0.1 beyond, and
 *     cost = stability exp(-S) + unsafe min(3, max(0, 1 - S/S_safe)),
 * S the margin (11) of the robot at rest in that posture. forward, sideways and stability are those of (8) and (12). */
#ifndef LIMPHOME_PLANNER_H
#define LIMPHOME_PLANNER_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/base/random.h"
#include "limphome/body/quasi_static.h"
#include "limphome/learning/choice.h"
#include "limphome/learning/motion_model.h"
#include "limphome/learning/planned.h"
#include "limphome/learning/posture_values.h"
#include "limphome/task/task.h"

#ifdef __cplusplus
extern "C" {
#endif

#define LH_STEERING_GAIN 0.7f /* [rad/m] */

typedef struct lh_planner_config {
    float decision_period; /* [s] */
    float discount_rate;
    float curiosity;
    float curiosity_decay;
    float random_share;
    float stuck_share;
    float steering;
    float unsafe;
    float safe_margin;
    float width[3];
    float prior_weight;
    float physics;
    float ground_rate;
    float friction;
    int32_t candidates;
    int32_t backups;
    int32_t imagined_steps;
    float tuning[8];
} lh_planner_config;

/* What a posture promises. */
typedef struct lh_outlook {
    lh_rest rest;
    lh_footing footing;
    lh_motion_sums sums[LH_PLANNED_ACTIONS];
} lh_outlook;

typedef struct lh_planner {
    lh_planner_config config;
    lh_task_config task;
    lh_robot robot;
    lh_planned planned;

    lh_motion_model model;
    lh_posture_values values;
    lh_random random;
    lh_vec3 ground; /* normal in the world */
    int32_t round;  /* next node in turn */
    int32_t decisions;
    float curiosity; /* left */
    float pace;
    float best_pace;

    /* the step under way */
    bool acting;
    int32_t action; /* planned */
    lh_motion expected;
    lh_pose2 pose;
    float angle[LH_PLANNED_JOINTS];
    int32_t node;
    /* progress */
    float best_distance; /* least goal distance of the episode [m] */
    int32_t stalled;     /* decisions since it fell by 5 cm */

    /* while planning */
    float joint_angle[LH_MAX_ACTUATORS]; /* of the newest state */
    lh_vec3 up;                          /* vertical in the frame of the ground along the line */
    lh_outlook outlook;
} lh_planner;

lh_planner_config lh_planner_config_default(void);
lh_error lh_planner_config_validate(const lh_planner_config *config);
lh_error lh_planner_init(lh_planner *planner, const lh_planner_config *config, const lh_task *task, uint64_t seed);
void lh_planner_begin(lh_planner *planner);
void lh_planner_step(lh_planner *planner, const lh_observed *observed, bool learn, bool greedy, lh_choice *choice);

#ifdef __cplusplus
}
#endif
#endif
