#include "limphome/learning/boltzmann.h"

#include <stddef.h>

#include "limphome/base/capacity.h"
#include "limphome/base/elementary.h"
#include "limphome/base/exponential.h"
#include "limphome/base/lanes.h"

#define CHUNK (4 * LH_LANES) /* values of q that are computed at a time */

lh_error lh_boltzmann_temperature(int32_t episode, float floor, float *temperature) {
    if (episode < 1) {
        return LH_ERROR_EPISODE;
    }
    float t = 1.0f / lh_log((float)episode + 0.1f);
    *temperature = t < floor ? floor : t;
    return LH_OK;
}

/* The largest of q[count], found in LH_LANES strands. */
static float largest(const float *q, int32_t count) {
    float strand[LH_LANES];
    for (int32_t lane = 0; lane < LH_LANES; lane++) {
        strand[lane] = q[0];
    }
    int32_t whole = count / LH_LANES * LH_LANES;
    for (int32_t i = 0; i < whole; i += LH_LANES) {
        for (int32_t lane = 0; lane < LH_LANES; lane++) {
            strand[lane] = q[i + lane] > strand[lane] ? q[i + lane] : strand[lane];
        }
    }
    float most = q[count - 1];
    for (int32_t i = whole; i < count; i++) {
        most = q[i] > most ? q[i] : most;
    }
    for (int32_t lane = 0; lane < LH_LANES; lane++) {
        most = strand[lane] > most ? strand[lane] : most;
    }
    return most;
}

int32_t lh_boltzmann_greedy(const float *q, int32_t count) {
    float most = largest(q, count);
    int32_t best = 0;
    while (best < count - 1 && q[best] < most) {
        best++;
    }
    return best;
}

/* likelihood[CHUNK] = exp((q - q_max) / T), the numerators of (3) over exp(q_max / T), for the first of q[count]; 0
 * where it is below 1e-38, and from q[count] on. Returns their sum. */
static float likelihoods(const float *q, int32_t count, float temperature, float q_max, float *restrict likelihood) {
    float rest[CHUNK];
    if (count < CHUNK) {
        for (int32_t i = 0; i < CHUNK; i++) {
            rest[i] = i < count ? q[i] : -FLT_MAX;
        }
        q = rest;
    }
    for (int32_t i = 0; i < CHUNK; i++) {
        float exponent = (q_max - q[i]) / temperature;
        likelihood[i] = exponent > LH_DECAY_END ? 0.0f : lh_decay(exponent);
    }
    float sum[LH_LANES] = {0.0f};
    for (int32_t i = 0; i < CHUNK; i += LH_LANES) {
        for (int32_t lane = 0; lane < LH_LANES; lane++) {
            sum[lane] += likelihood[i + lane];
        }
    }
    return lh_sum_lanes(sum);
}

/* Sum of the likelihoods: between 1 and count. */
static float partition(const float *q, int32_t count, float temperature, float q_max) {
    float likelihood[CHUNK];
    float sum = 0.0f;
    for (int32_t i = 0; i < count; i += CHUNK) {
        sum += likelihoods(&q[i], count - i, temperature, q_max, likelihood);
    }
    return sum;
}

int32_t lh_boltzmann_select(const float *q, int32_t count, float temperature, lh_random *random, float *probability) {
    float q_max = largest(q, count);
    float total = partition(q, count, temperature, q_max);
    float target = lh_random_uniform(random) * total;

    /* the chunk in which the running sum, which takes the same roundings as `total`, passes the target */
    float likelihood[CHUNK];
    float below = 0.0f;
    int32_t first = 0;
    float sum = likelihoods(q, count, temperature, q_max, likelihood);
    while (first + CHUNK < count && below + sum <= target) {
        first += CHUNK;
        below += sum;
        sum = likelihoods(&q[first], count - first, temperature, q_max, likelihood);
    }
    /* the place in the chunk, which rounding must not make one of likelihood 0 */
    int32_t place = 0;
    int32_t end = CHUNK;
    //@ split first; // for Frama-C: the end depends on it
    if (count - first < CHUNK) {
        end = count - first;
    }
    for (int32_t i = 0; i < end && below <= target; i++) {
        if (likelihood[i] > 0.0f) {
            place = i;
            below += likelihood[i];
        }
    }
    if (probability != NULL) {
        *probability = likelihood[place] / total;
    }
    return first + place;
}

float lh_boltzmann_probability(const float *q, int32_t count, float temperature, int32_t index) {
    float q_max = largest(q, count);
    return lh_exp((q[index] - q_max) / temperature) / partition(q, count, temperature, q_max);
}
