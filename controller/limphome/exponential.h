/* The exponential, inline and without a branch, so that a loop over it becomes vector code. Not part of the interface:
 * callers of the library use lh_exp. */
#ifndef LIMPHOME_EXPONENTIAL_H
#define LIMPHOME_EXPONENTIAL_H

#include <stdint.h>
#include <string.h>

/* ln 2 as a sum of floats, the first so short that small multiples of it are exact. */
#define LH_LN2_1 0.693145751953125f
#define LH_LN2_2 1.428606765330187e-06f

/* Added to a number below 2^22 it leaves no room for a fraction: the sum is rounded to the nearest integer. */
#define LH_ROUNDER 12582912.0f /* 1.5 * 2^23 */

static inline uint32_t lh_bits_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline float lh_float_of(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* e^x for x up to 89, see lh_exp. */
static inline float lh_exponential(float x) {
    x = x < -104.0f ? -104.0f : x; /* below the result is 0 anyway; NaN passes */

    /* e^x = 2^n e^r with |r| <= ln(2) / 2; (e^r - 1 - r) / r^2 by its best polynomial of degree 4, error below 5e-9 */
    float shifted = x * 1.44269504f + LH_ROUNDER;
    float n = shifted - LH_ROUNDER;
    float r = x - n * LH_LN2_1 - n * LH_LN2_2;
    float tail = 0.041668400f + r * (0.0083688507f + r * 0.0013814308f);
    float series = 0.49999994f + r * (0.16666520f + r * tail);
    float power = 1.0f + (r + r * r * series);

    /* times 2^n in two steps, as 2^n alone may be too large or too small to be normal */
    uint32_t biased = lh_bits_of(shifted) - lh_bits_of(LH_ROUNDER) + 2 * 127; /* the bits of the rounded sum count on */
    uint32_t half = biased / 2;
    return power * lh_float_of(half << 23) * lh_float_of((biased - half) << 23);
}

#endif
