/* With a library whose capacity for joint actions is smaller than that for actuators: what does not fit is refused. */
#include "crawler.h"
#include "limphome/controller.h"
#include "test.h"

/* Too large for some stacks. */
static lh_controller controller;
static lh_controller other;
static lh_q_learning learner;
static lh_q_learning same;

_Static_assert(LH_MAX_ACTUATORS >= 5 && LH_MAX_ACTIONS == 81, "room for 5 actuators, but for the actions of 4 only");
_Static_assert(LH_MAX_PLANNED == 4, "a planner has room for one crawler only");

START_TEST(learner_refuses_more_actions_than_it_has_room_for) {
    lh_q_learning_config config = lh_q_learning_config_default();
    memset(&learner, 0x5a, sizeof learner);
    memset(&same, 0x5a, sizeof same);
    config.network.inputs = 12;
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, 7, 5, 1), LH_ERROR_ACTUATORS);
    ck_assert_mem_eq(&learner, &same, sizeof learner);
    config.network.inputs = 10;
    ck_assert_int_eq(lh_q_learning_init(&learner, &config, 6, 4, 1), LH_OK);
    ck_assert_int_eq(learner.num_actions, LH_MAX_ACTIONS);
}
END_TEST

START_TEST(controller_refuses_more_actions_than_it_has_room_for) {
    const lh_config config = lh_config_default();
    const lh_robot robot = crawler_robot();
    const lh_controlled all = {.count = 5, .index = {0, 1, 2, 3, 4}};
    const lh_controlled fewer = crawler_controlled();
    memset(&controller, 0x5a, sizeof controller);
    memset(&other, 0x5a, sizeof other);
    ck_assert_int_eq(lh_controller_init(&controller, &config, &robot, &all), LH_ERROR_ACTUATORS);
    ck_assert_mem_eq(&controller, &other, sizeof controller);
    ck_assert_int_eq(lh_controller_init(&controller, &config, &robot, &fewer), LH_OK);
}
END_TEST

/* Every joint action that there is room for, from the first to the last. */
START_TEST(chooses_among_all_actions) {
    const lh_config config = lh_config_default();
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    ck_assert_int_eq(lh_controller_init(&controller, &config, &robot, &controlled), LH_OK);
    const lh_state state = crawler_state(0.0f, 0.0f, 0.0f);
    int32_t chosen[LH_MAX_ACTIONS] = {0};
    for (int32_t i = 0; i < 2000; i++) {
        lh_decision decision;
        ck_assert_int_eq(lh_controller_step(&controller, &state, &decision), LH_OK);
        if (!decision.observed.reset) {
            ck_assert(decision.choice.action >= 0 && decision.choice.action < LH_MAX_ACTIONS);
            chosen[decision.choice.action]++;
        }
    }
    for (int32_t a = 0; a < LH_MAX_ACTIONS; a++) {
        ck_assert_int_gt(chosen[a], 0);
    }
}
END_TEST

/* Of two crawlers, the second stands still. */
START_TEST(a_planner_plans_with_one_crawler_where_there_is_no_room_for_two) {
    lh_config config = lh_config_default();
    config.learner.kind = LH_PLANNER;
    config.learner.planner.sweeps = 0;
    const lh_robot robot = crawler_robot();
    const lh_controlled crawlers_and_arm = {.count = 4, .index = {0, 1, 2, 3}};
    ck_assert_int_eq(lh_controller_init(&controller, &config, &robot, &crawlers_and_arm), LH_OK);
    const lh_planned *planned = &controller.learner.as.planner.planned;
    ck_assert_int_eq(planned->num_crawlers, 1);
    ck_assert_int_eq(planned->num_joints, 2);
    const lh_state state = crawler_state(0.0f, 0.0f, 0.0f);
    for (int32_t i = 0; i < 20; i++) {
        lh_decision decision;
        ck_assert_int_eq(lh_controller_step(&controller, &state, &decision), LH_OK);
        ck_assert(decision.velocity[1] == 0.0f);
    }
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("capacity");
    TCase *t = tcase_create("actions");
    tcase_add_test(t, learner_refuses_more_actions_than_it_has_room_for);
    tcase_add_test(t, controller_refuses_more_actions_than_it_has_room_for);
    tcase_add_test(t, chooses_among_all_actions);
    tcase_add_test(t, a_planner_plans_with_one_crawler_where_there_is_no_room_for_two);
    suite_add_tcase(s, t);
    return s;
}
