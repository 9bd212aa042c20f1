#include "limphome/network.h"

#include <stddef.h>
#include <string.h>

#include "limphome/elementary.h"

lh_network_config lh_network_config_default(void) {
    return (lh_network_config){
        .units = 50,
        .inputs = 10,
        .rate_weight = 0.1f,
        .rate_width = 0.01f,
        .rate_centre = 0.1f,
        .initial_weight = 0.0f,
        .initial_width = 1.0f,
        .width_floor = 0.05f,
        .weight_limit = 1e4f,
        .exact_gradient = false,
    };
}

lh_error lh_network_config_validate(const lh_network_config *config) {
    if (config->units < 1 || config->units > LH_MAX_UNITS) {
        return LH_ERROR_UNITS;
    }
    if (config->inputs < 1 || config->inputs > LH_MAX_INPUTS) {
        return LH_ERROR_INPUTS;
    }
    if (!lh_within(config->rate_weight, 0.0f, 10.0f) || !lh_within(config->rate_width, 0.0f, 10.0f) ||
        !lh_within(config->rate_centre, 0.0f, 10.0f)) {
        return LH_ERROR_RATE;
    }
    if (!lh_within(config->width_floor, 0.01f, 1.0f) || !lh_within(config->weight_limit, 1.0f, 1e6f)) {
        return LH_ERROR_LIMIT;
    }
    if (!lh_within(config->initial_weight, -config->weight_limit, config->weight_limit) ||
        !lh_within(config->initial_width, config->width_floor, 100.0f)) {
        return LH_ERROR_INITIAL;
    }
    return LH_OK;
}

lh_error lh_network_init(lh_network *network, const lh_network_config *config, lh_random *random) {
    lh_error error = lh_network_config_validate(config);
    if (error != LH_OK) {
        return error;
    }
    memset(network, 0, sizeof *network); /* not by a literal, which would lie on the stack */
    network->units = config->units;
    network->inputs = config->inputs;
    for (int32_t j = 0; j < config->units; ++j) {
        network->weight[j] = config->initial_weight;
        network->width[j] = config->initial_width;
        for (int32_t i = 0; i < config->inputs; ++i) {
            network->centre[j][i] = lh_random_uniform(random);
        }
    }
    return LH_OK;
}

lh_error lh_network_validate(const lh_network *network, const lh_network_config *config) {
    if (network->units != config->units || network->inputs != config->inputs) {
        return LH_ERROR_NETWORK;
    }
    for (int32_t j = 0; j < network->units; ++j) {
        bool good = lh_within(network->weight[j], -config->weight_limit, config->weight_limit) &&
                    lh_within(network->width[j], config->width_floor, LH_WIDTH_LIMIT);
        for (int32_t i = 0; i < network->inputs; ++i) {
            good = good && lh_within(network->centre[j][i], -LH_CENTRE_LIMIT, LH_CENTRE_LIMIT);
        }
        if (!good) {
            return LH_ERROR_NETWORK;
        }
    }
    return LH_OK;
}

/* ||x - mu_j||^2 */
static float squared_distance(const float *x, const float *centre, int32_t inputs) {
    float sum = 0.0f;
    for (int32_t i = 0; i < inputs; ++i) {
        float difference = x[i] - centre[i];
        sum += difference * difference;
    }
    return sum;
}

float lh_network_value(const lh_network *network, const float *x, float *phi) {
    float y = 0.0f;
    for (int32_t j = 0; j < network->units; ++j) {
        float width = network->width[j];
        float activation = lh_exp(-squared_distance(x, network->centre[j], network->inputs) / (width * width));
        if (phi != NULL) {
            phi[j] = activation;
        }
        y += network->weight[j] * activation;
    }
    return y;
}

/* `updated`, or the limit it would pass, or `value` where it is not finite; counts what it had to hold. */
static float held(float value, float updated, float low, float high, int32_t *count) {
    if (lh_within(updated, low, high)) {
        return updated;
    }
    ++*count;
    if (!lh_finite(updated)) {
        return value;
    }
    return updated < low ? low : high;
}

int32_t lh_network_learn(lh_network *network, const lh_network_config *config, const float *x, float learning_rate,
                         float td_error) {
    /* as printed, the change of y is alpha delta and (19)-(21) have alpha once more, but no factor 2 from the square */
    float step = learning_rate * td_error * (config->exact_gradient ? 1.0f : learning_rate);
    float factor = config->exact_gradient ? 2.0f : 1.0f;
    float phi[LH_MAX_UNITS];
    lh_network_value(network, x, phi);

    int32_t count = 0;
    for (int32_t j = 0; j < network->units; ++j) {
        float *centre = network->centre[j];
        float weight = network->weight[j];
        float width = network->width[j];
        float distance = squared_distance(x, centre, network->inputs);
        float pull = factor * step * weight * phi[j] / (width * width);

        float new_weight = weight + config->rate_weight * step * phi[j];
        network->weight[j] = held(weight, new_weight, -config->weight_limit, config->weight_limit, &count);
        float new_width = width + config->rate_width * pull * distance / width;
        network->width[j] = held(width, new_width, config->width_floor, LH_WIDTH_LIMIT, &count);
        for (int32_t i = 0; i < network->inputs; ++i) {
            float new_centre = centre[i] + config->rate_centre * pull * (x[i] - centre[i]);
            centre[i] = held(centre[i], new_centre, -LH_CENTRE_LIMIT, LH_CENTRE_LIMIT, &count);
        }
    }
    return count;
}
