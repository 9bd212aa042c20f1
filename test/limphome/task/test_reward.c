#include "limphome/task/reward.h"

#include "reference.h"
#include "test.h"

static lh_pose2 pose(const float *row) {
    return (lh_pose2){row[0], row[1], row[2]};
}

START_TEST(defaults_are_those_of_table_2) {
    const lh_reward_config config = lh_reward_config_default();
    ck_assert_float_eq(config.forward, 8.0f);
    ck_assert_float_eq(config.sideways, 2.0f);
    ck_assert_float_eq(config.turn, 10.0f);
    ck_assert(!config.heading_error);
    ck_assert_float_eq(config.goal, 10.0f);
    ck_assert_float_eq(config.stability, 1.0f);
    ck_assert_float_eq(config.tumble, -10.0f);
    ck_assert_int_eq(lh_reward_config_validate(&config), LH_OK);
}
END_TEST

START_TEST(bad_fields_are_named) {
#define BAD(field, value)                                                      \
    do {                                                                       \
        lh_reward_config config = lh_reward_config_default();                  \
        config.field = value;                                                  \
        ck_assert_int_eq(lh_reward_config_validate(&config), LH_ERROR_REWARD); \
    } while (0)
    BAD(forward, -1.0f);
    BAD(forward, NAN);
    BAD(sideways, 1001.0f);
    BAD(turn, INFINITY);
    BAD(goal, -0.001f);
    BAD(stability, -1.0f);
    BAD(tumble, 0.001f);
    BAD(tumble, -1001.0f);
    BAD(tumble, NAN);
#undef BAD
}
END_TEST

START_TEST(a_term_may_be_left_out) {
    lh_reward_config config = lh_reward_config_default();
    config.forward = config.sideways = config.turn = config.goal = config.stability = config.tumble = 0.0f;
    ck_assert_int_eq(lh_reward_config_validate(&config), LH_OK);
}
END_TEST

START_TEST(motion_against_reference) {
    lh_reward_config config = lh_reward_config_default();
    for (int32_t k = 0; k < COUNT(motion_reward); k++) {
        const lh_pose2 before = pose(motion_before[k]);
        const lh_pose2 after = pose(motion_after[k]);
        config.heading_error = false;
        expect_near(lh_reward_motion(&config, &before, &after, motion_direction[k]), motion_reward[k][0], 2e-5);
        config.heading_error = true;
        expect_near(lh_reward_motion(&config, &before, &after, motion_direction[k]), motion_reward[k][1], 2e-5);
    }
}
END_TEST

START_TEST(motion_by_hand) {
    const lh_reward_config config = lh_reward_config_default();
    const lh_pose2 start = {1.0f, 2.0f, (float)M_PI_2};
    const lh_pose2 ahead = {1.0f, 2.15f, (float)M_PI_2};
    const lh_pose2 back = {1.0f, 1.85f, (float)M_PI_2};
    const lh_pose2 left = {0.9f, 2.0f, (float)M_PI_2};
    const lh_pose2 right = {1.1f, 2.0f, (float)M_PI_2};
    const lh_pose2 turned = {1.0f, 2.0f, (float)M_PI_2 - 0.2f};
    expect_near(lh_reward_motion(&config, &start, &ahead, 0.0f), 8 * 0.15, 2e-6);
    expect_near(lh_reward_motion(&config, &start, &back, 0.0f), -8 * 0.15, 2e-6);
    expect_near(lh_reward_motion(&config, &start, &left, 0.0f), -2 * 0.1, 2e-6);
    expect_near(lh_reward_motion(&config, &start, &right, 0.0f), -2 * 0.1, 2e-6);
    expect_near(lh_reward_motion(&config, &start, &turned, 0.0f), -10 * 0.2, 2e-6);
    expect_near(lh_reward_motion(&config, &start, &start, 0.0f), 0.0, 1e-9);
}
END_TEST

START_TEST(goal_falls_with_the_offset) {
    const lh_reward_config config = lh_reward_config_default();
    ck_assert_float_eq(lh_reward_goal(&config, 0.0f), 10.0f);
    expect_near(lh_reward_goal(&config, 0.5f), 10.0 * exp(-0.5), 5e-6);
    expect_near(lh_reward_goal(&config, -0.5f), 10.0 * exp(-0.5), 5e-6);
    ck_assert_float_eq(lh_reward_goal(&config, 1e6f), 0.0f);
}
END_TEST

START_TEST(stability_falls_with_the_margin) {
    lh_reward_config config = lh_reward_config_default();
    config.stability = 2.0f;
    ck_assert_float_eq(lh_reward_stability(&config, 0.0f), -2.0f);
    expect_near(lh_reward_stability(&config, 0.3f), -2.0 * exp(-0.3), 1e-6);
    expect_near(lh_reward_stability(&config, -0.3f), -2.0 * exp(0.3), 1e-6);
    expect_near(lh_reward_stability(&config, -5.0f), -2.0 * exp(5.0), 1e-4);
    ck_assert_float_eq(lh_reward_stability(&config, -1e30f), lh_reward_stability(&config, -5.0f));
}
END_TEST

START_TEST(total_is_the_sum) {
    ck_assert_float_eq(lh_reward_total(&(lh_reward){1.0f, 20.0f, 300.0f, 4000.0f}), 4321.0f);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("reward");
    TCase *t = tcase_create("rewards (5)-(9)(12)");
    tcase_add_test(t, defaults_are_those_of_table_2);
    tcase_add_test(t, bad_fields_are_named);
    tcase_add_test(t, a_term_may_be_left_out);
    tcase_add_test(t, motion_against_reference);
    tcase_add_test(t, motion_by_hand);
    tcase_add_test(t, goal_falls_with_the_offset);
    tcase_add_test(t, stability_falls_with_the_margin);
    tcase_add_test(t, total_is_the_sum);
    suite_add_tcase(s, t);
    return s;
}
