#include "learned_planner.h"

#include <string.h>

/* What measurements and values are of: actuators, speeds of their levels, ranges of their joints, the time of a
 * decision, and what a measurement is told as a difference from. */
static void fill_purpose(const lh_controller *c, limphome_planner_t *message) {
    const lh_task *task = &c->task;
    const lh_planner_config *config = &c->learner.as.planner.config;
    message->decision_period = config->decision_period;
    message->mechanics = config->mechanics ? LIMPHOME_PLANNER_T_QUASI_STATIC : LIMPHOME_PLANNER_T_NONE;
    message->num_actuators = task->robot.num_actuators;
    message->num_controlled = task->controlled.count;
    for (int32_t k = 0; k < task->controlled.count; k++) {
        const lh_actuator *actuator = &task->robot.actuators[task->controlled.index[k]];
        message->controlled[k] = (int8_t)task->controlled.index[k];
        if (actuator->kind == LH_JOINT) {
            message->speed[k] = task->config.joint_speed;
            message->joint_low[k] = actuator->low;
            message->joint_high[k] = actuator->high;
        } else {
            message->speed[k] = task->config.crawler_speed;
        }
    }
}

static bool has_purpose(const limphome_planner_t *message, const lh_controller *c) {
    limphome_planner_t ours;
    memset(&ours, 0, sizeof ours);
    fill_purpose(c, &ours);
    const size_t bytes = (size_t)ours.num_controlled * sizeof ours.speed[0];
    return message->decision_period == ours.decision_period && message->mechanics == ours.mechanics &&
           message->num_actuators == ours.num_actuators && message->num_controlled == ours.num_controlled &&
           memcmp(message->controlled, ours.controlled, (size_t)ours.num_controlled) == 0 &&
           memcmp(message->speed, ours.speed, bytes) == 0 && memcmp(message->joint_low, ours.joint_low, bytes) == 0 &&
           memcmp(message->joint_high, ours.joint_high, bytes) == 0;
}

/* Arrays of the library and of the message are of the same types. */
#define COPY(to, from, count) memcpy(to, from, (size_t)(count) * sizeof *(to))

static void fill_model(const lh_motion_model *model, limphome_planner_t *message) {
    message->num_actions = model->num_actions;
    message->num_joints = model->num_joints;
    message->prior_weight = model->prior_weight;
    message->num_samples = model->num_samples;
    COPY(message->kernel_low, model->low, LH_PLANNED_JOINTS);
    COPY(message->kernel_width, model->width, LH_PLANNED_JOINTS);
    for (int32_t k = 0; k < LH_PLANNED_JOINTS; k++) {
        COPY(message->sample_posture[k], model->posture[k], model->num_samples);
    }
    for (int32_t k = 0; k < LH_MOTION_PARTS; k++) {
        COPY(message->sample_motion[k], model->motion[k], model->num_samples);
    }
    COPY(message->sample_action, model->action, model->num_samples);
    COPY(message->sample_count, model->count, model->num_samples);
    COPY(message->sample_updated, model->updated, model->num_samples);
}

static void read_model(const limphome_planner_t *message, lh_motion_model *model) {
    memset(model, 0, sizeof *model);
    model->num_actions = message->num_actions;
    model->num_joints = message->num_joints;
    model->prior_weight = message->prior_weight;
    model->num_samples = message->num_samples;
    COPY(model->low, message->kernel_low, LH_PLANNED_JOINTS);
    COPY(model->width, message->kernel_width, LH_PLANNED_JOINTS);
    for (int32_t k = 0; k < LH_PLANNED_JOINTS; k++) {
        COPY(model->posture[k], message->sample_posture[k], model->num_samples);
    }
    for (int32_t k = 0; k < LH_MOTION_PARTS; k++) {
        COPY(model->motion[k], message->sample_motion[k], model->num_samples);
    }
    COPY(model->action, message->sample_action, model->num_samples);
    COPY(model->count, message->sample_count, model->num_samples);
    COPY(model->updated, message->sample_updated, model->num_samples);
}

static void fill_values(const lh_posture_values *values, limphome_planner_t *message) {
    message->num_nodes = values->num_nodes;
    COPY(message->node_count, values->count, LH_PLANNED_JOINTS);
    COPY(message->node_low, values->low, LH_PLANNED_JOINTS);
    COPY(message->node_spacing, values->spacing, LH_PLANNED_JOINTS);
    COPY(message->node_value, values->value, values->num_nodes);
    COPY(message->node_cost, values->cost, values->num_nodes);
}

static void read_values(const limphome_planner_t *message, lh_posture_values *values) {
    memset(values, 0, sizeof *values);
    values->num_joints = message->num_joints;
    values->num_nodes = message->num_nodes;
    COPY(values->count, message->node_count, LH_PLANNED_JOINTS);
    COPY(values->low, message->node_low, LH_PLANNED_JOINTS);
    COPY(values->spacing, message->node_spacing, LH_PLANNED_JOINTS);
    COPY(values->value, message->node_value, values->num_nodes);
    COPY(values->cost, message->node_cost, values->num_nodes);
}

void learned_save_planner(limphome_planner_t *message, const lh_controller *c) {
    lh_planner_learned learned;
    lh_planner_save(&c->learner.as.planner, &learned);
    fill_purpose(c, message);
    fill_model(&learned.model, message);
    fill_values(&learned.values, message);
    memcpy(message->random_state, learned.random.s, sizeof message->random_state);
    message->ground[0] = learned.ground.x;
    message->ground[1] = learned.ground.y;
    message->ground[2] = learned.ground.z;
    message->turn = learned.turn;
    message->decisions = learned.decisions;
}

bool learned_restore_planner(const limphome_planner_t *message, const lh_controller *c, lh_planner_learned *restored) {
    if (!has_purpose(message, c) || message->num_samples > LH_MAX_SAMPLES || message->num_nodes > LH_MAX_POSTURES) {
        return false;
    }
    read_model(message, &restored->model);
    read_values(message, &restored->values);
    memcpy(restored->random.s, message->random_state, sizeof restored->random.s);
    restored->ground = (lh_vec3){message->ground[0], message->ground[1], message->ground[2]};
    restored->turn = message->turn;
    restored->decisions = message->decisions;
    return true;
}
