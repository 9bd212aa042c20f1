#include "limphome/safety/interlock.h"

/* Written so that what is no number is beyond. */
/*@ assigns \nothing;
  @ ensures \result != 0 <==> lh_beyond(x, limit);
  @*/
static bool is_beyond(float x, float limit) {
    return !(x >= -limit && x <= limit);
}

/*@ requires \valid_read(a);
  @ assigns \nothing;
  @ ensures \result != 0 <==> lh_into_stop(a);
  @*/
static bool runs_into_stop(const lh_guarded *a) {
    bool up = a->velocity > 0.0f && (a->angle >= a->high || a->ahead > a->high);
    bool down = a->velocity < 0.0f && (a->angle <= a->low || a->ahead < a->low);
    return a->is_joint && (up || down);
}

/* A sum, as each bit is there once: provers like it better than bitwise or. */
uint32_t lh_interlock_hazards(const lh_guarded *a, bool joints_unsafe) {
    if (a->level == LH_STILL) {
        return 0;
    }
    uint32_t hazards = joints_unsafe && a->is_joint ? LH_HAZARD_MARGIN : 0;
    hazards += is_beyond(a->velocity, a->speed_limit) ? LH_HAZARD_SPEED : 0;
    hazards += is_beyond(a->change, a->change_limit) ? LH_HAZARD_ACCELERATION : 0;
    hazards += runs_into_stop(a) ? LH_HAZARD_STOP : 0;
    hazards += a->failed ? LH_HAZARD_FAILED : 0;
    hazards += a->stuck ? LH_HAZARD_STUCK : 0;
    hazards += a->collides ? LH_HAZARD_COLLISION : 0;
    return hazards;
}

void lh_interlock(const lh_guarded *guarded, int32_t count, uint32_t whole, bool joints_unsafe, lh_verdict *verdict) {
    uint32_t hazards[LH_MAX_ACTUATORS];
    /*@ loop invariant 0 <= k <= count;
      @ loop invariant \forall integer i; 0 <= i < k ==> guarded[i].level != LH_STILL ==>
      @   (hazards[i] != 0 <==> lh_hazardous(guarded + i, joints_unsafe));
      @ loop assigns k, hazards[0 .. count - 1];
      @ loop variant count - k;
      @*/
    for (int32_t k = 0; k < count; k++) {
        hazards[k] = lh_interlock_hazards(&guarded[k], joints_unsafe);
    }
    verdict->hazards = whole;
    verdict->stilled = 0;
    /*@ loop invariant 0 <= k <= LH_MAX_ACTUATORS;
      @ loop invariant \forall integer i; 0 <= i < k ==> lh_is_still(verdict, i) || (i < count &&
      @   verdict->level[i] == \at(guarded[i].level, Pre) && verdict->velocity[i] == \at(guarded[i].velocity, Pre));
      @ loop invariant \forall integer i; 0 <= i < k && i < count ==>
      @   whole != 0 || \at(lh_hazardous(guarded + i, joints_unsafe), Pre) ==> lh_is_still(verdict, i);
      @ loop invariant \forall integer i; 0 <= i < k && i < count ==>
      @   whole == 0 && !\at(lh_hazardous(guarded + i, joints_unsafe), Pre) ==>
      @   verdict->level[i] == \at(guarded[i].level, Pre);
      @ loop assigns k, *verdict;
      @ loop variant LH_MAX_ACTUATORS - k;
      @*/
    for (int32_t k = 0; k < LH_MAX_ACTUATORS; k++) {
        bool moves = k < count && guarded[k].level != LH_STILL;
        bool passes = moves && whole == 0 && hazards[k] == 0;
        verdict->level[k] = passes ? guarded[k].level : LH_STILL;
        verdict->velocity[k] = passes ? guarded[k].velocity : 0.0f;
        verdict->hazards |= k < count ? hazards[k] : 0;
        verdict->stilled |= moves && !passes ? (uint32_t)1 << k : 0;
    }
}
