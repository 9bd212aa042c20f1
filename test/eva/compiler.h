/* What gcc knows and Frama-C does not. */
#include <math.h>
#define __builtin_sqrtf sqrtf
#define __builtin_inff() INFINITY
#define __builtin_nanf(text) NAN
static inline float magnitude_of(float x) {
    return x < 0.0f ? -x : x;
}
#define __builtin_fabsf magnitude_of
