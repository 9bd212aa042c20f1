#include "limphome/task/action.h"

#include "test.h"

START_TEST(counts) {
    const int32_t expected[] = {1, 3, 9, 27, 81, 243, 729, 2187, 6561};
    for (int32_t n = 0; n <= LH_MAX_ACTUATORS; n++) {
        ck_assert_int_eq(lh_action_count(n), expected[n]);
    }
}
END_TEST

START_TEST(every_action_is_reached_once) {
    for (int32_t n = 1; n <= LH_MAX_ACTUATORS; n++) {
        int8_t levels[LH_MAX_ACTUATORS] = {0};
        for (int32_t index = 0; index < lh_action_count(n); index++) {
            /* `levels` counts up as an odometer, the first digit fastest */
            int8_t found[LH_MAX_ACTUATORS];
            lh_action_levels(index, n, found);
            ck_assert_mem_eq(found, levels, (size_t)n);
            ck_assert_int_eq(lh_action_index(levels, n), index);
            for (int32_t k = 0; k < n && ++levels[k] == LH_ACTION_LEVELS; k++) {
                levels[k] = 0;
            }
        }
    }
}
END_TEST

START_TEST(levels_as_inputs_and_velocities) {
    const float inputs[] = {0.0f, 0.5f, 1.0f};
    const float velocities[] = {-0.3f, 0.0f, 0.3f};
    for (int8_t level = 0; level < LH_ACTION_LEVELS; level++) {
        ck_assert_float_eq(lh_action_input(level), inputs[level]);
        ck_assert_float_eq(lh_action_velocity(level, 0.3f), velocities[level]);
    }
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("action");
    TCase *t = tcase_create("joint actions");
    tcase_add_test(t, counts);
    tcase_add_test(t, every_action_is_reached_once);
    tcase_add_test(t, levels_as_inputs_and_velocities);
    suite_add_tcase(s, t);
    return s;
}
