/* The straightforward loop over (13)(14), (3) and (19)-(21) as the exact gradient, with libm. Compiled with REAL float
 * and double. */
#include <tgmath.h>

#include "decision.h"

static struct {
    REAL weight[UNITS];
    REAL width[UNITS];
    REAL centre[UNITS][LH_MAX_INPUTS];
} network;

static const problem *given;
static lh_random generator;
static int32_t num_inputs;
static int32_t num_actions;
static int32_t last_action;
static REAL q[LH_MAX_ACTIONS];

static void begin(const problem *p) {
    given = p;
    generator = p->learner.random;
    num_inputs = p->num_states + p->num_controlled;
    num_actions = p->learner.num_actions;
    last_action = 0;
    for (int32_t j = 0; j < UNITS; j++) {
        network.weight[j] = (REAL)p->learner.network.weight[j];
        network.width[j] = (REAL)p->learner.network.width[j];
        for (int32_t i = 0; i < num_inputs; i++) {
            network.centre[j][i] = (REAL)p->learner.network.centre[i][j];
        }
    }
}

static void fill_inputs(int32_t k, int32_t action, REAL *x) {
    for (int32_t i = 0; i < given->num_states; i++) {
        x[i] = (REAL)given->states[k % SITUATIONS][i];
    }
    for (int32_t i = given->num_states; i < num_inputs; i++) {
        x[i] = (REAL)0.5 * (REAL)(action % 3);
        action /= 3;
    }
}

static REAL squared_distance(const REAL *x, int32_t j) {
    REAL sum = 0;
    for (int32_t i = 0; i < num_inputs; i++) { /* NOLINTNEXTLINE(clang-analyzer-core.*): fill_inputs set as many */
        REAL difference = x[i] - network.centre[j][i];
        sum += difference * difference;
    }
    return sum;
}

static REAL value(const REAL *x) {
    REAL y = 0;
    for (int32_t j = 0; j < UNITS; j++) {
        REAL width = network.width[j];
        y += network.weight[j] * exp(-squared_distance(x, j) / (width * width));
    }
    return y;
}

static REAL evaluate_all(int32_t k) {
    REAL largest = -INFINITY;
    for (int32_t a = 0; a < num_actions; a++) {
        REAL x[LH_MAX_INPUTS];
        fill_inputs(k, a, x);
        q[a] = value(x);
        largest = q[a] > largest ? q[a] : largest;
    }
    return largest;
}

static int32_t choose(REAL q_max) {
    static REAL weight[LH_MAX_ACTIONS];
    REAL total = 0;
    for (int32_t a = 0; a < num_actions; a++) {
        weight[a] = exp((q[a] - q_max) / (REAL)TEMPERATURE);
        total += weight[a];
    }
    REAL target = (REAL)lh_random_uniform(&generator) * total;
    int32_t chosen = 0;
    for (REAL sum = weight[0]; sum <= target && chosen + 1 < num_actions; sum += weight[chosen]) {
        chosen++;
    }
    return chosen;
}

static void learn(const REAL *x, REAL target) {
    const lh_network_config *rates = &given->learner.config.network;
    REAL alpha = (REAL)given->learner.config.learning_rate;
    REAL step = alpha * (target - value(x));
    for (int32_t j = 0; j < UNITS; j++) {
        REAL weight = network.weight[j];
        REAL width = network.width[j];
        REAL distance = squared_distance(x, j);
        REAL phi = exp(-distance / (width * width));
        REAL pull = 2 * step * weight * phi / (width * width);
        network.weight[j] += (REAL)rates->rate_weight * step * phi;
        network.width[j] += (REAL)rates->rate_width * pull * distance / width;
        for (int32_t i = 0; i < num_inputs; i++) { /* NOLINTNEXTLINE(clang-analyzer-core.*): as above */
            network.centre[j][i] += (REAL)rates->rate_centre * pull * (x[i] - network.centre[j][i]);
        }
    }
}

static int32_t decide(int32_t k) {
    REAL q_max = evaluate_all(k);
    int32_t action = choose(q_max);
    REAL x[LH_MAX_INPUTS];
    fill_inputs(k + SITUATIONS - 1, last_action, x);
    learn(x, (REAL)reward_of(k) + (REAL)given->learner.config.discount_rate * q_max);
    last_action = action;
    return action;
}

const method METHOD = {begin, decide};
