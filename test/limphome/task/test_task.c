#include "limphome/task/task.h"

#include <stddef.h>

#include "crawler.h"
#include "limphome/task/action.h"
#include "reference.h"
#include "test.h"

static const float facing_y = (float)M_PI_2;

static lh_task make_task(const lh_task_config *config) {
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    lh_task task;
    ck_assert_int_eq(lh_task_init(&task, config, &robot, &controlled), LH_OK);
    return task;
}

/* The level robot at (x, y) facing +y. */
static lh_observed observe_at(lh_task *task, float x, float y) {
    const lh_state state = crawler_state(x, y, facing_y);
    lh_observed observed;
    ck_assert_int_eq(lh_task_observe(task, &state, &observed), LH_OK);
    return observed;
}

START_TEST(defaults_are_those_of_the_paper) {
    const lh_task_config config = lh_task_config_default();
    ck_assert_float_eq(config.crawler_speed, 0.3f);
    ck_assert_float_eq(config.joint_speed, 0.3f);
    ck_assert_float_eq(config.episode.goal_distance, 2.0f);
    ck_assert_int_eq(lh_task_config_validate(&config), LH_OK);
}
END_TEST

START_TEST(bad_fields_are_named) {
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    lh_task task;
    lh_task same;
    memset(&task, 0x5a, sizeof task);
    memset(&same, 0x5a, sizeof same);
#define BAD(field, value, error)                                                    \
    do {                                                                            \
        lh_task_config config = lh_task_config_default();                           \
        config.field = value;                                                       \
        ck_assert_int_eq(lh_task_config_validate(&config), error);                  \
        ck_assert_int_eq(lh_task_init(&task, &config, &robot, &controlled), error); \
        ck_assert_mem_eq(&task, &same, sizeof task);                                \
    } while (0)
    BAD(crawler_speed, 0.0f, LH_ERROR_SPEED);
    BAD(joint_speed, NAN, LH_ERROR_SPEED);
    BAD(support_tolerance, 0.0f, LH_ERROR_LIMIT);
    BAD(reward.forward, -1.0f, LH_ERROR_REWARD);
    BAD(episode.reset_every, 0, LH_ERROR_EPISODE);
#undef BAD
}
END_TEST

START_TEST(first_state_begins_an_episode) {
    const lh_task_config config = lh_task_config_default();
    lh_task task = make_task(&config);
    const lh_observed first = observe_at(&task, 3.0f, 4.0f);
    ck_assert(!first.stepped && !first.reset);
    ck_assert_int_eq(first.outcome, LH_OUTCOME_NONE);
    ck_assert_float_eq(lh_reward_total(&first.reward), 0.0f);
    ck_assert_int_eq(first.episode, 1);
    ck_assert_int_eq(first.step, 0);
    ck_assert_int_eq(first.num_inputs, 6);
    ck_assert_float_eq(first.pose.x, 3.0f);
    ck_assert_float_eq(first.pose.y, 4.0f);
    expect_near(first.pose.heading, M_PI_2, 1e-6);
    expect_near(first.goal_distance, 2.0, 1e-6);
    expect_near(first.stability_margin, initial_margin[0], 2e-6);
}
END_TEST

START_TEST(a_step_is_rewarded_and_summed_up) {
    lh_task_config config = lh_task_config_default();
    config.episode.step_limit = 2;
    lh_task task = make_task(&config);
    observe_at(&task, 0.0f, 0.0f);
    const lh_observed one = observe_at(&task, 0.0f, 0.1f);
    ck_assert(one.stepped && one.outcome == LH_OUTCOME_NONE);
    expect_near(one.reward.motion, 0.8, 1e-5); /* eta d1 of (8) */
    expect_near(one.reward.stability, -exp(-one.stability_margin), 1e-6);
    ck_assert_int_eq(one.step, 1);
    const lh_observed two = observe_at(&task, 0.05f, 0.1f);
    expect_near(two.reward.motion, -0.1, 1e-5); /* lambda d2 */
    ck_assert_int_eq(two.outcome, LH_OUTCOME_TIMEOUT);
    ck_assert_int_eq(two.summary.number, 1);
    ck_assert_int_eq(two.summary.steps, 2);
    expect_near(two.summary.total.motion, 0.7, 1e-5);
    expect_near(two.summary.lateral_error, -0.05, 1e-6);
    ck_assert_int_eq(two.episode, 2); /* has begun here */
    ck_assert_int_eq(two.step, 0);
    expect_near(two.lateral_error, 0.0, 1e-6);
}
END_TEST

START_TEST(beginning_elsewhere_forgets_the_step) {
    const lh_task_config config = lh_task_config_default();
    lh_task task = make_task(&config);
    observe_at(&task, 0.0f, 0.0f);
    lh_task_begin(&task, 7);
    const lh_observed again = observe_at(&task, 5.0f, 5.0f);
    ck_assert(!again.stepped);
    ck_assert_int_eq(again.episode, 7);
    expect_near(again.goal_distance, 2.0, 1e-6);
    ck_assert(observe_at(&task, 5.0f, 5.1f).stepped);
}
END_TEST

START_TEST(after_a_reset_the_next_state_is_a_first_one) {
    lh_task_config config = lh_task_config_default();
    config.episode.reset_every = 1;
    lh_task task = make_task(&config);
    observe_at(&task, 0.0f, 0.0f);
    const lh_observed goal = observe_at(&task, 0.0f, 2.5f);
    ck_assert_int_eq(goal.outcome, LH_OUTCOME_GOAL);
    ck_assert(goal.reset);
    ck_assert_int_eq(goal.episode, 1); /* the one that has ended */
    const lh_observed next = observe_at(&task, 0.0f, 0.0f);
    ck_assert(!next.stepped);
    ck_assert_int_eq(next.episode, 2);
}
END_TEST

START_TEST(velocities_are_those_of_the_levels) {
    lh_task_config config = lh_task_config_default();
    config.crawler_speed = 0.5f;
    config.joint_speed = 0.25f;
    const lh_task task = make_task(&config);
    const int8_t levels[] = {2, 0, 1, 2};
    float velocity[LH_MAX_ACTUATORS] = {9.0f};
    lh_task_velocities(&task, lh_action_index(levels, 4), velocity);
    ck_assert_float_eq(velocity[0], 9.0f); /* not controlled */
    ck_assert_float_eq(velocity[1], 0.5f);
    ck_assert_float_eq(velocity[2], -0.25f);
    ck_assert_float_eq(velocity[3], 0.0f);
    ck_assert_float_eq(velocity[4], 0.25f);
}
END_TEST

START_TEST(an_invalid_state_changes_nothing) {
    const lh_task_config config = lh_task_config_default();
    lh_task task = make_task(&config);
    observe_at(&task, 0.0f, 0.0f);
    const lh_task before = task;
    lh_observed observed;
    memset(&observed, 0x5a, sizeof observed);
    const lh_observed untouched = observed;
    lh_state bad = crawler_state(0.0f, NAN, facing_y);
    ck_assert_int_eq(lh_task_observe(&task, &bad, &observed), LH_ERROR_STATE);
    ck_assert_mem_eq(&task, &before, sizeof task);
    ck_assert_mem_eq(&observed, &untouched, sizeof observed);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("task");
    TCase *t = tcase_create("task");
    tcase_add_test(t, defaults_are_those_of_the_paper);
    tcase_add_test(t, bad_fields_are_named);
    tcase_add_test(t, first_state_begins_an_episode);
    tcase_add_test(t, a_step_is_rewarded_and_summed_up);
    tcase_add_test(t, beginning_elsewhere_forgets_the_step);
    tcase_add_test(t, after_a_reset_the_next_state_is_a_first_one);
    tcase_add_test(t, velocities_are_those_of_the_levels);
    tcase_add_test(t, an_invalid_state_changes_nothing);
    suite_add_tcase(s, t);
    return s;
}
