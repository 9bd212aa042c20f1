/* The library's own way. */
#include "decision.h"

static lh_q_learning learner;
static const problem *given;
static int32_t action;

static void begin(const problem *p) {
    given = p;
    learner = p->learner;
    action = 0;
}

static int32_t decide(int32_t k) {
    const float *before = given->states[(k + SITUATIONS - 1) % SITUATIONS];
    float q_max = lh_q_learning_evaluate(&learner, given->states[k % SITUATIONS]);
    lh_choice choice;
    lh_q_learning_choose(&learner, TEMPERATURE, false, &choice);
    lh_q_learning_learn(&learner, before, action, reward_of(k), q_max, false);
    action = choice.action;
    return action;
}

const method library_method = {begin, decide};
