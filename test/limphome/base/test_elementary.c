/* Against libm in double precision, over the bit patterns of all floats with an odd stride. An assertion of Check is
 * slow, so the loops only take note. */
#include "limphome/base/elementary.h"

#include "limphome/base/exponential.h"
#include "test.h"

#define STRIDE 257u

static float float_of(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static uint32_t bits_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* Calls body for every STRIDE-th float, which includes denormals, infinities and NaN. */
#define FOR_FLOATS(x)                                              \
    for (uint64_t bits_ = 0; bits_ <= UINT32_MAX; bits_ += STRIDE) \
        for (float x = float_of((uint32_t)bits_), once_ = 0.0f; once_ == 0.0f; once_ = 1.0f)

START_TEST(exp_over_all_floats) {
    double worst = 0.0;
    double worst_denormal = 0.0;
    int64_t wrong = 0;
    FOR_FLOATS(x) {
        const double expected = exp((double)x);
        const float actual = lh_exp(x);
        if (isnan(x)) {
            wrong += !isnan(actual);
        } else if (expected > (double)FLT_MAX) {
            wrong += actual != INFINITY && (double)x > 88.723;
        } else if (expected >= (double)FLT_MIN) {
            worst = fmax(worst, fabs((double)actual - expected) / expected);
        } else {
            worst_denormal = fmax(worst_denormal, fabs((double)actual - expected));
        }
    }
    ck_assert_double_lt(worst, 2e-7);
    ck_assert_double_le(worst_denormal, 0x1p-149); /* one step of the denormals */
    ck_assert_int_eq(wrong, 0);
}
END_TEST

START_TEST(decay_over_all_floats_from_zero) {
    double worst = 0.0;
    int64_t wrong = 0;
    for (uint32_t bits = 0; float_of(bits) <= FLT_MAX; bits += STRIDE) {
        const float x = float_of(bits);
        const float actual = lh_decay(x);
        worst = fmax(worst, fabs((double)actual * exp(fmin((double)x, (double)LH_DECAY_END)) - 1.0));
        wrong += !(actual >= FLT_MIN && actual <= 1.0f);
    }
    ck_assert_double_lt(worst, 2e-7);
    ck_assert_int_eq(wrong, 0);
    ck_assert_float_eq(lh_decay(0.0f), 1.0f);
    ck_assert_float_eq(lh_decay(FLT_MAX), lh_decay(LH_DECAY_END));
    ck_assert_float_eq(lh_decay(INFINITY), lh_decay(LH_DECAY_END));
    for (float x = LH_DECAY_END - 1.0f; x < LH_DECAY_END; x += 1e-4f) { /* where the exponent is at its end */
        ck_assert_float_ge(lh_decay(x), lh_decay(LH_DECAY_END));
    }
}
END_TEST

START_TEST(exp_near_zero_and_at_the_ends) {
    double worst = 0.0;
    for (float x = -20.0f; x < 20.0f; x += 0.00013f) { /* dense where the controller works */
        worst = fmax(worst, fabs((double)lh_exp(x) / exp((double)x) - 1.0));
    }
    ck_assert_double_lt(worst, 2e-7);
    ck_assert_float_eq(lh_exp(0.0f), 1.0f);
    ck_assert_float_eq(lh_exp(-0.0f), 1.0f);
    ck_assert_float_eq(lh_exp(-104.0f), 0.0f);
    ck_assert_float_eq(lh_exp(-INFINITY), 0.0f);
    ck_assert_float_eq(lh_exp(-FLT_MAX), 0.0f);
    ck_assert_float_gt(lh_exp(-103.97f), 0.0f);
    ck_assert(isfinite(lh_exp(88.722f)));
    ck_assert(isinf(lh_exp(88.73f)));
    ck_assert(isinf(lh_exp(INFINITY)));
}
END_TEST

START_TEST(log_over_all_floats) {
    double worst = 0.0;
    int64_t wrong = 0;
    FOR_FLOATS(x) {
        const float actual = lh_log(x);
        if (isnan(x) || x < 0.0f) {
            wrong += !isnan(actual);
        } else if (x > 0.0f && !isinf(x)) {
            const double expected = log((double)x);
            const double error = fabs((double)actual - expected);
            worst = fmax(worst, error / fmax(fabs(expected), 1.0));
        }
    }
    ck_assert_double_lt(worst, 2e-7);
    ck_assert_int_eq(wrong, 0);
}
END_TEST

START_TEST(log_relative_near_one_and_special) {
    double worst = 0.0;
    for (float x = 0.5f; x < 2.0f; x += 1.1e-6f) {
        const double expected = log((double)x);
        worst = fmax(worst, fabs((double)lh_log(x) - expected) / fmax(fabs(expected), 1e-3));
    }
    ck_assert_double_lt(worst, 2e-7);
    ck_assert_float_eq(lh_log(1.0f), 0.0f);
    ck_assert(lh_log(0.0f) == -INFINITY);
    ck_assert(lh_log(-0.0f) == -INFINITY);
    ck_assert(lh_log(INFINITY) == INFINITY);
    ck_assert(isnan(lh_log(-INFINITY)));
    expect_near(lh_log(0x1p-149f), log(0x1p-149), 2e-5);
}
END_TEST

START_TEST(sine_and_cosine_over_all_floats) {
    double worst = 0.0;
    int64_t wrong = 0;
    FOR_FLOATS(x) {
        if (fabsf(x) <= 8192.0f) {
            worst = fmax(worst, fabs((double)lh_sin(x) - sin((double)x)));
            worst = fmax(worst, fabs((double)lh_cos(x) - cos((double)x)));
        } else {
            wrong += !isnan(lh_sin(x)) || !isnan(lh_cos(x));
        }
    }
    ck_assert_double_lt(worst, 2e-7);
    ck_assert_int_eq(wrong, 0);
}
END_TEST

START_TEST(sine_and_cosine_densely) {
    double worst = 0.0;
    for (float x = -8192.0f; x <= 8192.0f; x += 0.00731f) {
        worst = fmax(worst, fabs((double)lh_sin(x) - sin((double)x)));
        worst = fmax(worst, fabs((double)lh_cos(x) - cos((double)x)));
    }
    ck_assert_double_lt(worst, 2e-7);
    ck_assert_float_eq(lh_sin(0.0f), 0.0f);
    ck_assert_float_eq(lh_cos(0.0f), 1.0f);
}
END_TEST

START_TEST(atan2_over_pairs_of_floats) {
    double worst = 0.0;
    int64_t wrong = 0;
    uint32_t bits = 1;
    for (int32_t i = 0; i < 8000000; i++) {
        const float y = float_of(bits = bits * 1664525u + 1013904223u);
        const float x = float_of(bits = bits * 1664525u + 1013904223u);
        if (isnan(x) || isnan(y)) {
            wrong += !isnan(lh_atan2(y, x));
        } else {
            worst = fmax(worst, fabs((double)lh_atan2(y, x) - atan2((double)y, (double)x)));
        }
    }
    for (double angle = -3.14159; angle < 3.14159; angle += 1.3e-6) {
        const float y = (float)sin(angle);
        const float x = (float)cos(angle);
        worst = fmax(worst, fabs((double)lh_atan2(y, x) - atan2((double)y, (double)x)));
    }
    ck_assert_double_lt(worst, 4e-7);
    ck_assert_int_eq(wrong, 0);
}
END_TEST

START_TEST(atan2_on_the_axes) {
    ck_assert_float_eq(lh_atan2(0.0f, 0.0f), 0.0f);
    ck_assert_float_eq(lh_atan2(-0.0f, -0.0f), 0.0f);
    ck_assert_float_eq(lh_atan2(0.0f, 1.0f), 0.0f);
    expect_near(lh_atan2(0.0f, -1.0f), M_PI, 4e-7);
    expect_near(lh_atan2(1.0f, 0.0f), M_PI_2, 4e-7);
    expect_near(lh_atan2(-1.0f, 0.0f), -M_PI_2, 4e-7);
    expect_near(lh_atan2(INFINITY, INFINITY), M_PI_4, 4e-7);
    expect_near(lh_atan2(-INFINITY, -INFINITY), -3.0 * M_PI_4, 4e-7);
    expect_near(lh_atan2(1.0f, -INFINITY), M_PI, 4e-7);
    ck_assert(isnan(lh_atan2(NAN, 0.0f)) && isnan(lh_atan2(0.0f, NAN)) && isnan(lh_atan2(NAN, INFINITY)));
}
END_TEST

START_TEST(square_root_is_correctly_rounded) {
    int64_t wrong = 0;
    FOR_FLOATS(x) {
        const float expected = (float)sqrt((double)x); /* double rounding is harmless for a square root */
        wrong += isnan(expected) ? !isnan(lh_sqrt(x)) : bits_of(lh_sqrt(x)) != bits_of(expected);
    }
    ck_assert_int_eq(wrong, 0);
}
END_TEST

START_TEST(wrapped_angles) {
    double worst = 0.0;
    int64_t wrong = 0;
    for (float x = -100.0f; x <= 100.0f; x += 0.00017f) {
        const float wrapped = lh_wrap_angle(x);
        worst = fmax(worst, fabs(remainder((double)wrapped - (double)x, 2.0 * M_PI)));
        wrong += !(wrapped > -LH_PI && wrapped <= LH_PI);
        wrong += x > -LH_PI && x <= LH_PI && wrapped != x;
    }
    ck_assert_double_lt(worst, 2e-7);
    ck_assert_int_eq(wrong, 0);
    for (int32_t turn = -15; turn <= 15; turn++) { /* odd multiples of pi fall on either side */
        const float wrapped = lh_wrap_angle((float)((2 * turn + 1) * M_PI));
        ck_assert(wrapped > -LH_PI && wrapped <= LH_PI);
    }
    expect_near(lh_wrap_angle(-LH_PI), M_PI, 2e-7);
    ck_assert_float_eq(lh_wrap_angle(LH_PI), LH_PI);
    /* where the rounding of 35 half turns ends outside */
    ck_assert_float_eq(lh_wrap_angle(109.955742f), LH_PI);
    ck_assert_float_eq(lh_wrap_angle(-109.955742f), LH_PI);
    ck_assert(isnan(lh_wrap_angle(NAN)) && isnan(lh_wrap_angle(INFINITY)) && isnan(lh_wrap_angle(1e9f)));
}
END_TEST

START_TEST(limited_to_a_range) {
    ck_assert_float_eq(lh_clip(1.5f, 1.0f, 2.0f), 1.5f);
    ck_assert_float_eq(lh_clip(0.5f, 1.0f, 2.0f), 1.0f);
    ck_assert_float_eq(lh_clip(2.5f, 1.0f, 2.0f), 2.0f);
    ck_assert_float_eq(lh_clip(-INFINITY, 1.0f, 2.0f), 1.0f);
    ck_assert_float_eq(lh_clip(INFINITY, 1.0f, 2.0f), 2.0f);
    ck_assert_float_eq(lh_clip(NAN, 1.0f, 2.0f), 1.0f);
}
END_TEST

START_TEST(ranges) {
    ck_assert(lh_within(1.0f, 1.0f, 2.0f) && lh_within(2.0f, 1.0f, 2.0f));
    ck_assert(!lh_within(0.999f, 1.0f, 2.0f) && !lh_within(2.001f, 1.0f, 2.0f) && !lh_within(NAN, 1.0f, 2.0f));
    ck_assert(lh_finite(FLT_MAX) && lh_finite(0.0f) && lh_finite(-FLT_MAX));
    ck_assert(!lh_finite(INFINITY) && !lh_finite(-INFINITY) && !lh_finite(NAN));
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("elementary");
    TCase *t = tcase_create("against libm");
    tcase_add_test(t, exp_over_all_floats);
    tcase_add_test(t, decay_over_all_floats_from_zero);
    tcase_add_test(t, exp_near_zero_and_at_the_ends);
    tcase_add_test(t, log_over_all_floats);
    tcase_add_test(t, log_relative_near_one_and_special);
    tcase_add_test(t, sine_and_cosine_over_all_floats);
    tcase_add_test(t, sine_and_cosine_densely);
    tcase_add_test(t, atan2_over_pairs_of_floats);
    tcase_add_test(t, atan2_on_the_axes);
    tcase_add_test(t, square_root_is_correctly_rounded);
    tcase_add_test(t, wrapped_angles);
    tcase_add_test(t, ranges);
    tcase_add_test(t, limited_to_a_range);
    suite_add_tcase(s, t);
    return s;
}
