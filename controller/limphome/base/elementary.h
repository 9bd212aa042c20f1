/* Elementary functions in single precision that give the same bits on every platform, unlike those of libm:
 * only +, -, *, / and square root, which IEEE 754 rounds alike everywhere. Compile with -ffp-contract=off.
 * NaN in gives NaN out. */
#ifndef LIMPHOME_ELEMENTARY_H
#define LIMPHOME_ELEMENTARY_H

#include <float.h>
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LH_PI 3.14159265358979f

/* e^x; relative error below 2e-7 where the result is normal; 0 below about -103.97, infinity above about 88.72. */
float lh_exp(float x);

/* Natural logarithm; absolute error below 2e-7 near 1, relative below 2e-7 elsewhere; x > 0.
 * log(0) is -infinity, of a negative number NaN. */
float lh_log(float x);

/* Sine and cosine; absolute error below 2e-7 for |x| up to 8192 rad, NaN beyond. */
float lh_sin(float x);
float lh_cos(float x);

/* Angle of (x, y) in [-pi, pi]; absolute error below 4e-7; atan2(0, 0) is 0, signs of zero are not told apart. */
float lh_atan2(float y, float x);

/* Square root, correctly rounded; NaN below 0. */
float lh_sqrt(float x);

/* x brought into (-pi, pi] by whole turns; absolute error below 2e-7 for |x| up to 100 rad, NaN beyond 8192 rad. */
float lh_wrap_angle(float x);

/* Whether low <= x <= high; false for NaN, which is asked for first as Frama-C does not conclude it from the rest. */
static inline bool lh_within(float x, float low, float high) {
    return x == x && x >= low && x <= high;
}

/* x, limited to low..high; low for NaN. */
static inline float lh_clip(float x, float low, float high) {
    if (x != x || x < low) {
        return low;
    }
    return x > high ? high : x;
}

/* |x|. */
/*@ assigns \nothing;
  @ ensures !\is_NaN(x) ==> \result == (x < 0 ? -x : x);
  @*/
static inline float lh_magnitude(float x) {
    return x < 0.0f ? -x : x;
}

/* The nearest whole number of 16 bits, halves away from 0; beyond +-32767, and for NaN, the end of that range. */
static inline int16_t lh_round_16(float x) {
    x = lh_clip(x, -32767.0f, 32767.0f);
    return (int16_t)(x < 0.0f ? x - 0.5f : x + 0.5f);
}

/* False for NaN and infinity. */
static inline bool lh_finite(float x) {
    return lh_within(x, -FLT_MAX, FLT_MAX);
}

#ifdef __cplusplus
}
#endif
#endif
