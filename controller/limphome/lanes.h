/* What is computed side by side in LH_LANES lanes. Not part of the interface. */
#ifndef LIMPHOME_LANES_H
#define LIMPHOME_LANES_H

#include <stdint.h>

#include "limphome/capacity.h"

/* Sum of x[LH_LANES], in pairs. */
static inline float lh_sum_lanes(const float *x) {
    float half[4];
    for (int32_t lane = 0; lane < 4; ++lane) {
        half[lane] = x[lane] + x[lane + 4];
    }
    return (half[0] + half[2]) + (half[1] + half[3]);
}

/* sum_j a[j] b[j] over LH_UNIT_SLOTS, in LH_LANES partial sums. */
static inline float lh_dot(const float *a, const float *b) {
    float sum[LH_LANES] = {0.0f};
    for (int32_t j = 0; j < LH_UNIT_SLOTS; j += LH_LANES) {
        for (int32_t lane = 0; lane < LH_LANES; ++lane) {
            sum[lane] += a[j + lane] * b[j + lane];
        }
    }
    return lh_sum_lanes(sum);
}

#endif
