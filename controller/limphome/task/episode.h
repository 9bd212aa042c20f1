/* The episode: from a start pose to the goal line at distance b ahead of it, across the heading at the start.
 * It ends on reaching the line, on tumbling, or when the time is up. */
#ifndef LIMPHOME_EPISODE_H
#define LIMPHOME_EPISODE_H

#include <stdint.h>

#include "limphome/task/reward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Ranges of lh_episode_config. */
#define LH_GOAL_DISTANCE_MIN 0.1f   /* [m] */
#define LH_GOAL_DISTANCE_MAX 100.0f /* [m] */
#define LH_STEP_LIMIT_MAX 100000    /* decisions; at least 1 */
#define LH_TUMBLE_TILT_MIN 0.1f     /* [rad] */
#define LH_TUMBLE_TILT_MAX 3.0f     /* [rad] */
#define LH_RESET_EVERY_MAX 1000000  /* episodes; at least 1 */

#define LH_LAST_EPISODE 1000000000 /* where counting stops */

typedef enum lh_outcome {
    LH_OUTCOME_NONE = 0, /* goes on */
    LH_OUTCOME_GOAL = 1,
    LH_OUTCOME_TUMBLE = 2,
    LH_OUTCOME_TIMEOUT = 3
} lh_outcome;

typedef struct lh_episode_config {
    float goal_distance; /* b, LH_GOAL_DISTANCE_MIN to LH_GOAL_DISTANCE_MAX [m]; paper: 2 */
    int32_t step_limit;  /* decisions, 1 to LH_STEP_LIMIT_MAX; default 2000 */
    float tumble_tilt;   /* LH_TUMBLE_TILT_MIN to LH_TUMBLE_TILT_MAX [rad]; default pi/3 */
    int32_t reset_every; /* episodes between returns to the initial pose, 1 to LH_RESET_EVERY_MAX; default 50 */
} lh_episode_config;

typedef struct lh_episode {
    int32_t number; /* t of (4), 1 to LH_LAST_EPISODE */
    int32_t steps;  /* decisions completed */
    lh_pose2 start;
    lh_reward total; /* sums over the steps */
} lh_episode;

lh_episode_config lh_episode_config_default(void);
lh_error lh_episode_config_validate(const lh_episode_config *config);

/* Begins episode `number` at `start`. */
void lh_episode_begin(lh_episode *episode, int32_t number, const lh_pose2 *start);

/* Distance still to go to the goal line, along the heading at the start; 0 or below once it is reached [m]. */
float lh_episode_distance(const lh_episode *episode, const lh_episode_config *config, const lh_pose2 *pose);

/* Offset from the straight line to the goal, positive to the left; its magnitude on the goal line is d3 [m]. */
float lh_episode_lateral(const lh_episode *episode, const lh_pose2 *pose);

/* Outcome after the newest step; a tumble counts before the goal, the goal before the time limit.
 * `tilt` is the angle between the body's and the world's z axis [rad]. */
lh_outcome lh_episode_outcome(const lh_episode *episode, const lh_episode_config *config, const lh_pose2 *pose,
                              float tilt);

#ifdef __cplusplus
}
#endif
#endif
