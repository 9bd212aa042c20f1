#include "limphome/action_values.h"

#include <float.h>

#include "limphome/action.h"
#include "limphome/exponential.h"
#include "limphome/lanes.h"

/* weighted[j] = w_j g_j(s), the Gaussian over the state inputs; 0 beyond the last unit. */
static void weigh_states(const lh_network *network, const float *states, int32_t num_states,
                         const float *restrict precision, float *restrict weighted) {
    for (int32_t j = 0; j < LH_UNIT_SLOTS; ++j) {
        weighted[j] = 0.0f;
    }
    for (int32_t i = 0; i < num_states; ++i) {
        const float *restrict centre = network->centre[i];
        float input = states[i];
        for (int32_t j = 0; j < LH_UNIT_SLOTS; ++j) {
            float difference = input - centre[j];
            weighted[j] += difference * difference;
        }
    }
    const float *restrict weight = network->weight;
    for (int32_t j = 0; j < LH_UNIT_SLOTS; ++j) {
        weighted[j] = weight[j] * lh_exponential(-weighted[j] * precision[j]);
    }
}

/* factor[j] = f_jk(level): the Gaussian over the one input of actuator k, whose centres are centre[j]. */
static void gaussians(float input, const float *restrict centre, const float *restrict precision,
                      float *restrict factor) {
    for (int32_t j = 0; j < LH_UNIT_SLOTS; ++j) {
        float difference = input - centre[j];
        factor[j] = lh_exponential(-(difference * difference) * precision[j]);
    }
}

static void multiply(const float *restrict a, const float *restrict b, float *restrict product) {
    for (int32_t j = 0; j < LH_UNIT_SLOTS; ++j) {
        product[j] = a[j] * b[j];
    }
}

/* Goes through the joint actions like a counter with actuator 0 as its lowest digit: where only the lower digits
 * change, the products of the higher actuators stay as they are. */
float lh_action_values(const lh_network *network, const float *states, int32_t num_states, lh_action_scratch *scratch,
                       float *q) {
    int32_t n = network->inputs - num_states;
    /* w_j g_j(s) times f_jk of actuators k to n - 1; aligned, as its rows are read right after they were written */
    _Alignas(64) float product[LH_MAX_ACTUATORS + 1][LH_UNIT_SLOTS];
    lh_network_precisions(network, scratch->precision);
    weigh_states(network, states, num_states, scratch->precision, product[n]);
    for (int32_t k = 0; k < n; ++k) {
        for (int8_t level = 0; level < LH_ACTION_LEVELS; ++level) {
            gaussians(lh_action_input(level), network->centre[num_states + k], scratch->precision,
                      scratch->factor[k][level]);
        }
    }

    float largest = -FLT_MAX;
    int8_t levels[LH_MAX_ACTUATORS] = {0};
    int32_t changed = n - 1; /* the highest digit that differs from the last round */
    for (int32_t first = 0; changed < n; first += LH_ACTION_LEVELS) {
        for (int32_t k = changed; k > 0; --k) {
            multiply(product[k + 1], scratch->factor[k][levels[k]], product[k]);
        }
        for (int32_t level = 0; level < LH_ACTION_LEVELS; ++level) {
            float value = lh_dot(product[1], scratch->factor[0][level]);
            largest = value > largest ? value : largest;
            q[first + level] = value;
        }
        changed = 1;
        while (changed < n && ++levels[changed] == LH_ACTION_LEVELS) {
            levels[changed++] = 0;
        }
    }
    return largest;
}
