#include "limphome/learning/boltzmann.h"

#include <float.h>
#include <stddef.h>

#include "reference.h"
#include "test.h"

START_TEST(temperature_of_the_episode) {
    for (int32_t k = 0; k < COUNT(temperature_episode); k++) {
        float t = 0.0f;
        ck_assert_int_eq(lh_boltzmann_temperature(temperature_episode[k], 1e-4f, &t), LH_OK);
        expect_near(t, temperature[k], 4e-7 * temperature[k] + 1e-8);
    }
}
END_TEST

START_TEST(temperature_has_a_floor) {
    float t = 0.0f;
    ck_assert_int_eq(lh_boltzmann_temperature(2500, 0.2f, &t), LH_OK); /* 0.1278 without it */
    ck_assert_float_eq(t, 0.2f);
    ck_assert_int_eq(lh_boltzmann_temperature(INT32_MAX, 0.01f, &t), LH_OK);
    expect_near(t, 1.0 / log(2147483647.0), 1e-7);
}
END_TEST

START_TEST(temperature_before_the_first_episode_is_refused) {
    const int32_t refused[] = {0, -1, -2500, INT32_MIN};
    for (int32_t k = 0; k < COUNT(refused); k++) {
        float t = 7.0f;
        ck_assert_int_eq(lh_boltzmann_temperature(refused[k], 0.01f, &t), LH_ERROR_EPISODE);
        ck_assert_float_eq(t, 7.0f);
    }
}
END_TEST

START_TEST(greedy_takes_the_first_of_equals) {
    ck_assert_int_eq(lh_boltzmann_greedy((float[]){1.0f, 3.0f, 3.0f, 2.0f}, 4), 1);
    ck_assert_int_eq(lh_boltzmann_greedy((float[]){-5.0f}, 1), 0);
    ck_assert_int_eq(lh_boltzmann_greedy((float[]){-5.0f, -5.0f, -4.0f}, 3), 2);
}
END_TEST

START_TEST(probabilities_against_reference) {
    for (int32_t k = 0; k < COUNT(selection_q); k++) {
        const int32_t count = COUNT(selection_q[k]);
        for (int32_t i = 0; i < count; i++) {
            const double expected = selection_probability[k][i];
            const float actual = lh_boltzmann_probability(selection_q[k], count, selection_temperature[k], i);
            /* a rounding of q / T is multiplied by its magnitude */
            expect_near(actual, expected, 1e-6 * expected * (1.0 + 10.0 / selection_temperature[k]) + 1e-12);
        }
    }
}
END_TEST

START_TEST(equal_values_give_equal_probabilities) {
    const float q[81] = {0};
    for (int32_t i = 0; i < 81; i++) {
        expect_near(lh_boltzmann_probability(q, 81, 0.128f, i), 1.0 / 81.0, 1e-8);
    }
}
END_TEST

START_TEST(probabilities_sum_to_one) {
    static const float scales[] = {0.0f, 1.0f, 100.0f, 1e30f, FLT_MAX};
    float q[729];
    for (int32_t k = 0; k < COUNT(scales); k++) {
        lh_random random;
        lh_random_init(&random, 5);
        const int32_t count = COUNT(q);
        for (int32_t i = 0; i < count; i++) {
            q[i] = scales[k] * (2.0f * lh_random_uniform(&random) - 1.0f);
        }
        double sum = 0.0;
        for (int32_t i = 0; i < count; i++) {
            const float p = lh_boltzmann_probability(q, count, 0.5f, i);
            ck_assert(p >= 0.0f && p <= 1.0f);
            sum += p;
        }
        expect_near(sum, 1.0, 1e-5);
    }
}
END_TEST

START_TEST(huge_values_do_not_overflow) {
    const float q[] = {-1e30f, 1e30f, -FLT_MAX, 0.0f};
    lh_random random;
    lh_random_init(&random, 1);
    for (int32_t i = 0; i < 1000; i++) {
        float p = 0.0f;
        ck_assert_int_eq(lh_boltzmann_select(q, 4, 1e-4f, &random, &p), 1);
        ck_assert_float_eq(p, 1.0f);
    }
    const float extremes[] = {FLT_MAX, FLT_MAX, -FLT_MAX};
    expect_near(lh_boltzmann_probability(extremes, 3, 1e-4f, 0), 0.5, 1e-7);
    ck_assert_float_eq(lh_boltzmann_probability(extremes, 3, 1e-4f, 2), 0.0f);
}
END_TEST

START_TEST(selection_agrees_with_probability) {
    for (int32_t k = 0; k < COUNT(selection_q); k++) {
        lh_random random;
        lh_random_init(&random, (uint64_t)k);
        for (int32_t i = 0; i < 200; i++) {
            float p = 0.0f;
            const int32_t a = lh_boltzmann_select(selection_q[k], 9, selection_temperature[k], &random, &p);
            ck_assert(a >= 0 && a < 9);
            ck_assert_float_eq(p, lh_boltzmann_probability(selection_q[k], 9, selection_temperature[k], a));
            ck_assert_float_gt(p, 0.0f);
        }
    }
}
END_TEST

/* Not even by the random number 0, which xoshiro128** gives for s[1] = 0. */
START_TEST(impossible_actions_are_not_selected) {
    const float q[] = {-1e30f, 0.0f, -1e30f};
    lh_random random = {{1, 0, 0, 0}};
    lh_random same = random;
    ck_assert_float_eq(lh_random_uniform(&same), 0.0f);
    ck_assert_int_eq(lh_boltzmann_select(q, 3, 1.0f, &random, NULL), 1);
}
END_TEST

START_TEST(selection_uses_one_random_number) {
    lh_random a;
    lh_random b;
    lh_random_init(&a, 9);
    b = a;
    lh_boltzmann_select(selection_q[0], 9, 1.0f, &a, NULL);
    lh_random_next(&b);
    ck_assert_mem_eq(&a, &b, sizeof a);
}
END_TEST

/* Pearson's test of one row of the table. */
START_TEST(frequencies_agree_with_probability) {
    enum { DRAWS = 200000, ACTIONS = 9 };
    for (int32_t k = 0; k < 2; k++) {
        lh_random random;
        lh_random_init(&random, 77);
        int32_t drawn[ACTIONS] = {0};
        for (int32_t i = 0; i < DRAWS; i++) {
            drawn[lh_boltzmann_select(selection_q[k], ACTIONS, selection_temperature[k], &random, NULL)]++;
        }
        double chi_square = 0.0;
        int32_t freedom = -1;
        int32_t rare = 0;
        double rare_expected = 0.0;
        for (int32_t i = 0; i < ACTIONS; i++) {
            const double expected = (double)DRAWS * selection_probability[k][i];
            if (expected < 10.0) { /* too rare for the chi-square distribution; taken together below */
                rare += drawn[i];
                rare_expected += expected;
            } else {
                chi_square += (drawn[i] - expected) * (drawn[i] - expected) / expected;
                freedom++;
            }
        }
        ck_assert_int_ge(freedom, 4);
        ck_assert_double_lt(chi_square, 31.9); /* 8 degrees of freedom: exceeded with probability 1e-4 */
        ck_assert_double_le(fabs(rare - rare_expected), 5.0 * sqrt(rare_expected + 1.0));
    }
}
END_TEST

/* The table's temperatures have frequent values only; here a single draw decides the interval exactly. */
START_TEST(draws_at_the_edges_of_the_interval) {
    /* exp(0) and exp(-ln 3): probabilities 3/4 and 1/4 */
    const float q[] = {0.0f, -1.0986123f};
    lh_random random;
    lh_random_init(&random, 11);
    for (int32_t i = 0; i < 10000; i++) {
        lh_random same = random;
        const float u = lh_random_uniform(&same);
        const int32_t a = lh_boltzmann_select(q, 2, 1.0f, &random, NULL);
        if (fabs(u - 0.75) > 1e-6) {
            ck_assert_int_eq(a, u < 0.75f ? 0 : 1);
        }
    }
}
END_TEST

/* The library computes several values at a time; here the cumulative distribution is summed up one by one. */
START_TEST(draws_agree_with_the_cumulative_distribution) {
    static const int32_t counts[] = {1, 2, 8, 31, 32, 33, 63, 64, 65, 81, 243};
    for (int32_t k = 0; k < COUNT(counts); k++) {
        const int32_t count = counts[k];
        float q[243];
        double likelihood[243];
        double total = 0.0;
        lh_random random;
        lh_random_init(&random, (uint64_t)count);
        for (int32_t i = 0; i < count; i++) {
            q[i] = lh_random_uniform(&random);
            likelihood[i] = exp(q[i] / 0.5);
            total += likelihood[i];
        }
        int32_t last = 0; /* how often the last was drawn */
        for (int32_t draw = 0; draw < 2000; draw++) {
            lh_random same = random;
            const double target = lh_random_uniform(&same) * total;
            const int32_t a = lh_boltzmann_select(q, count, 0.5f, &random, NULL);
            ck_assert(a >= 0 && a < count);
            double below = 0.0;
            for (int32_t i = 0; i < a; i++) {
                below += likelihood[i];
            }
            ck_assert_double_le(below - 1e-5 * total, target);
            ck_assert_double_le(target, below + likelihood[a] + 1e-5 * total);
            last += a == count - 1;
        }
        ck_assert_int_gt(last, 0);
    }
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("boltzmann");
    TCase *t = tcase_create("temperature (4)");
    tcase_add_test(t, temperature_of_the_episode);
    tcase_add_test(t, temperature_has_a_floor);
    tcase_add_test(t, temperature_before_the_first_episode_is_refused);
    suite_add_tcase(s, t);
    t = tcase_create("selection (3)");
    tcase_add_test(t, greedy_takes_the_first_of_equals);
    tcase_add_test(t, probabilities_against_reference);
    tcase_add_test(t, equal_values_give_equal_probabilities);
    tcase_add_test(t, probabilities_sum_to_one);
    tcase_add_test(t, huge_values_do_not_overflow);
    tcase_add_test(t, selection_agrees_with_probability);
    tcase_add_test(t, impossible_actions_are_not_selected);
    tcase_add_test(t, selection_uses_one_random_number);
    tcase_add_test(t, frequencies_agree_with_probability);
    tcase_add_test(t, draws_at_the_edges_of_the_interval);
    tcase_add_test(t, draws_agree_with_the_cumulative_distribution);
    suite_add_tcase(s, t);
    return s;
}
