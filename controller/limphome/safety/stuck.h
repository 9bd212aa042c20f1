/* Finds joints that do not move although they are told to. A joint that presses against something may be stopped in one
 * direction; one that has failed moves in neither. Crawlers slip, so what their belts do does not tell. */
#ifndef LIMPHOME_STUCK_H
#define LIMPHOME_STUCK_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/body/robot.h"

#ifdef __cplusplus
extern "C" {
#endif

#define LH_STUCK_DECISIONS 3 /* in each direction without moving in between, and a joint is stuck */
#define LH_STUCK_SHARE 0.1f  /* less of the way that it was to go is not moving */

typedef struct lh_stuck {
    int8_t up[LH_MAX_ACTUATORS];   /* decisions in which it was to move up and did not, since it last moved */
    int8_t down[LH_MAX_ACTUATORS]; /* likewise */
} lh_stuck;

/*@ predicate lh_stuck_counts{L}(lh_stuck *s) = \forall integer k; 0 <= k < LH_MAX_ACTUATORS ==>
  @   0 <= s->up[k] <= LH_STUCK_DECISIONS && 0 <= s->down[k] <= LH_STUCK_DECISIONS;
  @*/

/* Nothing is known: no joint is stuck. */
/*@ requires \valid(stuck);
  @ assigns *stuck;
  @ ensures lh_stuck_counts(stuck);
  @ ensures \forall integer k; 0 <= k < LH_MAX_ACTUATORS ==> stuck->up[k] == 0 && stuck->down[k] == 0;
  @*/
void lh_stuck_begin(lh_stuck *stuck);

/* Joint `index` was to go `way` and went `gone` [rad]. One that was not to go tells nothing. */
/*@ requires \valid(stuck) && 0 <= index < LH_MAX_ACTUATORS;
  @ assigns stuck->up[index], stuck->down[index];
  @ ensures \old(lh_stuck_counts(stuck)) ==> lh_stuck_counts(stuck);
  @ ensures idle: way == 0 ==>
  @   stuck->up[index] == \old(stuck->up[index]) && stuck->down[index] == \old(stuck->down[index]);
  @ ensures one_at_a_time: (stuck->up[index] == 0 && stuck->down[index] == 0) ||
  @   (stuck->up[index] <= \old(stuck->up[index]) + 1 && stuck->down[index] == \old(stuck->down[index])) ||
  @   (stuck->down[index] <= \old(stuck->down[index]) + 1 && stuck->up[index] == \old(stuck->up[index]));
  @*/
void lh_stuck_watch(lh_stuck *stuck, int32_t index, float way, float gone);

/* Whether joint `index` is. */
/*@ requires \valid_read(stuck) && 0 <= index < LH_MAX_ACTUATORS;
  @ assigns \nothing;
  @ ensures \result != 0 <==> stuck->up[index] >= LH_STUCK_DECISIONS && stuck->down[index] >= LH_STUCK_DECISIONS;
  @*/
bool lh_stuck_is(const lh_stuck *stuck, int32_t index);

#ifdef __cplusplus
}
#endif
#endif
