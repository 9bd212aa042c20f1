#include "limphome/learning/planner.h"

#include <stddef.h>

#include "crawler.h"
#include "limphome/base/elementary.h"
#include "limphome/learning/planning.h"
#include "limphome/task/action.h"
#include "test.h"

/* Too large for some stacks. */
static lh_planner planner;
static lh_planner other;
static lh_planner_learned learned;

enum { RIGHT = 1, SWING, BOOM, ARM };

static const lh_controlled crawler_and_boom = {.count = 2, .index = {RIGHT, BOOM}};

/* That costs little time: without sweeps, and one node backed up in turn. */
static lh_planner_config quick_config(void) {
    lh_planner_config config = lh_planner_config_default();
    config.sweeps = 0;
    config.backups = 1;
    config.candidates = 2;
    return config;
}

static lh_task make_task(const lh_controlled *controlled) {
    const lh_task_config config = lh_task_config_default();
    const lh_robot robot = crawler_robot();
    lh_task task;
    ck_assert_int_eq(lh_task_init(&task, &config, &robot, controlled), LH_OK);
    return task;
}

static void init(lh_planner *p, const lh_planner_config *config, const lh_controlled *controlled, uint64_t seed) {
    const lh_task task = make_task(controlled);
    ck_assert_int_eq(lh_planner_init(p, config, &task, seed), LH_OK);
}

static void init_quick(lh_planner *p, uint64_t seed) {
    const lh_planner_config config = quick_config();
    init(p, &config, &crawler_and_boom, seed);
}

/* At a pose, with the joints at these angles, on the way along x. */
static lh_observed observed_at(float x, float y, float heading, float swing, float boom, float arm) {
    return (lh_observed){.stepped = true,
                         .outcome = LH_OUTCOME_NONE,
                         .episode = 1,
                         .pose = {x, y, heading},
                         .attitude = lh_quat_about((lh_vec3){0.0f, 0.0f, 1.0f}, heading),
                         .joint_angle = {0.0f, 0.0f, swing, boom, arm},
                         .goal_distance = 2.0f - x,
                         .lateral_error = y,
                         .heading_error = heading};
}

static lh_choice step(lh_planner *p, const lh_observed *observed, bool learns, bool greedy) {
    lh_choice choice;
    lh_planner_step(p, observed, learns, greedy, &choice);
    return choice;
}

static lh_choice step_at(lh_planner *p, float x, float boom) {
    const lh_observed observed = observed_at(x, 0.0f, 0.0f, 0.0f, boom, -1.5f);
    return step(p, &observed, true, false);
}

/* A robot that wanders: states that have nothing to do with what was chosen. */
static lh_observed draw_state(lh_random *random) {
    lh_observed observed =
        observed_at(4.0f * lh_random_uniform(random) - 2.0f, 4.0f * lh_random_uniform(random) - 2.0f,
                    6.28f * lh_random_uniform(random) - 3.14f, 5.4f * lh_random_uniform(random) - 2.7f,
                    2.0f * lh_random_uniform(random) - 0.7f, 2.6f * lh_random_uniform(random) - 2.5f);
    const lh_vec3 axis = {1.0f, 0.0f, 0.0f};
    observed.attitude =
        lh_quat_multiply(observed.attitude, lh_quat_about(axis, 2.0f * lh_random_uniform(random) - 1.0f));
    return observed;
}

/* --- configuration --- */

START_TEST(defaults_are_good) {
    const lh_planner_config config = lh_planner_config_default();
    ck_assert_int_eq(lh_planner_config_validate(&config), LH_OK);
    ck_assert_float_eq(config.decision_period, 0.5f);
    ck_assert(config.mechanics);
}
END_TEST

START_TEST(every_number_has_a_range) {
    const struct {
        size_t offset;
        float low, high;
        lh_error error;
    } reals[] = {{offsetof(lh_planner_config, decision_period), 0.01f, 10.0f, LH_ERROR_PLANNER},
                 {offsetof(lh_planner_config, discount_rate), 0.0f, LH_DISCOUNT_RATE_MAX, LH_ERROR_RATE},
                 {offsetof(lh_planner_config, steering), 0.0f, 100.0f, LH_ERROR_PLANNER},
                 {offsetof(lh_planner_config, unsafe), 0.0f, 100.0f, LH_ERROR_PLANNER},
                 {offsetof(lh_planner_config, caution), 0.0f, 100.0f, LH_ERROR_PLANNER},
                 {offsetof(lh_planner_config, random_share), 0.0f, 1.0f, LH_ERROR_PLANNER}};
    for (int32_t i = 0; i < COUNT(reals); i++) {
        const float good[] = {reals[i].low, reals[i].high};
        const float bad[] = {nextafterf(reals[i].low, -1.0f), nextafterf(reals[i].high, 1000.0f), NAN, -INFINITY};
        for (int32_t k = 0; k < COUNT(good); k++) {
            lh_planner_config config = lh_planner_config_default();
            memcpy((char *)&config + reals[i].offset, &good[k], sizeof good[k]);
            ck_assert_int_eq(lh_planner_config_validate(&config), LH_OK);
        }
        for (int32_t k = 0; k < COUNT(bad); k++) {
            lh_planner_config config = lh_planner_config_default();
            memcpy((char *)&config + reals[i].offset, &bad[k], sizeof bad[k]);
            ck_assert_int_eq(lh_planner_config_validate(&config), reals[i].error);
        }
    }
    const struct {
        size_t offset;
        int32_t low, high;
    } counts[] = {{offsetof(lh_planner_config, candidates), 1, LH_CANDIDATES_MAX},
                  {offsetof(lh_planner_config, sweeps), 0, LH_SWEEPS_MAX},
                  {offsetof(lh_planner_config, backups), 0, LH_BACKUPS_MAX}};
    for (int32_t i = 0; i < COUNT(counts); i++) {
        const int32_t tried[] = {counts[i].low, counts[i].high, counts[i].low - 1, counts[i].high + 1};
        for (int32_t k = 0; k < COUNT(tried); k++) {
            lh_planner_config config = lh_planner_config_default();
            memcpy((char *)&config + counts[i].offset, &tried[k], sizeof tried[k]);
            ck_assert_int_eq(lh_planner_config_validate(&config), k < 2 ? LH_OK : LH_ERROR_PLANNER);
        }
    }
}
END_TEST

START_TEST(a_bad_configuration_changes_nothing) {
    const lh_task task = make_task(&crawler_and_boom);
    lh_planner_config config = quick_config();
    config.backups = -1;
    memset(&planner, 0x5a, sizeof planner);
    memset(&other, 0x5a, sizeof other);
    ck_assert_int_eq(lh_planner_init(&planner, &config, &task, 1), LH_ERROR_PLANNER);
    ck_assert_mem_eq(&planner, &other, sizeof other);
}
END_TEST

START_TEST(sweeps_back_up_every_node_as_often) {
    lh_planner_config config = quick_config();
    config.sweeps = 3;
    init(&planner, &config, &crawler_and_boom, 1);
    init_quick(&other, 1);
    for (int32_t sweep = 0; sweep < 3; sweep++) {
        for (int32_t node = 0; node < other.learned.values.num_nodes; node++) {
            lh_planning_back_up(&other, node);
        }
    }
    ck_assert_mem_eq(&planner.learned.values, &other.learned.values, sizeof other.learned.values);
    ck_assert_int_eq(planner.learned.turn, 0);
}
END_TEST

/* Nodes are two decisions apart. */
START_TEST(the_lattice_follows_speed_and_period) {
    lh_planner_config config = quick_config();
    config.decision_period = 1.0f;
    init(&planner, &config, &crawler_and_boom, 1);
    ck_assert_int_eq(planner.learned.values.num_nodes, 4); /* 1.8 rad by 0.6 */
    init_quick(&planner, 1);
    ck_assert_int_eq(planner.learned.values.num_nodes, 7);
}
END_TEST

/* --- learning --- */

static double in_units(int16_t part) {
    return part / 16384.0;
}

/* Along and across the heading midway, less what was expected. */
START_TEST(it_learns_what_the_step_did) {
    lh_planner_config config = quick_config();
    config.mechanics = false;
    init(&planner, &config, &crawler_and_boom, 1);
    lh_observed observed = observed_at(1.0f, 2.0f, 3.0f, 0.0f, 0.2f, -1.5f);
    observed.stepped = false;
    ck_assert(!step(&planner, &observed, true, false).learned);
    const int32_t action = planner.action;
    const float lift = (float)(planner.planned.level[action][1] - 1);
    /* turned over pi by 0.4 rad, and 0.1 m ahead and 0.05 m to the left by the heading midway; half of the way that the
     * boom was to go, if it was to go at all */
    const double midway = 3.2;
    observed = observed_at((float)(1.0 + 0.1 * cos(midway) - 0.05 * sin(midway)),
                           (float)(2.0 + 0.1 * sin(midway) + 0.05 * cos(midway)), (float)(3.4 - 2.0 * M_PI), 0.0f,
                           0.2f + 0.075f * lift, -1.5f);
    ck_assert(step(&planner, &observed, true, false).learned);
    const lh_motion_model *model = &planner.learned.model;
    ck_assert_int_eq(model->num_samples, 1);
    ck_assert_int_eq(model->action[0], action);
    expect_near(in_units(model->motion[0][0]), 0.1, 1e-4);
    expect_near(in_units(model->motion[1][0]), 0.05, 1e-4);
    expect_near(in_units(model->motion[2][0]), 0.4, 1e-4);
    expect_near(in_units(model->motion[3][0]), lift == 0.0f ? 0.0 : -0.5, 1e-4);
    expect_near(model->posture[0][0] / 512.0, (0.2 + 0.6) / 0.45, 1e-3); /* where it began */
}
END_TEST

START_TEST(what_was_expected_leaves_nothing_to_learn) {
    init_quick(&planner, 1);
    step_at(&planner, 0.0f, 0.2f);
    const lh_twist *t = &planner.expected;
    const float boom = 0.2f + 0.15f * (float)(planner.planned.level[planner.action][1] - 1);
    const double half = 0.5 * t->turn;
    const lh_observed observed =
        observed_at((float)(t->forward * cos(half) - t->sideways * sin(half)),
                    (float)(t->forward * sin(half) + t->sideways * cos(half)), t->turn, 0.0f, boom, -1.5f);
    step(&planner, &observed, true, false);
    for (int32_t k = 0; k < LH_MOTION_PARTS; k++) {
        expect_near(in_units(planner.learned.model.motion[k][0]), 0.0, 1e-4);
    }
}
END_TEST

/* How much of what the boom was told has happened, from 0 to 1, as far as its range lets it. */
START_TEST(the_share_of_motion_of_the_joints) {
    const struct {
        float from, to;
        int8_t level;
        double moved;
    } cases[] = {
        {0.0f, 0.15f, 2, 1.0},
        {0.0f, 0.16f, 2, 1.0},
        {0.0f, 0.3f, 2, 1.0},
        {0.0f, 0.0f, 2, 0.0},
        {0.0f, -0.1f, 2, 0.0},
        {0.0f, -0.05f, 0, 1.0 / 3},
        {1.1f, 1.2f, 2, 1.0},
        {1.1f, 1.15f, 2, 0.5},
        {-0.55f, -0.6f, 0, 1.0},
        {0.0f, 0.1f, 1, 1.0},
        {1.185f, 1.185f, 2, 1.0} /* nothing much was left to go */,
    };
    for (int32_t i = 0; i < COUNT(cases); i++) {
        init_quick(&planner, 1);
        step_at(&planner, 0.0f, cases[i].from);
        const int8_t levels[] = {2, cases[i].level};
        planner.action = lh_action_index(levels, 2);
        step_at(&planner, 0.0f, cases[i].to);
        expect_near(1.0 + in_units(planner.learned.model.motion[3][0]), cases[i].moved, 1e-3);
    }
}
END_TEST

START_TEST(it_learns_from_steps_of_its_own_only) {
    init_quick(&planner, 1);
    ck_assert(!step_at(&planner, 0.0f, 0.2f).learned); /* nothing was chosen before */
    ck_assert(step_at(&planner, 0.1f, 0.2f).learned);
    lh_planner_begin(&planner);
    ck_assert(!step_at(&planner, 0.2f, 0.2f).learned);
    lh_observed observed = observed_at(0.3f, 0.0f, 0.0f, 0.0f, 0.2f, -1.5f);
    observed.stepped = false; /* put elsewhere, says the task */
    ck_assert(!step(&planner, &observed, true, false).learned);
    observed.stepped = true;
    observed.outcome = LH_OUTCOME_TUMBLE;
    ck_assert(!step(&planner, &observed, true, false).learned);
    observed.outcome = LH_OUTCOME_GOAL;
    const lh_motion_model before = planner.learned.model;
    ck_assert(!step(&planner, &observed, false, false).learned);
    ck_assert_mem_eq(&planner.learned.model, &before, sizeof before);
    ck_assert(step(&planner, &observed, true, false).learned);
}
END_TEST

START_TEST(nothing_is_chosen_before_a_reset) {
    init_quick(&planner, 1);
    step_at(&planner, 0.0f, 0.2f);
    lh_observed last = observed_at(0.1f, 0.0f, 0.0f, 0.0f, 0.2f, -1.5f);
    last.outcome = LH_OUTCOME_GOAL;
    last.reset = true;
    const lh_random random = planner.learned.random;
    const lh_choice choice = step(&planner, &last, true, false);
    ck_assert(choice.learned);
    ck_assert_float_eq(choice.probability, 0.0f);
    ck_assert_mem_eq(&planner.learned.random, &random, sizeof random);
    ck_assert_int_eq(planner.learned.decisions, 2);
}
END_TEST

START_TEST(decisions_are_counted_up_to_a_last_one) {
    init_quick(&planner, 1);
    planner.learned.decisions = LH_LAST_DECISION - 1;
    step_at(&planner, 0.0f, 0.2f);
    ck_assert_int_eq(planner.learned.decisions, LH_LAST_DECISION);
    step_at(&planner, 0.0f, 0.2f);
    ck_assert_int_eq(planner.learned.decisions, LH_LAST_DECISION);
}
END_TEST

/* --- ground --- */

START_TEST(it_finds_the_slope_it_lies_on) {
    init_quick(&planner, 1);
    const double slope = 0.14;
    const double heading = 0.5;
    const lh_quat turn = lh_quat_about((lh_vec3){0.0f, 0.0f, 1.0f}, (float)heading);
    lh_observed observed = observed_at(0.0f, 0.0f, (float)heading, 0.0f, 0.6f, -1.0f);
    observed.attitude = lh_quat_multiply(turn, lh_quat_about((lh_vec3){0.0f, 1.0f, 0.0f}, (float)-slope)); /* nose up */
    for (int32_t i = 0; i < 200; i++) {
        step(&planner, &observed, false, true);
    }
    expect_near(planner.learned.ground.x, -sin(slope) * cos(heading), 1e-4);
    expect_near(planner.learned.ground.y, -sin(slope) * sin(heading), 1e-4);
    expect_near(planner.learned.ground.z, cos(slope), 1e-4);
    /* the line is along x of the world: the vertical leans uphill */
    expect_near(planner.up.z, cos(slope), 1e-4);
    expect_near(atan2(planner.up.y, planner.up.x), heading, 0.01);
}
END_TEST

START_TEST(a_body_on_its_side_tells_nothing_of_the_ground) {
    init_quick(&planner, 1);
    lh_observed observed = observed_at(0.0f, 0.0f, 0.0f, 0.0f, 0.6f, -1.0f);
    observed.attitude = lh_quat_about((lh_vec3){1.0f, 0.0f, 0.0f}, 1.1f);
    step(&planner, &observed, true, false);
    ck_assert(planner.learned.ground.x == 0.0f && planner.learned.ground.y == 0.0f && planner.learned.ground.z == 1.0f);
}
END_TEST

/* --- choice --- */

START_TEST(greedy_draws_no_random_number) {
    init_quick(&planner, 1);
    planner.config.random_share = 1.0f;
    const lh_random before = planner.learned.random;
    for (int32_t i = 0; i < 20; i++) {
        const lh_observed observed = observed_at(0.1f * (float)i, 0.0f, 0.0f, 0.0f, 0.2f, -1.5f);
        const lh_choice choice = step(&planner, &observed, true, true);
        ck_assert_float_eq(choice.q, choice.q_max);
        ck_assert_float_eq(choice.probability, 1.0f);
        ck_assert_float_eq(choice.temperature, 0.0f);
    }
    ck_assert_mem_eq(&planner.learned.random, &before, sizeof before);
}
END_TEST

/* Greedy, it keeps to what was tried; while it learns, it does not. */
START_TEST(greedy_is_cautious) {
    for (int32_t i = 0; i < 2; i++) {
        init_quick(&planner, 1);
        planner.config.random_share = 0.0f;
        planner.config.caution = 100.0f;
        const lh_observed observed = observed_at(0.0f, 0.0f, 0.0f, 0.0f, 0.2f, -1.5f);
        const int32_t tried = 0; /* reverse, while the boom goes down */
        const float boom = 0.2f;
        lh_motion_model_insert(&planner.learned.model, tried, &boom, &(lh_motion){.forward = 0.0f}, 0);
        const int32_t action = step(&planner, &observed, false, i == 0).action;
        ck_assert_int_eq(action == tried, i == 0);
    }
}
END_TEST

START_TEST(without_progress_chance_helps) {
    init_quick(&planner, 1);
    const lh_random before = planner.learned.random;
    lh_observed observed = observed_at(0.0f, 0.0f, 0.0f, 0.0f, 0.2f, -1.5f);
    observed.stepped = false;
    for (int32_t i = 0; i < 25; i++) { /* the first sees that an episode begins */
        step(&planner, &observed, true, true);
        observed.stepped = i != 10; /* a step that was forgotten begins no episode */
        observed.step++;
    }
    ck_assert_int_eq(planner.stalled, 24);
    ck_assert_mem_eq(&planner.learned.random, &before, sizeof before);
    step(&planner, &observed, true, true);
    ck_assert_mem_ne(&planner.learned.random, &before, sizeof before);
    step(&planner, &observed, true, true);
    ck_assert_int_eq(planner.stalled, 25);
    observed.goal_distance -= 0.06f;
    step(&planner, &observed, true, true);
    ck_assert_int_eq(planner.stalled, 0);
    step(&planner, &observed, true, true);
    observed.outcome = LH_OUTCOME_GOAL; /* another episode begins here */
    observed.step = 0;
    observed.goal_distance = 2.0f;
    step(&planner, &observed, true, true);
    ck_assert_int_eq(planner.stalled, 0);
    ck_assert_float_eq(planner.best_distance, 2.0f);
}
END_TEST

START_TEST(random_actions_are_allowed_ones) {
    init_quick(&planner, 1);
    planner.config.random_share = 1.0f;
    int32_t taken[9] = {0};
    for (int32_t i = 0; i < 200; i++) {
        const lh_observed observed = observed_at(0.1f * (float)i, 0.0f, 0.0f, 0.0f, 1.19f, -1.5f);
        taken[step(&planner, &observed, true, false).action]++;
    }
    for (int32_t a = 0; a < 9; a++) { /* all but standing still and lifting the boom, alike */
        ck_assert_int_eq(taken[a] > 0, a < 6 && a != 4);
        ck_assert_int_lt(taken[a], 70);
    }
}
END_TEST

/* The joints left: a range so small that both of its limits are near. */
START_TEST(where_nothing_is_allowed_it_stands_still) {
    const lh_controlled controlled = {.count = 1, .index = {BOOM}};
    lh_task task = make_task(&controlled);
    task.robot.actuators[BOOM].high = -0.55f;
    const lh_planner_config config = quick_config();
    ck_assert_int_eq(lh_planner_init(&planner, &config, &task, 1), LH_OK);
    for (int32_t i = 0; i < 2; i++) {
        planner.config.random_share = (float)i;
        ck_assert_int_eq(step_at(&planner, 0.0f, -0.575f).action, 1);
        ck_assert_int_eq(step_at(&planner, 0.0f, -0.575f).action, 1);
    }
}
END_TEST

/* Whatever the states, what comes out is finite and can be saved and restored. */
START_TEST(any_states_give_numbers) {
    const lh_planner_config config = quick_config();
    const lh_controlled controlled = crawler_controlled();
    init(&planner, &config, &controlled, 1);
    init(&other, &config, &controlled, 1);
    lh_random random;
    lh_random_init(&random, 3);
    for (int32_t i = 0; i < 300; i++) {
        lh_observed observed = draw_state(&random);
        observed.stepped = i % 7 != 0;
        observed.outcome = (lh_outcome)(i % 11 < 4 ? i % 11 : 0);
        observed.reset = i % 50 == 3;
        const lh_choice choice = step(&planner, &observed, true, false);
        ck_assert(lh_finite(choice.q) && choice.q == choice.q_max);
        ck_assert(choice.action >= 0 && choice.action < 81);
        if (observed.reset) {
            lh_planner_begin(&planner);
        }
    }
    ck_assert_int_gt(planner.learned.model.num_samples, 100);
    lh_planner_save(&planner, &learned);
    ck_assert_int_eq(lh_planner_restore(&other, &learned), LH_OK);
}
END_TEST

/* --- reproduction --- */

/* Draws a walk in which a reset is asked for where the step is a multiple of 20. */
static void walk(lh_planner *p, lh_random *random, int32_t steps, int32_t *actions) {
    for (int32_t i = 0; i < steps; i++) {
        lh_observed observed = draw_state(random);
        observed.reset = i % 20 == 19;
        observed.stepped = i % 20 != 0;
        actions[i] = step(p, &observed, true, false).action;
        if (observed.reset) {
            lh_planner_begin(p);
        }
    }
}

enum { STEPS = 60 };

START_TEST(equal_seeds_give_equal_bytes) {
    lh_planner *const both[] = {&planner, &other};
    int32_t actions[2][STEPS];
    for (int32_t i = 0; i < 2; i++) {
        lh_random random;
        lh_random_init(&random, 5);
        memset(both[i], i == 0 ? 0x5a : 0, sizeof *both[i]);
        init_quick(both[i], 1);
        both[i]->config.random_share = 0.5f;
        walk(both[i], &random, STEPS, actions[i]);
    }
    ck_assert_mem_eq(&planner.learned, &other.learned, sizeof other.learned);
    ck_assert_mem_eq(actions[0], actions[1], sizeof actions[0]);
    lh_random random;
    lh_random_init(&random, 5);
    init_quick(&other, 2);
    other.config.random_share = 0.5f;
    walk(&other, &random, STEPS, actions[1]);
    ck_assert_mem_ne(actions[0], actions[1], sizeof actions[0]);
}
END_TEST

START_TEST(what_was_saved_goes_on_bit_by_bit) {
    int32_t actions[2][STEPS];
    lh_random random;
    lh_random_init(&random, 6);
    init_quick(&planner, 1);
    walk(&planner, &random, STEPS, actions[0]);
    lh_planner_save(&planner, &learned);

    init_quick(&other, 9);
    step_at(&other, 0.0f, 0.2f); /* forgotten by restoring */
    ck_assert_int_eq(lh_planner_restore(&other, &learned), LH_OK);
    ck_assert(!other.acting);
    lh_random again = random;
    walk(&planner, &random, STEPS, actions[0]);
    walk(&other, &again, STEPS, actions[1]);
    ck_assert_mem_eq(actions[0], actions[1], sizeof actions[0]);
    ck_assert_mem_eq(&planner.learned, &other.learned, sizeof other.learned);
}
END_TEST

static void expect_refused(lh_error error) {
    static lh_planner before;
    before = planner;
    ck_assert_int_eq(lh_planner_restore(&planner, &learned), error);
    ck_assert_mem_eq(&planner, &before, sizeof before);
}

START_TEST(what_is_out_of_range_is_not_restored) {
    init_quick(&planner, 1);
    step_at(&planner, 0.0f, 0.2f);
    const lh_planner_learned good = planner.learned;
    learned = good;
    learned.model.num_samples = -1;
    expect_refused(LH_ERROR_PLANNER);
    learned = good;
    learned.values.num_nodes--;
    expect_refused(LH_ERROR_PLANNER);
    const int32_t bad_turn[] = {-1, good.values.num_nodes};
    const int32_t bad_decisions[] = {-1, LH_LAST_DECISION + 1};
    const lh_vec3 bad_ground[] = {{1.1f, 0.0f, 0.6f},  {0.0f, -1.1f, 0.6f}, {0.9f, 0.0f, 0.43588989f},
                                  {0.0f, 0.0f, 1.01f}, {0.5f, 0.0f, 0.6f},  {0.9f, 0.0f, 0.9f},
                                  {NAN, 0.0f, 1.0f}};
    for (int32_t i = 0; i < 2; i++) {
        learned = good;
        learned.turn = bad_turn[i];
        expect_refused(LH_ERROR_PLANNER);
        learned = good;
        learned.decisions = bad_decisions[i];
        expect_refused(LH_ERROR_PLANNER);
    }
    for (int32_t i = 0; i < COUNT(bad_ground); i++) {
        learned = good;
        learned.ground = bad_ground[i];
        expect_refused(LH_ERROR_PLANNER);
    }
    learned = good;
    memset(learned.random.s, 0, sizeof learned.random.s);
    expect_refused(LH_ERROR_RANDOM_STATE);
    learned = good;
    learned.turn = good.values.num_nodes - 1;
    learned.decisions = LH_LAST_DECISION;
    ck_assert_int_eq(lh_planner_restore(&planner, &learned), LH_OK);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("planner");
    TCase *t = tcase_create("configuration");
    tcase_add_test(t, defaults_are_good);
    tcase_add_test(t, every_number_has_a_range);
    tcase_add_test(t, a_bad_configuration_changes_nothing);
    tcase_add_test(t, sweeps_back_up_every_node_as_often);
    tcase_add_test(t, the_lattice_follows_speed_and_period);
    suite_add_tcase(s, t);
    t = tcase_create("learning");
    tcase_add_test(t, it_learns_what_the_step_did);
    tcase_add_test(t, what_was_expected_leaves_nothing_to_learn);
    tcase_add_test(t, the_share_of_motion_of_the_joints);
    tcase_add_test(t, it_learns_from_steps_of_its_own_only);
    tcase_add_test(t, nothing_is_chosen_before_a_reset);
    tcase_add_test(t, decisions_are_counted_up_to_a_last_one);
    suite_add_tcase(s, t);
    t = tcase_create("ground");
    tcase_add_test(t, it_finds_the_slope_it_lies_on);
    tcase_add_test(t, a_body_on_its_side_tells_nothing_of_the_ground);
    suite_add_tcase(s, t);
    t = tcase_create("choice");
    tcase_add_test(t, greedy_draws_no_random_number);
    tcase_add_test(t, greedy_is_cautious);
    tcase_add_test(t, without_progress_chance_helps);
    tcase_add_test(t, random_actions_are_allowed_ones);
    tcase_add_test(t, where_nothing_is_allowed_it_stands_still);
    tcase_add_test(t, any_states_give_numbers);
    suite_add_tcase(s, t);
    t = tcase_create("reproduction");
    tcase_add_test(t, equal_seeds_give_equal_bytes);
    tcase_add_test(t, what_was_saved_goes_on_bit_by_bit);
    tcase_add_test(t, what_is_out_of_range_is_not_restored);
    suite_add_tcase(s, t);
    return s;
}
