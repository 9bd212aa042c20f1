#include "convert.h"

#include <string.h>

lh_config convert_config(const settings *s) {
    lh_config config = lh_config_default();
    config.seed = (uint64_t)s->learning.seed;
    config.crawler_speed = (float)s->action.crawler_speed;
    config.joint_speed = (float)s->action.joint_speed;
    config.temperature_floor = (float)s->exploration.temperature_floor;

    config.learner.learning_rate = (float)s->learning.learning_rate;
    config.learner.discount_rate = (float)s->learning.discount_rate;

    lh_network_config *network = &config.learner.network;
    network->units = (int32_t)s->rbf.units;
    network->rate_weight = (float)s->rbf.rate_weight;
    network->rate_width = (float)s->rbf.rate_width;
    network->rate_centre = (float)s->rbf.rate_centre;
    network->initial_weight = (float)s->rbf.initial_weight;
    network->initial_width = (float)s->rbf.initial_width;
    network->width_floor = (float)s->rbf.width_floor;
    network->weight_limit = (float)s->rbf.weight_limit;
    network->exact_gradient = s->rbf.gradient == SETTINGS_GRADIENT_EXACT;

    config.reward.forward = (float)s->reward.forward;
    config.reward.sideways = (float)s->reward.sideways;
    config.reward.turn = (float)s->reward.turn;
    config.reward.heading_error = s->reward.turn_of == SETTINGS_TURN_ERROR;
    config.reward.goal = (float)s->reward.goal;
    config.reward.stability = (float)s->reward.stability;
    config.reward.tumble = (float)s->reward.tumble;

    config.episode.goal_distance = (float)s->episode.goal_distance_m;
    config.episode.step_limit = (int32_t)s->episode.step_limit;
    config.episode.tumble_tilt = (float)s->episode.tumble_tilt_rad;
    config.episode.reset_every = (int32_t)s->episode.reset_every;
    return config;
}

lh_state convert_state(const limphome_robot_state_t *message) {
    lh_state state;
    memset(&state, 0, sizeof state);
    for (int i = 0; i < 3; i++) {
        state.position[i] = (float)message->position[i];
    }
    state.orientation = (lh_quat){(float)message->orientation[0], (float)message->orientation[1],
                                  (float)message->orientation[2], (float)message->orientation[3]};
    state.num_actuators = message->num_actuators;
    for (int i = 0; i < message->num_actuators && i < LH_MAX_ACTUATORS; i++) {
        state.actuator_position[i] = (float)message->actuator_position[i];
        state.actuator_effort[i] = (float)message->actuator_effort[i];
    }
    return state;
}

lh_controlled convert_controlled(const limphome_robot_state_t *message) {
    enum { FAILED = 1 };
    lh_controlled controlled = {.count = 0};
    for (int32_t i = 0; i < message->num_actuators && i < LH_MAX_ACTUATORS; i++) {
        if (message->actuator_health[i] != FAILED) {
            controlled.index[controlled.count++] = i;
        }
    }
    return controlled;
}

limphome_decision_t convert_decision(const lh_decision *d, const limphome_robot_state_t *state) {
    limphome_decision_t message = {
        .utime = state->utime,
        .session = state->session,
        .seq = state->seq,
        .episode = d->episode,
        .step = d->step,
        .num_inputs = d->num_inputs,
        .action = d->choice.action,
        .q = d->choice.q,
        .q_max = d->choice.q_max,
        .probability = d->choice.probability,
        .temperature = d->temperature,
        .learned = d->learned,
        .td_error = d->td_error,
        .reward_motion = d->reward.motion,
        .reward_goal = d->reward.goal,
        .reward_stability = d->reward.stability,
        .reward_tumble = d->reward.tumble,
        .stability_margin = d->stability_margin,
        .goal_distance = d->goal_distance,
        .lateral_error = d->lateral_error,
    };
    memcpy(message.inputs, d->inputs, sizeof d->inputs);
    return message;
}

limphome_episode_t convert_episode(const lh_summary *s, const limphome_robot_state_t *state, double decision_period) {
    return (limphome_episode_t){
        .utime = state->utime,
        .session = state->session,
        .episode = s->number,
        .outcome = (int8_t)s->outcome,
        .steps = s->steps,
        .duration = s->steps * decision_period,
        .reward = (double)lh_reward_total(&s->total),
        .reward_motion = (double)s->total.motion,
        .reward_goal = (double)s->total.goal,
        .reward_stability = (double)s->total.stability,
        .reward_tumble = (double)s->total.tumble,
        .lateral_error = (double)s->lateral_error,
        .heading_change = (double)s->heading_change,
        .temperature = (double)s->temperature,
        .start = {(double)s->start.x, (double)s->start.y},
        .start_heading = (double)s->start.heading,
        .goal_distance = (double)s->goal_distance,
    };
}

limphome_policy_t convert_policy(const lh_controller *c, int32_t episode, int64_t utime) {
    limphome_policy_t policy;
    memset(&policy, 0, sizeof policy);
    policy.utime = utime;
    policy.episode = episode;
    policy.num_actuators = c->robot.num_actuators;
    policy.num_controlled = c->controlled.count;
    for (int32_t k = 0; k < c->controlled.count; k++) {
        const lh_actuator *actuator = &c->robot.actuators[c->controlled.index[k]];
        policy.controlled[k] = (int8_t)c->controlled.index[k];
        policy.speed[k] = actuator->kind == LH_CRAWLER ? c->config.crawler_speed : c->config.joint_speed;
        lh_observation_range(actuator, &policy.input_low[k], &policy.input_high[k]);
    }
    const lh_network *network = &c->learner.network;
    policy.num_units = network->units;
    policy.num_inputs = network->inputs;
    for (int32_t j = 0; j < network->units; j++) {
        policy.weight[j] = network->weight[j];
        policy.width[j] = network->width[j];
        for (int32_t i = 0; i < network->inputs; i++) {
            policy.centre[j][i] = network->centre[i][j];
        }
    }
    return policy;
}

bool convert_network(const limphome_policy_t *policy, const lh_controller *c, lh_network *network) {
    const limphome_policy_t ours = convert_policy(c, 0, 0);
    memset(network, 0, sizeof *network);
    const size_t bytes = (size_t)ours.num_controlled * sizeof ours.speed[0];
    if (policy->num_actuators != ours.num_actuators || policy->num_controlled != ours.num_controlled ||
        memcmp(policy->controlled, ours.controlled, (size_t)ours.num_controlled) != 0 ||
        memcmp(policy->speed, ours.speed, bytes) != 0 || memcmp(policy->input_low, ours.input_low, bytes) != 0 ||
        memcmp(policy->input_high, ours.input_high, bytes) != 0 || policy->num_units > LH_MAX_UNITS ||
        policy->num_inputs > LH_MAX_INPUTS) {
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
