/* Rewards of one step: relocation (5)-(8), goal (9), stability (12) and tumbling (section 3.2). */
#ifndef LIMPHOME_REWARD_H
#define LIMPHOME_REWARD_H

#include <stdbool.h>

#include "limphome/base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

#define LH_REWARD_MAX 1000.0f   /* largest coefficient, in its unit, and largest magnitude of `tumble` */
#define LH_LEAST_MARGIN (-5.0f) /* [m]; keeps exp(-S) of (12) in bounds whatever the posture */

typedef struct lh_reward_config {
    float forward;      /* eta of (8) [1/m], 0 to LH_REWARD_MAX; paper: 8 */
    float sideways;     /* lambda of (8) [1/m], 0 to LH_REWARD_MAX; paper: 2 */
    float turn;         /* tau of (8) [1/rad], 0 to LH_REWARD_MAX; paper: 10 */
    bool heading_error; /* phi of (8): false, change of heading over the step; true, heading at its end against the
                           direction of the episode */
    float goal;         /* zeta of (9), 0 to LH_REWARD_MAX; paper: 10 */
    float stability;    /* rho of (12), 0 to LH_REWARD_MAX; paper: 1 */
    float tumble;       /* -LH_REWARD_MAX to 0; paper: -10 */
} lh_reward_config;

/* The terms of one step, or their sums over an episode. */
typedef struct lh_reward {
    float motion;    /* r(1) of (8) */
    float goal;      /* r(2) of (9) */
    float stability; /* r(3) of (12) */
    float tumble;
} lh_reward;

/* Where the body is, seen from above. */
typedef struct lh_pose2 {
    float x, y;    /* of the body origin in the world frame [m] */
    float heading; /* (-pi, pi] [rad] */
} lh_pose2;

lh_reward_config lh_reward_config_default(void);
lh_error lh_reward_config_validate(const lh_reward_config *config);

/* r(1) of (8) for the step from `before` to `after`; d1 and d2 are along and across the heading `before`.
 * `direction` is the heading the episode should keep [rad], used only with heading_error. */
float lh_reward_motion(const lh_reward_config *config, const lh_pose2 *before, const lh_pose2 *after, float direction);

/* r(2) of (9) on reaching the goal line `lateral_error` [m] beside the goal (d3). */
float lh_reward_goal(const lh_reward_config *config, float lateral_error);

/* r(3) of (12) for the NE stability margin `margin` [m]; margins below LH_LEAST_MARGIN
 * count as that. */
float lh_reward_stability(const lh_reward_config *config, float margin);

/* Sum of the four terms. */
float lh_reward_total(const lh_reward *reward);

#ifdef __cplusplus
}
#endif
#endif
