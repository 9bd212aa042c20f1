#include "limphome/safety/stuck.h"

#include <string.h>

#include "limphome/base/elementary.h"

void lh_stuck_begin(lh_stuck *stuck) {
    memset(stuck, 0, sizeof *stuck);
}

void lh_stuck_watch(lh_stuck *stuck, int32_t index, float way, float gone) {
    int8_t *count = way > 0.0f ? &stuck->up[index] : &stuck->down[index];
    if (way == 0.0f) {
        return;
    }
    if (lh_magnitude(gone) >= LH_STUCK_SHARE * lh_magnitude(way)) {
        stuck->up[index] = 0;
        stuck->down[index] = 0;
    } else if (*count < LH_STUCK_DECISIONS) {
        (*count)++;
    }
}

bool lh_stuck_is(const lh_stuck *stuck, int32_t index) {
    return stuck->up[index] >= LH_STUCK_DECISIONS && stuck->down[index] >= LH_STUCK_DECISIONS;
}
