/* Q-learning (1)(2) on the RBF network, with Boltzmann selection (3). */
#ifndef LIMPHOME_Q_LEARNING_H
#define LIMPHOME_Q_LEARNING_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/base/random.h"
#include "limphome/learning/action_values.h"
#include "limphome/learning/choice.h"
#include "limphome/learning/network.h"
#include "limphome/task/task.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Ranges of lh_q_learning_config, from 0; for the temperature floor see boltzmann.h. */
#define LH_LEARNING_RATE_MAX 1.0f

typedef struct lh_q_learning_config {
    float learning_rate;       /* alpha of (2), 0 to LH_LEARNING_RATE_MAX; paper: 0.1 */
    float discount_rate;       /* gamma of (1), 0 to LH_DISCOUNT_RATE_MAX; paper: 0.9 */
    float temperature_floor;   /* least T of (4), LH_TEMPERATURE_FLOOR_MIN to _MAX; default 0.01 */
    lh_network_config network; /* inputs = state inputs + controlled actuators; lh_learner_init sets it */
} lh_q_learning_config;

typedef struct lh_q_learning {
    lh_q_learning_config config;
    int32_t num_states;  /* state inputs of the network */
    int32_t num_actions; /* joint actions, 3^n */
    lh_network network;
    lh_random random;
    lh_held held;     /* network parameters held at a limit so far */
    uint64_t floored; /* choices with the temperature at its floor so far */
    /* the step under way */
    int32_t acting; /* 1: an action was chosen and its result is awaited; else 0 */
    int32_t action;
    float states[LH_MAX_STATE_INPUTS]; /* state inputs where it was chosen */
    /* overwritten by each decision */
    float q_max;             /* the largest of q */
    float q[LH_MAX_ACTIONS]; /* Q(s, a) of the newest state [num_actions] */
    lh_action_scratch scratch;
} lh_q_learning;

/* All that a later run needs to go on as if unbroken from where a reset was asked for. */
typedef struct lh_q_learned {
    lh_network network;
    lh_random random;
    lh_held held;     /* as in lh_q_learning */
    uint64_t floored; /* as in lh_q_learning */
} lh_q_learned;

/* alpha 0.1, gamma 0.9, temperature floor 0.01, and the network's default. */
lh_q_learning_config lh_q_learning_config_default(void);
lh_error lh_q_learning_config_validate(const lh_q_learning_config *config);

/* `num_controlled` actuators (1 to LH_MAX_ACTUATORS) give 3^num_controlled actions; config->network.inputs must be
 * num_states + num_controlled. Centres are drawn from `seed`, and the same generator goes on to select actions. On an
 * error nothing is changed. */
lh_error lh_q_learning_init(lh_q_learning *learner, const lh_q_learning_config *config, int32_t num_states,
                            int32_t num_controlled, uint64_t seed);

/* Forgets the step under way. */
void lh_q_learning_begin(lh_q_learning *learner);

/* One decision: learns from the step that led here, if `learn`, and then chooses, by (3) or, if `greedy`, a best
 * action. Learning, max over a of Q(s, a) in (1) is that of the network before it learns; the choice is made by the
 * network after. A time limit is no property of the task, so it does not end the bootstrap of (1). */
void lh_q_learning_step(lh_q_learning *learner, const lh_observed *observed, bool learn, bool greedy,
                        lh_choice *choice);

/* Another action than the one just chosen is executed: (1) is then about Q(s, action). */
void lh_q_learning_executed(lh_q_learning *learner, int32_t action);

/* T of (4) in `episode`, from 1, but not below its floor. */
float lh_q_learning_temperature(const lh_q_learning *learner, int32_t episode);

void lh_q_learning_save(const lh_q_learning *learner, lh_q_learned *learned);

/* LH_ERROR_NETWORK or LH_ERROR_RANDOM_STATE, and nothing changed, if what was saved does not fit or is out of range. */
lh_error lh_q_learning_restore(lh_q_learning *learner, const lh_q_learned *learned);

/* What a step is made of.
 *
 * Computes Q(s, a) of all joint actions into learner->q for the state inputs states[num_states], each in [0, 1].
 * Returns the largest. */
float lh_q_learning_evaluate(lh_q_learning *learner, const float *states);

/* Chooses among learner->q: by (3) at `temperature`, or a largest one if `greedy` (then no random number is used).
 * Fills the second part of *choice. */
void lh_q_learning_choose(lh_q_learning *learner, float temperature, bool greedy, lh_choice *choice);

/* Learns from one step: Q(states, action) moves towards reward + gamma * next_q_max by (1), (2), (19)-(21).
 * `terminal`: there is no next state and next_q_max is not used. Returns the TD error delta of (1). */
float lh_q_learning_learn(lh_q_learning *learner, const float *states, int32_t action, float reward, float next_q_max,
                          bool terminal);

#ifdef __cplusplus
}
#endif
#endif
