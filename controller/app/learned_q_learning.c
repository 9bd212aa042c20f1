#include "learned_q_learning.h"

#include <string.h>

/* For what the policy is: actuators, speeds of their levels, ranges of their state inputs. */
static void fill_purpose(const lh_task *task, limphome_policy_t *policy) {
    policy->num_actuators = task->robot.num_actuators;
    policy->num_controlled = task->controlled.count;
    for (int32_t k = 0; k < task->controlled.count; k++) {
        const lh_actuator *actuator = &task->robot.actuators[task->controlled.index[k]];
        policy->controlled[k] = (int8_t)task->controlled.index[k];
        policy->speed[k] = actuator->kind == LH_CRAWLER ? task->config.crawler_speed : task->config.joint_speed;
        lh_observation_range(actuator, &policy->input_low[k], &policy->input_high[k]);
    }
}

static bool has_purpose(const limphome_policy_t *policy, const lh_task *task) {
    limphome_policy_t ours;
    memset(&ours, 0, sizeof ours);
    fill_purpose(task, &ours);
    const size_t bytes = (size_t)ours.num_controlled * sizeof ours.speed[0];
    return policy->num_actuators == ours.num_actuators && policy->num_controlled == ours.num_controlled &&
           memcmp(policy->controlled, ours.controlled, (size_t)ours.num_controlled) == 0 &&
           memcmp(policy->speed, ours.speed, bytes) == 0 && memcmp(policy->input_low, ours.input_low, bytes) == 0 &&
           memcmp(policy->input_high, ours.input_high, bytes) == 0;
}

static void fill_network(const lh_network *network, limphome_policy_t *policy) {
    policy->num_units = network->units;
    policy->num_inputs = network->inputs;
    for (int32_t j = 0; j < network->units; j++) {
        policy->weight[j] = network->weight[j];
        policy->width[j] = network->width[j];
        for (int32_t i = 0; i < network->inputs; i++) {
            policy->centre[j][i] = network->centre[i][j];
        }
    }
}

static bool read_network(const limphome_policy_t *policy, lh_network *network) {
    memset(network, 0, sizeof *network);
    if (policy->num_units > LH_MAX_UNITS || policy->num_inputs > LH_MAX_INPUTS) {
        return false;
    }
    network->units = policy->num_units;
    network->inputs = policy->num_inputs;
    for (int32_t j = 0; j < policy->num_units; j++) {
        network->weight[j] = policy->weight[j];
        network->width[j] = policy->width[j];
        for (int32_t i = 0; i < policy->num_inputs; i++) {
            network->centre[i][j] = policy->centre[j][i];
        }
    }
    return true;
}

/* What Q-learning has beside its network. */
static void fill_rest(const lh_q_learned *learned, limphome_q_learning_t *rest) {
    rest->clamped_temperatures = (int64_t)learned->floored;
    rest->clamped_weights = (int64_t)learned->held.weights;
    rest->clamped_widths = (int64_t)learned->held.widths;
    rest->clamped_centres = (int64_t)learned->held.centres;
    memcpy(rest->random_state, learned->random.s, sizeof rest->random_state);
}

static void read_rest(const limphome_q_learning_t *rest, lh_q_learned *learned) {
    learned->floored = (uint64_t)rest->clamped_temperatures;
    learned->held.weights = (uint64_t)rest->clamped_weights;
    learned->held.widths = (uint64_t)rest->clamped_widths;
    learned->held.centres = (uint64_t)rest->clamped_centres;
    memcpy(learned->random.s, rest->random_state, sizeof learned->random.s);
}

void learned_save_q_learning(limphome_policy_t *policy, limphome_q_learning_t *rest, const lh_controller *c) {
    lh_q_learned learned;
    lh_q_learning_save(&c->learner.as.q_learning, &learned);
    fill_purpose(&c->task, policy);
    fill_network(&learned.network, policy);
    fill_rest(&learned, rest);
}

bool learned_restore_q_learning(const limphome_policy_t *policy, const limphome_q_learning_t *rest,
                                const lh_controller *c, lh_q_learned *restored) {
    if (!has_purpose(policy, &c->task) || !read_network(policy, &restored->network)) {
        return false;
    }
    if (rest != NULL) {
        read_rest(rest, restored);
    }
    return true;
}
