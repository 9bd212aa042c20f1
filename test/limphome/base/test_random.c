#include "limphome/base/random.h"

#include "reference.h"
#include "test.h"

START_TEST(known_answers) {
    for (int32_t k = 0; k < COUNT(random_seed); k++) {
        lh_random random;
        lh_random_init(&random, random_seed[k]);
        for (int32_t i = 0; i < COUNT(random_output[k]); i++) {
            ck_assert_uint_eq(lh_random_next(&random), random_output[k][i]);
        }
    }
}
END_TEST

START_TEST(restored_state_goes_on) {
    lh_random a;
    lh_random b;
    lh_random_init(&a, 42);
    lh_random_next(&a);
    ck_assert_int_eq(lh_random_restore(&b, a.s), LH_OK);
    for (int32_t i = 0; i < 100; i++) {
        ck_assert_uint_eq(lh_random_next(&a), lh_random_next(&b));
    }
}
END_TEST

START_TEST(state_of_zeros_is_refused) {
    lh_random random;
    lh_random_init(&random, 1);
    const lh_random before = random;
    ck_assert_int_eq(lh_random_restore(&random, (uint32_t[4]){0, 0, 0, 0}), LH_ERROR_RANDOM_STATE);
    ck_assert_mem_eq(&random, &before, sizeof random);
    ck_assert_int_eq(lh_random_restore(&random, (uint32_t[4]){0, 0, 0, 1}), LH_OK);
}
END_TEST

START_TEST(uniform_is_even_over_its_range) {
    lh_random random;
    lh_random_init(&random, 3);
    enum { DRAWS = 1000000, BINS = 64 };
    int32_t bins[BINS] = {0};
    double sum = 0.0;
    int32_t wrong = 0;
    for (int32_t i = 0; i < DRAWS; i++) {
        const float u = lh_random_uniform(&random);
        wrong += !(u >= 0.0f && u < 1.0f) || floor(u * 0x1p24) != u * 0x1p24;
        sum += u;
        bins[(int32_t)(u * (float)BINS) & (BINS - 1)]++;
    }
    ck_assert_int_eq(wrong, 0);
    /* five standard deviations of the mean, 1 / sqrt(12 n) */
    expect_near(sum / (double)DRAWS, 0.5, 5.0 / sqrt(12.0 * (double)DRAWS));
    double chi_square = 0.0;
    for (int32_t i = 0; i < BINS; i++) {
        const double expected = (double)DRAWS / (double)BINS;
        chi_square += (bins[i] - expected) * (bins[i] - expected) / expected;
    }
    /* 63 degrees of freedom: quantiles 1e-4 and 1 - 1e-4 */
    ck_assert_double_gt(chi_square, 28.1);
    ck_assert_double_lt(chi_square, 113.5);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("random");
    TCase *t = tcase_create("xoshiro128**");
    tcase_add_test(t, known_answers);
    tcase_add_test(t, restored_state_goes_on);
    tcase_add_test(t, state_of_zeros_is_refused);
    tcase_add_test(t, uniform_is_even_over_its_range);
    suite_add_tcase(s, t);
    return s;
}
