/* The task: what is seen, rewarded and ended. It knows nothing of how anything is learned, and draws no random number.
 *
 *     lh_task_init(&task, &config, &robot, &controlled);
 *     for each state: lh_task_observe(&task, &state, &observed); choose an action, unless observed.reset */
#ifndef LIMPHOME_TASK_H
#define LIMPHOME_TASK_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/task/episode.h"
#include "limphome/task/observation.h"
#include "limphome/task/path.h"
#include "limphome/task/reward.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lh_task_config {
    float crawler_speed; /* of the forward and reverse levels, LH_SPEED_MIN to LH_SPEED_MAX [m/s]; paper: 0.3 */
    float joint_speed;   /* of the forward and reverse levels, LH_SPEED_MIN to LH_SPEED_MAX [rad/s]; paper: 0.3 */
    lh_reward_config reward;
    lh_episode_config episode;
    lh_path_config path;
} lh_task_config;

/* An episode that has ended. */
typedef struct lh_summary {
    int32_t number; /* from 1 */
    lh_outcome outcome;
    int32_t steps;
    lh_reward total;
    float lateral_error;  /* at the end, positive to the left [m] */
    float heading_change; /* end minus start, (-pi, pi] [rad] */
    lh_pose2 start;
    float line_heading;        /* direction of the straight line, across which the goal line lies [rad] */
    float start_lateral_error; /* at the start, positive to the left [m] */
    float goal_distance;       /* from start to goal line, along the straight line [m] */
    float waypoint_distance;   /* straight from the end to the waypoint at the end of the leg; without one: 0 [m] */
    bool arrived;              /* reached the end of the path */
} lh_summary;

/* What one state tells. */
typedef struct lh_observed {
    /* the step that led here; reward is 0 where there was none */
    bool stepped;       /* false on the first state, after a reset, lh_task_begin, lh_task_resume and lh_task_gap */
    lh_reward reward;   /* of that step */
    lh_outcome outcome; /* how that step ended its episode; LH_OUTCOME_NONE: it goes on */
    lh_summary summary; /* of the episode that ended; valid unless outcome is LH_OUTCOME_NONE */
    bool reset;         /* the robot must be put into its initial pose: no action follows from here */

    /* this state */
    int32_t episode;                     /* running episode, from 1; with `reset`, the one that has just ended */
    int32_t step;                        /* decisions before this one in the running episode */
    lh_pose2 pose;                       /* of the body, seen from above */
    lh_quat attitude;                    /* of the body, body to world, unit length */
    float joint_angle[LH_MAX_ACTUATORS]; /* as in lh_state [rad] */
    float stability_margin;              /* S_NE of (11) [m] */
    float goal_distance;                 /* to the goal line of the running episode [m] */
    float lateral_error;                 /* from the straight line of the running episode, positive to the left [m] */
    float heading_error;                 /* from the direction of that line, positive to the left, (-pi, pi] [rad] */
    float waypoint_distance;             /* straight to the waypoint at the end of the leg; without one: 0 [m] */
    int32_t num_inputs;                  /* controlled actuators + 2 */
    float inputs[LH_MAX_STATE_INPUTS];   /* states of the controlled actuators, roll, pitch, in [0, 1]: observation.h */
} lh_observed;

/* How often a limit acted. */
typedef struct lh_clamped {
    uint64_t inputs;  /* sensor values limited to their range */
    uint64_t margins; /* stability margins taken to be LH_LEAST_MARGIN */
} lh_clamped;

typedef struct lh_task {
    lh_task_config config;
    lh_robot robot;
    lh_controlled controlled;
    lh_path path;
    lh_episode episode;
    bool acting;   /* an action follows the newest state, and its result is awaited; false: episode.number begins at the
                      next state */
    bool gap;      /* that result will not be known */
    bool resuming; /* the episode that begins at the next state is entered where the robot stands on the path */
    lh_pose2 pose; /* where that action began */
    lh_clamped clamped; /* so far */
} lh_task;

/* The paper's values. */
lh_task_config lh_task_config_default(void);

/* LH_OK, or the error of the first bad field. */
lh_error lh_task_config_validate(const lh_task_config *config);

/* Sets up the task before episode 1. `controlled` must list 1 or more ascending actuator indices. On an error nothing
 * is changed. */
lh_error lh_task_init(lh_task *task, const lh_task_config *config, const lh_robot *robot,
                      const lh_controlled *controlled);

/* The robot is somewhere else than its last action led it to: the step under way is forgotten, and `episode`, 1 to
 * LH_LAST_EPISODE, begins at the next state. */
void lh_task_begin(lh_task *task, int32_t episode);

/* The same for a robot that was not carried to where the path begins: it goes on along the path (lh_path_resume). */
void lh_task_resume(lh_task *task, int32_t episode);

/* Something else than the action under way leads to the next state: that step is forgotten, without reward, while the
 * episode goes on. How it may end there is told as ever. */
void lh_task_gap(lh_task *task);

/* Takes in one state. LH_ERROR_STATE, and nothing changed, if it is not valid.
 * An episode that ends on the goal line or by the time limit is followed by the next from where the robot is, unless
 * its number is a multiple of config.episode.reset_every; then, after a tumble and at the end of the path, a reset is
 * asked for, and the next episode begins at the next state, where the path begins again. Episode LH_LAST_EPISODE is
 * followed by others of the same number. */
lh_error lh_task_observe(lh_task *task, const lh_state *state, lh_observed *observed);

/* Velocities [m/s or rad/s] of joint action `action`, into velocity[robot.num_actuators]; those of actuators that are
 * not controlled stay as they are. */
void lh_task_velocities(const lh_task *task, int32_t action, float *velocity);

#ifdef __cplusplus
}
#endif
#endif
