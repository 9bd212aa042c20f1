/* The bits of the elementary functions all over the range of a float: elementary.bin receives a checksum for each
 * function. The host's tests compare the functions with libm; on every platform the bits must be the same. */
#include "limphome/base/elementary.h"

#include <stdint.h>
#include <string.h>

#include "limphome/base/exponential.h"
#include "platform.h"

enum { STRIDE = 4099 }; /* prime: every exponent, and all kinds of mantissas */

static float angle_by_height(float x) {
    return lh_atan2(x, 0.75f);
}

static float angle_by_base(float x) {
    return lh_atan2(-0.75f, x);
}

/* Not made for NaN. */
static float decay(float x) {
    return x != x ? x : lh_decay(x > 0.0f ? x : -x);
}

static float (*const functions[])(float) = {
    lh_exp, decay, lh_log, lh_sin, lh_cos, angle_by_height, angle_by_base, lh_sqrt, lh_wrap_angle,
};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

/* Which NaN comes out depends on the processor; that it is one does not. */
static uint32_t bits_of(float x) {
    uint32_t bits = 0x7FC00000;
    if (x == x) {
        memcpy(&bits, &x, sizeof bits);
    }
    return bits;
}

/* FNV-1a by words. */
static uint64_t checksum(float (*function)(float)) {
    uint64_t sum = 14695981039346656037u;
    for (uint64_t pattern = 0; pattern <= UINT32_MAX; pattern += STRIDE) {
        const uint32_t bits = (uint32_t)pattern;
        float x;
        memcpy(&x, &bits, sizeof x);
        sum = (sum ^ bits_of(function(x))) * 1099511628211u;
    }
    return sum;
}

int main(void) {
    uint64_t sums[FUNCTIONS];
    for (int i = 0; i < FUNCTIONS; i++) {
        sums[i] = checksum(functions[i]);
    }
    return platform_write(platform_open("elementary.bin", true), sums, sizeof sums) ? 0 : 1;
}
