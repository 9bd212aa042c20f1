/* The exponential, inline and without a branch, so that a loop over it becomes vector code. Not part of the interface:
 * callers of the library use lh_exp. */
#ifndef LIMPHOME_EXPONENTIAL_H
#define LIMPHOME_EXPONENTIAL_H

#include <stdint.h>
#include <string.h>

/* Also where code is made small: called, it would fetch its constants each time. */
#define LH_ALWAYS_INLINE static inline __attribute__((always_inline))

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

/* e^x = 2^n e^r with |r| <= ln(2) / 2: returns e^r; *shifted is n + LH_ROUNDER, whose lowest bits are those of n. */
LH_ALWAYS_INLINE float lh_exponential_parts(float x, float *shifted) {
    *shifted = x * 1.44269504f + LH_ROUNDER;
    float n = *shifted - LH_ROUNDER;
    float r = x - n * LH_LN2_1 - n * LH_LN2_2;
    /* (e^r - 1 - r) / r^2 by its best polynomial of degree 4, error below 5e-9 */
    float tail = 0.041668400f + r * (0.0083688507f + r * 0.0013814308f);
    float series = 0.49999994f + r * (0.16666520f + r * tail);
    return 1.0f + (r + r * r * series);
}

/* e^x for x up to 89, see lh_exp. */
static inline float lh_exponential(float x) {
    x = x < -104.0f ? -104.0f : x; /* below the result is 0 anyway; NaN passes */
    float shifted;
    float power = lh_exponential_parts(x, &shifted);
    /* times 2^n in two steps, as 2^n alone may be too large or too small to be normal */
    uint32_t biased = lh_bits_of(shifted) - lh_bits_of(LH_ROUNDER) + 2 * 127; /* the bits of the rounded sum count on */
    uint32_t half = biased / 2;
    return power * lh_float_of(half << 23) * lh_float_of((biased - half) << 23);
}

#define LH_DECAY_END 87.3f

/* e^-x for x >= 0, not NaN, as exact as lh_exp up to LH_DECAY_END, and beyond what it is there, 1.2e-38: never 0, so
 * that it may be divided by, and never denormal, so that n can be added to the exponent of e^r. */
LH_ALWAYS_INLINE float lh_decay(float x) {
    x = x > LH_DECAY_END ? LH_DECAY_END : x;
    float shifted;
    float power = lh_exponential_parts(-x, &shifted);
    return lh_float_of(lh_bits_of(power) + (lh_bits_of(shifted) << 23));
}

#endif
