/* What a learner answers to one observation; the same for every kind. */
#ifndef LIMPHOME_CHOICE_H
#define LIMPHOME_CHOICE_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LH_DISCOUNT_RATE_MAX 1.0f /* of every kind */

typedef struct lh_choice {
    /* what the step that led here has taught */
    bool learned;   /* something was changed by it */
    float td_error; /* delta of (1); 0 unless learned */

    /* what to do now; all 0 where a reset is asked for */
    int32_t action;    /* joint action, see action.h */
    float q;           /* its Q(s, a) */
    float q_max;       /* max over a of Q(s, a) */
    float probability; /* (3) of the chosen action; 1 when greedy */
    float temperature; /* T of (4) */
} lh_choice;

#ifdef __cplusplus
}
#endif
#endif
