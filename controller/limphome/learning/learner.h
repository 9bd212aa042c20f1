/* The learner: takes what was observed, answers with a choice. Each kind orders learning and choosing itself.
 *
 * Another kind is a pair of files like q_learning, and a line each where the kinds are listed here and switched over in
 * learner.c. */
#ifndef LIMPHOME_LEARNER_H
#define LIMPHOME_LEARNER_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/learning/choice.h"
#include "limphome/learning/planner.h"
#include "limphome/learning/q_learning.h"
#include "limphome/task/task.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lh_learner_kind {
    LH_Q_LEARNING = 0, /* the paper's */
    LH_PLANNER = 1,    /* plans on a motion model that it measures */
} lh_learner_kind;

typedef struct lh_learner_config {
    lh_learner_kind kind;
    uint64_t seed; /* of all random numbers */
    bool learn;    /* false: what was learned stays as it is */
    bool greedy;   /* true: always a best action, without exploration */
    lh_q_learning_config q_learning;
    lh_planner_config planner;
} lh_learner_config;

typedef struct lh_learner {
    lh_learner_kind kind;
    bool learn;  /* as in the configuration; may be changed between two steps */
    bool greedy; /* likewise */
    union {
        lh_q_learning q_learning;
        lh_planner planner;
    } as; /* by kind */
} lh_learner;

/* What was learned so far and the state of the random numbers: all that a later run needs. */
typedef struct lh_learned {
    lh_learner_kind kind;
    union {
        lh_q_learned q_learning;
        lh_planner_learned planner;
    } as; /* by kind */
} lh_learned;

/* Q-learning, learning, with Boltzmann selection, seed 1; every kind at its own defaults. */
lh_learner_config lh_learner_config_default(void);

/* LH_OK, LH_ERROR_LEARNER for an unknown kind, or the error of the first bad field of that kind. */
lh_error lh_learner_config_validate(const lh_learner_config *config);

/* A learner that knows nothing, for the actuators that `task` controls. On an error nothing is changed. */
lh_error lh_learner_init(lh_learner *learner, const lh_learner_config *config, const lh_task *task);

/* Where a session begins or the robot was put elsewhere: the step under way is forgotten. */
void lh_learner_begin(lh_learner *learner);

/* One decision, on what lh_task_observe has told: fills *choice. With observed->reset nothing is chosen; call
 * lh_learner_begin before the next step. */
void lh_learner_step(lh_learner *learner, const lh_observed *observed, lh_choice *choice);

/* Joints nearer than `clearance` [rad] to a stop are not driven towards it by whoever executes: what plans need not
 * reckon with it. */
void lh_learner_keep_clear(lh_learner *learner, float clearance);

/* Another action than the one just chosen is executed: what follows is learned of that one. */
void lh_learner_executed(lh_learner *learner, int32_t action);

/* Temperature of exploration in `episode`, from 1: T of (4) for Q-learning; 0 for a planner, which
 * has none. */
float lh_learner_temperature(const lh_learner *learner, int32_t episode);

void lh_learner_save(const lh_learner *learner, lh_learned *learned);

/* Goes on from what was saved. LH_ERROR_LEARNER for that of another kind, or the kind's own error; then nothing is
 * changed. */
lh_error lh_learner_restore(lh_learner *learner, const lh_learned *learned);

#ifdef __cplusplus
}
#endif
#endif
