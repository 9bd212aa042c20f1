/* One decision of the paper's learner, computed in several ways: Q of all joint actions, Boltzmann selection (3), one
 * step of learning (1)(19)-(21). All ways begin with the same network and see the same states and random numbers. */
#ifndef LIMPHOME_BENCH_DECISION_H
#define LIMPHOME_BENCH_DECISION_H

#include "limphome/learning/q_learning.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { UNITS = 50, SITUATIONS = 1024 };

typedef struct problem {
    lh_q_learning learner; /* as it begins */
    int32_t num_states;
    int32_t num_controlled;
    float states[SITUATIONS][LH_MAX_STATE_INPUTS]; /* state inputs of decision k are states[k % SITUATIONS] */
} problem;

#define TEMPERATURE 0.5f

/* A way to decide. `begin` takes over the problem; `decide` makes decision k, counted from 0, and returns its action.
 */
typedef struct method {
    void (*begin)(const problem *p);
    int32_t (*decide)(int32_t k);
} method;

/* What the step from decision k - 1 to decision k brought. */
static inline float reward_of(int32_t k) {
    return (float)(k % 7) * 0.25f - 0.75f;
}

extern const method library_method;
extern const method plain_float_method;
extern const method plain_double_method;
extern const method eigen_method;

#ifdef __cplusplus
}
#endif
#endif
