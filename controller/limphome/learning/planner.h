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

/* Ranges of lh_planner_config. */
#define LH_PLANNER_WEIGHT_MAX 100.0f /* of weights in the planning reward */
#define LH_CANDIDATES_MAX 10
#define LH_SWEEPS_MAX 100
#define LH_BACKUPS_MAX 1000
#define LH_DECISION_PERIOD_MIN 0.01f /* [s] */
#define LH_DECISION_PERIOD_MAX 10.0f /* [s] */

typedef struct lh_planner_config {
    float decision_period; /* LH_DECISION_PERIOD_MIN to _MAX [s]; default 0.5 */
    float discount_rate;   /* 0 to LH_DISCOUNT_RATE_MAX; default 0.99: what it takes to fetch the arm must pay */
    bool mechanics;        /* true: what is not known is expected by quasi_static.h; false: that nothing moves but the
                              arm. Default true */
    float steering;        /* weight of the steering error, 0 to LH_PLANNER_WEIGHT_MAX; default 1.5 */
    float unsafe;          /* weight of a margin below the safe one, 0 to LH_PLANNER_WEIGHT_MAX; default 3 */
    float caution; /* reward withheld from what was never tried where the arm is, when greedy: what is not known cannot
                      be put right then. 0 to LH_PLANNER_WEIGHT_MAX; default 1 */
    float random_share; /* of actions taken at random while it learns, 0 to 1; default 0.01 */
    int32_t candidates; /* actions looked into by a second step, 1 (none) to LH_CANDIDATES_MAX; default 5 */
    int32_t sweeps;     /* of value iteration over all postures before the first decision, 0 to LH_SWEEPS_MAX; default
                           10 */
    int32_t backups;    /* nodes backed up in turn by each decision, 0 to LH_BACKUPS_MAX; default 8 */
} lh_planner_config;

/* All that a later run needs to go on as if unbroken from where a reset was asked for. */
typedef struct lh_planner_learned {
    lh_motion_model model;
    lh_posture_values values;
    lh_random random;
    lh_vec3 ground;    /* its normal in the world frame, unit length, z above LH_LEAST_GROUND */
    int32_t turn;      /* node that is backed up next in turn */
    int32_t decisions; /* so far, 0 to LH_LAST_DECISION */
} lh_planner_learned;

#define LH_LEAST_GROUND 0.5f        /* steeper ground is taken for a misreading */
#define LH_LAST_DECISION 2000000000 /* where counting stops */

/* What the robot would do at a posture. */
typedef struct lh_outlook {
    lh_rest rest;
    lh_footing footing;
    lh_twist expected[LH_PLANNED_ACTIONS]; /* by mechanics alone */
    lh_motion_sums sums[LH_PLANNED_ACTIONS];
} lh_outlook;

/* Where the robot is against its line. */
typedef struct lh_course {
    float heading; /* error [rad] */
    float lateral; /* error [m] */
} lh_course;

/* An action taken where the arm is, and where it leads. */
typedef struct lh_option {
    int32_t action;                 /* of lh_planner.planned */
    float reward;                   /* for the step itself */
    float value;                    /* with all that follows */
    lh_twist expected;              /* by mechanics alone */
    lh_course course;               /* then */
    float angle[LH_PLANNED_JOINTS]; /* then [rad] */
} lh_option;

typedef struct lh_planner {
    lh_planner_config config;
    lh_task_config task;
    lh_robot robot;
    lh_planned planned;
    lh_planner_learned learned;
    /* the step under way */
    bool acting;                    /* an action was chosen and its result is awaited */
    int32_t action;                 /* of `planned`, as chosen */
    lh_twist expected;              /* what mechanics says it will do */
    int32_t executed;               /* of `planned`: mostly the same */
    lh_twist expected_executed;     /* likewise */
    lh_pose2 pose;                  /* where it began */
    float angle[LH_PLANNED_JOINTS]; /* [planned.num_joints] there [rad] */
    int32_t node;                   /* nearest to these */
    float best_distance;            /* least goal distance so far, to within 5 cm [m] */
    int32_t stalled;                /* decisions since it fell */
    /* while it plans */
    float joint_angle[LH_MAX_ACTUATORS]; /* of the newest state [rad] */
    lh_vec3 up;                          /* vertical in the frame of the ground, x along the line: rest.h */
    lh_outlook outlook;
    lh_option best[LH_CANDIDATES_MAX]; /* of the options where the robot is, in falling order of their values */
} lh_planner;

lh_planner_config lh_planner_config_default(void);

/* LH_OK, LH_ERROR_RATE for the discount rate, else LH_ERROR_PLANNER. */
lh_error lh_planner_config_validate(const lh_planner_config *config);

/* A planner that has measured nothing, for the robot and the actuators that `task` controls. On an error nothing is
 * changed. */
lh_error lh_planner_init(lh_planner *planner, const lh_planner_config *config, const lh_task *task, uint64_t seed);

/* Chooses nothing that drives a joint nearer than `clearance` to its limit towards it [rad]; not less than its own. */
void lh_planner_keep_clear(lh_planner *planner, float clearance);

/* Forgets the step under way. */
void lh_planner_begin(lh_planner *planner);

/* One decision: takes in what the step that led here did, if `learn`, plans, and then chooses; if `greedy`, without
 * chance. Planning goes on without `learn`, on what was measured before. Where the robot has made no progress for long,
 * chance decides some of the actions in any case. */
void lh_planner_step(lh_planner *planner, const lh_observed *observed, bool learn, bool greedy, lh_choice *choice);

/* Another action than the one just chosen is executed, one that moves no actuator that is not planned with: what is
 * measured is what that one does, and what comes of choosing the other where the arm is now. */
void lh_planner_executed(lh_planner *planner, int32_t action);

void lh_planner_save(const lh_planner *planner, lh_planner_learned *learned);

/* LH_ERROR_PLANNER or LH_ERROR_RANDOM_STATE, and nothing changed, if what was saved is of other postures or actions or
 * is out of range. */
lh_error lh_planner_restore(lh_planner *planner, const lh_planner_learned *learned);

#ifdef __cplusplus
}
#endif
#endif
