#include "limphome/base/random.h"

/* splitmix64 by Steele, Lea and Flood. */
static uint64_t splitmix64(uint64_t *state) {
    *state += 0x9e3779b97f4a7c15u;
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Two numbers of splitmix64 in a row are never both 0, so neither is the state. */
void lh_random_init(lh_random *random, uint64_t seed) {
    for (int32_t i = 0; i < 4; i += 2) {
        uint64_t z = splitmix64(&seed);
        random->s[i] = (uint32_t)z;
        random->s[i + 1] = (uint32_t)(z >> 32);
    }
}

lh_error lh_random_restore(lh_random *random, const uint32_t s[4]) {
    if ((s[0] | s[1] | s[2] | s[3]) == 0) {
        return LH_ERROR_RANDOM_STATE;
    }
    for (int32_t i = 0; i < 4; i++) {
        random->s[i] = s[i];
    }
    return LH_OK;
}

static uint32_t rotate_left(uint32_t x, int32_t count) {
    return (x << count) | (x >> (32 - count));
}

uint32_t lh_random_next(lh_random *random) {
    uint32_t *s = random->s;
    uint32_t result = rotate_left(s[1] * 5u, 7) * 9u;
    uint32_t shifted = s[1] << 9;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= shifted;
    s[3] = rotate_left(s[3], 11);
    return result;
}

float lh_random_uniform(lh_random *random) {
    return (float)(lh_random_next(random) >> 8) * 0x1p-24f;
}
