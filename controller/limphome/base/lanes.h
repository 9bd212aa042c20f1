/* What is computed side by side. Not part of the interface. */
#ifndef LIMPHOME_LANES_H
#define LIMPHOME_LANES_H

#include <stdint.h>

#include "limphome/base/capacity.h"

/* Floats that one instruction can add or multiply, by what is compiled for; 1 where there are no vectors, or with
 * LH_NO_VECTORS. It makes no difference to any result. */
#if defined(LH_NO_VECTORS)
#define LH_VECTOR_WIDTH 1
#elif defined(__AVX512F__)
#define LH_VECTOR_WIDTH 16
#elif defined(__AVX__)
#define LH_VECTOR_WIDTH 8
#elif defined(__SSE2__) || defined(__ARM_NEON)
#define LH_VECTOR_WIDTH 4
#else
#define LH_VECTOR_WIDTH 1
#endif

/* One such group of floats in an array; + and * go element by element, and by a single float. */
#if LH_VECTOR_WIDTH > 1
typedef float lh_vector __attribute__((vector_size(4 * LH_VECTOR_WIDTH), aligned(4), may_alias));
#else
typedef float lh_vector;
#endif

/* The number of units, up to a multiple of LH_LANES that the compiler can see. */
static inline int32_t lh_whole_lanes(int32_t units) {
    return (int32_t)((uint32_t)(units + LH_LANES - 1) & ~(uint32_t)(LH_LANES - 1));
}

/* Where loops over units end: with vectors after the last whole one, and what is computed beyond the last unit is not
 * used; without them after the last unit. */
static inline int32_t lh_end_of_units(int32_t units) {
    return LH_VECTOR_WIDTH > 1 ? lh_whole_lanes(units) : units;
}

/* Sum of x[LH_LANES], in pairs. */
static inline float lh_sum_lanes(const float *x) {
    return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

/* sum_j a[j] b[j] over the units, in LH_LANES partial sums; in the last lanes one of the two must be 0 beyond. */
static inline float lh_dot(const float *a, const float *b, int32_t units) {
    float sum[LH_LANES] = {0.0f};
    int32_t end = lh_whole_lanes(units);
    for (int32_t j = 0; j < end; j += LH_LANES) {
        for (int32_t lane = 0; lane < LH_LANES; lane++) {
            sum[lane] += a[j + lane] * b[j + lane];
        }
    }
    return lh_sum_lanes(sum);
}

#endif
