/* The interlock: the last word on what is commanded. Of each actuator it takes the level that is proposed and what is
 * known of it, and lets the level pass or makes it "still"; nothing else, so that what is executed is again one of the
 * learner's actions. Logic and comparisons alone: Frama-C proves the contracts below (docs/safety.md). What is compared
 * is computed by the monitor (monitor.h). */
#ifndef LIMPHOME_INTERLOCK_H
#define LIMPHOME_INTERLOCK_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/task/action.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Why something was stilled: bits of a mask. */
typedef enum lh_hazard {
    /* the whole robot */
    LH_HAZARD_INVALID = 1, /* the state is not valid */
    LH_HAZARD_STALE = 2,   /* the state is too old, or there is none */
    LH_HAZARD_JUMP = 4,    /* a sensor is further from what it said before than the fastest motion leads */
    LH_HAZARD_TILT = 8,    /* the body is tilted beyond the limit */
    /* all joints */
    LH_HAZARD_MARGIN = 16, /* the stability margin would fall below its floor */
    /* one actuator */
    LH_HAZARD_SPEED = 32,        /* the velocity is beyond the limit */
    LH_HAZARD_ACCELERATION = 64, /* so is its change */
    LH_HAZARD_STOP = 128,        /* the joint would run into its stop */
    LH_HAZARD_FAILED = 256,      /* the plant says that the actuator does not obey */
    LH_HAZARD_STUCK = 512,       /* the joint was commanded and did not move */
    LH_HAZARD_COLLISION = 1024   /* parts of the robot would come together by the joint */
} lh_hazard;

#define LH_HAZARDS 11 /* bits in use */

/* One actuator: what is proposed, and what is known of it. */
typedef struct lh_guarded {
    int8_t level;       /* proposed, 0 to LH_ACTION_LEVELS - 1; one that is not controlled: LH_STILL */
    bool is_joint;      /* false: a crawler, for which angle, ahead, low and high are not read */
    bool failed;        /* the plant says so */
    bool stuck;         /* found to be */
    bool collides;      /* a joint that would bring parts of the robot together */
    float velocity;     /* of the level [m/s or rad/s] */
    float change;       /* from the velocity executed before to this one [m/s or rad/s] */
    float speed_limit;  /* largest magnitude of velocity, 0 or more */
    float change_limit; /* largest magnitude of change, 0 or more */
    float angle;        /* now [rad] */
    float ahead;        /* after a decision at this velocity [rad] */
    float low, high;    /* the joint is not driven beyond these [rad] */
} lh_guarded;

typedef struct lh_verdict {
    uint32_t hazards;                 /* bits of lh_hazard: all that was found */
    uint32_t stilled;                 /* bit k: actuator k was to move and is not to */
    int8_t level[LH_MAX_ACTUATORS];   /* to be executed */
    float velocity[LH_MAX_ACTUATORS]; /* the same [m/s or rad/s] */
} lh_verdict;

/*@ predicate lh_beyond(real x, real limit) = x < -limit || x > limit;
  @ // where the joint is, or would be, beyond what it may be driven to in the direction of its velocity
  @ predicate lh_into_stop{L}(lh_guarded *a) =
  @   a->is_joint && ((a->velocity > 0 && (a->angle >= a->high || a->ahead > a->high)) ||
  @                   (a->velocity < 0 && (a->angle <= a->low || a->ahead < a->low)));
  @ predicate lh_hazardous{L}(lh_guarded *a, integer joints_unsafe) =
  @   lh_beyond(a->velocity, a->speed_limit) || lh_beyond(a->change, a->change_limit) || lh_into_stop(a) ||
  @   a->failed || a->stuck || a->collides || (joints_unsafe != 0 && a->is_joint);
  @ predicate lh_is_still{L}(lh_verdict *v, integer k) = v->level[k] == LH_STILL && v->velocity[k] == 0;
  @*/

/* Bits of what forbids that an actuator moves as proposed; 0 for one that is to be still. joints_unsafe: no joint may
 * move (LH_HAZARD_MARGIN). */
/*@ requires \valid_read(a);
  @ assigns \nothing;
  @ ensures still: a->level == LH_STILL ==> \result == 0;
  @ ensures found: a->level != LH_STILL ==> (\result != 0 <==> lh_hazardous(a, joints_unsafe));
  @*/
uint32_t lh_interlock_hazards(const lh_guarded *a, bool joints_unsafe);

/* What is to be executed of `count` actuators, 0 to LH_MAX_ACTUATORS. `whole`: bits of the hazards for which nothing
 * may move, or 0. */
/*@ requires 0 <= count <= LH_MAX_ACTUATORS;
  @ requires \valid_read(guarded + (0 .. count - 1)) && \valid(verdict);
  @ requires \separated(guarded + (0 .. count - 1), verdict);
  @ assigns *verdict;
  @ ensures proposed_or_still: \forall integer k; 0 <= k < count ==> lh_is_still(verdict, k) ||
  @   (verdict->level[k] == \old(guarded[k].level) && verdict->velocity[k] == \old(guarded[k].velocity));
  @ ensures nothing_else_moves: \forall integer k; count <= k < LH_MAX_ACTUATORS ==> lh_is_still(verdict, k);
  @ ensures hazardous_is_still: \forall integer k; 0 <= k < count ==>
  @   whole != 0 || \old(lh_hazardous(guarded + k, joints_unsafe)) ==> lh_is_still(verdict, k);
  @ ensures not_without_reason: \forall integer k; 0 <= k < count ==>
  @   whole == 0 && !\old(lh_hazardous(guarded + k, joints_unsafe)) ==>
  @   verdict->level[k] == \old(guarded[k].level);
  @ ensures speed: \forall integer k; 0 <= k < count ==> \old(0 <= guarded[k].speed_limit) ==>
  @   \old(-guarded[k].speed_limit) <= verdict->velocity[k] <= \old(guarded[k].speed_limit);
  @ ensures acceleration: \forall integer k; 0 <= k < count ==>
  @   \old(lh_beyond(guarded[k].change, guarded[k].change_limit)) ==> lh_is_still(verdict, k);
  @ ensures not_up_into_stop: \forall integer k; 0 <= k < count ==>
  @   \old(guarded[k].is_joint && (guarded[k].angle >= guarded[k].high || guarded[k].ahead > guarded[k].high)) ==>
  @   verdict->velocity[k] <= 0;
  @ ensures not_down_into_stop: \forall integer k; 0 <= k < count ==>
  @   \old(guarded[k].is_joint && (guarded[k].angle <= guarded[k].low || guarded[k].ahead < guarded[k].low)) ==>
  @   verdict->velocity[k] >= 0;
  @ ensures out_of_order: \forall integer k; 0 <= k < count ==>
  @   \old(guarded[k].failed || guarded[k].stuck || guarded[k].collides) ==> lh_is_still(verdict, k);
  @ ensures joints_stop: joints_unsafe ==> \forall integer k; 0 <= k < count ==>
  @   \old(guarded[k].is_joint) ==> lh_is_still(verdict, k);
  @ ensures whole_stop: whole != 0 ==> \forall integer k; 0 <= k < LH_MAX_ACTUATORS ==> lh_is_still(verdict, k);
  @*/
void lh_interlock(const lh_guarded *guarded, int32_t count, uint32_t whole, bool joints_unsafe, lh_verdict *verdict);

#ifdef __cplusplus
}
#endif
#endif
