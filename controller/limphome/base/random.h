/* Random numbers: xoshiro128** by Blackman and Vigna, seeded through splitmix64. Period 2^128 - 1. */
#ifndef LIMPHOME_RANDOM_H
#define LIMPHOME_RANDOM_H

#include <stdint.h>

#include "limphome/base/error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lh_random {
    uint32_t s[4]; /* never all zero */
} lh_random;

/* Any seed is good; equal seeds give equal sequences on every platform. */
void lh_random_init(lh_random *random, uint64_t seed);

/* Takes over a state saved earlier. LH_ERROR_RANDOM_STATE, and nothing changed, if it is all zero. */
lh_error lh_random_restore(lh_random *random, const uint32_t s[4]);

/* Uniform over all 32-bit numbers. */
uint32_t lh_random_next(lh_random *random);

/* Uniform in [0, 1), a multiple of 2^-24. */
float lh_random_uniform(lh_random *random);

#ifdef __cplusplus
}
#endif
#endif
