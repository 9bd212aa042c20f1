#include "limphome/learning/learner.h"

#include "crawler.h"
#include "reference.h"
#include "test.h"

/* Too large for some stacks. */
static lh_learner learner;
static lh_learner other;

static const lh_learner_kind unknown = (lh_learner_kind)7;

static lh_task make_task(void) {
    const lh_task_config config = lh_task_config_default();
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    lh_task task;
    ck_assert_int_eq(lh_task_init(&task, &config, &robot, &controlled), LH_OK);
    return task;
}

static void init(lh_learner *l) {
    lh_learner_config config = lh_learner_config_default();
    config.q_learning.network.initial_weight = 0.3f;
    const lh_task task = make_task();
    ck_assert_int_eq(lh_learner_init(l, &config, &task), LH_OK);
}

/* Half of every range in episode 3, after a step with that reward. */
static lh_observed observed_after(bool stepped, float reward) {
    return (lh_observed){.stepped = stepped,
                         .reward = {.motion = reward},
                         .outcome = LH_OUTCOME_NONE,
                         .episode = 3,
                         .num_inputs = 6,
                         .inputs = {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f}};
}

static lh_choice step(lh_learner *l, bool stepped, float reward) {
    const lh_observed observed = observed_after(stepped, reward);
    lh_choice choice;
    lh_learner_step(l, &observed, &choice);
    return choice;
}

START_TEST(defaults_are_those_of_the_paper) {
    const lh_learner_config config = lh_learner_config_default();
    ck_assert_int_eq(config.kind, LH_Q_LEARNING);
    ck_assert(config.learn && !config.greedy);
    ck_assert_int_eq(lh_learner_config_validate(&config), LH_OK);
}
END_TEST

START_TEST(an_unknown_kind_is_refused) {
    const lh_task task = make_task();
    lh_learner_config config = lh_learner_config_default();
    config.kind = unknown;
    memset(&learner, 0x5a, sizeof learner);
    memset(&other, 0x5a, sizeof other);
    ck_assert_int_eq(lh_learner_config_validate(&config), LH_ERROR_LEARNER);
    ck_assert_int_eq(lh_learner_init(&learner, &config, &task), LH_ERROR_LEARNER);
    ck_assert_mem_eq(&learner, &other, sizeof learner);
}
END_TEST

START_TEST(bad_fields_of_the_kind_are_named) {
    const lh_task task = make_task();
    lh_learner_config config = lh_learner_config_default();
    config.q_learning.discount_rate = 2.0f;
    memset(&learner, 0x5a, sizeof learner);
    memset(&other, 0x5a, sizeof other);
    ck_assert_int_eq(lh_learner_config_validate(&config), LH_ERROR_RATE);
    ck_assert_int_eq(lh_learner_init(&learner, &config, &task), LH_ERROR_RATE);
    ck_assert_mem_eq(&learner, &other, sizeof learner);
}
END_TEST

START_TEST(bad_fields_of_a_planner_are_named) {
    const lh_task task = make_task();
    lh_learner_config config = lh_learner_config_default();
    config.q_learning.discount_rate = 2.0f; /* of no concern to it */
    config.kind = LH_PLANNER;
    ck_assert_int_eq(lh_learner_config_validate(&config), LH_OK);
    config.planner.backups = -1;
    memset(&learner, 0x5a, sizeof learner);
    memset(&other, 0x5a, sizeof other);
    ck_assert_int_eq(lh_learner_config_validate(&config), LH_ERROR_PLANNER);
    ck_assert_int_eq(lh_learner_init(&learner, &config, &task), LH_ERROR_PLANNER);
    ck_assert_mem_eq(&learner, &other, sizeof learner);
}
END_TEST

START_TEST(nothing_is_done_by_what_is_no_learner) {
    init(&learner);
    learner.kind = unknown;
    lh_learner_executed(&learner, 0);
    lh_learner_keep_clear(&learner, 0.5f);
    other = learner;
    lh_learner_begin(&learner);
    step(&learner, true, 1.0f);
    ck_assert_float_eq(lh_learner_temperature(&learner, 1), 0.0f);
    lh_learned learned;
    lh_learner_save(&learner, &learned);
    ck_assert_int_eq(learned.kind, unknown);
    ck_assert_int_eq(lh_learner_restore(&learner, &learned), LH_ERROR_LEARNER);
    ck_assert_mem_eq(&learner, &other, sizeof learner);
}
END_TEST

START_TEST(learns_from_a_step_of_its_own_only) {
    init(&learner);
    ck_assert(!step(&learner, true, 1.0f).learned); /* nothing was chosen before */
    ck_assert(step(&learner, true, 1.0f).learned);
    ck_assert(!step(&learner, false, 0.0f).learned); /* put elsewhere, says the task */
    lh_learner_begin(&learner);
    const lh_choice begun = step(&learner, true, 1.0f);
    ck_assert(!begun.learned);
    ck_assert_float_eq(begun.td_error, 0.0f);
    learner.learn = false;
    ck_assert(!step(&learner, true, 1.0f).learned);
}
END_TEST

START_TEST(nothing_is_chosen_before_a_reset) {
    init(&learner);
    step(&learner, false, 0.0f);
    lh_observed last = observed_after(true, -10.0f);
    last.outcome = LH_OUTCOME_TUMBLE;
    last.reset = true;
    lh_choice choice;
    const lh_random before = learner.as.q_learning.random;
    lh_learner_step(&learner, &last, &choice);
    ck_assert(choice.learned);
    ck_assert_float_eq(choice.probability, 0.0f);
    ck_assert_mem_eq(&learner.as.q_learning.random, &before, sizeof before);
}
END_TEST

START_TEST(temperature_is_that_of_the_episode) {
    init(&learner);
    expect_near(lh_learner_temperature(&learner, 1), temperature[0], 1e-5);
    expect_near(lh_learner_temperature(&learner, 2), temperature[1], 1e-5);
    ck_assert_float_eq(step(&learner, false, 0.0f).temperature, lh_learner_temperature(&learner, 3));
}
END_TEST

START_TEST(what_was_saved_goes_on_bit_by_bit) {
    init(&learner);
    learner.as.q_learning.config.temperature_floor = 2.0f; /* acts from episode 2 on */
    for (int32_t i = 0; i < 20; i++) {
        step(&learner, i > 0, 0.1f * (float)i);
    }
    lh_learned learned;
    lh_learner_save(&learner, &learned);
    lh_learner_begin(&learner);
    init(&other);
    other.as.q_learning.config.temperature_floor = 2.0f;
    step(&other, false, 0.0f); /* forgotten by restoring */
    ck_assert_int_eq(lh_learner_restore(&other, &learned), LH_OK);
    ck_assert_uint_eq(other.as.q_learning.floored, 20);
    for (int32_t i = 0; i < 20; i++) {
        const lh_choice a = step(&learner, i > 0, 1.0f);
        const lh_choice b = step(&other, i > 0, 1.0f);
        ck_assert_int_eq(a.action, b.action);
        ck_assert_float_eq(a.td_error, b.td_error);
    }
    lh_learned again;
    lh_learner_save(&learner, &learned);
    lh_learner_save(&other, &again);
    ck_assert_mem_eq(&learned.as.q_learning, &again.as.q_learning, sizeof again.as.q_learning);
}
END_TEST

/* --- a planner --- */

static void init_planner(lh_learner *l, bool learns) {
    const lh_task task = make_task();
    lh_learner_config config = lh_learner_config_default();
    config.kind = LH_PLANNER;
    config.learn = learns;
    config.planner.sweeps = 0;
    config.planner.random_share = 0.3f;
    ck_assert_int_eq(lh_learner_init(l, &config, &task), LH_OK);
}

/* Going on along x. */
static lh_choice planner_step(lh_learner *l, int32_t i) {
    lh_observed observed = observed_after(i > 0, 0.0f);
    observed.pose.x = 0.1f * (float)i;
    observed.attitude.w = 1.0f;
    observed.goal_distance = 5.0f - observed.pose.x;
    lh_choice choice;
    lh_learner_step(l, &observed, &choice);
    return choice;
}

START_TEST(a_planner_is_a_learner) {
    init_planner(&learner, true);
    ck_assert_int_eq(learner.kind, LH_PLANNER);
    ck_assert_float_eq(lh_learner_temperature(&learner, 1), 0.0f);
    ck_assert(!planner_step(&learner, 0).learned);
    ck_assert(planner_step(&learner, 1).learned);
    lh_learner_begin(&learner);
    ck_assert(!planner_step(&learner, 2).learned);
    learner.learn = false;
    ck_assert(!planner_step(&learner, 3).learned);
    init_planner(&other, false);
    ck_assert(!planner_step(&other, 0).learned);
    ck_assert(!planner_step(&other, 1).learned);
}
END_TEST

START_TEST(a_planner_goes_on_bit_by_bit) {
    init_planner(&learner, true);
    for (int32_t i = 0; i < 10; i++) {
        planner_step(&learner, i);
    }
    static lh_learned learned;
    static lh_learned again;
    lh_learner_save(&learner, &learned);
    lh_learner_begin(&learner);
    init_planner(&other, true);
    ck_assert_int_eq(lh_learner_restore(&other, &learned), LH_OK);
    for (int32_t i = 0; i < 10; i++) {
        ck_assert_int_eq(planner_step(&learner, i).action, planner_step(&other, i).action);
    }
    lh_learner_save(&learner, &learned);
    lh_learner_save(&other, &again);
    ck_assert_mem_eq(&learned.as.planner, &again.as.planner, sizeof again.as.planner);
    init(&other);
    ck_assert_int_eq(lh_learner_restore(&other, &learned), LH_ERROR_LEARNER);
}
END_TEST

START_TEST(what_another_kind_has_saved_is_refused) {
    init(&learner);
    lh_learned learned;
    lh_learner_save(&learner, &learned);
    learned.kind = unknown;
    other = learner;
    ck_assert_int_eq(lh_learner_restore(&learner, &learned), LH_ERROR_LEARNER);
    ck_assert_mem_eq(&learner, &other, sizeof learner);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("learner");
    TCase *t = tcase_create("kinds");
    tcase_add_test(t, defaults_are_those_of_the_paper);
    tcase_add_test(t, an_unknown_kind_is_refused);
    tcase_add_test(t, bad_fields_of_the_kind_are_named);
    tcase_add_test(t, bad_fields_of_a_planner_are_named);
    tcase_add_test(t, nothing_is_done_by_what_is_no_learner);
    suite_add_tcase(s, t);
    t = tcase_create("steps");
    tcase_add_test(t, learns_from_a_step_of_its_own_only);
    tcase_add_test(t, nothing_is_chosen_before_a_reset);
    tcase_add_test(t, temperature_is_that_of_the_episode);
    suite_add_tcase(s, t);
    t = tcase_create("saving");
    tcase_add_test(t, what_was_saved_goes_on_bit_by_bit);
    tcase_add_test(t, what_another_kind_has_saved_is_refused);
    suite_add_tcase(s, t);
    t = tcase_create("planner");
    tcase_add_test(t, a_planner_is_a_learner);
    tcase_add_test(t, a_planner_goes_on_bit_by_bit);
    suite_add_tcase(s, t);
    return s;
}
