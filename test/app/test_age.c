/* How old a state is, by two clocks that have nothing to do with each other. */
#include "age.h"
#include "suite.h"

static const double limit = 1;
static const double offset = 5000; /* the plant's clock is that far ahead of ours [s] */

/* A session whose first state was asked for at 99.9, sent at 99.95 and heard at 100 on our clock. */
static age_tracker begun(void) {
    age_tracker t;
    age_begin(&t, 99.9, offset + 99.95, 100);
    return t;
}

START_TEST(a_state_that_comes_at_once_is_fresh) {
    age_tracker t = begun();
    for (int i = 1; i < 1000; i++) {
        ck_assert_int_eq(age_judge(&t, offset + 100 + i, 100.01 + i, limit), AGE_FRESH);
    }
}
END_TEST

START_TEST(a_state_that_was_long_under_way_is_stale) {
    age_tracker t = begun();
    ck_assert_int_eq(age_judge(&t, offset + 101, 101.01, limit), AGE_FRESH);
    ck_assert_int_eq(age_judge(&t, offset + 102, 102.9, limit), AGE_FRESH);
    ck_assert_int_eq(age_judge(&t, offset + 103, 104.1, limit), AGE_STALE);
    ck_assert_int_eq(age_judge(&t, offset + 104, 109, limit), AGE_STALE);
    ck_assert_int_eq(age_judge(&t, offset + 109, 109.01, limit), AGE_FRESH);
}
END_TEST

/* That the first one was slow is found out by the next. */
START_TEST(the_fastest_stands_for_one_that_comes_at_once) {
    age_tracker t;
    age_begin(&t, 90, offset + 91, 100);
    ck_assert_int_eq(age_judge(&t, offset + 92, 101, limit), AGE_FRESH); /* as slow as the first */
    ck_assert_int_eq(age_judge(&t, offset + 102, 102, limit), AGE_FRESH);
    ck_assert_int_eq(age_judge(&t, offset + 94, 103, limit), AGE_STALE);
}
END_TEST

START_TEST(a_state_from_the_future_is_impossible_and_spoils_nothing) {
    age_tracker t = begun();
    static const double ahead[] = {1, 1000, 1e12, 9.2e12};
    ck_assert_int_eq(age_judge(&t, offset + 101 + ahead[_i], 101, limit), AGE_IMPOSSIBLE);
    ck_assert_int_eq(age_judge(&t, offset + 102, 102.01, limit), AGE_FRESH);
}
END_TEST

/* For ten days, by 100 parts in a million one way or the other. */
START_TEST(clocks_may_drift) {
    age_tracker t = begun();
    const double rate = _i == 0 ? 1.0001 : 0.9999;
    for (int i = 1; i < 864000; i += 10) {
        ck_assert_int_eq(age_judge(&t, offset + 99.95 + i * rate, 100.0 + i, limit), AGE_FRESH);
    }
    ck_assert_int_eq(age_judge(&t, offset + 99.95 + (864000 - 2) * rate, 100.0 + 864000, limit), AGE_STALE);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("age");
    tcase_add_test(cases, a_state_that_comes_at_once_is_fresh);
    tcase_add_test(cases, a_state_that_was_long_under_way_is_stale);
    tcase_add_test(cases, the_fastest_stands_for_one_that_comes_at_once);
    tcase_add_loop_test(cases, a_state_from_the_future_is_impossible_and_spoils_nothing, 0, 4);
    tcase_add_loop_test(cases, clocks_may_drift, 0, 2);
    return run_suite("age", cases);
}
