#include "limphome/learner.h"

#include <stddef.h>
#include <string.h>

#include "limphome/action.h"
#include "limphome/boltzmann.h"
#include "limphome/elementary.h"

/* The joint actions of half of the actuators: 3^(LH_MAX_ACTUATORS / 2), rounded up; 243 allows for up to 10. */
#define MAX_HALF_ACTIONS 243

_Static_assert(LH_MAX_ACTUATORS <= 10, "MAX_HALF_ACTIONS is too small");

lh_learner_config lh_learner_config_default(void) {
    return (lh_learner_config){
        .learning_rate = 0.1f,
        .discount_rate = 0.9f,
        .network = lh_network_config_default(),
    };
}

lh_error lh_learner_config_validate(const lh_learner_config *config) {
    if (!lh_within(config->learning_rate, 0.0f, 1.0f) || !lh_within(config->discount_rate, 0.0f, 1.0f)) {
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

/* exp(-(x - mu)^2 / sigma^2), the factor of phi_j for one input. */
static float gaussian(float x, float centre, float width) {
    float ratio = (x - centre) / width;
    return lh_exp(-ratio * ratio);
}

/* product[a] = `first` times the factor of each of n actuators at its level in joint action a.
 * centre[n] are those of the actuators' inputs. Returns 3^n. */
static int32_t expand(float first, const float *centre, float width, int32_t n, float *product) {
    int32_t count = 1;
    product[0] = first;
    for (int32_t k = 0; k < n; ++k) {
        /* from the top, so that the products of the actuators before k are read before they are overwritten */
        for (int8_t level = LH_ACTION_LEVELS - 1; level >= 0; --level) {
            float factor = gaussian(lh_action_input(level), centre[k], width);
            for (int32_t a = 0; a < count; ++a) {
                product[level * count + a] = product[a] * factor;
            }
        }
        count *= LH_ACTION_LEVELS;
    }
    return count;
}

/* Each phi_j is a product over the inputs, so the joint actions need only three exponentials per actuator and unit.
 * Half of the actuators give the rows of a table and half its columns: q is the sum over the units of their outer
 * products, w_j and the state inputs being part of the rows. */
float lh_learner_evaluate(lh_learner *learner, const float *states) {
    const lh_network *network = &learner->network;
    int32_t num_controlled = network->inputs - learner->num_states;
    int32_t num_low = num_controlled / 2;
    for (int32_t a = 0; a < learner->num_actions; ++a) {
        learner->q[a] = 0.0f;
    }
    for (int32_t j = 0; j < network->units; ++j) {
        float width = network->width[j];
        const float *centre = network->centre[j];
        float first = network->weight[j];
        for (int32_t i = 0; i < learner->num_states; ++i) {
            first *= gaussian(states[i], centre[i], width);
        }
        centre += learner->num_states;

        float low[MAX_HALF_ACTIONS];
        float high[MAX_HALF_ACTIONS];
        int32_t columns = expand(1.0f, centre, width, num_low, low);
        int32_t rows = expand(first, centre + num_low, width, num_controlled - num_low, high);
        for (int32_t row = 0; row < rows; ++row) {
            for (int32_t column = 0; column < columns; ++column) {
                learner->q[row * columns + column] += high[row] * low[column];
            }
        }
    }
    return learner->q[lh_boltzmann_greedy(learner->q, learner->num_actions)];
}

lh_choice lh_learner_choose(lh_learner *learner, float temperature, bool greedy) {
    const float *q = learner->q;
    int32_t best = lh_boltzmann_greedy(q, learner->num_actions);
    lh_choice choice = {.action = best, .q_max = q[best], .probability = 1.0f};
    if (!greedy) {
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
    float td_error = target - lh_network_value(&learner->network, x, NULL);
    learner->clamped +=
        lh_network_learn(&learner->network, &learner->config.network, x, learner->config.learning_rate, td_error);
    return td_error;
}
