#include "limphome/safety/stuck.h"

#include "limphome/base/elementary.h"

void lh_stuck_begin(lh_stuck *stuck) {
    /*@ loop invariant 0 <= k <= LH_MAX_ACTUATORS;
      @ loop invariant \forall integer i; 0 <= i < k ==> stuck->up[i] == 0 && stuck->down[i] == 0;
      @ loop assigns k, *stuck;
      @ loop variant LH_MAX_ACTUATORS - k;
      @*/
    for (int32_t k = 0; k < LH_MAX_ACTUATORS; k++) {
        stuck->up[k] = 0;
        stuck->down[k] = 0;
    }
}

void lh_stuck_watch(lh_stuck *stuck, int32_t index, float way, float gone) {
    if (way == 0.0f) {
        return;
    }
    int8_t *count = way > 0.0f ? &stuck->up[index] : &stuck->down[index];
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
