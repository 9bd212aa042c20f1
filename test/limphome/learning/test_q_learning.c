#include "limphome/learning/q_learning.h"

#include <stddef.h>

#include "limphome/learning/boltzmann.h"
#include "limphome/task/action.h"
#include "reference.h"
#include "test.h"

static lh_q_learning learner; /* 37 KiB, too much for some stacks */

static lh_q_learning_config reference_config(void) {
    lh_q_learning_config config = lh_q_learning_config_default();
    config.learning_rate = 0.5f;
    config.network.units = LEARNER_UNITS;
    config.network.inputs = LEARNER_STATES + LEARNER_CONTROLLED;
    config.network.initial_weight = 0.5f;
    config.network.exact_gradient = false; /* reference.py goes by the printed equations */
    return config;
}

START_TEST(defaults_are_those_of_table_2) {
    const lh_q_learning_config config = lh_q_learning_config_default();
    ck_assert_float_eq(config.learning_rate, 0.1f);
    ck_assert_float_eq(config.discount_rate, 0.9f);
    ck_assert_int_eq(lh_q_learning_config_validate(&config), LH_OK);
}
END_TEST

START_TEST(bad_fields_are_named) {
    const float bad[] = {-0.01f, 1.01f, NAN};
    for (int32_t k = 0; k < COUNT(bad); k++) {
        lh_q_learning_config config = lh_q_learning_config_default();
        config.learning_rate = bad[k];
        ck_assert_int_eq(lh_q_learning_config_validate(&config), LH_ERROR_RATE);
        config = lh_q_learning_config_default();
        config.discount_rate = bad[k];
        ck_assert_int_eq(lh_q_learning_config_validate(&config), LH_ERROR_RATE);
    }
    lh_q_learning_config config = lh_q_learning_config_default();
    config.network.units = 0;
    ck_assert_int_eq(lh_q_learning_config_validate(&config), LH_ERROR_UNITS);
    config = lh_q_learning_config_default();
    config.temperature_floor = 0.0f;
    ck_assert_int_eq(lh_q_learning_config_validate(&config), LH_ERROR_LIMIT);
}
END_TEST

START_TEST(sizes_must_go_together) {
    lh_q_learning_config config = reference_config();
    memset(&learner, 0x5a, sizeof learner);
    const lh_q_learning before = learner;
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, 3, 0, 1), LH_ERROR_ACTUATORS);
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, 3, LH_MAX_ACTUATORS + 1, 1), LH_ERROR_ACTUATORS);
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, 2, 2, 1), LH_ERROR_INPUTS);
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, -1, 6, 1), LH_ERROR_INPUTS);
    config.network.inputs = 2; /* actions alone are enough */
    static lh_q_learning stateless;
    ck_assert_int_eq(lh_q_learning_init(&stateless, &config, 0, 2, 1), LH_OK);
    config.network.inputs = LH_MAX_STATE_INPUTS + 2; /* for too many states of one actuator */
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, LH_MAX_STATE_INPUTS + 1, 1, 1), LH_ERROR_INPUTS);
    config.network.rate_width = -1.0f;
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, 3, 2, 1), LH_ERROR_RATE);
    ck_assert_mem_eq(&learner, &before, sizeof learner);
}
END_TEST

static float between(float low, float high) {
    return low + (high - low) * lh_random_uniform(&learner.random);
}

/* A network as training could leave it, for n actuators, with widths from `narrow` to `wide`; fills states[n + 2]. */
static void make_random_network(int32_t n, uint64_t seed, float narrow, float wide, float *states) {
    lh_q_learning_config config = lh_q_learning_config_default();
    config.network.inputs = 2 * n + 2;
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, n + 2, n, seed), LH_OK);
    for (int32_t i = 0; i < n + 2; i++) {
        states[i] = between(0.0f, 1.0f);
    }
    for (int32_t j = 0; j < config.network.units; j++) {
        learner.network.weight[j] = between(-10.0f, 10.0f);
        learner.network.width[j] = between(narrow, wide);
        for (int32_t i = 0; i < 2 * n + 2; i++) {
            learner.network.centre[i][j] = between(-0.2f, 1.2f);
        }
    }
}

/* y of (13) by the plain loop in double precision. *scale is the sum of |w_j phi_j|; *spread the same with each term
 * times 1 + the exponent of phi_j, whose rounding in single precision changes phi_j by so much. */
static double plain_value(const lh_network *network, const float *x, double *scale, double *spread) {
    double y = 0.0;
    *scale = *spread = 0.0;
    for (int32_t j = 0; j < network->units; j++) {
        double distance = 0.0;
        for (int32_t i = 0; i < network->inputs; i++) {
            distance += pow((double)x[i] - (double)network->centre[i][j], 2.0);
        }
        const double exponent = distance / pow(network->width[j], 2.0);
        const double term = network->weight[j] * exp(-exponent);
        y += term;
        *scale += fabs(term);
        *spread += fabs(term) * (1.0 + exponent);
    }
    return y;
}

/* The largest error of Q(s, a) over all joint actions, relative to the scale or to the spread. */
static double worst_error(int32_t n, const float *states, bool by_spread) {
    const float q_max = lh_q_learning_evaluate(&learner, states);
    double worst = 0.0;
    float largest = learner.q[0];
    for (int32_t a = 0; a < learner.num_actions; a++) {
        float x[LH_MAX_INPUTS];
        int8_t levels[LH_MAX_ACTUATORS];
        memcpy(x, states, sizeof *states * (size_t)(n + 2));
        lh_action_levels(a, n, levels);
        for (int32_t k = 0; k < n; k++) {
            x[n + 2 + k] = lh_action_input(levels[k]);
        }
        double scale;
        double spread;
        const double error = fabs(learner.q[a] - plain_value(&learner.network, x, &scale, &spread));
        worst = fmax(worst, error / fmax(by_spread ? spread : scale, 1e-30));
        largest = learner.q[a] > largest ? learner.q[a] : largest;
    }
    ck_assert_int_eq(learner.num_actions, lh_action_count(n));
    ck_assert_float_eq(q_max, largest);
    return worst;
}

START_TEST(evaluation_is_that_of_the_plain_loop) {
    for (int32_t n = 1; n <= LH_MAX_ACTUATORS; n++) {
        for (uint64_t seed = 1; seed <= (n < 6 ? 100 : 3); seed++) {
            float states[LH_MAX_STATE_INPUTS];
            make_random_network(n, seed, 0.7f, 2.0f, states);
            ck_assert_double_le(worst_error(n, states, false), 1e-6);
        }
    }
}
END_TEST

/* Narrow units reach far down, where the exponents are large and their rounding counts; wide ones hardly differ. */
START_TEST(evaluation_with_extreme_widths) {
    const float width[][2] = {{0.05f, 0.1f}, {0.05f, 0.7f}, {2.0f, LH_WIDTH_LIMIT}};
    for (int32_t k = 0; k < COUNT(width); k++) {
        for (uint64_t seed = 1; seed <= 100; seed++) {
            float states[LH_MAX_STATE_INPUTS];
            make_random_network(4, seed, width[k][0], width[k][1], states);
            ck_assert_double_le(worst_error(4, states, true), 1e-6);
        }
    }
}
END_TEST

START_TEST(td_error_by_hand) {
    /* one unit at the inputs, so that phi = 1 and y = w */
    lh_q_learning_config config = lh_q_learning_config_default();
    config.network.units = 1;
    config.network.inputs = 2;
    config.network.initial_weight = 2.0f;
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, 1, 1, 1), LH_OK);
    learner.network.centre[0][0] = 0.25f;
    learner.network.centre[1][0] = 0.5f;
    const float states[] = {0.25f};
    /* action 1 is level 1 is input 0.5; delta = 1 + 0.9 * 3 - 2 */
    expect_near(lh_q_learning_learn(&learner, states, 1, 1.0f, 3.0f, false), 1.7, 1e-6);
    /* w grows by alpha_w alpha delta */
    expect_near(learner.network.weight[0], 2.0 + 0.1 * 0.1 * 1.7, 5e-7);
    ck_assert_float_eq(learner.network.width[0], 1.0f);
    ck_assert_float_eq(learner.network.centre[0][0], 0.25f);

    learner.network.weight[0] = 2.0f;
    /* terminal: delta = 1 - 2, whatever the next state promises */
    expect_near(lh_q_learning_learn(&learner, states, 1, 1.0f, 3.0f, true), -1.0, 1e-6);
    learner.network.weight[0] = 2.0f;
    expect_near(lh_q_learning_learn(&learner, states, 1, 1.0f, NAN, true), -1.0, 1e-6);
    ck_assert_uint_eq(learner.held.weights + learner.held.widths + learner.held.centres, 0);
}
END_TEST

START_TEST(sequence_against_reference) {
    const lh_q_learning_config config = reference_config();
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, LEARNER_STATES, LEARNER_CONTROLLED, 7), LH_OK);
    for (int32_t k = 0; k < LEARNER_STEPS; k++) {
        const float q_max = lh_q_learning_evaluate(&learner, learner_state[k + 1]);
        expect_near(q_max, learner_q_max[k], 1e-5);
        const float td_error = lh_q_learning_learn(&learner, learner_state[k], learner_action[k], learner_reward[k],
                                                   q_max, learner_terminal[k] != 0);
        expect_near(td_error, learner_td_error[k], 2e-5);
    }
    for (int32_t j = 0; j < LEARNER_UNITS; j++) {
        expect_near(learner.network.weight[j], learner_weight[j], 5e-6);
    }
    ck_assert_uint_eq(learner.held.weights + learner.held.widths + learner.held.centres, 0);
}
END_TEST

START_TEST(non_finite_reward_is_not_learned) {
    const lh_q_learning_config config = reference_config();
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, LEARNER_STATES, LEARNER_CONTROLLED, 7), LH_OK);
    const lh_network before = learner.network;
    lh_q_learning_learn(&learner, learner_state[0], 0, NAN, 0.0f, false);
    ck_assert_mem_eq(&learner.network, &before, sizeof before);
    ck_assert_uint_eq(learner.held.weights, LEARNER_UNITS);
    ck_assert_uint_eq(learner.held.widths, LEARNER_UNITS);
    ck_assert_uint_eq(learner.held.centres, LEARNER_UNITS * (uint64_t)config.network.inputs);
    lh_q_learning_learn(&learner, learner_state[0], 0, NAN, 0.0f, false); /* they add up */
    ck_assert_uint_eq(learner.held.weights, UINT64_C(2) * LEARNER_UNITS);
    ck_assert_uint_eq(learner.held.widths, UINT64_C(2) * LEARNER_UNITS);
    ck_assert_uint_eq(learner.held.centres, UINT64_C(2) * LEARNER_UNITS * (uint64_t)config.network.inputs);
}
END_TEST

START_TEST(choice_is_greedy_or_by_probability) {
    const lh_q_learning_config config = reference_config();
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, LEARNER_STATES, LEARNER_CONTROLLED, 7), LH_OK);
    learner.network.weight[0] = 3.0f;
    const float q_max = lh_q_learning_evaluate(&learner, learner_state[0]);

    const lh_random before = learner.random;
    lh_choice greedy;
    lh_q_learning_choose(&learner, 1.0f, true, &greedy);
    ck_assert_mem_eq(&learner.random, &before, sizeof before);
    ck_assert_float_eq(greedy.q, q_max);
    ck_assert_float_eq(greedy.q_max, q_max);
    ck_assert_float_eq(greedy.probability, 1.0f);
    ck_assert_int_eq(greedy.action, lh_boltzmann_greedy(learner.q, 9));

    int32_t others = 0;
    for (int32_t i = 0; i < 100; i++) {
        lh_choice choice;
        lh_q_learning_choose(&learner, 1.0f, false, &choice);
        ck_assert_float_eq(choice.q, learner.q[choice.action]);
        ck_assert_float_eq(choice.q_max, q_max);
        ck_assert_float_eq(choice.probability, lh_boltzmann_probability(learner.q, 9, 1.0f, choice.action));
        others += choice.action != greedy.action;
    }
    ck_assert_int_gt(others, 0);
}
END_TEST

/* Two states, three actions: forward (2) leads from state 0 to state 1 for nothing, and from state 1 to the end for 1;
 * reverse (0) and still (1) stay where they are for nothing. The optimum: Q(1, 2) = 1, Q(0, 2) = gamma,
 * Q(1, 0) = gamma, Q(0, 0) = gamma^2. */
START_TEST(converges_on_two_states) {
    lh_q_learning_config config = lh_q_learning_config_default();
    config.learning_rate = 1.0f;
    config.discount_rate = 0.5f;
    config.network.units = 30;
    config.network.inputs = 2;
    config.network.initial_width = 0.3f;
    config.network.exact_gradient = true;
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, 1, 1, 5), LH_OK);
    const float states[][1] = {{0.0f}, {1.0f}};
    lh_random random;
    lh_random_init(&random, 99);
    for (int32_t i = 0; i < 20000; i++) {
        const int32_t state = (int32_t)(lh_random_next(&random) >> 31);
        const int32_t action = (int32_t)(lh_random_next(&random) % 3);
        const bool forward = action == 2;
        const bool terminal = forward && state == 1;
        const int32_t next = forward ? 1 : state;
        const float q_max = lh_q_learning_evaluate(&learner, states[next]);
        lh_q_learning_learn(&learner, states[state], action, terminal ? 1.0f : 0.0f, q_max, terminal);
    }
    lh_q_learning_evaluate(&learner, states[0]);
    expect_near(learner.q[0], 0.25, 0.02);
    expect_near(learner.q[1], 0.25, 0.02);
    expect_near(learner.q[2], 0.5, 0.02);
    lh_q_learning_evaluate(&learner, states[1]);
    expect_near(learner.q[0], 0.5, 0.02);
    expect_near(learner.q[1], 0.5, 0.02);
    expect_near(learner.q[2], 1.0, 0.02);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("q_learning");
    TCase *t = tcase_create("configuration");
    tcase_add_test(t, defaults_are_those_of_table_2);
    tcase_add_test(t, bad_fields_are_named);
    tcase_add_test(t, sizes_must_go_together);
    suite_add_tcase(s, t);
    t = tcase_create("Q-learning (1)(2)");
    tcase_add_test(t, evaluation_is_that_of_the_plain_loop);
    tcase_add_test(t, evaluation_with_extreme_widths);
    tcase_add_test(t, td_error_by_hand);
    tcase_add_test(t, sequence_against_reference);
    tcase_add_test(t, non_finite_reward_is_not_learned);
    tcase_add_test(t, choice_is_greedy_or_by_probability);
    tcase_add_test(t, converges_on_two_states);
    suite_add_tcase(s, t);
    return s;
}
