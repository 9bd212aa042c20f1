#include "limphome/controller.h"

#include <float.h>

#include "reference.h"
#include "steps.h"

/* Too large for some stacks. */
static lh_controller controller;

static float any_of(lh_random *random, const float *values, int32_t count) {
    return values[lh_random_next(random) % (uint32_t)count];
}

/* Within the interface every fourth time or so, at its ends and beyond. */
static lh_state extreme_state(lh_random *random) {
    static const float length[] = {0.0f, 1.0f, -1e6f, 1e6f, 1e-38f, 0.3f, 2.1f, -2.1f, 1e6f, 1e7f, NAN};
    static const float angle[] = {0.0f, -0.0f, 0.6f, -1.5f, 3.0f, -100.0f, 100.0f, 1e-40f, 99.0f, 101.0f, INFINITY};
    static const float effort[] = {0.0f, 1e3f, -1e3f, FLT_MAX, -FLT_MAX, FLT_MIN, 3e38f, 5e2f, 1e30f, -INFINITY};
    lh_state state = crawler_state(0.0f, 0.0f, 6.2f * lh_random_uniform(random));
    for (int32_t i = 0; i < 3; i++) {
        state.position[i] = any_of(random, length, COUNT(length));
    }
    for (int32_t k = 0; k < state.num_actuators; k++) {
        state.actuator_position[k] = any_of(random, angle, COUNT(angle) - (k % 2));
        state.actuator_effort[k] = any_of(random, effort, COUNT(effort) - (k % 2));
    }
    const float tilt[] = {0.0f, 0.01f, 0.9f, 1.6f, 3.14159274f};
    state.orientation = lh_quat_multiply(state.orientation,
                                         lh_quat_about((lh_vec3){1.0f, 0.0f, 0.0f}, any_of(random, tilt, COUNT(tilt))));
    return state;
}

static bool all_finite(const float *values, int32_t count) {
    bool finite = true;
    for (int32_t i = 0; i < count; i++) {
        finite = finite && isfinite(values[i]);
    }
    return finite;
}

static bool is_finite_decision(const lh_decision *d) {
    const float all[] = {d->observed.reward.motion,
                         d->observed.reward.goal,
                         d->observed.reward.stability,
                         d->observed.reward.tumble,
                         d->choice.td_error,
                         d->observed.goal_distance,
                         d->observed.lateral_error,
                         d->observed.stability_margin,
                         d->choice.q,
                         d->choice.q_max,
                         d->choice.temperature,
                         d->choice.probability,
                         d->observed.summary.total.motion,
                         d->observed.summary.lateral_error};
    return all_finite(all, COUNT(all)) && all_finite(d->observed.inputs, d->observed.num_inputs) &&
           all_finite(d->velocity, 5);
}

START_TEST(limited_temperatures_and_margins_are_counted) {
    lh_config config = lh_config_default();
    config.learner.q_learning.temperature_floor = 2.0f; /* (4) gives 10.5 in episode 1, and 1.35 in episode 2 */
    config.task.episode.step_limit = 3;
    init(&controller, &config);
    for (int32_t i = 0; i < 3; i++) {
        ck_assert_float_gt(step_at(&controller, 0.0f, 0.0f).choice.temperature, 2.0f);
        ck_assert_uint_eq(controller.learner.as.q_learning.floored, 0);
    }
    for (int32_t i = 0; i < 3; i++) {
        ck_assert_float_eq(step_at(&controller, 0.0f, 0.0f).choice.temperature, 2.0f);
        ck_assert_uint_eq(controller.learner.as.q_learning.floored, (uint64_t)i + 1);
    }
    ck_assert_uint_eq(controller.task.clamped.margins, 0);
    /* a mast so high that the centre of mass lies far out when the robot lies on its side */
    controller.task.robot.links[3].centre.z = 900.0f;
    lh_state state = tumbled_state((lh_vec3){1.0f, 0.0f, 0.0f});
    const lh_decision d = step(&controller, &state);
    ck_assert_float_lt(d.observed.stability_margin, LH_LEAST_MARGIN);
    expect_near(d.observed.reward.stability, -exp(5.0), 1e-3);
    ck_assert_uint_eq(controller.task.clamped.margins, 1);
    ck_assert_uint_eq(controller.task.clamped.inputs, 0);
}
END_TEST

START_TEST(limited_sensor_values_are_counted) {
    const lh_config config = lh_config_default();
    init(&controller, &config);
    lh_state state = crawler_state(0.0f, 0.0f, facing_y);
    step(&controller, &state);
    ck_assert_uint_eq(controller.task.clamped.inputs, 0);
    state.actuator_effort[1] = 2000.0f;
    state.actuator_position[4] = 0.01f;
    step(&controller, &state);
    step(&controller, &state);
    ck_assert_uint_eq(controller.task.clamped.inputs, 4);
}
END_TEST

/* A robot of eight actuators: six joints on end, two crawlers. */
START_TEST(works_at_full_capacity) {
    lh_robot robot = crawler_robot();
    robot.num_actuators = LH_MAX_ACTUATORS;
    for (int32_t k = 5; k < LH_MAX_ACTUATORS; k++) {
        robot.actuators[k] = (lh_actuator){LH_JOINT, -1.0f, 1.0f, 100.0f};
        robot.links[robot.num_links] = robot.links[5];
        robot.links[robot.num_links].parent = robot.num_links - 1;
        robot.links[robot.num_links].actuator = k;
        robot.num_links++;
    }
    lh_controlled controlled = {.count = LH_MAX_ACTUATORS};
    for (int32_t k = 0; k < LH_MAX_ACTUATORS; k++) {
        controlled.index[k] = k;
    }
    lh_config config = lh_config_default();
    config.learner.q_learning.network.units = LH_MAX_UNITS;
    ck_assert_int_eq(lh_controller_init(&controller, &config, &robot, &controlled), LH_OK);
    lh_state state = crawler_state(0.0f, 0.0f, facing_y);
    state.num_actuators = LH_MAX_ACTUATORS;
    for (int32_t i = 0; i < 20; i++) {
        const lh_decision d = step(&controller, &state);
        ck_assert_int_eq(d.observed.num_inputs, LH_MAX_STATE_INPUTS);
        ck_assert(d.choice.action >= 0 && d.choice.action < 6561);
        state.position[1] += 0.01f;
    }
}
END_TEST

/* Whatever the sensors say and however the rates are set, nothing but finite numbers within their limits is stored. */
START_TEST(extremes_leave_finite_numbers_within_their_limits) {
    lh_config config = lh_config_default();
    config.learner.q_learning.learning_rate = config.learner.q_learning.discount_rate = 1.0f;
    config.learner.q_learning.network.rate_weight = config.learner.q_learning.network.rate_centre =
        config.learner.q_learning.network.rate_width = 10.0f;
    config.learner.q_learning.network.exact_gradient = true;
    config.learner.q_learning.network.weight_limit = 1e6f;
    config.learner.q_learning.network.width_floor = 0.01f;
    config.task.reward = (lh_reward_config){1000.0f, 1000.0f, 1000.0f, true, 1000.0f, 1000.0f, -1000.0f};
    config.learner.q_learning.temperature_floor = 1e-4f;
    lh_random random;
    lh_random_init(&random, 4);
    int32_t decided = 0;
    int32_t faults = 0;
    int64_t held = 0;
    for (int32_t offered = 0; decided < 100000; offered++) {
        if (decided % 100 == 0) { /* once all is at its limits, little is learned */
            config.learner.seed = (uint64_t)offered;
            init(&controller, &config);
        }
        const lh_state state = extreme_state(&random);
        lh_decision d;
        if (lh_controller_step(&controller, &state, &d) == LH_OK) {
            decided++;
            held += d.choice.learned && controller.learner.as.q_learning.held.centres > 0;
            faults += !is_finite_decision(&d);
            faults +=
                lh_network_validate(network_of(&controller), &controller.learner.as.q_learning.config.network) != LH_OK;
            faults += !all_finite(controller.learner.as.q_learning.q, controller.learner.as.q_learning.num_actions);
        }
        ck_assert_int_lt(offered, 10000000);
    }
    ck_assert_int_eq(faults, 0);
    ck_assert_int_gt(held, 10000);
    ck_assert_uint_gt(controller.task.clamped.inputs, 0);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("limits");
    TCase *t = tcase_create("limits");
    tcase_add_test(t, limited_sensor_values_are_counted);
    tcase_add_test(t, limited_temperatures_and_margins_are_counted);
    tcase_add_test(t, works_at_full_capacity);
    tcase_add_test(t, extremes_leave_finite_numbers_within_their_limits);
    suite_add_tcase(s, t);
    return s;
}
