#include "limphome/learning/network.h"

#include <float.h>
#include <stddef.h>

#include "reference.h"
#include "test.h"

static lh_network_config reference_config(void) {
    lh_network_config config = lh_network_config_default();
    config.units = NETWORK_UNITS;
    config.inputs = NETWORK_INPUTS;
    return config;
}

static lh_network reference_network(void) {
    lh_network network = {.units = NETWORK_UNITS, .inputs = NETWORK_INPUTS};
    memcpy(network.weight, network_weight, sizeof network_weight);
    memcpy(network.width, network_width, sizeof network_width);
    for (int32_t j = 0; j < NETWORK_UNITS; j++) {
        for (int32_t i = 0; i < NETWORK_INPUTS; i++) {
            network.centre[i][j] = network_centre[j][i];
        }
    }
    return network;
}

static float value(const lh_network *network, const float *x) {
    lh_activation at;
    return lh_network_value(network, x, &at);
}

static lh_held learn(lh_network *network, const lh_network_config *config, const float *x, float learning_rate,
                     float td_error) {
    lh_activation at;
    lh_network_value(network, x, &at);
    return lh_network_learn(network, config, x, &at, learning_rate, td_error);
}

static void expect_held(lh_held held, uint64_t weights, uint64_t widths, uint64_t centres) {
    ck_assert_uint_eq(held.weights, weights);
    ck_assert_uint_eq(held.widths, widths);
    ck_assert_uint_eq(held.centres, centres);
}

START_TEST(defaults_are_those_of_table_2) {
    const lh_network_config config = lh_network_config_default();
    ck_assert_int_eq(config.units, 50);
    ck_assert_int_eq(config.inputs, 10);
    ck_assert_float_eq(config.rate_weight, 0.1f);
    ck_assert_float_eq(config.rate_width, 0.01f);
    ck_assert_float_eq(config.rate_centre, 0.1f);
    ck_assert_float_eq(config.initial_weight, 0.0f);
    ck_assert_float_eq(config.initial_width, 1.0f);
    ck_assert(config.exact_gradient);
    ck_assert_int_eq(lh_network_config_validate(&config), LH_OK);
}
END_TEST

/* Every field just outside its range, and NaN. */
START_TEST(bad_fields_are_named) {
#define BAD(field, value, error)                                              \
    do {                                                                      \
        lh_network_config config = lh_network_config_default();               \
        config.field = value;                                                 \
        ck_assert_int_eq(lh_network_config_validate(&config), error);         \
        lh_network network;                                                   \
        memset(&network, 0x5a, sizeof network);                               \
        const lh_network before = network;                                    \
        lh_random random = {{1, 2, 3, 4}};                                    \
        ck_assert_int_eq(lh_network_init(&network, &config, &random), error); \
        ck_assert_mem_eq(&network, &before, sizeof network);                  \
        ck_assert_uint_eq(random.s[0], 1);                                    \
    } while (0)
    BAD(units, 0, LH_ERROR_UNITS);
    BAD(units, LH_MAX_UNITS + 1, LH_ERROR_UNITS);
    BAD(inputs, 0, LH_ERROR_INPUTS);
    BAD(inputs, LH_MAX_INPUTS + 1, LH_ERROR_INPUTS);
    BAD(rate_weight, -0.1f, LH_ERROR_RATE);
    BAD(rate_weight, NAN, LH_ERROR_RATE);
    BAD(rate_width, 10.1f, LH_ERROR_RATE);
    BAD(rate_centre, INFINITY, LH_ERROR_RATE);
    BAD(initial_weight, 10001.0f, LH_ERROR_INITIAL);
    BAD(initial_weight, NAN, LH_ERROR_INITIAL);
    BAD(initial_width, 0.049f, LH_ERROR_INITIAL);
    BAD(initial_width, 101.0f, LH_ERROR_INITIAL);
    BAD(width_floor, 0.0099f, LH_ERROR_LIMIT);
    BAD(width_floor, 1.1f, LH_ERROR_LIMIT);
    BAD(weight_limit, 0.9f, LH_ERROR_LIMIT);
    BAD(weight_limit, NAN, LH_ERROR_LIMIT);
#undef BAD
}
END_TEST

START_TEST(initial_values) {
    lh_network_config config = lh_network_config_default();
    config.initial_weight = -0.25f;
    lh_random random;
    lh_random_init(&random, 8);
    lh_random same = random;
    lh_network network;
    ck_assert_int_eq(lh_network_init(&network, &config, &random), LH_OK);
    ck_assert_int_eq(lh_network_validate(&network, &config), LH_OK);
    for (int32_t j = 0; j < LH_MAX_UNITS; j++) {
        ck_assert_float_eq(network.weight[j], j < 50 ? -0.25f : 0.0f);
        ck_assert_float_eq(network.width[j], j < 50 ? 1.0f : 0.0f);
        for (int32_t i = 0; i < LH_MAX_INPUTS; i++) {
            const float expected = j < 50 && i < 10 ? lh_random_uniform(&same) : 0.0f;
            ck_assert_float_eq(network.centre[i][j], expected);
        }
    }
    ck_assert_mem_eq(&random, &same, sizeof random);
}
END_TEST

START_TEST(value_against_reference) {
    const lh_network network = reference_network();
    for (int32_t k = 0; k < COUNT(network_x); k++) {
        lh_activation at;
        expect_near(lh_network_value(&network, network_x[k], &at), network_y[k], 3e-6);
        for (int32_t j = 0; j < LH_UNIT_SLOTS; j++) {
            expect_near(at.phi[j], j < NETWORK_UNITS ? network_phi[k][j] : 0.0, 5e-7);
        }
    }
}
END_TEST

/* A step changes a parameter by far less than its size, so it is the change that is compared. */
static void expect_change(float actual, double expected, float before, double scale) {
    expect_near((double)actual - before, expected - before, 2e-7 * (fabs(before) + 1.0) + 1e-5 * scale);
}

static void expect_learned(bool exact, const double (*weight)[NETWORK_UNITS], const double (*width)[NETWORK_UNITS],
                           const double (*centre)[NETWORK_UNITS][NETWORK_INPUTS]) {
    lh_network_config config = reference_config();
    config.exact_gradient = exact;
    const lh_network before = reference_network();
    for (int32_t k = 0; k < COUNT(network_x); k++) {
        lh_network network = before;
        expect_held(learn(&network, &config, network_x[k], learn_alpha[k], learn_delta[k]), 0, 0, 0);
        for (int32_t j = 0; j < NETWORK_UNITS; j++) {
            expect_change(network.weight[j], weight[k][j], before.weight[j], fabs(weight[k][j] - before.weight[j]));
            expect_change(network.width[j], width[k][j], before.width[j], fabs(width[k][j] - before.width[j]));
            for (int32_t i = 0; i < NETWORK_INPUTS; i++) {
                const float old = before.centre[i][j];
                expect_change(network.centre[i][j], centre[k][j][i], old, fabs(centre[k][j][i] - old));
            }
        }
    }
}

START_TEST(printed_rule_against_reference) {
    expect_learned(false, printed_weight, printed_width, printed_centre);
}
END_TEST

START_TEST(exact_gradient_against_finite_differences) {
    expect_learned(true, exact_weight, exact_width, exact_centre);
}
END_TEST

START_TEST(learning_moves_the_value_towards_the_target) {
    lh_network_config config = reference_config();
    config.exact_gradient = true;
    lh_network network = reference_network();
    const float before = value(&network, network_x[0]);
    learn(&network, &config, network_x[0], 0.1f, 1.0f);
    ck_assert_float_gt(value(&network, network_x[0]), before);
    network = reference_network();
    learn(&network, &config, network_x[0], 0.1f, -1.0f);
    ck_assert_float_lt(value(&network, network_x[0]), before);
}
END_TEST

START_TEST(width_stops_at_its_floor) {
    lh_network_config config = reference_config();
    config.rate_width = 10.0f;
    lh_network network = reference_network();
    /* a negative error narrows the units of positive weight and widens the others */
    const lh_held held = learn(&network, &config, network_x[0], 1.0f, -1000.0f);
    uint64_t at_floor = 0, at_limit = 0;
    for (int32_t j = 0; j < NETWORK_UNITS; j++) {
        ck_assert_float_ge(network.width[j], config.width_floor);
        ck_assert_float_le(network.width[j], LH_WIDTH_LIMIT);
        at_floor += network.width[j] == config.width_floor;
        at_limit += network.width[j] == LH_WIDTH_LIMIT;
    }
    ck_assert_uint_gt(at_floor, 0);
    ck_assert_uint_eq(held.widths, at_floor + at_limit);
    ck_assert_int_eq(lh_network_validate(&network, &config), LH_OK);
    ck_assert(isfinite(value(&network, network_x[0])));
}
END_TEST

START_TEST(weight_stops_at_its_limit) {
    lh_network_config config = reference_config();
    config.rate_width = config.rate_centre = 0.0f;
    config.weight_limit = 20.0f;
    lh_network network = reference_network();
    expect_held(learn(&network, &config, network_x[0], 1.0f, 1e6f), NETWORK_UNITS, 0, 0);
    for (int32_t j = 0; j < NETWORK_UNITS; j++) {
        ck_assert_float_eq(network.weight[j], 20.0f);
    }
    expect_held(learn(&network, &config, network_x[0], 1.0f, -1e6f), NETWORK_UNITS, 0, 0);
    for (int32_t j = 0; j < NETWORK_UNITS; j++) {
        ck_assert_float_eq(network.weight[j], -20.0f);
    }
    expect_held(learn(&network, &config, network_x[0], 1.0f, 0.0f), 0, 0, 0); /* at the limit is not beyond it */
}
END_TEST

START_TEST(centre_stops_at_its_limit) {
    lh_network_config config = reference_config();
    config.rate_weight = config.rate_width = 0.0f;
    config.rate_centre = 10.0f;
    lh_network network = reference_network();
    const lh_held held = learn(&network, &config, network_x[0], 1.0f, 1e6f);
    uint64_t least = 0, largest = 0;
    for (int32_t j = 0; j < NETWORK_UNITS; j++) {
        for (int32_t i = 0; i < NETWORK_INPUTS; i++) {
            least += network.centre[i][j] == -LH_CENTRE_LIMIT;
            largest += network.centre[i][j] == LH_CENTRE_LIMIT;
        }
    }
    ck_assert_uint_gt(least, 0);
    ck_assert_uint_gt(largest, 0);
    ck_assert_uint_eq(held.centres, least + largest);
    ck_assert_int_eq(lh_network_validate(&network, &config), LH_OK);
}
END_TEST

START_TEST(what_is_not_finite_is_never_stored) {
    const lh_network_config config = reference_config();
    const float errors[] = {NAN, INFINITY, -INFINITY};
    for (int32_t k = 0; k < COUNT(errors); k++) {
        lh_network network = reference_network();
        const lh_network before = network;
        /* all weights and widths and every centre */
        expect_held(learn(&network, &config, network_x[0], 0.1f, errors[k]), NETWORK_UNITS, NETWORK_UNITS,
                    (uint64_t)NETWORK_UNITS * NETWORK_INPUTS);
        ck_assert_mem_eq(&network, &before, sizeof network);
    }
    const float finite[] = {FLT_MAX, -FLT_MAX, 1e30f, -1e30f};
    for (int32_t k = 0; k < COUNT(finite); k++) {
        lh_network network = reference_network();
        for (int32_t repeat = 0; repeat < 5; repeat++) {
            learn(&network, &config, network_x[k], 1.0f, finite[k]);
            ck_assert_int_eq(lh_network_validate(&network, &config), LH_OK);
            ck_assert(isfinite(value(&network, network_x[k])));
        }
    }
}
END_TEST

START_TEST(network_of_extremes_has_a_finite_value) {
    lh_network network = reference_network();
    for (int32_t j = 0; j < NETWORK_UNITS; j++) {
        network.weight[j] = 1e6f;
        network.width[j] = 0.01f;
        network.centre[0][j] = j % 2 ? LH_CENTRE_LIMIT : network_x[0][0];
    }
    ck_assert(isfinite(value(&network, network_x[0])));
}
END_TEST

START_TEST(bad_networks_are_refused) {
    const lh_network_config config = reference_config();
    const lh_network good = reference_network();
    ck_assert_int_eq(lh_network_validate(&good, &config), LH_OK);
#define BAD(place, value)                                                           \
    do {                                                                            \
        lh_network network = good;                                                  \
        network.place = value;                                                      \
        ck_assert_int_eq(lh_network_validate(&network, &config), LH_ERROR_NETWORK); \
    } while (0)
    BAD(units, NETWORK_UNITS - 1);
    BAD(inputs, NETWORK_INPUTS + 1);
    BAD(weight[NETWORK_UNITS - 1], NAN);
    BAD(weight[0], 10001.0f);
    BAD(weight[0], -INFINITY);
    BAD(width[0], 0.0499f);
    BAD(width[NETWORK_UNITS - 1], INFINITY);
    BAD(centre[NETWORK_INPUTS - 1][NETWORK_UNITS - 1], NAN);
    BAD(centre[0][0], 1001.0f);
    BAD(weight[NETWORK_UNITS], 0.1f);
    BAD(width[LH_UNIT_SLOTS - 1], 1.0f);
    BAD(centre[0][NETWORK_UNITS], 0.1f);
    BAD(centre[NETWORK_INPUTS][0], NAN);
#undef BAD
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("network");
    TCase *t = tcase_create("configuration");
    tcase_add_test(t, defaults_are_those_of_table_2);
    tcase_add_test(t, bad_fields_are_named);
    tcase_add_test(t, initial_values);
    tcase_add_test(t, bad_networks_are_refused);
    suite_add_tcase(s, t);
    t = tcase_create("value (13)(14) and learning (15)-(21)");
    tcase_add_test(t, value_against_reference);
    tcase_add_test(t, printed_rule_against_reference);
    tcase_add_test(t, exact_gradient_against_finite_differences);
    tcase_add_test(t, learning_moves_the_value_towards_the_target);
    suite_add_tcase(s, t);
    t = tcase_create("limits");
    tcase_add_test(t, width_stops_at_its_floor);
    tcase_add_test(t, weight_stops_at_its_limit);
    tcase_add_test(t, centre_stops_at_its_limit);
    tcase_add_test(t, what_is_not_finite_is_never_stored);
    tcase_add_test(t, network_of_extremes_has_a_finite_value);
    suite_add_tcase(s, t);
    return s;
}
