/* What the planner plans with: the controlled crawlers, at most two, and the first controlled joints of the arm, at
 * most LH_PLANNED_JOINTS; the others hold still. Its actions are numbered like joint actions (action.h), over these
 * alone. */
#ifndef LIMPHOME_PLANNED_H
#define LIMPHOME_PLANNED_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/task/task.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lh_planned {
    int32_t num_controlled;           /* of the task */
    int32_t count;                    /* planned actuators: crawlers, then joints */
    int32_t num_crawlers;             /* of these */
    int32_t num_joints;               /* of these */
    int32_t place[LH_MAX_PLANNED];    /* [count] in the task's controlled actuators, ascending */
    int32_t actuator[LH_MAX_PLANNED]; /* [count] of the robot */
    float clearance;                  /* this near to its limit a joint is not driven towards it [rad] */
    float low[LH_PLANNED_JOINTS];     /* [num_joints] [rad] */
    float high[LH_PLANNED_JOINTS];    /* [num_joints] [rad] */
    float travel[LH_MAX_ACTUATORS];   /* [robot's actuators] of each in one decision [m or rad] */
    int32_t num_actions;              /* 3^count */
    int32_t num_crawler_actions;      /* 3^num_crawlers: the lowest digits of an action are those of the crawlers */
    int8_t level[LH_PLANNED_ACTIONS][LH_MAX_PLANNED]; /* [num_actions][count] */
} lh_planned;

/* `period` is the time of a decision [s]. */
void lh_planned_init(lh_planned *planned, const lh_task *task, float period);

/* The angles of the planned joints among those of all actuators, into angle[num_joints]. */
void lh_planned_angles(const lh_planned *planned, const float *joint_angle, float *angle);

/* The other way round. */
void lh_planned_set_angles(const lh_planned *planned, const float *angle, float *joint_angle);

/* Levels of the joints of an action: [num_joints]. */
const int8_t *lh_planned_joint_levels(const lh_planned *planned, int32_t action);

/* The action that leaves everything as it is. */
int32_t lh_planned_still(const lh_planned *planned);

/* Whether `action` does something at angle[num_joints], and drives no joint nearer to its limit than `clearance`. */
bool lh_planned_allows(const lh_planned *planned, const float *angle, int32_t action);

/* Angles after `action` when the share `moved` of its motion happens, into next[num_joints]. */
void lh_planned_move(const lh_planned *planned, const float *angle, int32_t action, float moved, float *next);

/* The task's joint action that is `action`, with all others still. */
int32_t lh_planned_joint_action(const lh_planned *planned, int32_t action);

/* The inverse: what the task's joint action is of the planned actuators. */
int32_t lh_planned_action(const lh_planned *planned, int32_t joint_action);

#ifdef __cplusplus
}
#endif
#endif
