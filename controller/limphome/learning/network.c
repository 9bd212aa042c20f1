#include "limphome/learning/network.h"

#include <stddef.h>
#include <string.h>

#include "limphome/base/elementary.h"
#include "limphome/base/exponential.h"
#include "limphome/base/lanes.h"

/* Largest change of y. With it no product in (19)-(21) is infinite but the last of (20), so that no NaN can arise. */
#define LARGEST_STEP 1e20f

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
        .exact_gradient = true,
    };
}

lh_error lh_network_config_validate(const lh_network_config *config) {
    if (config->units < 1 || config->units > LH_MAX_UNITS) {
        return LH_ERROR_UNITS;
    }
    if (config->inputs < 1 || config->inputs > LH_MAX_INPUTS) {
        return LH_ERROR_INPUTS;
    }
    if (!lh_within(config->rate_weight, 0.0f, LH_NETWORK_RATE_MAX) ||
        !lh_within(config->rate_width, 0.0f, LH_NETWORK_RATE_MAX) ||
        !lh_within(config->rate_centre, 0.0f, LH_NETWORK_RATE_MAX)) {
        return LH_ERROR_RATE;
    }
    if (!lh_within(config->width_floor, LH_WIDTH_FLOOR_MIN, LH_WIDTH_FLOOR_MAX) ||
        !lh_within(config->weight_limit, LH_WEIGHT_LIMIT_MIN, LH_WEIGHT_LIMIT_MAX)) {
        return LH_ERROR_LIMIT;
    }
    if (!lh_within(config->initial_weight, -config->weight_limit, config->weight_limit) ||
        !lh_within(config->initial_width, config->width_floor, LH_INITIAL_WIDTH_MAX)) {
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
    for (int32_t j = 0; j < config->units; j++) {
        network->weight[j] = config->initial_weight;
        network->width[j] = config->initial_width;
        for (int32_t i = 0; i < config->inputs; i++) {
            network->centre[i][j] = lh_random_uniform(random);
        }
    }
    return LH_OK;
}

static bool rest_is_zero(const lh_network *network) {
    bool zero = true;
    for (int32_t j = 0; j < LH_UNIT_SLOTS; j++) {
        bool used = j < network->units;
        zero = zero && (used || (network->weight[j] == 0.0f && network->width[j] == 0.0f));
        for (int32_t i = 0; i < LH_MAX_INPUTS; i++) {
            zero = zero && ((used && i < network->inputs) || network->centre[i][j] == 0.0f);
        }
    }
    return zero;
}

lh_error lh_network_validate(const lh_network *network, const lh_network_config *config) {
    if (network->units != config->units || network->inputs != config->inputs) {
        return LH_ERROR_NETWORK;
    }
    for (int32_t j = 0; j < network->units; j++) {
        bool good = lh_within(network->weight[j], -config->weight_limit, config->weight_limit) &&
                    lh_within(network->width[j], config->width_floor, LH_WIDTH_LIMIT);
        for (int32_t i = 0; i < network->inputs; i++) {
            good = good && lh_within(network->centre[i][j], -LH_CENTRE_LIMIT, LH_CENTRE_LIMIT);
        }
        if (!good) {
            return LH_ERROR_NETWORK;
        }
    }
    return rest_is_zero(network) ? LH_OK : LH_ERROR_NETWORK;
}

void lh_network_precisions(const lh_network *network, float *precision) {
    const float *width = network->width;
    int32_t end = lh_end_of_units(network->units);
    for (int32_t j = 0; j < end; j++) {
        precision[j] = width[j] > 0.0f ? 1.0f / (width[j] * width[j]) : 0.0f;
    }
}

/* distance[j] = ||x - mu_j||^2 */
static void measure(const lh_network *restrict network, const float *restrict x, int32_t end,
                    float *restrict distance) {
    for (int32_t j = 0; j < end; j++) {
        distance[j] = 0.0f;
    }
    for (int32_t i = 0; i < network->inputs; i++) {
        const float *centre = network->centre[i];
        float input = x[i];
        for (int32_t j = 0; j < end; j++) {
            float difference = input - centre[j];
            distance[j] += difference * difference;
        }
    }
}

float lh_network_value(const lh_network *network, const float *x, lh_activation *at) {
    int32_t end = lh_end_of_units(network->units);
    lh_network_precisions(network, at->precision);
    measure(network, x, end, at->distance);
    for (int32_t j = 0; j < end; j++) {
        at->phi[j] = lh_decay(at->distance[j] * at->precision[j]);
    }
    for (int32_t j = network->units; j < LH_UNIT_SLOTS; j++) {
        at->phi[j] = 0.0f;
    }
    return lh_dot(network->weight, at->phi, network->units);
}

static inline bool is_beyond(float x, float limit) {
    return __builtin_fabsf(x) > limit;
}

/* Brings values that are beyond -limit or limit back to it. Seldom needed, so not part of the loops that learn. */
static void hold(float *values, int32_t end, float limit) {
    for (int32_t j = 0; j < end; j++) {
        if (is_beyond(values[j], limit)) {
            values[j] = values[j] < 0.0f ? -limit : limit;
        }
    }
}

/* (19) */
static uint32_t learn_weights(float *restrict weight, const lh_network_config *config, int32_t end,
                              const float *restrict phi, float step) {
    uint32_t held = 0;
    float rate = config->rate_weight * step;
    float limit = config->weight_limit;
    for (int32_t j = 0; j < end; j++) {
        weight[j] += rate * phi[j];
        held += is_beyond(weight[j], limit);
    }
    if (held > 0) {
        hold(weight, end, limit);
    }
    return held;
}

/* (20) */
static uint32_t learn_widths(float *restrict width, const lh_network_config *config, int32_t units,
                             const float *restrict pull, const float *restrict distance) {
    uint32_t held = 0;
    for (int32_t j = 0; j < units; j++) {
        float updated = width[j] + config->rate_width * pull[j] * distance[j] / width[j];
        float kept = updated < config->width_floor ? config->width_floor : updated;
        kept = kept > LH_WIDTH_LIMIT ? LH_WIDTH_LIMIT : kept;
        held += kept != updated ? 1u : 0u;
        width[j] = kept;
    }
    return held;
}

/* (21) for one input */
static uint32_t learn_centres(float *restrict centre, int32_t end, const float *restrict pull, float input) {
    uint32_t held = 0;
    for (int32_t j = 0; j < end; j++) {
        centre[j] += pull[j] * (input - centre[j]);
        held += is_beyond(centre[j], LH_CENTRE_LIMIT);
    }
    if (held > 0) {
        hold(centre, end, LH_CENTRE_LIMIT);
    }
    return held;
}

lh_held lh_network_learn(lh_network *network, const lh_network_config *config, const float *x, const lh_activation *at,
                         float learning_rate, float td_error) {
    /* as printed, the change of y is alpha delta and (19)-(21) have alpha once more, but no factor 2 from the square */
    float step = learning_rate * td_error * (config->exact_gradient ? 1.0f : learning_rate);
    float factor = config->exact_gradient ? 2.0f * step : step;
    if (!lh_within(step, -LARGEST_STEP, LARGEST_STEP)) {
        uint64_t units = (uint64_t)network->units;
        return (lh_held){units, units, units * (uint64_t)network->inputs};
    }

    float pull[LH_UNIT_SLOTS]; /* step w_j phi_j / sigma_j^2, what (20) and (21) share */
    int32_t end = lh_end_of_units(network->units);
    for (int32_t j = 0; j < end; j++) {
        pull[j] = factor * network->weight[j] * at->phi[j] * at->precision[j];
    }
    lh_held held = {
        .weights = learn_weights(network->weight, config, end, at->phi, step),
        .widths = learn_widths(network->width, config, network->units, pull, at->distance),
    };
    for (int32_t j = 0; j < end; j++) {
        pull[j] *= config->rate_centre;
    }
    for (int32_t i = 0; i < network->inputs; i++) {
        held.centres += learn_centres(network->centre[i], end, pull, x[i]);
    }
    return held;
}
