#include "limphome/boltzmann.h"

#include <stddef.h>

#include "limphome/elementary.h"

lh_error lh_boltzmann_temperature(int32_t episode, float floor, float *temperature) {
    if (episode < 1) {
        return LH_ERROR_EPISODE;
    }
    float t = 1.0f / lh_log((float)episode + 0.1f);
    *temperature = t < floor ? floor : t;
    return LH_OK;
}

int32_t lh_boltzmann_greedy(const float *q, int32_t count) {
    int32_t best = 0;
    for (int32_t i = 1; i < count; ++i) {
        best = q[i] > q[best] ? i : best;
    }
    return best;
}

/* Sum of exp((q - q_max) / T), the denominator of (3) over exp(q_max / T): between 1 and count. */
static float partition(const float *q, int32_t count, float temperature, float q_max) {
    float sum = 0.0f;
    for (int32_t i = 0; i < count; ++i) {
        sum += lh_exp((q[i] - q_max) / temperature);
    }
    return sum;
}

int32_t lh_boltzmann_select(const float *q, int32_t count, float temperature, lh_random *random, float *probability) {
    float q_max = q[lh_boltzmann_greedy(q, count)];
    float total = partition(q, count, temperature, q_max);

    /* the running sum takes the same roundings as `total`, which is above the target, so it passes the target */
    float target = lh_random_uniform(random) * total;
    int32_t chosen = 0;
    float weight = lh_exp((q[0] - q_max) / temperature);
    float sum = weight;
    while (sum <= target && chosen + 1 < count) {
        ++chosen;
        weight = lh_exp((q[chosen] - q_max) / temperature);
        sum += weight;
    }
    if (probability != NULL) {
        *probability = weight / total;
    }
    return chosen;
}

float lh_boltzmann_probability(const float *q, int32_t count, float temperature, int32_t index) {
    float q_max = q[lh_boltzmann_greedy(q, count)];
    return lh_exp((q[index] - q_max) / temperature) / partition(q, count, temperature, q_max);
}
