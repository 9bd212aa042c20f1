#include "limphome/learning/planned.h"

#include <string.h>

#include "limphome/task/action.h"

#define CLEARANCE 0.03f /* of joints to their limits, unless more is asked for [rad] */

_Static_assert(LH_MAX_PLANNED == 4 || LH_MAX_PLANNED == 5, "one crawler or two, and the joints");

static void add(lh_planned *planned, const lh_task *task, int32_t place) {
    int32_t index = task->controlled.index[place];
    const lh_actuator *actuator = &task->robot.actuators[index];
    if (actuator->kind == LH_JOINT) {
        planned->low[planned->num_joints] = actuator->low;
        planned->high[planned->num_joints] = actuator->high;
        planned->num_joints++;
    } else {
        planned->num_crawlers++;
    }
    planned->place[planned->count] = place;
    planned->actuator[planned->count] = index;
    planned->count++;
}

void lh_planned_init(lh_planned *planned, const lh_task *task, float period) {
    memset(planned, 0, sizeof *planned);
    planned->num_controlled = task->controlled.count;
    planned->clearance = CLEARANCE;
    for (int32_t k = 0; k < task->controlled.count; k++) {
        bool is_joint = task->robot.actuators[task->controlled.index[k]].kind == LH_JOINT;
        if (is_joint ? planned->num_joints < LH_PLANNED_JOINTS
                     : planned->num_crawlers < LH_MAX_PLANNED - LH_PLANNED_JOINTS) {
            add(planned, task, k);
        }
    }
    for (int32_t k = 0; k < task->robot.num_actuators; k++) {
        bool is_joint = task->robot.actuators[k].kind == LH_JOINT;
        planned->travel[k] = period * (is_joint ? task->config.joint_speed : task->config.crawler_speed);
    }
    planned->num_actions = lh_action_count(planned->count);
    planned->num_crawler_actions = lh_action_count(planned->num_crawlers);
    for (int32_t a = 0; a < planned->num_actions; a++) {
        lh_action_levels(a, planned->count, planned->level[a]);
    }
}

void lh_planned_angles(const lh_planned *planned, const float *joint_angle, float *angle) {
    for (int32_t k = 0; k < planned->num_joints; k++) {
        angle[k] = joint_angle[planned->actuator[planned->num_crawlers + k]];
    }
}

void lh_planned_set_angles(const lh_planned *planned, const float *angle, float *joint_angle) {
    for (int32_t k = 0; k < planned->num_joints; k++) {
        joint_angle[planned->actuator[planned->num_crawlers + k]] = angle[k];
    }
}

const int8_t *lh_planned_joint_levels(const lh_planned *planned, int32_t action) {
    return planned->level[action] + planned->num_crawlers;
}

int32_t lh_planned_still(const lh_planned *planned) {
    return planned->num_actions / 2; /* all digits 1 */
}

bool lh_planned_allows(const lh_planned *planned, const float *angle, int32_t action) {
    if (action == lh_planned_still(planned)) {
        return false;
    }
    const int8_t *level = lh_planned_joint_levels(planned, action);
    for (int32_t k = 0; k < planned->num_joints; k++) {
        if ((level[k] == 0 && angle[k] < planned->low[k] + planned->clearance) ||
            (level[k] == 2 && angle[k] > planned->high[k] - planned->clearance)) {
            return false;
        }
    }
    return true;
}

void lh_planned_move(const lh_planned *planned, const float *angle, int32_t action, float moved, float *next) {
    const int8_t *level = lh_planned_joint_levels(planned, action);
    for (int32_t k = 0; k < planned->num_joints; k++) {
        float travel = planned->travel[planned->actuator[planned->num_crawlers + k]];
        next[k] = angle[k] + moved * travel * (float)(level[k] - 1);
    }
}

int32_t lh_planned_joint_action(const lh_planned *planned, int32_t action) {
    int8_t levels[LH_MAX_ACTUATORS];
    memset(levels, 1, sizeof levels); /* still */
    for (int32_t k = 0; k < planned->count; k++) {
        levels[planned->place[k]] = planned->level[action][k];
    }
    return lh_action_index(levels, planned->num_controlled);
}

int32_t lh_planned_action(const lh_planned *planned, int32_t joint_action) {
    int8_t levels[LH_MAX_ACTUATORS];
    int8_t of_planned[LH_MAX_PLANNED];
    lh_action_levels(joint_action, planned->num_controlled, levels);
    for (int32_t k = 0; k < planned->count; k++) {
        of_planned[k] = levels[planned->place[k]];
    }
    return lh_action_index(of_planned, planned->count);
}
