#include "limphome/base/elementary.h"

#include <stdint.h>

#include "limphome/base/exponential.h"

/* Wider intermediate results, as of the x87, would give other bits. */
_Static_assert(FLT_EVAL_METHOD == 0, "float must be evaluated as float");

#define INFINITE __builtin_inff()
#define NOT_A_NUMBER __builtin_nanf("")

/* pi/2 as a sum of floats, all but the last so short that small multiples of them are exact. */
#define QUARTER_1 1.5703125f
#define QUARTER_2 0.0004837512969970703f
#define QUARTER_3 7.549790126404332e-08f

#define LARGEST_ANGLE 8192.0f

/* |x| must be below 2^31. */
static int32_t nearest(float x) {
    return (int32_t)(x < 0.0f ? x - 0.5f : x + 0.5f);
}

float lh_exp(float x) {
    return lh_exponential(x > 89.0f ? 89.0f : x); /* above the result is infinite anyway */
}

float lh_log(float x) {
    if (x != x || x < 0.0f) {
        return NOT_A_NUMBER;
    }
    if (x == 0.0f) {
        return -INFINITE;
    }
    if (x > FLT_MAX) {
        return x;
    }

    /* x = 2^k (1 + f), 1 + f between sqrt(1/2) and sqrt(2) */
    int32_t k = 0;
    if (x < FLT_MIN) {
        x *= 0x1p23f;
        k = -23;
    }
    uint32_t above = lh_bits_of(x) - lh_bits_of(0.70710678f);
    k += (int32_t)above >> 23;
    float f = lh_float_of((above & 0x007fffffu) + lh_bits_of(0.70710678f)) - 1.0f;

    /* log(1 + f) = 2 artanh(s), by its series in s; written so that f, which is exact, is the leading term */
    float s = f / (2.0f + f);
    float z = s * s;
    float series = z * (2.0f / 3.0f + z * (2.0f / 5.0f + z * (2.0f / 7.0f + z * (2.0f / 9.0f))));
    float half_square = 0.5f * f * f;
    float correction = s * (half_square + series) + (float)k * LH_LN2_2;
    return (float)k * LH_LN2_1 + (f - (half_square - correction));
}

/* x - n pi/2, exact but for the rounding of the result, for |n| < 2^13. */
static float minus_quarter_turns(float x, int32_t n) {
    return x - (float)n * QUARTER_1 - (float)n * QUARTER_2 - (float)n * QUARTER_3;
}

/* Series for |r| <= pi/4; the next terms are below 2e-9 and 3e-8. */
static float sine_series(float r) {
    float z = r * r;
    return r + r * z * (-1.0f / 6.0f + z * (1.0f / 120.0f + z * (-1.0f / 5040.0f + z * (1.0f / 362880.0f))));
}

static float cosine_series(float r) {
    float z = r * r;
    return 1.0f + z * (-0.5f + z * (1.0f / 24.0f + z * (-1.0f / 720.0f + z * (1.0f / 40320.0f))));
}

/* Sine of x + `turn` quarter turns. */
static float sine_of_turned(float x, int32_t turn) {
    if (!lh_within(x, -LARGEST_ANGLE, LARGEST_ANGLE)) {
        return NOT_A_NUMBER;
    }
    int32_t n = nearest(x * 0.636619772f);
    float r = minus_quarter_turns(x, n);
    uint32_t quadrant = (uint32_t)(n + turn) & 3u;
    float magnitude = (quadrant & 1u) ? cosine_series(r) : sine_series(r);
    return (quadrant & 2u) ? -magnitude : magnitude;
}

float lh_sin(float x) {
    return sine_of_turned(x, 0);
}

float lh_cos(float x) {
    return sine_of_turned(x, 1);
}

/* Arc tangent of t in [0, 1]. */
static float arc_tangent(float t) {
    bool upper = t > 0.41421356f; /* tan(pi/8) */
    float r = upper ? (t - 1.0f) / (t + 1.0f) : t;
    /* polynomial through the Chebyshev nodes of |r| <= tan(pi/8); error below 3e-8 */
    float z = r * r;
    float angle = r + r * z * (-0.333332865f + z * (0.199912353f + z * (-0.140240966f + z * 0.0852027783f)));
    return upper ? 0.25f * LH_PI + angle : angle;
}

float lh_atan2(float y, float x) {
    float width = x < 0.0f ? -x : x;
    float height = y < 0.0f ? -y : y;
    if (width == 0.0f && height == 0.0f) {
        return 0.0f;
    }
    bool steep = height > width;
    /* equal ones apart, as both may be infinite */
    float ratio = height == width ? 1.0f : steep ? width / height : height / width;

    float angle = arc_tangent(ratio);
    angle = steep ? 0.5f * LH_PI - angle : angle;
    angle = x < 0.0f ? LH_PI - angle : angle;
    return y < 0.0f ? -angle : angle;
}

float lh_sqrt(float x) {
    return __builtin_sqrtf(x);
}

float lh_wrap_angle(float x) {
    if (x > -LH_PI && x <= LH_PI) {
        return x;
    }
    if (!lh_within(x, -LARGEST_ANGLE, LARGEST_ANGLE)) {
        return NOT_A_NUMBER;
    }
    /* rounding of the number of turns may leave the result just outside on either side */
    float r = minus_quarter_turns(x, 4 * nearest(x * 0.159154943f));
    return lh_within(r, -LH_PI, LH_PI) && r != -LH_PI ? r : LH_PI;
}
