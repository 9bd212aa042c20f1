#include "limphome/task/episode.h"

#include "test.h"

static const lh_pose2 start = {3.0f, -1.0f, (float)M_PI_2}; /* facing +y */

START_TEST(defaults) {
    const lh_episode_config config = lh_episode_config_default();
    ck_assert_float_eq(config.goal_distance, 2.0f);
    ck_assert_int_eq(config.step_limit, 2000);
    expect_near(config.tumble_tilt, M_PI / 3.0, 1e-6);
    ck_assert_int_eq(config.reset_every, 50);
    ck_assert_int_eq(lh_episode_config_validate(&config), LH_OK);
}
END_TEST

START_TEST(bad_fields_are_named) {
#define BAD(field, value)                                                        \
    do {                                                                         \
        lh_episode_config config = lh_episode_config_default();                  \
        config.field = value;                                                    \
        ck_assert_int_eq(lh_episode_config_validate(&config), LH_ERROR_EPISODE); \
    } while (0)
    BAD(goal_distance, 0.09f);
    BAD(goal_distance, 101.0f);
    BAD(goal_distance, NAN);
    BAD(step_limit, 0);
    BAD(step_limit, 100001);
    BAD(tumble_tilt, 0.09f);
    BAD(tumble_tilt, 3.1f);
    BAD(reset_every, 0);
    BAD(reset_every, 1000001);
#undef BAD
}
END_TEST

START_TEST(begins_clean) {
    lh_episode episode;
    memset(&episode, 0x5a, sizeof episode);
    lh_episode_begin(&episode, 17, &start);
    ck_assert_int_eq(episode.number, 17);
    ck_assert_int_eq(episode.steps, 0);
    ck_assert_float_eq(episode.start.y, -1.0f);
    ck_assert_float_eq(lh_reward_total(&episode.total), 0.0f);
}
END_TEST

START_TEST(distance_and_offset) {
    const lh_episode_config config = lh_episode_config_default();
    lh_episode episode;
    lh_episode_begin(&episode, 1, &start);
    /* 0.5 m ahead, 0.25 m to the left of a robot that faces +y */
    const lh_pose2 pose = {2.75f, -0.5f, 0.0f};
    expect_near(lh_episode_distance(&episode, &config, &pose), 1.5, 1e-6);
    expect_near(lh_episode_lateral(&episode, &pose), 0.25, 1e-6);

    /* the same seen along another heading */
    const lh_pose2 oblique = {0.0f, 0.0f, 0.7f};
    lh_episode_begin(&episode, 1, &oblique);
    const lh_pose2 there = {(float)(1.2 * cos(0.7) + 0.4 * sin(0.7)), (float)(1.2 * sin(0.7) - 0.4 * cos(0.7)), 2.0f};
    expect_near(lh_episode_distance(&episode, &config, &there), 0.8, 1e-6);
    expect_near(lh_episode_lateral(&episode, &there), -0.4, 1e-6);
}
END_TEST

START_TEST(outcomes_and_their_precedence) {
    const lh_episode_config config = lh_episode_config_default();
    lh_episode episode;
    lh_episode_begin(&episode, 1, &start);
    const lh_pose2 before = {3.0f, 0.999f, 0.0f};
    const lh_pose2 beyond = {5.0f, 1.001f, 0.0f}; /* the line is infinite: 2 m beside the goal counts */
    const float upright = 1.04f;
    const float tumbled = 1.05f;
    ck_assert_int_eq(lh_episode_outcome(&episode, &config, &before, upright), LH_OUTCOME_NONE);
    ck_assert_int_eq(lh_episode_outcome(&episode, &config, &beyond, upright), LH_OUTCOME_GOAL);
    ck_assert_int_eq(lh_episode_outcome(&episode, &config, &before, tumbled), LH_OUTCOME_TUMBLE);
    ck_assert_int_eq(lh_episode_outcome(&episode, &config, &before, config.tumble_tilt), LH_OUTCOME_NONE);
    ck_assert_int_eq(lh_episode_outcome(&episode, &config, &beyond, tumbled), LH_OUTCOME_TUMBLE);
    episode.steps = config.step_limit - 1;
    ck_assert_int_eq(lh_episode_outcome(&episode, &config, &before, upright), LH_OUTCOME_NONE);
    episode.steps = config.step_limit;
    ck_assert_int_eq(lh_episode_outcome(&episode, &config, &before, upright), LH_OUTCOME_TIMEOUT);
    ck_assert_int_eq(lh_episode_outcome(&episode, &config, &beyond, upright), LH_OUTCOME_GOAL);
    ck_assert_int_eq(lh_episode_outcome(&episode, &config, &beyond, tumbled), LH_OUTCOME_TUMBLE);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("episode");
    TCase *t = tcase_create("episode");
    tcase_add_test(t, defaults);
    tcase_add_test(t, bad_fields_are_named);
    tcase_add_test(t, begins_clean);
    tcase_add_test(t, distance_and_offset);
    tcase_add_test(t, outcomes_and_their_precedence);
    suite_add_tcase(s, t);
    return s;
}
