/* Boltzmann selection (3) with the temperature of (4). */
#ifndef LIMPHOME_BOLTZMANN_H
#define LIMPHOME_BOLTZMANN_H

#include <stdint.h>

#include "limphome/base/error.h"
#include "limphome/base/random.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Range of the least T of (4), in the unit of Q. */
#define LH_TEMPERATURE_FLOOR_MIN 1e-4f
#define LH_TEMPERATURE_FLOOR_MAX 10.0f

/* T = 1 / log(t + 0.1) of (4) for episode t, counted from 1, but not less than `floor` [same unit as Q].
 * LH_ERROR_EPISODE, and *temperature unchanged, for t < 1, where (4) is negative. */
lh_error lh_boltzmann_temperature(int32_t episode, float floor, float *temperature);

/* Index of a largest value of q[count], count >= 1; the first of equals. */
int32_t lh_boltzmann_greedy(const float *q, int32_t count);

/* Draws an index with the probabilities (3) from q[count], count >= 1, temperature > 0. The largest q is subtracted
 * first, so that no exponential overflows. Uses one random number. *probability, if not NULL, receives pi(s, a). */
int32_t lh_boltzmann_select(const float *q, int32_t count, float temperature, lh_random *random, float *probability);

/* Probability (3) of `index`. */
float lh_boltzmann_probability(const float *q, int32_t count, float temperature, int32_t index);

#ifdef __cplusplus
}
#endif
#endif
