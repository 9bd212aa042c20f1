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
    BAD(reward.forward, -1.0f, LH_ERROR_REWARD);
    BAD(episode.reset_every, 0, LH_ERROR_EPISODE);
    BAD(path.kind, (lh_path_kind)7, LH_ERROR_PATH);
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

/* The step that a gap is in has no reward, and the steps after it have theirs; the episode goes on and counts it. */
START_TEST(a_gap_is_no_step) {
    lh_task_config config = lh_task_config_default();
    config.episode.step_limit = 3;
    lh_task task = make_task(&config);
    observe_at(&task, 0.0f, 0.0f);
    lh_task_gap(&task);
    const lh_observed after = observe_at(&task, 0.0f, 0.5f);
    ck_assert(!after.stepped && after.outcome == LH_OUTCOME_NONE);
    ck_assert_float_eq(lh_reward_total(&after.reward), 0.0f);
    ck_assert_int_eq(after.episode, 1);
    ck_assert_int_eq(after.step, 1);
    expect_near(after.goal_distance, 1.5, 1e-6);
    const lh_observed next = observe_at(&task, 0.0f, 0.6f);
    ck_assert(next.stepped);
    expect_near(next.reward.motion, 0.8, 1e-5);
    lh_task_gap(&task);
    const lh_observed last = observe_at(&task, 0.0f, 0.7f);
    ck_assert(!last.stepped);
    ck_assert_int_eq(last.outcome, LH_OUTCOME_TIMEOUT);
    expect_near(last.summary.total.motion, 0.8, 1e-5);
}
END_TEST

START_TEST(goal_and_tumble_are_noticed_across_a_gap) {
    const lh_task_config config = lh_task_config_default();
    lh_task task = make_task(&config);
    observe_at(&task, 0.0f, 0.0f);
    lh_task_gap(&task);
    const lh_observed goal = observe_at(&task, 0.0f, 2.5f);
    ck_assert_int_eq(goal.outcome, LH_OUTCOME_GOAL);
    ck_assert(!goal.stepped);
    ck_assert_float_eq(lh_reward_total(&goal.summary.total), 0.0f);
    lh_task_gap(&task);
    lh_state state = crawler_state(0.0f, 2.5f, facing_y);
    state.orientation = (lh_quat){0.0f, 1.0f, 0.0f, 0.0f};
    lh_observed tumble;
    ck_assert_int_eq(lh_task_observe(&task, &state, &tumble), LH_OK);
    ck_assert_int_eq(tumble.outcome, LH_OUTCOME_TUMBLE);
    ck_assert(tumble.reset && !tumble.stepped);
    ck_assert_float_eq(tumble.reward.tumble, 0.0f);
}
END_TEST

/* What is under way is over: a gap before it is none after it. */
START_TEST(a_gap_ends_with_what_it_is_in) {
    const lh_task_config config = lh_task_config_default();
    lh_task task = make_task(&config);
    observe_at(&task, 0.0f, 0.0f);
    lh_task_gap(&task);
    lh_task_begin(&task, 2);
    observe_at(&task, 0.0f, 0.0f);
    ck_assert(observe_at(&task, 0.0f, 0.1f).stepped);
    lh_task_begin(&task, 3);
    lh_task_gap(&task); /* nothing is under way */
    observe_at(&task, 0.0f, 0.0f);
    ck_assert(observe_at(&task, 0.0f, 0.1f).stepped);
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

/* The level robot at (x, y) with this heading. */
static lh_observed observe_pose(lh_task *task, float x, float y, float heading) {
    const lh_state state = crawler_state(x, y, heading);
    lh_observed observed;
    ck_assert_int_eq(lh_task_observe(task, &state, &observed), LH_OK);
    return observed;
}

/* The first point is 3 m ahead of a robot at the origin that faces +y, the second 1 m to the right of it. */
static lh_task make_task_of_corner(void) {
    lh_task_config config = lh_task_config_default();
    config.path =
        (lh_path_config){.kind = LH_PATH_WAYPOINTS, .num_waypoints = 2, .waypoint = {{0.0f, 3.0f}, {1.0f, 3.0f}}};
    return make_task(&config);
}

START_TEST(a_rolling_line_goes_where_the_robot_faces) {
    const lh_task_config config = lh_task_config_default();
    lh_task task = make_task(&config);
    observe_pose(&task, 0.0f, 0.0f, facing_y);
    const lh_observed next = observe_pose(&task, 0.5f, 2.1f, 0.0f);
    ck_assert_int_eq(next.outcome, LH_OUTCOME_GOAL);
    ck_assert(!next.summary.arrived);
    expect_near(next.summary.line_heading, M_PI_2, 1e-6);
    expect_near(next.summary.start_lateral_error, 0.0, 1e-6);
    ck_assert_float_eq(next.summary.waypoint_distance, 0.0f);
    expect_near(next.goal_distance, 2.0, 1e-6);
    expect_near(next.lateral_error, 0.0, 1e-6);
    expect_near(next.heading_error, 0.0, 1e-6);
}
END_TEST

/* An error at the end of one episode is still one at the beginning of the next. */
START_TEST(the_line_ahead_stays) {
    lh_task_config config = lh_task_config_default();
    config.path.kind = LH_PATH_AHEAD;
    lh_task task = make_task(&config);
    observe_pose(&task, 0.0f, 0.0f, facing_y);
    const lh_observed next = observe_pose(&task, 0.5f, 2.1f, facing_y - 0.25f);
    ck_assert_int_eq(next.outcome, LH_OUTCOME_GOAL);
    expect_near(next.goal_distance, 2.0, 1e-6);
    expect_near(next.lateral_error, -0.5, 1e-6);
    expect_near(next.heading_error, -0.25, 1e-6);
    const lh_observed after = observe_pose(&task, 0.5f, 4.2f, facing_y);
    ck_assert_int_eq(after.outcome, LH_OUTCOME_GOAL);
    expect_near(after.summary.goal_distance, 2.0, 1e-6);
    expect_near(after.summary.start_lateral_error, -0.5, 1e-6);
    expect_near(after.summary.lateral_error, -0.5, 1e-6);
    expect_near(after.summary.heading_change, 0.25, 1e-6);
    ck_assert(!after.summary.arrived && !after.reset);
}
END_TEST

START_TEST(a_path_is_followed_to_its_end) {
    lh_task task = make_task_of_corner();
    const lh_observed first = observe_pose(&task, 0.0f, 0.0f, facing_y);
    expect_near(first.goal_distance, 2.0, 1e-6);
    expect_near(first.waypoint_distance, 3.0, 1e-6);
    const lh_observed second = observe_pose(&task, 0.1f, 2.1f, facing_y);
    ck_assert_int_eq(second.outcome, LH_OUTCOME_GOAL);
    expect_near(second.goal_distance, 0.9, 1e-6); /* the waypoint is nearer than b */
    expect_near(second.lateral_error, -0.1, 1e-6);
    const lh_observed third = observe_pose(&task, -0.2f, 3.1f, facing_y);
    ck_assert_int_eq(third.outcome, LH_OUTCOME_GOAL);
    ck_assert(!third.summary.arrived && !third.reset);
    expect_near(third.summary.lateral_error, 0.2, 1e-6);
    expect_near(third.summary.waypoint_distance, sqrt(0.05), 1e-6);
    expect_near(third.goal_distance, 1.2, 1e-6); /* along +x from here on */
    expect_near(third.lateral_error, 0.1, 1e-6);
    expect_near(third.heading_error, M_PI_2, 1e-6);
    const lh_observed last = observe_pose(&task, 1.05f, 2.95f, 0.0f);
    ck_assert_int_eq(last.outcome, LH_OUTCOME_GOAL);
    ck_assert(last.summary.arrived && last.reset);
    expect_near(last.summary.goal_distance, 1.2, 1e-6);
    expect_near(last.summary.start_lateral_error, 0.1, 1e-6);
    expect_near(last.summary.line_heading, 0.0, 1e-6);
    expect_near(last.summary.waypoint_distance, 0.05 * sqrt(2.0), 1e-6);
    expect_near(last.reward.goal, 10.0 * exp(-0.05), 1e-5);

    const lh_observed again = observe_pose(&task, 0.0f, 0.0f, facing_y);
    ck_assert_int_eq(again.episode, 4);
    expect_near(again.goal_distance, 2.0, 1e-6);
    expect_near(again.heading_error, 0.0, 1e-6);
}
END_TEST

/* Nothing but the end of the path, a tumble and reset_every begin it again. */
START_TEST(a_time_limit_stays_on_the_leg) {
    lh_task task = make_task_of_corner();
    task.config.episode.step_limit = 1;
    observe_pose(&task, 0.0f, 0.0f, facing_y);
    const lh_observed next = observe_pose(&task, 0.5f, -0.5f, facing_y);
    ck_assert_int_eq(next.outcome, LH_OUTCOME_TIMEOUT);
    expect_near(next.goal_distance, 2.0, 1e-6); /* from where the robot is, along the leg */
    expect_near(next.lateral_error, -0.5, 1e-6);
    expect_near(next.waypoint_distance, sqrt(12.5), 1e-6);
}
END_TEST

START_TEST(a_reset_begins_the_path_again) {
    lh_task task = make_task_of_corner();
    task.config.episode.reset_every = 1;
    observe_pose(&task, 0.0f, 0.0f, facing_y);
    ck_assert(observe_pose(&task, 0.0f, 3.0f, facing_y).reset);
    const lh_observed again = observe_pose(&task, 1.0f, 2.0f, facing_y); /* another leg to the first waypoint */
    expect_near(again.waypoint_distance, sqrt(2.0), 1e-6);
    expect_near(again.goal_distance, sqrt(2.0), 1e-6);
    expect_near(again.heading_error, -M_PI_4, 1e-6);
}
END_TEST

/* Carried back, the robot would be 0.8 m from the first waypoint; where it stands it is on the way to the second. */
START_TEST(resuming_goes_on_along_the_path) {
    lh_task task = make_task_of_corner();
    observe_pose(&task, 0.0f, 0.0f, facing_y);
    lh_task_resume(&task, 7);
    const lh_observed there = observe_pose(&task, 0.8f, 2.9f, 0.0f);
    ck_assert(!there.stepped);
    ck_assert_int_eq(there.episode, 7);
    expect_near(there.waypoint_distance, sqrt(0.05), 1e-6);
    expect_near(there.goal_distance, 0.2, 1e-6);
    expect_near(there.lateral_error, -0.1, 1e-6);
    ck_assert(observe_pose(&task, 0.9f, 2.9f, 0.0f).stepped);
    lh_task_begin(&task, 8); /* as ever: another leg to the first waypoint */
    expect_near(observe_pose(&task, 0.9f, 2.9f, 0.0f).waypoint_distance, sqrt(0.82), 1e-6);
}
END_TEST

/* Both ways round are equally far; moving off before the turn reaches no goal. */
START_TEST(a_target_behind_is_reached_by_turning) {
    lh_task_config config = lh_task_config_default();
    config.path = (lh_path_config){.kind = LH_PATH_WAYPOINTS, .num_waypoints = 1, .waypoint = {{0.0f, -4.0f}}};
    lh_task task = make_task(&config);
    const lh_observed first = observe_pose(&task, 0.0f, 0.0f, facing_y);
    expect_near(fabs(first.heading_error), M_PI, 1e-6);
    expect_near(first.goal_distance, 2.0, 1e-6);
    const lh_observed away = observe_pose(&task, -0.5f, 2.5f, facing_y + 0.5f);
    ck_assert_int_eq(away.outcome, LH_OUTCOME_NONE);
    expect_near(away.goal_distance, 4.5, 1e-6);
    expect_near(away.lateral_error, -0.5, 1e-6); /* seen along -y the robot is on the right */
    expect_near(away.heading_error, 0.5 - M_PI, 1e-6);
    ck_assert_int_eq(observe_pose(&task, -0.5f, -2.0f, -facing_y).outcome, LH_OUTCOME_GOAL);
    ck_assert(observe_pose(&task, 0.0f, -4.01f, -facing_y).summary.arrived);
}
END_TEST

START_TEST(tumbling_on_the_last_line_is_no_arrival) {
    lh_task task = make_task_of_corner();
    task.config.path.num_waypoints = 1;
    observe_pose(&task, 0.0f, 0.0f, facing_y);
    lh_state state = crawler_state(0.0f, 3.5f, facing_y);
    state.orientation = (lh_quat){0.0f, 1.0f, 0.0f, 0.0f};
    lh_observed observed;
    ck_assert_int_eq(lh_task_observe(&task, &state, &observed), LH_OK);
    ck_assert_int_eq(observed.outcome, LH_OUTCOME_TUMBLE);
    ck_assert(observed.reset && !observed.summary.arrived);
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
    tcase_add_test(t, a_gap_is_no_step);
    tcase_add_test(t, goal_and_tumble_are_noticed_across_a_gap);
    tcase_add_test(t, a_gap_ends_with_what_it_is_in);
    tcase_add_test(t, after_a_reset_the_next_state_is_a_first_one);
    tcase_add_test(t, a_rolling_line_goes_where_the_robot_faces);
    tcase_add_test(t, the_line_ahead_stays);
    tcase_add_test(t, a_path_is_followed_to_its_end);
    tcase_add_test(t, a_time_limit_stays_on_the_leg);
    tcase_add_test(t, a_reset_begins_the_path_again);
    tcase_add_test(t, resuming_goes_on_along_the_path);
    tcase_add_test(t, a_target_behind_is_reached_by_turning);
    tcase_add_test(t, tumbling_on_the_last_line_is_no_arrival);
    tcase_add_test(t, velocities_are_those_of_the_levels);
    tcase_add_test(t, an_invalid_state_changes_nothing);
    suite_add_tcase(s, t);
    return s;
}
