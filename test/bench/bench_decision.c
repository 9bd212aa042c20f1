/* Times one decision in several ways, interleaved, and prints a line for each: name, median processor time per decision
 * [s], share of the decisions that took the action the library takes. */
#include <stdio.h>
#include <stdlib.h>

#include "decision.h"
#include "limphome/task/action.h"
#include "timing.h"

enum { ROUNDS = 15, CHECKED = 200 };

static void pose(problem *p, int32_t num_controlled) {
    lh_q_learning_config config = lh_q_learning_config_default();
    p->num_controlled = num_controlled;
    p->num_states = num_controlled + 2;
    config.network.units = UNITS;
    config.network.inputs = p->num_states + num_controlled;
    if (lh_q_learning_init(&p->learner, &config, p->num_states, num_controlled, 1) != LH_OK) {
        abort();
    }
    lh_random *random = &p->learner.random;
    for (int32_t j = 0; j < UNITS; j++) {
        p->learner.network.weight[j] = 2.0f * lh_random_uniform(random) - 1.0f;
        p->learner.network.width[j] = 0.7f + 0.6f * lh_random_uniform(random);
    }
    for (int32_t k = 0; k < SITUATIONS; k++) {
        for (int32_t i = 0; i < p->num_states; i++) {
            p->states[k][i] = lh_random_uniform(random);
        }
    }
}

static double seconds_per_decision(const method *m, const problem *p, int32_t count) {
    m->begin(p);
    const double start = timing_now(CLOCK_PROCESS_CPUTIME_ID);
    for (int32_t k = 0; k < count; k++) {
        m->decide(k);
    }
    return (timing_now(CLOCK_PROCESS_CPUTIME_ID) - start) / count;
}

/* All ways must make the same decisions, but for ties that rounding turns. */
static int32_t agreement(const method *m, const problem *p) {
    static int32_t expected[CHECKED];
    library_method.begin(p);
    for (int32_t k = 0; k < CHECKED; k++) {
        expected[k] = library_method.decide(k);
    }
    m->begin(p);
    int32_t same = 0;
    for (int32_t k = 0; k < CHECKED; k++) {
        same += m->decide(k) == expected[k];
    }
    return same;
}

int main(void) {
    static problem four, seven; /* actuators */
    pose(&four, 4);
    pose(&seven, 7);
    const struct {
        const char *title;
        const method *method;
        const problem *problem;
        int32_t count;
    } runs[] = {
        {"limphome", &library_method, &four, 8000},         {"plain_single", &plain_float_method, &four, 400},
        {"plain_double", &plain_double_method, &four, 400}, {"eigen", &eigen_method, &four, 1000},
        {"limphome_two_arm", &library_method, &seven, 500},
    };
    enum { RUNS = sizeof runs / sizeof *runs };
    static double seconds[RUNS][ROUNDS];
    for (int round = -1; round < ROUNDS; round++) { /* the first warms up */
        for (int r = 0; r < RUNS; r++) {
            const double measured = seconds_per_decision(runs[r].method, runs[r].problem, runs[r].count);
            seconds[r][round < 0 ? 0 : round] = measured;
        }
    }
    for (int r = 0; r < RUNS; r++) {
        printf("%s %.4g %.3f\n", runs[r].title, timing_median(seconds[r], ROUNDS),
               (double)agreement(runs[r].method, runs[r].problem) / CHECKED);
    }
    return EXIT_SUCCESS;
}
