#include "limphome/learning/q_learning.h"

#include <stddef.h>
#include <string.h>

#include "limphome/base/elementary.h"
#include "limphome/learning/boltzmann.h"
#include "limphome/task/action.h"

lh_q_learning_config lh_q_learning_config_default(void) {
    return (lh_q_learning_config){
        .learning_rate = 0.1f,
        .discount_rate = 0.9f,
        .temperature_floor = 0.01f,
        .network = lh_network_config_default(),
    };
}

lh_error lh_q_learning_config_validate(const lh_q_learning_config *config) {
    if (!lh_within(config->learning_rate, 0.0f, LH_LEARNING_RATE_MAX) ||
        !lh_within(config->discount_rate, 0.0f, LH_DISCOUNT_RATE_MAX)) {
        return LH_ERROR_RATE;
    }
    if (!lh_within(config->temperature_floor, LH_TEMPERATURE_FLOOR_MIN, LH_TEMPERATURE_FLOOR_MAX)) {
        return LH_ERROR_LIMIT;
    }
    return lh_network_config_validate(&config->network);
}

lh_error lh_q_learning_init(lh_q_learning *learner, const lh_q_learning_config *config, int32_t num_states,
                            int32_t num_controlled, uint64_t seed) {
    lh_error error = lh_q_learning_config_validate(config);
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

void lh_q_learning_begin(lh_q_learning *learner) {
    learner->acting = 0;
}

float lh_q_learning_evaluate(lh_q_learning *learner, const float *states) {
    learner->q_max = lh_action_values(&learner->network, states, learner->num_states, &learner->scratch, learner->q);
    return learner->q_max;
}

void lh_q_learning_choose(lh_q_learning *learner, float temperature, bool greedy, lh_choice *choice) {
    const float *q = learner->q;
    choice->probability = 1.0f;
    if (greedy) {
        choice->action = lh_boltzmann_greedy(q, learner->num_actions);
    } else {
        choice->action =
            lh_boltzmann_select(q, learner->num_actions, temperature, &learner->random, &choice->probability);
    }
    choice->q = q[choice->action];
    choice->q_max = learner->q_max;
    choice->temperature = temperature;
}

float lh_q_learning_learn(lh_q_learning *learner, const float *states, int32_t action, float reward, float next_q_max,
                          bool terminal) {
    float x[LH_MAX_INPUTS];
    for (int32_t i = 0; i < learner->num_states; i++) {
        x[i] = states[i];
    }
    lh_action_inputs(action, learner->network.inputs - learner->num_states, x + learner->num_states);

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

float lh_q_learning_temperature(const lh_q_learning *learner, int32_t episode) {
    float temperature = learner->config.temperature_floor;
    lh_boltzmann_temperature(episode, learner->config.temperature_floor, &temperature);
    return temperature;
}

static void learn_from_step(lh_q_learning *learner, const lh_observed *observed, lh_choice *choice) {
    bool terminal = observed->outcome == LH_OUTCOME_GOAL || observed->outcome == LH_OUTCOME_TUMBLE;
    float next_q_max = terminal ? 0.0f : lh_q_learning_evaluate(learner, observed->inputs);
    choice->td_error = lh_q_learning_learn(learner, learner->states, learner->action,
                                           lh_reward_total(&observed->reward), next_q_max, terminal);
    choice->learned = true;
}

/* Evaluates anew, as the network may have learned since the target was taken. */
static void choose_next(lh_q_learning *learner, const lh_observed *observed, bool greedy, lh_choice *choice) {
    float temperature = lh_q_learning_temperature(learner, observed->episode);
    learner->floored += temperature == learner->config.temperature_floor;
    lh_q_learning_evaluate(learner, observed->inputs);
    lh_q_learning_choose(learner, temperature, greedy, choice);
    for (int32_t i = 0; i < learner->num_states; i++) {
        learner->states[i] = observed->inputs[i];
    }
    learner->action = choice->action;
    learner->acting = 1;
}

void lh_q_learning_step(lh_q_learning *learner, const lh_observed *observed, bool learn, bool greedy,
                        lh_choice *choice) {
    *choice = (lh_choice){.learned = false};
    if (learn && observed->stepped && learner->acting) {
        learn_from_step(learner, observed, choice);
    }
    if (!observed->reset) {
        choose_next(learner, observed, greedy, choice);
    }
}

void lh_q_learning_executed(lh_q_learning *learner, int32_t action) {
    learner->action = action;
}

void lh_q_learning_save(const lh_q_learning *learner, lh_q_learned *learned) {
    learned->network = learner->network;
    learned->random = learner->random;
    learned->held = learner->held;
    learned->floored = learner->floored;
}

lh_error lh_q_learning_restore(lh_q_learning *learner, const lh_q_learned *learned) {
    lh_error error = lh_network_validate(&learned->network, &learner->config.network);
    if (error == LH_OK) {
        error = lh_random_restore(&learner->random, learned->random.s);
    }
    if (error != LH_OK) {
        return error;
    }
    learner->network = learned->network;
    learner->held = learned->held;
    learner->floored = learned->floored;
    lh_q_learning_begin(learner);
    return LH_OK;
}
