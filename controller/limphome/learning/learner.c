#include "limphome/learning/learner.h"

#include <stddef.h>
#include <string.h>

#include "limphome/task/action.h"
#include "limphome/learning/boltzmann.h"
#include "limphome/base/elementary.h"

lh_learner_config lh_learner_config_default(void) {
    return (lh_learner_config){
        .learning_rate = 0.1f,
        .discount_rate = 0.9f,
        .network = lh_network_config_default(),
    };
}

lh_error lh_learner_config_validate(const lh_learner_config *config) {
    if (!lh_within(config->learning_rate, 0.0f, LH_LEARNING_RATE_MAX) ||
        !lh_within(config->discount_rate, 0.0f, LH_DISCOUNT_RATE_MAX)) {
        return LH_ERROR_RATE;
    }
    return lh_network_config_validate(&config->network);
}

lh_error lh_learner_init(lh_learner *learner, const lh_learner_config *config, int32_t num_states,
                         int32_t num_controlled, uint64_t seed) {
    lh_error error = lh_learner_config_validate(config);
    if (error != LH_OK) {
        return error;
    }
    if (num_controlled < 1 || num_controlled > LH_MAX_ACTUATORS || lh_action_count(num_controlled) > LH_MAX_ACTIONS) {
        return LH_ERROR_ACTUATORS;
    }
    if (num_states < 0 || num_states > LH_MAX_STATE_INPUTS || config->network.inputs != num_states + num_controlled) {
        return LH_ERROR_INPUTS;
    }
    memset(learner, 0, sizeof *learner); /* not by a literal, which would lie on the stack */
    learner->config = *config;
    learner->num_states = num_states;
    learner->num_actions = lh_action_count(num_controlled);
    lh_random_init(&learner->random, seed);
    return lh_network_init(&learner->network, &config->network, &learner->random);
}

float lh_learner_evaluate(lh_learner *learner, const float *states) {
    learner->q_max = lh_action_values(&learner->network, states, learner->num_states, &learner->scratch, learner->q);
    return learner->q_max;
}

lh_choice lh_learner_choose(lh_learner *learner, float temperature, bool greedy) {
    const float *q = learner->q;
    lh_choice choice = {.q_max = learner->q_max, .probability = 1.0f};
    if (greedy) {
        choice.action = lh_boltzmann_greedy(q, learner->num_actions);
    } else {
        choice.action =
            lh_boltzmann_select(q, learner->num_actions, temperature, &learner->random, &choice.probability);
    }
    choice.q = q[choice.action];
    return choice;
}

float lh_learner_learn(lh_learner *learner, const float *states, int32_t action, float reward, float next_q_max,
                       bool terminal) {
    int32_t num_controlled = learner->network.inputs - learner->num_states;
    int8_t levels[LH_MAX_ACTUATORS];
    lh_action_levels(action, num_controlled, levels);
    float x[LH_MAX_INPUTS];
    for (int32_t i = 0; i < learner->num_states; ++i) {
        x[i] = states[i];
    }
    for (int32_t k = 0; k < num_controlled; ++k) {
        x[learner->num_states + k] = lh_action_input(levels[k]);
    }

    float target = reward + (terminal ? 0.0f : learner->config.discount_rate * next_q_max);
    lh_activation at;
    float td_error = target - lh_network_value(&learner->network, x, &at);
    lh_held held =
        lh_network_learn(&learner->network, &learner->config.network, x, &at, learner->config.learning_rate, td_error);
    learner->held.weights += held.weights;
    learner->held.widths += held.widths;
    learner->held.centres += held.centres;
    return td_error;
}
