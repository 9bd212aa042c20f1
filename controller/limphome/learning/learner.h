/* Q-learning (1)(2) on the RBF network, with Boltzmann selection (3). */
#ifndef LIMPHOME_LEARNER_H
#define LIMPHOME_LEARNER_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/learning/action_values.h"
#include "limphome/learning/network.h"
#include "limphome/base/random.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Ranges of lh_learner_config, from 0. */
#define LH_LEARNING_RATE_MAX 1.0f
#define LH_DISCOUNT_RATE_MAX 1.0f

typedef struct lh_learner_config {
    float learning_rate;       /* alpha of (2), 0 to 1; paper: 0.1 */
    float discount_rate;       /* gamma of (1), 0 to 1; paper: 0.9 */
    lh_network_config network; /* inputs = state inputs + controlled actuators */
} lh_learner_config;

/* What a resumed run needs is `network` and `random`; the rest is overwritten by each decision. */
typedef struct lh_learner {
    lh_learner_config config;
    int32_t num_states;  /* state inputs of the network */
    int32_t num_actions; /* joint actions, 3^n */
    lh_network network;
    lh_random random;
    lh_held held;            /* network parameters held at a limit so far */
    float q_max;             /* the largest of q */
    float q[LH_MAX_ACTIONS]; /* Q(s, a) of the newest state [num_actions] */
    lh_action_scratch scratch;
} lh_learner;

/* Choice of one decision. */
typedef struct lh_choice {
    int32_t action;    /* joint action, see action.h */
    float q;           /* its Q(s, a) */
    float q_max;       /* max over a of Q(s, a) */
    float probability; /* (3) of the chosen action; 1 when greedy */
} lh_choice;

/* alpha 0.1, gamma 0.9, and the network's default. */
lh_learner_config lh_learner_config_default(void);
lh_error lh_learner_config_validate(const lh_learner_config *config);

/* `num_controlled` actuators (1 to LH_MAX_ACTUATORS) give 3^num_controlled actions; config->network.inputs must be
 * num_states + num_controlled. Centres are drawn from `seed`, and the same generator goes on to select actions. */
lh_error lh_learner_init(lh_learner *learner, const lh_learner_config *config, int32_t num_states,
                         int32_t num_controlled, uint64_t seed);

/* Computes Q(s, a) of all joint actions into learner->q for the state inputs states[num_states], each in [0, 1].
 * Returns the largest. */
float lh_learner_evaluate(lh_learner *learner, const float *states);

/* Chooses among learner->q: by (3) at `temperature`, or a largest one if `greedy` (then no random number is used). */
lh_choice lh_learner_choose(lh_learner *learner, float temperature, bool greedy);

/* Learns from one step: Q(states, action) moves towards reward + gamma * next_q_max by (1), (2), (19)-(21).
 * `terminal`: there is no next state and next_q_max is not used. Returns the TD error delta of (1). */
float lh_learner_learn(lh_learner *learner, const float *states, int32_t action, float reward, float next_q_max,
                       bool terminal);

#ifdef __cplusplus
}
#endif
#endif
