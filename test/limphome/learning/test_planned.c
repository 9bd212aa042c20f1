#include "limphome/learning/planned.h"

#include "crawler.h"
#include "limphome/task/action.h"
#include "test.h"

static lh_planned planned;

/* The plan of the crawler robot with these actuators controlled, by decisions of 0.5 s. */
static void plan(const lh_robot *robot, const lh_controlled *controlled) {
    const lh_task_config config = lh_task_config_default();
    lh_task task;
    ck_assert_int_eq(lh_task_init(&task, &config, robot, controlled), LH_OK);
    memset(&planned, 0x5a, sizeof planned);
    lh_planned_init(&planned, &task, 0.5f);
}

static void plan_usual(void) {
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    plan(&robot, &controlled);
}

/* Two crawlers and five joints, as of two arms. */
static lh_robot two_arms(void) {
    lh_robot robot = crawler_robot();
    robot.num_actuators = 7;
    robot.actuators[5] = (lh_actuator){LH_JOINT, -1.0f, 1.0f, 100.0f};
    robot.actuators[6] = (lh_actuator){LH_JOINT, -2.0f, 2.0f, 100.0f};
    return robot;
}

START_TEST(it_plans_with_what_is_controlled) {
    plan_usual();
    ck_assert_int_eq(planned.num_controlled, 4);
    ck_assert_int_eq(planned.count, 4);
    ck_assert_int_eq(planned.num_crawlers, 1);
    ck_assert_int_eq(planned.num_joints, 3);
    ck_assert_int_eq(planned.num_actions, 81);
    ck_assert_int_eq(planned.num_crawler_actions, 3);
    for (int32_t k = 0; k < 4; k++) {
        ck_assert_int_eq(planned.place[k], k);
        ck_assert_int_eq(planned.actuator[k], k + 1);
    }
    const float low[] = {-2.6f, -0.6f, -2.4f};
    const float high[] = {2.6f, 1.2f, 0.0f};
    ck_assert_mem_eq(planned.low, low, sizeof low);
    ck_assert_mem_eq(planned.high, high, sizeof high);
}
END_TEST

START_TEST(travel_is_speed_times_period) {
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    lh_task_config config = lh_task_config_default();
    config.crawler_speed = 0.2f;
    config.joint_speed = 0.4f;
    lh_task task;
    ck_assert_int_eq(lh_task_init(&task, &config, &robot, &controlled), LH_OK);
    lh_planned_init(&planned, &task, 0.25f);
    for (int32_t k = 0; k < robot.num_actuators; k++) { /* controlled or not */
        expect_near(planned.travel[k], k < 2 ? 0.05 : 0.1, 1e-7);
    }
}
END_TEST

START_TEST(two_crawlers_and_three_joints_are_the_most) {
    const lh_robot robot = two_arms();
    const lh_controlled controlled = {.count = 7, .index = {0, 1, 2, 3, 4, 5, 6}};
    plan(&robot, &controlled);
    ck_assert_int_eq(planned.num_controlled, 7);
    ck_assert_int_eq(planned.count, LH_MAX_PLANNED);
    ck_assert_int_eq(planned.num_crawlers, 2);
    ck_assert_int_eq(planned.num_joints, LH_PLANNED_JOINTS);
    ck_assert_int_eq(planned.num_actions, LH_PLANNED_ACTIONS);
    ck_assert_int_eq(planned.num_crawler_actions, 9);
}
END_TEST

START_TEST(a_third_crawler_is_left_out) {
    lh_robot robot = two_arms();
    robot.actuators[2] = robot.actuators[1];
    robot.links[3].actuator = -1; /* which hung on it */
    const lh_controlled controlled = {.count = 5, .index = {0, 1, 2, 3, 5}};
    plan(&robot, &controlled);
    ck_assert_int_eq(planned.count, 4);
    ck_assert_int_eq(planned.num_crawlers, 2);
    ck_assert_int_eq(planned.num_joints, 2);
    const int32_t place[] = {0, 1, 3, 4};
    const int32_t actuator[] = {0, 1, 3, 5};
    ck_assert_mem_eq(planned.place, place, sizeof place);
    ck_assert_mem_eq(planned.actuator, actuator, sizeof actuator);
}
END_TEST

/* All that is left out stands still in the task's action; all else is as in the plan's. */
START_TEST(its_actions_are_actions_of_the_task) {
    const lh_robot robot = two_arms();
    const lh_controlled controlled = {.count = 6, .index = {1, 2, 3, 4, 5, 6}};
    plan(&robot, &controlled);
    ck_assert_int_eq(planned.num_actions, 81);
    for (int32_t a = 0; a < planned.num_actions; a++) {
        int8_t expected[6] = {0, 0, 0, 0, 1, 1};
        int8_t levels[6];
        lh_action_levels(a, 4, expected);
        lh_action_levels(lh_planned_joint_action(&planned, a), 6, levels);
        ck_assert_mem_eq(levels, expected, sizeof levels);
        ck_assert_mem_eq(lh_planned_joint_levels(&planned, a), expected + 1, 3);
        ck_assert_int_eq(a == lh_planned_still(&planned),
                         expected[0] == 1 && expected[1] == 1 && expected[2] == 1 && expected[3] == 1);
    }
}
END_TEST

START_TEST(the_planned_joints_among_all) {
    plan_usual();
    float joint_angle[LH_MAX_ACTUATORS] = {10.0f, 11.0f, 12.0f, 13.0f, 14.0f, 15.0f, 16.0f, 17.0f};
    float angle[LH_PLANNED_JOINTS];
    lh_planned_angles(&planned, joint_angle, angle);
    ck_assert(angle[0] == 12.0f && angle[1] == 13.0f && angle[2] == 14.0f);
    const float set[LH_PLANNED_JOINTS] = {1.0f, 2.0f, 3.0f};
    lh_planned_set_angles(&planned, set, joint_angle);
    const float expected[LH_MAX_ACTUATORS] = {10.0f, 11.0f, 1.0f, 2.0f, 3.0f, 15.0f, 16.0f, 17.0f};
    for (int32_t k = 0; k < LH_MAX_ACTUATORS; k++) {
        ck_assert(joint_angle[k] == expected[k]);
    }
}
END_TEST

static int32_t index_of(int8_t crawler, int8_t swing, int8_t boom, int8_t arm) {
    const int8_t levels[] = {crawler, swing, boom, arm};
    return lh_action_index(levels, 4);
}

START_TEST(no_joint_is_pushed_against_its_limit) {
    plan_usual();
    const float middle[] = {0.0f, 0.3f, -1.2f};
    for (int32_t a = 0; a < planned.num_actions; a++) {
        ck_assert_int_eq(lh_planned_allows(&planned, middle, a), a != index_of(1, 1, 1, 1));
    }
    for (int32_t k = 0; k < 3; k++) {
        for (int32_t end = 0; end < 2; end++) {
            const float limit = end == 0 ? planned.low[k] : planned.high[k];
            const float inward = end == 0 ? 1.0f : -1.0f;
            const float distance[] = {-1.0f, 0.0f, 0.029f, 0.031f};
            for (int32_t i = 0; i < COUNT(distance); i++) {
                float angle[] = {0.0f, 0.3f, -1.2f};
                angle[k] = limit + inward * distance[i];
                int8_t levels[] = {0, 1, 1, 1};
                levels[1 + k] = (int8_t)(end == 0 ? 0 : 2);
                ck_assert_int_eq(lh_planned_allows(&planned, angle, lh_action_index(levels, 4)), i == 3);
                levels[1 + k] = (int8_t)(end == 0 ? 2 : 0);
                ck_assert(lh_planned_allows(&planned, angle, lh_action_index(levels, 4)));
                levels[1 + k] = 1;
                ck_assert(lh_planned_allows(&planned, angle, lh_action_index(levels, 4)));
            }
        }
    }
}
END_TEST

START_TEST(joints_move_by_the_share_that_happens) {
    plan_usual();
    const float angle[] = {0.1f, 0.2f, -0.3f};
    float next[LH_PLANNED_JOINTS];
    lh_planned_move(&planned, angle, index_of(2, 2, 0, 1), 0.5f, next);
    expect_near(next[0], 0.175, 1e-6);
    expect_near(next[1], 0.125, 1e-6);
    expect_near(next[2], -0.3, 1e-7);
}
END_TEST

START_TEST(a_crawler_alone_is_a_plan_without_joints) {
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = {.count = 1, .index = {1}};
    plan(&robot, &controlled);
    ck_assert_int_eq(planned.num_joints, 0);
    ck_assert_int_eq(planned.num_actions, 3);
    ck_assert_int_eq(planned.num_crawler_actions, 3);
    ck_assert(!lh_planned_allows(&planned, NULL, 1));
    ck_assert(lh_planned_allows(&planned, NULL, 2));
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("planned");
    TCase *t = tcase_create("actuators");
    tcase_add_test(t, it_plans_with_what_is_controlled);
    tcase_add_test(t, travel_is_speed_times_period);
    tcase_add_test(t, two_crawlers_and_three_joints_are_the_most);
    tcase_add_test(t, a_third_crawler_is_left_out);
    tcase_add_test(t, a_crawler_alone_is_a_plan_without_joints);
    tcase_add_test(t, the_planned_joints_among_all);
    suite_add_tcase(s, t);
    t = tcase_create("actions");
    tcase_add_test(t, its_actions_are_actions_of_the_task);
    tcase_add_test(t, no_joint_is_pushed_against_its_limit);
    tcase_add_test(t, joints_move_by_the_share_that_happens);
    suite_add_tcase(s, t);
    return s;
}
