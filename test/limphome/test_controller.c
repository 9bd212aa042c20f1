#include "limphome/controller.h"

#include <float.h>
#include <stddef.h>

#include "limphome/task/action.h"
#include "reference.h"
#include "steps.h"

/* Too large for some stacks. */
static lh_controller controller;
static lh_controller other;

/* Q of what was chosen, by `network`. */
static float value(const lh_network *network, const lh_decision *d) {
    float x[LH_MAX_INPUTS];
    lh_activation at;
    memcpy(x, d->observed.inputs, sizeof d->observed.inputs);
    lh_action_inputs(d->choice.action, 4, x + d->observed.num_inputs);
    return lh_network_value(network, x, &at);
}

START_TEST(defaults_are_those_of_the_paper) {
    const lh_config config = lh_config_default();
    ck_assert(config.learner.learn && !config.learner.greedy);
    ck_assert_float_eq(config.task.crawler_speed, 0.3f);
    ck_assert_float_eq(config.task.joint_speed, 0.3f);
    ck_assert_int_eq(lh_config_validate(&config), LH_OK);
}
END_TEST

START_TEST(bad_fields_are_named) {
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    memset(&controller, 0x5a, sizeof controller);
    memset(&other, 0x5a, sizeof other);
#define BAD(field, value, error)                                                                \
    do {                                                                                        \
        lh_config config = lh_config_default();                                                 \
        config.field = value;                                                                   \
        ck_assert_int_eq(lh_config_validate(&config), error);                                   \
        ck_assert_int_eq(lh_controller_init(&controller, &config, &robot, &controlled), error); \
        ck_assert_mem_eq(&controller, &other, sizeof controller);                               \
    } while (0)
    BAD(task.crawler_speed, 0.0f, LH_ERROR_SPEED);
    BAD(task.crawler_speed, NAN, LH_ERROR_SPEED);
    BAD(task.joint_speed, 2.1f, LH_ERROR_SPEED);
    BAD(learner.q_learning.temperature_floor, 0.0f, LH_ERROR_LIMIT);
    BAD(learner.q_learning.temperature_floor, 11.0f, LH_ERROR_LIMIT);
    BAD(learner.q_learning.learning_rate, -0.1f, LH_ERROR_RATE);
    BAD(learner.q_learning.network.units, 0, LH_ERROR_UNITS);
    BAD(learner.q_learning.network.width_floor, 0.0f, LH_ERROR_LIMIT);
    BAD(learner.q_learning.network.initial_weight, INFINITY, LH_ERROR_INITIAL);
    BAD(task.reward.tumble, 1.0f, LH_ERROR_REWARD);
    BAD(task.episode.step_limit, 0, LH_ERROR_EPISODE);
#undef BAD
}
END_TEST

START_TEST(controlled_actuators_must_ascend_within_the_robot) {
    const lh_config config = lh_config_default();
    lh_robot robot = crawler_robot();
    const lh_controlled bad[] = {
        {.count = 0},
        {.count = -1},
        {.count = 6, .index = {0, 1, 2, 3, 4, 5}},
        {.count = 2, .index = {2, 1}},
        {.count = 2, .index = {2, 2}},
        {.count = 1, .index = {5}},
        {.count = 1, .index = {-1}},
        {.count = INT32_MAX},
    };
    memset(&controller, 0x5a, sizeof controller);
    memset(&other, 0x5a, sizeof other);
    for (int32_t k = 0; k < COUNT(bad); k++) {
        ck_assert_int_eq(lh_controller_init(&controller, &config, &robot, &bad[k]), LH_ERROR_ACTUATORS);
    }
    const lh_controlled controlled = crawler_controlled();
    robot.links[1].mass = NAN;
    ck_assert_int_eq(lh_controller_init(&controller, &config, &robot, &controlled), LH_ERROR_ROBOT);
    ck_assert_mem_eq(&controller, &other, sizeof controller);
}
END_TEST

START_TEST(first_decision) {
    const lh_config config = lh_config_default();
    init(&controller, &config);
    const lh_decision d = step_at(&controller, 3.0f, 4.0f);
    ck_assert(!d.observed.stepped && !d.choice.learned && d.observed.outcome == LH_OUTCOME_NONE && !d.observed.reset);
    ck_assert_int_eq(d.observed.episode, 1);
    ck_assert_int_eq(d.observed.step, 0);
    ck_assert_int_eq(d.observed.num_inputs, 6);
    expect_near(d.observed.goal_distance, 2.0, 1e-6);
    expect_near(d.observed.lateral_error, 0.0, 1e-6);
    expect_near(d.choice.temperature, temperature[0], 1e-5);
    expect_near(d.observed.stability_margin, initial_margin[0], 2e-6);
    expect_near(d.choice.probability, 1.0 / 81.0, 1e-7); /* all Q are 0 */
    ck_assert_float_eq(d.velocity[0], 0.0f);             /* the failed crawler */
    int8_t levels[4];
    lh_action_levels(d.choice.action, 4, levels);
    for (int32_t k = 0; k < 4; k++) {
        ck_assert_float_eq(d.velocity[k + 1], lh_action_velocity(levels[k], 0.3f));
    }
}
END_TEST

START_TEST(crawlers_and_joints_have_their_own_speed) {
    lh_config config = lh_config_default();
    config.task.crawler_speed = 0.5f;
    config.task.joint_speed = 0.25f;
    init(&controller, &config);
    bool seen[2][3] = {{false}};
    for (int32_t i = 0; i < 200; i++) {
        const lh_decision d = step_at(&controller, 0.0f, 0.0f);
        for (int32_t k = 1; k < 5; k++) {
            const float speed = k == 1 ? 0.5f : 0.25f;
            const int32_t level = (int32_t)(d.velocity[k] / speed) + 1;
            ck_assert_float_eq(d.velocity[k], (float)(level - 1) * speed);
            seen[k == 1][level] = true;
        }
    }
    for (int32_t i = 0; i < 6; i++) {
        ck_assert(seen[i / 3][i % 3]);
    }
}
END_TEST

/* Q, target and TD error of one ordinary step, from the library's own parts. */
START_TEST(one_step_is_rewarded_and_learned) {
    lh_config config = lh_config_default();
    config.learner.q_learning.network.initial_weight = 0.3f;
    init(&controller, &config);
    const lh_decision first = step_at(&controller, 0.0f, 0.0f);
    const lh_network before = controller.learner.as.q_learning.network;
    float states[LH_MAX_STATE_INPUTS];
    memcpy(states, first.observed.inputs, sizeof states);

    lh_state state = crawler_state(0.05f, 0.1f, facing_y + 0.02f);
    state.actuator_effort[1] = 640.0f;
    const lh_decision d = step(&controller, &state);
    ck_assert(d.observed.stepped && d.choice.learned && d.observed.outcome == LH_OUTCOME_NONE);
    ck_assert_int_eq(d.observed.step, 1);
    expect_near(d.observed.reward.motion, 8 * 0.1 - 2 * 0.05 - 10 * 0.02, 1e-5);
    expect_near(d.observed.reward.stability, -exp(-d.observed.stability_margin), 1e-6);
    ck_assert_float_eq(d.observed.reward.goal, 0.0f);
    ck_assert_float_eq(d.observed.reward.tumble, 0.0f);
    expect_near(d.observed.goal_distance, 1.9, 1e-6);
    expect_near(d.observed.lateral_error, -0.05, 1e-6);

    /* the target from the network as it was */
    other = controller;
    other.learner.as.q_learning.network = before;
    const float q_max = lh_q_learning_evaluate(&other.learner.as.q_learning, d.observed.inputs);
    const float expected = lh_reward_total(&d.observed.reward) + 0.9f * q_max - value(&before, &first);
    expect_near(d.choice.td_error, expected, 1e-6);
    lh_q_learning_learn(&other.learner.as.q_learning, states, first.choice.action, lh_reward_total(&d.observed.reward),
                        q_max, false);
    ck_assert_mem_eq(network_of(&other), network_of(&controller), sizeof before);
    ck_assert_mem_ne(&before, network_of(&controller), sizeof before);

    /* the choice from the network as it is now */
    ck_assert_float_eq(d.choice.q_max, lh_q_learning_evaluate(&other.learner.as.q_learning, d.observed.inputs));
}
END_TEST

START_TEST(goal_is_terminal_and_the_next_line_lies_ahead) {
    lh_config config = lh_config_default();
    config.learner.q_learning.network.initial_weight = 0.3f;
    init(&controller, &config);
    const lh_decision first = step_at(&controller, 0.0f, 0.0f);
    const float q = value(network_of(&controller), &first);
    const lh_state state = crawler_state(-0.3f, 2.1f, facing_y + 0.5f);
    const lh_decision d = step(&controller, &state);
    ck_assert(d.observed.stepped && d.choice.learned && d.observed.outcome != LH_OUTCOME_NONE && !d.observed.reset);
    expect_near(d.observed.reward.goal, 10.0 * exp(-0.3), 1e-5);
    expect_near(d.choice.td_error, (double)lh_reward_total(&d.observed.reward) - q, 1e-5); /* no next state */
    ck_assert_int_eq(d.observed.summary.number, 1);
    ck_assert_int_eq(d.observed.summary.outcome, LH_OUTCOME_GOAL);
    ck_assert_int_eq(d.observed.summary.steps, 1);
    expect_near(d.observed.summary.lateral_error, 0.3, 1e-6);
    expect_near(d.observed.summary.heading_change, 0.5, 1e-6);
    expect_near(lh_learner_temperature(&controller.learner, 1), temperature[0], 1e-5);
    ck_assert_float_eq(d.observed.summary.goal_distance, 2.0f);
    ck_assert_float_eq(d.observed.summary.start.y, 0.0f);
    ck_assert_float_eq(lh_reward_total(&d.observed.summary.total), lh_reward_total(&d.observed.reward));

    /* episode 2 has begun here, along the new heading */
    ck_assert_int_eq(d.observed.episode, 2);
    ck_assert_int_eq(d.observed.step, 0);
    expect_near(d.observed.goal_distance, 2.0, 1e-6);
    expect_near(d.choice.temperature, temperature[1], 1e-5);
    const lh_state ahead = crawler_state(-0.3f - (float)sin(0.5), 2.1f + (float)cos(0.5), facing_y + 0.5f);
    const lh_decision next = step(&controller, &ahead);
    ck_assert(next.observed.stepped && next.observed.outcome == LH_OUTCOME_NONE);
    expect_near(next.observed.goal_distance, 1.0, 1e-5);
    expect_near(next.observed.lateral_error, 0.0, 1e-5);
    expect_near(next.observed.reward.motion, 8.0, 1e-4);
}
END_TEST

START_TEST(tumble_is_punished_terminal_and_reset) {
    lh_config config = lh_config_default();
    config.learner.q_learning.network.initial_weight = 0.3f;
    init(&controller, &config);
    const lh_decision first = step_at(&controller, 0.0f, 0.0f);
    const float q = value(network_of(&controller), &first);
    const lh_state tumbled = tumbled_state((lh_vec3){1, 0, 0});
    const lh_decision d = step(&controller, &tumbled);
    ck_assert(d.observed.stepped && d.choice.learned && d.observed.outcome != LH_OUTCOME_NONE && d.observed.reset);
    ck_assert_int_eq(d.observed.summary.outcome, LH_OUTCOME_TUMBLE);
    ck_assert_float_eq(d.observed.reward.tumble, -10.0f);
    expect_near(d.observed.reward.motion, 4.0, 1e-5); /* in addition to the step's own */
    ck_assert_float_lt(d.observed.reward.stability, -1.0f);
    ck_assert_float_lt(d.observed.stability_margin, 0.0f);
    expect_near(d.choice.td_error, (double)lh_reward_total(&d.observed.reward) - q, 1e-5);
    ck_assert_int_eq(d.observed.episode, 1);
    ck_assert_int_eq(d.observed.num_inputs, 6);
    for (int32_t k = 0; k < LH_MAX_ACTUATORS; k++) {
        ck_assert_float_eq(d.velocity[k], 0.0f);
    }

    /* the next state begins episode 2; nothing is learned from the way there */
    const lh_network before = controller.learner.as.q_learning.network;
    const lh_decision next = step_at(&controller, 7.0f, 7.0f);
    ck_assert(!next.observed.stepped && !next.choice.learned && next.observed.outcome == LH_OUTCOME_NONE &&
              !next.observed.reset);
    ck_assert_int_eq(next.observed.episode, 2);
    expect_near(next.observed.goal_distance, 2.0, 1e-6);
    ck_assert_mem_eq(network_of(&controller), &before, sizeof before);
}
END_TEST

START_TEST(tumbles_to_every_side) {
    const lh_config config = lh_config_default();
    const lh_vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    for (int32_t k = 0; k < COUNT(axes); k++) {
        init(&controller, &config);
        step_at(&controller, 0.0f, 0.0f);
        const lh_state tumbled = tumbled_state(axes[k]);
        ck_assert_int_eq(step(&controller, &tumbled).observed.summary.outcome, LH_OUTCOME_TUMBLE);
    }
}
END_TEST

START_TEST(timeout_goes_on_bootstrapping) {
    lh_config config = lh_config_default();
    config.learner.q_learning.network.initial_weight = 0.3f;
    config.task.episode.step_limit = 2;
    init(&controller, &config);
    step_at(&controller, 0.0f, 0.0f);
    const lh_decision first = step_at(&controller, 0.0f, 0.1f);
    ck_assert(first.observed.outcome == LH_OUTCOME_NONE);
    other = controller;
    const float q = value(network_of(&other), &first);
    const lh_decision d = step_at(&controller, 0.0f, 0.2f);
    ck_assert(d.observed.outcome != LH_OUTCOME_NONE && !d.observed.reset);
    ck_assert_int_eq(d.observed.summary.outcome, LH_OUTCOME_TIMEOUT);
    ck_assert_int_eq(d.observed.summary.steps, 2);
    const float q_max = lh_q_learning_evaluate(&other.learner.as.q_learning, d.observed.inputs);
    expect_near(d.choice.td_error, lh_reward_total(&d.observed.reward) + 0.9 * q_max - q, 1e-5);
    expect_near(lh_reward_total(&d.observed.summary.total),
                (double)lh_reward_total(&first.observed.reward) + lh_reward_total(&d.observed.reward), 1e-5);
    ck_assert_int_eq(d.observed.episode, 2);
}
END_TEST

START_TEST(reset_every_so_many_episodes) {
    lh_config config = lh_config_default();
    config.task.episode.reset_every = 3;
    config.task.episode.step_limit = 1;
    init(&controller, &config);
    step_at(&controller, 0.0f, 0.0f);
    for (int32_t number = 1; number <= 9; number++) {
        const lh_decision d = step_at(&controller, 0.0f, 0.0f);
        ck_assert(d.observed.outcome != LH_OUTCOME_NONE);
        ck_assert_int_eq(d.observed.summary.number, number);
        ck_assert_int_eq(d.observed.reset, number % 3 == 0);
        if (d.observed.reset) {
            ck_assert(!step_at(&controller, 0.0f, 0.0f).observed.stepped);
        }
    }
}
END_TEST

START_TEST(begun_anew_by_the_plant) {
    const lh_config config = lh_config_default();
    init(&controller, &config);
    step_at(&controller, 0.0f, 0.0f);
    step_at(&controller, 0.0f, 0.5f);
    lh_controller_begin(&controller);
    const lh_network before = controller.learner.as.q_learning.network;
    const lh_decision d = step_at(&controller, 0.0f, 0.0f);
    ck_assert(!d.observed.stepped && d.observed.outcome == LH_OUTCOME_NONE);
    ck_assert_int_eq(d.observed.episode, 1); /* the same one */
    ck_assert_int_eq(d.observed.step, 0);
    expect_near(d.observed.goal_distance, 2.0, 1e-6);
    ck_assert_mem_eq(network_of(&controller), &before, sizeof before);
}
END_TEST

/* Neither what a gap hides nor where it leads is learned from, by either kind; what comes after it is. */
START_TEST(nothing_is_learned_across_a_gap) {
    for (int32_t kind = LH_Q_LEARNING; kind <= LH_PLANNER; kind++) {
        lh_config config = lh_config_default();
        config.learner.kind = (lh_learner_kind)kind;
        config.learner.planner.sweeps = 0;
        init(&controller, &config);
        step_at(&controller, 0.0f, 0.0f);
        ck_assert(step_at(&controller, 0.0f, 0.1f).choice.learned);
        static lh_learned before;
        static lh_learned after;
        memset(&before, 0, sizeof before);
        memset(&after, 0, sizeof after);
        lh_learner_save(&controller.learner, &before);
        lh_controller_gap(&controller);
        const lh_decision d = step_at(&controller, 0.0f, 1.1f);
        ck_assert(!d.observed.stepped && !d.choice.learned && d.observed.outcome == LH_OUTCOME_NONE);
        ck_assert_int_eq(d.observed.step, 2);
        lh_learner_save(&controller.learner, &after);
        if (kind == LH_Q_LEARNING) {
            ck_assert_mem_eq(&after.as.q_learning.network, &before.as.q_learning.network, sizeof(lh_network));
        } else {
            ck_assert_mem_eq(&after.as.planner.model, &before.as.planner.model, sizeof(lh_motion_model));
        }
        ck_assert(step_at(&controller, 0.0f, 1.2f).choice.learned);
    }
}
END_TEST

/* All controlled actuators stand still, for that reason. */
static void expect_held(const lh_decision *d, lh_hazard hazard) {
    ck_assert_uint_eq(d->intervention.hazards, (uint32_t)hazard);
    ck_assert_uint_eq(d->intervention.stilled, 0x1e);
    ck_assert_int_eq(d->intervention.action, 40);
    ck_assert(!d->observed.stepped && !d->choice.learned && !d->observed.reset);
    ck_assert_int_eq(d->observed.episode, 1);
    for (int32_t k = 0; k < LH_MAX_ACTUATORS; k++) {
        ck_assert_float_eq(d->velocity[k], 0.0f);
    }
}

START_TEST(resumed_where_it_stands) {
    lh_config config = lh_config_default();
    config.task.path =
        (lh_path_config){.kind = LH_PATH_WAYPOINTS, .num_waypoints = 2, .waypoint = {{0.0f, 4.0f}, {6.0f, 4.0f}}};
    init(&controller, &config);
    step_at(&controller, 0.0f, 0.0f);
    lh_controller_resume(&controller, 12);
    const lh_decision d = step_at(&controller, 3.0f, 4.5f);
    ck_assert(!d.observed.stepped && !d.choice.learned);
    ck_assert_int_eq(d.observed.episode, 12);
    expect_near(d.observed.lateral_error, 0.5, 1e-5);
    expect_near(d.observed.heading_error, M_PI_2, 1e-5);
    ck_assert(step_at(&controller, 3.1f, 4.5f).choice.learned);
}
END_TEST

/* Without the monitor, too: the robot is held, the step forgotten, nothing learned, and the hold counted. */
START_TEST(an_invalid_state_holds_the_robot) {
    const lh_config config = lh_config_default();
    init(&controller, &config);
    step_at(&controller, 0.0f, 0.0f);
    other = controller;
    lh_state bad[4];
    for (int32_t k = 0; k < COUNT(bad); k++) {
        bad[k] = crawler_state(0.0f, 0.1f, facing_y);
    }
    bad[0].position[1] = NAN;
    bad[1].orientation.w = 9.0f;
    bad[2].num_actuators = 4;
    bad[3].actuator_position[3] = INFINITY;
    for (int32_t k = 0; k < COUNT(bad); k++) {
        lh_decision d;
        memset(&d, 0x5a, sizeof d);
        ck_assert_int_eq(lh_controller_step(&controller, &bad[k], &d), LH_ERROR_STATE);
        expect_held(&d, LH_HAZARD_INVALID);
        ck_assert_mem_eq(&controller.learner, &other.learner, sizeof controller.learner);
        ck_assert_mem_eq(&controller.task.episode, &other.task.episode, sizeof other.task.episode);
        ck_assert_uint_eq(controller.monitor.counts.decisions, (uint64_t)k + 1);
        ck_assert_uint_eq(controller.monitor.counts.hazards[0], (uint64_t)k + 1);
        ck_assert_uint_eq(controller.monitor.counts.actuators, 4 * ((uint64_t)k + 1));
    }
    const lh_decision after = step_at(&controller, 0.0f, 0.1f);
    ck_assert(!after.observed.stepped && !after.choice.learned);
    ck_assert_int_eq(after.observed.episode, 1);
    ck_assert(step_at(&controller, 0.0f, 0.2f).choice.learned);
}
END_TEST

START_TEST(a_stale_state_holds_the_robot) {
    const lh_config config = lh_config_default();
    init(&controller, &config);
    step_at(&controller, 0.0f, 0.0f);
    lh_decision d;
    memset(&d, 0x5a, sizeof d);
    lh_controller_hold(&controller, &d);
    expect_held(&d, LH_HAZARD_STALE);
    ck_assert_uint_eq(controller.monitor.counts.hazards[1], 1);
    ck_assert(!step_at(&controller, 0.0f, 0.1f).choice.learned);
}
END_TEST

/* --- with the monitor --- */

static void init_guarded(lh_learner_kind kind) {
    lh_config config = lh_config_default();
    config.learner.kind = kind;
    config.learner.planner.sweeps = 0;
    init(&controller, &config);
    lh_controller_guard(&controller);
}

/* A misread position is neither learned nor taken for the goal, and neither is the way back from it. */
START_TEST(a_position_spike_is_not_learned) {
    init_guarded(LH_Q_LEARNING);
    step_at(&controller, 0.0f, 0.0f);
    ck_assert(step_at(&controller, 0.0f, 0.1f).choice.learned);
    other = controller;
    const lh_decision spike = step_at(&controller, 0.0f, 300.0f);
    expect_held(&spike, LH_HAZARD_JUMP);
    ck_assert_int_eq(spike.observed.outcome, LH_OUTCOME_NONE);
    const lh_decision back = step_at(&controller, 0.0f, 0.2f);
    ck_assert(!back.choice.learned && back.observed.outcome == LH_OUTCOME_NONE);
    ck_assert_uint_eq(back.intervention.hazards, 0);
    ck_assert_mem_eq(network_of(&controller), network_of(&other), sizeof(lh_network));
    ck_assert(step_at(&controller, 0.0f, 0.3f).choice.learned);
}
END_TEST

/* Where it is said to be long enough it is, and the way there is not learned either. */
START_TEST(a_place_that_holds_is_believed) {
    init_guarded(LH_Q_LEARNING);
    step_at(&controller, 0.0f, 0.0f);
    for (int32_t i = 0; i < 2; i++) {
        const lh_decision held = step_at(&controller, 0.0f, 5.0f);
        expect_held(&held, LH_HAZARD_JUMP);
    }
    const lh_decision believed = step_at(&controller, 0.0f, 5.0f);
    ck_assert_int_eq(believed.observed.outcome, LH_OUTCOME_GOAL);
    ck_assert(!believed.choice.learned && !believed.observed.stepped);
    ck_assert(step_at(&controller, 0.0f, 5.1f).choice.learned);
}
END_TEST

/* After a reset the robot may be anywhere. */
START_TEST(put_back_is_no_jump) {
    init_guarded(LH_Q_LEARNING);
    step_at(&controller, 0.0f, 0.0f);
    lh_controller_begin(&controller);
    ck_assert_uint_eq(step_at(&controller, 9.0f, 9.0f).intervention.hazards, 0);
    lh_controller_resume(&controller, 3);
    ck_assert_uint_eq(step_at(&controller, 0.0f, 0.0f).intervention.hazards, 0);
    controller.task.config.episode.reset_every = 1;
    ck_assert(step_at(&controller, 0.0f, 0.5f).observed.outcome == LH_OUTCOME_NONE);
    controller.task.config.episode.goal_distance = 0.4f;
    controller.task.episode.goal = 0.4f;
    const lh_decision reset = step_at(&controller, 0.0f, 0.6f);
    ck_assert(reset.observed.reset);
    ck_assert_uint_eq(reset.intervention.hazards, 0);
    ck_assert_uint_eq(step_at(&controller, 9.0f, 9.0f).intervention.hazards, 0);
    static lh_learned learned;
    lh_learner_save(&controller.learner, &learned);
    ck_assert_int_eq(lh_controller_restore(&controller, &learned, 2), LH_OK);
    ck_assert_uint_eq(step_at(&controller, -9.0f, 9.0f).intervention.hazards, 0);
}
END_TEST

/* With all actuators out of order the only action is to be still; TD error and measurement are of that one. */
START_TEST(what_is_executed_is_learned) {
    init_guarded(LH_Q_LEARNING);
    lh_state state = crawler_state(0.0f, 0.0f, facing_y);
    memset(state.actuator_failed, 1, sizeof state.actuator_failed);
    int32_t stilled = 0;
    for (int32_t i = 0; i < 20; i++) {
        const lh_decision d = step(&controller, &state);
        ck_assert_int_eq(d.intervention.action, 40);
        ck_assert_int_eq(controller.learner.as.q_learning.action, 40);
        ck_assert(d.intervention.hazards == (d.choice.action == 40 ? 0 : LH_HAZARD_FAILED));
        stilled += d.intervention.hazards != 0;
        for (int32_t k = 0; k < 5; k++) {
            ck_assert_float_eq(d.velocity[k], 0.0f);
        }
    }
    ck_assert_int_gt(stilled, 10);
    ck_assert_uint_eq(controller.monitor.counts.decisions, (uint64_t)stilled);

    init_guarded(LH_PLANNER);
    for (int32_t i = 0; i < 3; i++) {
        const lh_decision d = step(&controller, &state);
        ck_assert_int_eq(d.intervention.action, 40);
        ck_assert_int_ne(d.choice.action, 40); /* it never chooses to be still */
        ck_assert_int_eq(controller.learner.as.planner.executed, 40);
        ck_assert_float_eq(controller.learner.as.planner.expected_executed.forward, 0.0f);
    }
    const lh_motion_model *model = &controller.learner.as.planner.learned.model;
    ck_assert_int_eq(model->action[0], 40);
    ck_assert_int_eq(model->count[0], 2);
    ck_assert_int_ne(model->action[1], 40); /* and what was chosen leads nowhere either */
    ck_assert_int_eq(model->motion[3][1], -16384);
}
END_TEST

/* A decision moves a joint by 0.15 rad; with 0.02 rad to spare a planner plans to keep 0.17 rad from its stops, and so
 * proposes nothing that is stilled for them. Guarded from the beginning or later on. */
START_TEST(a_planner_keeps_clear_of_stops) {
    lh_config config = lh_config_default();
    config.learner.kind = LH_PLANNER;
    config.learner.planner.sweeps = 0;
    config.learner.planner.random_share = 1.0f;
    config.monitor.stop_clearance = 0.02f;
    for (int32_t active = 0; active < 2; active++) {
        config.monitor.active = active;
        init(&controller, &config);
        lh_controller_guard(&controller);
        expect_near(controller.learner.as.planner.planned.clearance, 0.17, 1e-6);
        lh_state state = crawler_state(0.0f, 0.0f, facing_y);
        for (int32_t i = 0; i < 30; i++) {
            const lh_decision d = step(&controller, &state);
            ck_assert_uint_eq(d.intervention.hazards & LH_HAZARD_STOP, 0);
            for (int32_t k = 2; k < 5; k++) {
                state.actuator_position[k] += 0.5f * d.velocity[k];
            }
        }
    }
    config.monitor.stop_clearance = 0.0f;
    config.monitor.period = 0.01f;
    init(&controller, &config);
    expect_near(controller.learner.as.planner.planned.clearance, 0.03, 1e-6); /* its own */
    init_guarded(LH_Q_LEARNING);                                              /* plans nothing */
}
END_TEST

/* Not a bit differs where there is nothing to intervene in. */
/* Folded over its left crawler, the robot chooses by chance; it lowers its arm only while nobody knows of the crawler.
 */
START_TEST(parts_are_kept_apart_once_they_are_known) {
    lh_config config = lh_config_default();
    config.monitor.active = true;
    config.monitor.joint.acceleration = 100.0f;
    lh_state state = crawler_state(0.0f, 0.0f, facing_y);
    state.actuator_position[2] = 0.6f;
    state.actuator_position[3] = 0.1f;
    state.actuator_position[4] = -2.3f;
    for (int32_t known = 0; known < 2; known++) {
        init(&controller, &config);
        lh_shapes shapes = crawler_shapes();
        if (known) {
            ck_assert_int_eq(lh_controller_keep_apart(&controller, &shapes), LH_OK);
        }
        other = controller;
        shapes.shape[2].link = 6;
        ck_assert_int_eq(lh_controller_keep_apart(&controller, &shapes), LH_ERROR_ROBOT);
        ck_assert_mem_eq(&controller, &other, sizeof controller);
        for (int32_t i = 0; i < 100; i++) {
            const lh_decision d = step(&controller, &state);
            lh_controller_gap(&controller); /* that it stays where it is tells nothing of its joints */
            ck_assert((d.intervention.hazards & LH_HAZARD_COLLISION) == 0 || (d.intervention.stilled & 0x1c) != 0);
        }
        ck_assert(known ? controller.monitor.counts.hazards[10] > 10 : controller.monitor.counts.hazards[10] == 0);
    }
}
END_TEST

START_TEST(the_monitor_changes_nothing_else) {
    init_guarded(LH_Q_LEARNING);
    const lh_config config = lh_config_default();
    init(&other, &config);
    for (int32_t i = 0; i < 50; i++) {
        const lh_state state = crawler_state(0.0f, 0.02f * (float)i, facing_y);
        const lh_decision a = step(&controller, &state);
        const lh_decision b = step(&other, &state);
        if (a.intervention.hazards != 0) {
            ck_assert_uint_eq(a.intervention.hazards, LH_HAZARD_STUCK); /* as the joints do not move */
            break;
        }
        ck_assert_mem_eq(&a, &b, sizeof a);
    }
}
END_TEST

START_TEST(bad_checkpoints_change_nothing) {
    const lh_config config = lh_config_default();
    init(&controller, &config);
    step_at(&controller, 0.0f, 0.0f);
    lh_learned good;
    lh_learner_save(&controller.learner, &good);
    lh_learned bad = good;
    bad.as.q_learning.network.weight[3] = NAN;
    lh_learned small = good;
    small.as.q_learning.network.units = 49;
    lh_learned spent = good;
    spent.as.q_learning.random = (lh_random){{0}};
    other = controller;
    ck_assert_int_eq(lh_controller_restore(&controller, &good, 0), LH_ERROR_EPISODE);
    ck_assert_int_eq(lh_controller_restore(&controller, &good, INT32_MAX), LH_ERROR_EPISODE);
    ck_assert_int_eq(lh_controller_restore(&controller, &bad, 1), LH_ERROR_NETWORK);
    ck_assert_int_eq(lh_controller_restore(&controller, &small, 1), LH_ERROR_NETWORK);
    ck_assert_int_eq(lh_controller_restore(&controller, &spent, 1), LH_ERROR_RANDOM_STATE);
    ck_assert_mem_eq(&controller, &other, sizeof controller);
    ck_assert_int_eq(lh_controller_restore(&controller, &good, LH_LAST_EPISODE), LH_OK);
    ck_assert_int_eq(lh_controller_restore(&controller, &good, LH_LAST_EPISODE + 1), LH_ERROR_EPISODE);
    ck_assert_int_eq(lh_controller_restore(&controller, &good, 51), LH_OK);
    ck_assert_int_eq(step_at(&controller, 0.0f, 0.0f).observed.episode, 51);
}
END_TEST

/* Counting ends at the last number, after a reset and without one. */
START_TEST(last_episode_number_is_used_again) {
    const lh_config config = lh_config_default();
    init(&controller, &config);
    lh_learned learned;
    lh_learner_save(&controller.learner, &learned);
    ck_assert_int_eq(lh_controller_restore(&controller, &learned, 999999999), LH_OK);
    ck_assert_int_eq(step_at(&controller, 0.0f, 0.0f).observed.episode, 999999999);
    ck_assert(!step_at(&controller, 0.0f, 2.5f).observed.reset); /* on the goal line */
    ck_assert_int_eq(controller.task.episode.number, 1000000000);
    ck_assert(step_at(&controller, 0.0f, 5.0f).observed.reset); /* a multiple of reset_every */
    ck_assert_int_eq(controller.task.episode.number, 1000000000);
    controller.task.config.episode.reset_every = 7;
    step_at(&controller, 0.0f, 0.0f);
    ck_assert(!step_at(&controller, 0.0f, 2.5f).observed.reset);
    ck_assert_int_eq(controller.task.episode.number, 1000000000);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("controller");
    TCase *t = tcase_create("configuration");
    tcase_add_test(t, defaults_are_those_of_the_paper);
    tcase_add_test(t, bad_fields_are_named);
    tcase_add_test(t, controlled_actuators_must_ascend_within_the_robot);
    suite_add_tcase(s, t);
    t = tcase_create("decisions");
    tcase_add_test(t, first_decision);
    tcase_add_test(t, crawlers_and_joints_have_their_own_speed);
    tcase_add_test(t, one_step_is_rewarded_and_learned);
    tcase_add_test(t, an_invalid_state_holds_the_robot);
    tcase_add_test(t, a_stale_state_holds_the_robot);
    suite_add_tcase(s, t);
    t = tcase_create("monitor");
    tcase_add_test(t, a_position_spike_is_not_learned);
    tcase_add_test(t, a_place_that_holds_is_believed);
    tcase_add_test(t, put_back_is_no_jump);
    tcase_add_test(t, what_is_executed_is_learned);
    tcase_add_test(t, a_planner_keeps_clear_of_stops);
    tcase_add_test(t, parts_are_kept_apart_once_they_are_known);
    tcase_add_test(t, the_monitor_changes_nothing_else);
    suite_add_tcase(s, t);
    t = tcase_create("episodes");
    tcase_add_test(t, goal_is_terminal_and_the_next_line_lies_ahead);
    tcase_add_test(t, tumble_is_punished_terminal_and_reset);
    tcase_add_test(t, tumbles_to_every_side);
    tcase_add_test(t, timeout_goes_on_bootstrapping);
    tcase_add_test(t, reset_every_so_many_episodes);
    tcase_add_test(t, begun_anew_by_the_plant);
    tcase_add_test(t, nothing_is_learned_across_a_gap);
    tcase_add_test(t, resumed_where_it_stands);
    suite_add_tcase(s, t);
    t = tcase_create("reproduction");
    tcase_add_test(t, bad_checkpoints_change_nothing);
    tcase_add_test(t, last_episode_number_is_used_again);
    suite_add_tcase(s, t);
    return s;
}
