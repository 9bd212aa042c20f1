#include "limphome/controller.h"

#include "steps.h"

/* Too large for some stacks. */
static lh_controller controller;
static lh_controller other;

/* A toy plant: crawler and arm do what they are told, only one crawler pulls, and a raised boom topples it. */
typedef struct toy {
    float x, y, heading;
    float joint[3];
    float torque;
} toy;

static toy toy_start(void) {
    return (toy){.heading = facing_y, .joint = {0.0f, 0.6f, -1.5f}};
}

static lh_state toy_state(const toy *p) {
    lh_state state = crawler_state(p->x, p->y, p->heading);
    memcpy(&state.actuator_position[2], p->joint, sizeof p->joint);
    state.actuator_effort[1] = p->torque;
    const float roll = p->joint[1] > 1.15f ? 1.2f : 0.1f * p->joint[0];
    state.orientation = lh_quat_multiply(state.orientation, lh_quat_about((lh_vec3){1, 0, 0}, roll));
    return state;
}

static void toy_move(toy *p, const float *velocity) {
    const float travel = 0.5f * velocity[1];
    p->x += travel * lh_cos(p->heading);
    p->y += travel * lh_sin(p->heading);
    p->heading = lh_wrap_angle(p->heading + 0.2f * travel * (1.0f - p->joint[0]));
    p->torque = 1000.0f * velocity[1];
    const float low[] = {-2.6f, -0.6f, -2.4f};
    const float high[] = {2.6f, 1.2f, 0.0f};
    for (int32_t k = 0; k < 3; k++) {
        p->joint[k] = fminf(fmaxf(p->joint[k] + 0.5f * velocity[2 + k], low[k]), high[k]);
    }
}

/* One turn of the loop of controller.h. */
static lh_decision toy_turn(lh_controller *c, toy *plant) {
    const lh_state state = toy_state(plant);
    const lh_decision decision = step(c, &state);
    if (decision.observed.reset) {
        *plant = toy_start();
    } else {
        toy_move(plant, decision.velocity);
    }
    return decision;
}

START_TEST(without_learning_the_network_stays) {
    lh_config config = lh_config_default();
    config.learner.learn = false;
    config.learner.q_learning.network.initial_weight = 0.3f;
    init(&controller, &config);
    const lh_network before = controller.learner.as.q_learning.network;
    toy plant = toy_start();
    for (int32_t i = 0; i < 500; i++) {
        const lh_decision d = toy_turn(&controller, &plant);
        ck_assert(!d.choice.learned);
        ck_assert_float_eq(d.choice.td_error, 0.0f);
    }
    ck_assert_mem_eq(network_of(&controller), &before, sizeof before);
    ck_assert_int_gt(controller.task.episode.number, 1);
}
END_TEST

START_TEST(greedy_takes_a_best_action) {
    lh_config config = lh_config_default();
    config.learner.greedy = true;
    init(&controller, &config);
    const lh_random before = controller.learner.as.q_learning.random;
    toy plant = toy_start();
    for (int32_t i = 0; i < 300; i++) {
        const lh_decision d = toy_turn(&controller, &plant);
        if (!d.observed.reset) {
            ck_assert_float_eq(d.choice.q, d.choice.q_max);
            ck_assert_float_eq(d.choice.probability, 1.0f);
        }
    }
    ck_assert_mem_eq(&controller.learner.as.q_learning.random, &before, sizeof before);
}
END_TEST

/* As a function of the states alone: equal seeds give equal bytes, others do not. */
START_TEST(equal_runs_are_equal_bit_by_bit) {
    lh_config config = lh_config_default();
    init(&controller, &config);
    init(&other, &config);
    toy a = toy_start();
    toy b = toy_start();
    for (int32_t i = 0; i < 2000; i++) {
        const lh_decision da = toy_turn(&controller, &a);
        const lh_decision db = toy_turn(&other, &b);
        ck_assert_mem_eq(&da, &db, sizeof da);
    }
    ck_assert_mem_eq(&controller, &other, sizeof other);
    config.learner.seed = 2;
    init(&other, &config);
    ck_assert_mem_ne(network_of(&controller), network_of(&other), sizeof other.learner.as.q_learning.network);
}
END_TEST

/* Saved where a reset was asked for, then both go on: the unbroken run, and a fresh controller that is restored. */
START_TEST(restored_run_is_equal_bit_by_bit) {
    lh_config config = lh_config_default();
    config.task.episode.reset_every = 4;
    config.task.episode.step_limit = 30;
    init(&controller, &config);
    toy a = toy_start();
    lh_decision d = {.observed = {.reset = false}};
    int32_t resets = 0;
    for (int32_t i = 0; resets < 3 && i < 10000; i++) {
        d = toy_turn(&controller, &a);
        resets += d.observed.reset && d.observed.summary.number % 4 == 0;
    }
    ck_assert_int_eq(resets, 3);
    lh_learned learned;
    lh_learner_save(&controller.learner, &learned);

    init(&other, &config);
    ck_assert_int_eq(lh_controller_restore(&other, &learned, d.observed.summary.number + 1), LH_OK);
    toy b = toy_start();
    for (int32_t i = 0; i < 1000; i++) {
        const lh_decision da = toy_turn(&controller, &a);
        const lh_decision db = toy_turn(&other, &b);
        ck_assert_mem_eq(&da, &db, sizeof da);
    }
    ck_assert_mem_eq(network_of(&controller), network_of(&other), sizeof(lh_network));
    ck_assert_mem_eq(&controller.learner.as.q_learning.random, &other.learner.as.q_learning.random,
                     sizeof other.learner.as.q_learning.random);
    ck_assert_mem_eq(&controller.task.episode, &other.task.episode, sizeof other.task.episode);
}
END_TEST

/* A reward for driving forward must show: after learning on the toy, the greedy policy drives forward. */
START_TEST(learns_to_drive_forward) {
    lh_config config = lh_config_default();
    config.learner.q_learning.learning_rate = 1.0f;
    config.learner.q_learning.network.exact_gradient = true;
    config.learner.q_learning.network.rate_weight = 0.05f;
    config.learner.q_learning.network.rate_centre = config.learner.q_learning.network.rate_width = 0.0f;
    config.task.reward.tumble = -1.0f;
    init(&controller, &config);
    toy plant = toy_start();
    for (int32_t i = 0; i < 6000; i++) {
        toy_turn(&controller, &plant);
    }
    controller.learner.greedy = true;
    controller.learner.learn = false;
    lh_controller_begin(&controller);
    plant = toy_start();
    int32_t forward = 0;
    for (int32_t i = 0; i < 100; i++) {
        forward += toy_turn(&controller, &plant).velocity[1] > 0.0f;
    }
    ck_assert_int_ge(forward, 90);
}
END_TEST

/* --- a planner, on a robot that obeys mechanics --- */

/* Moves as quasi-static mechanics says, but that it veers to the right by 0.02 rad in each decision and gets only 0.8
 * of the way: what no planner can know before it measures. */
static void quasi_static_move(toy *p, const lh_controller *c, const float *velocity) {
    const lh_vec3 level = {0.0f, 0.0f, 1.0f};
    const lh_planned *planned = &c->learner.as.planner.planned;
    const float angle[LH_MAX_ACTUATORS] = {0.0f, 0.0f, p->joint[0], p->joint[1], p->joint[2]};
    float share[LH_MAX_ACTUATORS] = {0.0f};
    for (int32_t k = 0; k < 5; k++) {
        share[k] = 0.5f * velocity[k] / planned->travel[k];
    }
    lh_rest rest;
    lh_footing footing;
    lh_rest_find(&c->task.robot, angle, level, &rest);
    lh_footing_find(&c->task.robot, angle, &rest, level, planned->travel, 0.7f, &footing);
    const lh_twist t = lh_quasi_static_motion(&footing, 5, share);
    const float midway = p->heading + 0.5f * t.turn;
    p->x += 0.8f * (t.forward * lh_cos(midway) - t.sideways * lh_sin(midway));
    p->y += 0.8f * (t.forward * lh_sin(midway) + t.sideways * lh_cos(midway));
    p->heading = lh_wrap_angle(p->heading + t.turn - 0.02f);
    toy still = *p;
    toy_move(&still, velocity);
    memcpy(p->joint, still.joint, sizeof p->joint);
}

static lh_state lying_state(const toy *p, const lh_controller *c) {
    lh_state state = crawler_state(p->x, p->y, p->heading);
    memcpy(&state.actuator_position[2], p->joint, sizeof p->joint);
    const float angle[LH_MAX_ACTUATORS] = {0.0f, 0.0f, p->joint[0], p->joint[1], p->joint[2]};
    lh_rest rest;
    lh_rest_find(&c->task.robot, angle, (lh_vec3){0.0f, 0.0f, 1.0f}, &rest);
    state.orientation = lh_quat_multiply(state.orientation, lh_rest_upright(rest.normal));
    return state;
}

static lh_decision quasi_static_turn(lh_controller *c, toy *plant) {
    const lh_state state = lying_state(plant, c);
    const lh_decision decision = step(c, &state);
    if (decision.observed.reset) {
        *plant = toy_start();
    } else {
        quasi_static_move(plant, c, decision.velocity);
    }
    return decision;
}

static lh_config planner_config(void) {
    lh_config config = lh_config_default();
    config.learner.kind = LH_PLANNER;
    config.learner.planner.sweeps = 3;
    config.task.episode.step_limit = 100;
    return config;
}

/* The left crawler does not turn; what the others do must bring it straight ahead. */
START_TEST(a_planner_learns_to_go_straight) {
    const lh_config config = planner_config();
    init(&controller, &config);
    toy plant = toy_start();
    int32_t goals = 0;
    float lateral = 0.0f;
    for (int32_t i = 0; goals < 8 && i < 400; i++) {
        const lh_decision d = quasi_static_turn(&controller, &plant);
        goals += d.observed.outcome == LH_OUTCOME_GOAL;
        lateral = d.observed.outcome == LH_OUTCOME_GOAL ? d.observed.summary.lateral_error : lateral;
    }
    ck_assert_int_eq(goals, 8);
    ck_assert_float_lt(lateral * lateral, 0.15f * 0.15f);
}
END_TEST

START_TEST(a_restored_planner_is_equal_bit_by_bit) {
    lh_config config = planner_config();
    config.learner.planner.sweeps = 0;
    config.task.episode.reset_every = 1;
    config.task.episode.step_limit = 10;
    init(&controller, &config);
    toy a = toy_start();
    lh_decision d = {.observed = {.reset = false}};
    for (int32_t i = 0; d.observed.episode < 3 || !d.observed.reset; i++) {
        ck_assert_int_lt(i, 100);
        d = quasi_static_turn(&controller, &a);
    }
    static lh_learned learned;
    lh_learner_save(&controller.learner, &learned);
    init(&other, &config);
    ck_assert_int_eq(lh_controller_restore(&other, &learned, d.observed.summary.number + 1), LH_OK);
    toy b = toy_start();
    for (int32_t i = 0; i < 30; i++) {
        const lh_decision da = quasi_static_turn(&controller, &a);
        const lh_decision db = quasi_static_turn(&other, &b);
        ck_assert_mem_eq(&da, &db, sizeof da);
    }
    ck_assert_mem_eq(&controller.learner.as.planner.learned, &other.learner.as.planner.learned,
                     sizeof(lh_planner_learned));
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("runs");
    TCase *t = tcase_create("runs on a toy plant");
    tcase_add_test(t, without_learning_the_network_stays);
    tcase_add_test(t, greedy_takes_a_best_action);
    tcase_add_test(t, learns_to_drive_forward);
    suite_add_tcase(s, t);
    t = tcase_create("reproduction");
    tcase_add_test(t, equal_runs_are_equal_bit_by_bit);
    tcase_add_test(t, restored_run_is_equal_bit_by_bit);
    suite_add_tcase(s, t);
    t = tcase_create("planner");
    tcase_add_test(t, a_planner_learns_to_go_straight);
    tcase_add_test(t, a_restored_planner_is_equal_bit_by_bit);
    suite_add_tcase(s, t);
    return s;
}
