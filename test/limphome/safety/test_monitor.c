#include "limphome/safety/monitor.h"

#include "crawler.h"
#include "limphome/base/random.h"
#include "limphome/body/rest.h"
#include "limphome/task/action.h"
#include "test.h"

enum { REVERSE, STILL, FORWARD };
enum { RIGHT, SWING, BOOM, ARM }; /* of what is controlled */

static lh_monitor monitor;
static lh_task task;
static lh_intervention intervention;
static float velocity[LH_MAX_ACTUATORS];

static void init_with(const lh_monitor_config *config) {
    const lh_task_config task_config = lh_task_config_default();
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    ck_assert_int_eq(lh_task_init(&task, &task_config, &robot, &controlled), LH_OK);
    ck_assert_int_eq(lh_monitor_config_validate(config), LH_OK);
    lh_monitor_init(&monitor, config);
    memset(&intervention, 0, sizeof intervention);
}

static void init(void) {
    const lh_monitor_config config = lh_monitor_config_default();
    init_with(&config);
}

/* The arm as it stands at the start: swing 0, boom 0.6, arm -1.5. */
static lh_state standing(void) {
    return crawler_state(0.0f, 0.0f, 0.0f);
}

static int32_t action_of(int8_t right, int8_t swing, int8_t boom, int8_t arm) {
    const int8_t levels[] = {right, swing, boom, arm};
    return lh_action_index(levels, 4);
}

/* Takes in the state and judges the action: the hazards. */
static uint32_t check(const lh_state *state, int32_t action) {
    ck_assert(lh_monitor_believes(&monitor, &task.robot, state));
    memset(velocity, 0, sizeof velocity);
    lh_task_velocities(&task, action, velocity);
    lh_monitor_check(&monitor, &task, state, lh_quat_normalise(state->orientation), action, &intervention, velocity);
    return intervention.hazards;
}

/* Action, mask and velocities agree. */
static void expect_executed(int8_t right, int8_t swing, int8_t boom, int8_t arm, uint32_t stilled) {
    const int8_t levels[] = {STILL, right, swing, boom, arm};
    ck_assert_int_eq(intervention.action, lh_action_index(levels + 1, 4));
    ck_assert_uint_eq(intervention.stilled, stilled);
    for (int32_t k = 0; k < LH_MAX_ACTUATORS; k++) {
        ck_assert_float_eq(velocity[k], k < 5 ? 0.3f * (float)(levels[k] - 1) : 0.0f);
    }
    ck_assert_mem_eq(monitor.executed, velocity, sizeof velocity);
}

START_TEST(the_default_is_off_and_valid) {
    const lh_monitor_config config = lh_monitor_config_default();
    ck_assert(!config.active);
    ck_assert_int_eq(lh_monitor_config_validate(&config), LH_OK);
}
END_TEST

START_TEST(bad_fields_are_named) {
#define BAD(field, value)                                                        \
    do {                                                                         \
        lh_monitor_config config = lh_monitor_config_default();                  \
        config.field = value;                                                    \
        ck_assert_int_eq(lh_monitor_config_validate(&config), LH_ERROR_MONITOR); \
    } while (0)
    BAD(period, 0.0f);
    BAD(period, 10.1f);
    BAD(crawler.speed, -0.1f);
    BAD(crawler.acceleration, NAN);
    BAD(joint.speed, 10.1f);
    BAD(joint.acceleration, -1.0f);
    BAD(stop_clearance, 1.1f);
    BAD(margin_floor, -1.1f);
    BAD(collision_clearance, 1.1f);
    BAD(tilt, 0.0f);
    BAD(slack.position, -1.0f);
    BAD(slack.attitude, NAN);
    BAD(slack.joint, 1e8f);
#undef BAD
}
END_TEST

START_TEST(a_safe_action_passes) {
    init();
    const lh_state state = standing();
    ck_assert_uint_eq(check(&state, action_of(FORWARD, REVERSE, STILL, FORWARD)), 0);
    expect_executed(FORWARD, REVERSE, STILL, FORWARD, 0);
    ck_assert_uint_eq(monitor.counts.decisions, 0);
}
END_TEST

START_TEST(speeds_have_limits_by_kind) {
    lh_monitor_config config = lh_monitor_config_default();
    config.crawler.speed = 0.29f;
    init_with(&config);
    const lh_state state = standing();
    ck_assert_uint_eq(check(&state, action_of(REVERSE, REVERSE, STILL, FORWARD)), LH_HAZARD_SPEED);
    expect_executed(STILL, REVERSE, STILL, FORWARD, 1u << 1);
    config.crawler.speed = 0.3f;
    config.joint.speed = 0.0f;
    init_with(&config);
    ck_assert_uint_eq(check(&state, action_of(REVERSE, REVERSE, STILL, FORWARD)), LH_HAZARD_SPEED);
    expect_executed(REVERSE, STILL, STILL, STILL, 1u << 2 | 1u << 4);
}
END_TEST

/* From -0.3 to 0.3 within 0.5 s is 1.2 m/s^2. What was stilled comes from rest. */
START_TEST(accelerations_are_from_what_was_executed) {
    lh_monitor_config config = lh_monitor_config_default();
    config.crawler.acceleration = 1.1f;
    config.joint.acceleration = 1.3f;
    init_with(&config);
    const lh_state state = standing();
    ck_assert_uint_eq(check(&state, action_of(REVERSE, REVERSE, STILL, STILL)), 0);
    ck_assert_uint_eq(check(&state, action_of(FORWARD, FORWARD, STILL, STILL)), LH_HAZARD_ACCELERATION);
    expect_executed(STILL, FORWARD, STILL, STILL, 1u << 1);
    ck_assert_uint_eq(check(&state, action_of(FORWARD, FORWARD, STILL, STILL)), 0);
    lh_monitor_hold(&monitor, &task, LH_HAZARD_STALE, &intervention, velocity);
    ck_assert_uint_eq(check(&state, action_of(REVERSE, STILL, STILL, STILL)), 0); /* from rest */
}
END_TEST

/* The arm's range is -2.4 to 0: at -0.14 a decision leads to 0.01, at -0.16 to -0.01. */
START_TEST(no_command_into_a_stop) {
    lh_monitor_config config = lh_monitor_config_default();
    init_with(&config);
    lh_state state = standing();
    state.actuator_position[4] = -0.16f;
    ck_assert_uint_eq(check(&state, action_of(STILL, FORWARD, STILL, FORWARD)), 0);
    state.actuator_position[4] = -0.14f;
    ck_assert_uint_eq(check(&state, action_of(STILL, FORWARD, STILL, FORWARD)), LH_HAZARD_STOP);
    expect_executed(STILL, FORWARD, STILL, STILL, 1u << 4);
    ck_assert_uint_eq(check(&state, action_of(STILL, STILL, STILL, REVERSE)), 0);
    config.stop_clearance = 0.02f;
    init_with(&config);
    state.actuator_position[4] = -0.16f;
    ck_assert_uint_eq(check(&state, action_of(STILL, FORWARD, STILL, FORWARD)), LH_HAZARD_STOP);
    lh_monitor_begin(&monitor);
    state.actuator_position[4] = -2.22f;
    ck_assert_uint_eq(check(&state, action_of(STILL, FORWARD, STILL, REVERSE)), 0);
    state.actuator_position[4] = -2.24f;
    ck_assert_uint_eq(check(&state, action_of(STILL, FORWARD, STILL, REVERSE)), LH_HAZARD_STOP);
}
END_TEST

/* A weight at the end of the arm, out ahead: lowering the arm brings the centre of mass nearer to the front edge. */
static void load_the_arm(float mass, lh_state *state) {
    task.robot.links[5].mass = mass;
    task.robot.links[5].centre.x = 0.8f;
    *state = standing();
    state->actuator_position[3] = 0.9f;
    state->actuator_position[4] = -0.3f; /* pointing up and ahead */
}

/* The margin at rest after `action`. */
static float margin_after(const lh_state *state, int32_t action) {
    float next[LH_MAX_ACTUATORS] = {0.0f};
    lh_task_velocities(&task, action, next);
    for (int32_t k = 0; k < 5; k++) {
        next[k] = state->actuator_position[k] + 0.5f * next[k];
    }
    lh_rest rest;
    lh_rest_find(&task.robot, next, (lh_vec3){0.0f, 0.0f, 1.0f}, &rest);
    return rest.margin;
}

START_TEST(the_margin_keeps_above_its_floor) {
    lh_monitor_config config = lh_monitor_config_default();
    init_with(&config);
    lh_state state;
    load_the_arm(120.0f, &state);
    const int32_t stand = action_of(STILL, STILL, STILL, STILL);
    const int32_t outwards = action_of(FORWARD, STILL, STILL, REVERSE);
    const int32_t inwards = action_of(FORWARD, STILL, STILL, FORWARD);
    const float now = margin_after(&state, stand);
    const float after = margin_after(&state, outwards);
    ck_assert_float_lt(after, now);
    ck_assert_float_gt(margin_after(&state, inwards), now);

    config.margin_floor = 0.5f * (now + after);
    init_with(&config);
    load_the_arm(120.0f, &state);
    ck_assert_uint_eq(check(&state, outwards), LH_HAZARD_MARGIN);
    expect_executed(FORWARD, STILL, STILL, STILL, 1u << 4); /* the crawler is left alone */
    ck_assert_uint_eq(check(&state, inwards), 0);
    config.margin_floor = after; /* not below it */
    init_with(&config);
    load_the_arm(120.0f, &state);
    ck_assert_uint_eq(check(&state, outwards), 0);

    /* below the floor already: only what does not lower it further */
    config.margin_floor = now + 0.01f;
    init_with(&config);
    load_the_arm(120.0f, &state);
    ck_assert_uint_eq(check(&state, outwards), LH_HAZARD_MARGIN);
    ck_assert_uint_eq(check(&state, inwards), 0);
    ck_assert_uint_eq(check(&state, action_of(REVERSE, STILL, STILL, STILL)), 0);
}
END_TEST

/* Folded and turned aside, over the left crawler. */
static lh_state over_the_crawler(float boom) {
    lh_state state = standing();
    state.actuator_position[2] = 0.6f;
    state.actuator_position[3] = boom;
    state.actuator_position[4] = -2.4f;
    return state;
}

START_TEST(the_arm_is_not_lowered_on_a_crawler) {
    lh_monitor_config config = lh_monitor_config_default();
    init_with(&config);
    monitor.shapes = crawler_shapes();
    lh_state state = over_the_crawler(0.1f);
    ck_assert_uint_eq(check(&state, action_of(FORWARD, STILL, REVERSE, STILL)), LH_HAZARD_COLLISION);
    expect_executed(FORWARD, STILL, STILL, STILL, 1u << 3);
    ck_assert_uint_eq(check(&state, action_of(FORWARD, FORWARD, FORWARD, STILL)), 0);
    init_with(&config); /* which knows of no shapes */
    ck_assert_uint_eq(check(&state, action_of(FORWARD, STILL, REVERSE, STILL)), 0);
}
END_TEST

/* Whatever is let through leaves parts apart by the clearance, or no nearer than they were. */
START_TEST(what_is_executed_keeps_parts_apart) {
    lh_monitor_config config = lh_monitor_config_default();
    config.margin_floor = -1.0f;
    config.slack = (lh_jump_limits){1e6f, 1e6f, 1e6f};
    config.joint.acceleration = 100.0f;
    init_with(&config);
    monitor.shapes = crawler_shapes();
    lh_random random;
    lh_random_init(&random, 5);
    int32_t found = 0;
    for (int32_t i = 0; i < 3000; i++) {
        lh_state state = standing();
        for (int32_t k = 2; k < 5; k++) {
            const lh_actuator *joint = &task.robot.actuators[k];
            state.actuator_position[k] = joint->low + (joint->high - joint->low) * lh_random_uniform(&random);
        }
        lh_monitor_begin(&monitor);
        found += (check(&state, (int32_t)(lh_random_next(&random) % 81)) & LH_HAZARD_COLLISION) != 0;
        float next[LH_MAX_ACTUATORS];
        for (int32_t k = 0; k < 5; k++) {
            next[k] = state.actuator_position[k] + 0.5f * velocity[k];
        }
        ck_assert_uint_eq(lh_collision_joints(&task.robot, &monitor.shapes, 0.02f, state.actuator_position, next), 0);
    }
    ck_assert_int_gt(found, 50);
}
END_TEST

START_TEST(a_tilted_robot_does_not_move) {
    init();
    lh_state state = standing();
    state.orientation = lh_quat_about((lh_vec3){1.0f, 0.0f, 0.0f}, 1.04f);
    ck_assert_uint_eq(check(&state, action_of(FORWARD, STILL, STILL, STILL)), 0);
    state.orientation = lh_quat_about((lh_vec3){1.0f, 0.0f, 0.0f}, -1.06f);
    lh_monitor_begin(&monitor);
    ck_assert_uint_eq(check(&state, action_of(FORWARD, STILL, FORWARD, STILL)), LH_HAZARD_TILT);
    expect_executed(STILL, STILL, STILL, STILL, 1u << 1 | 1u << 3);
}
END_TEST

START_TEST(a_failed_actuator_is_still) {
    init();
    lh_state state = standing();
    state.actuator_failed[1] = 1;
    state.actuator_failed[3] = 1;
    ck_assert_uint_eq(check(&state, action_of(FORWARD, FORWARD, FORWARD, STILL)), LH_HAZARD_FAILED);
    expect_executed(STILL, FORWARD, STILL, STILL, 1u << 1 | 1u << 3);
}
END_TEST

/* The boom is told to go up and down and stays; the swing goes 0.15 rad each time. */
START_TEST(a_joint_that_does_not_move_is_found) {
    init();
    lh_state state = standing();
    int32_t decisions = 0;
    for (; decisions < 30 && intervention.hazards == 0; decisions++) {
        check(&state, action_of(STILL, decisions % 2 == 0 ? FORWARD : REVERSE,
                                decisions < 10 || decisions % 2 == 0 ? FORWARD : REVERSE, STILL));
        state.actuator_position[2] += 0.5f * velocity[2];
    }
    ck_assert_uint_eq(intervention.hazards, LH_HAZARD_STUCK);
    ck_assert_uint_eq(intervention.stilled, 1u << 3);
    ck_assert(velocity[2] != 0.0f);
    ck_assert_int_eq(decisions, 17); /* down at 11, 13 and 15, as seen at 16 */
    lh_monitor_begin(&monitor);      /* put back it may be sound */
    ck_assert_uint_eq(check(&state, action_of(STILL, STILL, FORWARD, STILL)), 0);
}
END_TEST

/* What happened in between is not what was commanded. */
START_TEST(a_gap_tells_nothing_of_the_joints) {
    init();
    const lh_state state = standing();
    for (int32_t i = 0; i < 40; i++) {
        ck_assert_uint_eq(check(&state, action_of(STILL, STILL, i % 2 == 0 ? FORWARD : REVERSE, STILL)), 0);
        lh_monitor_gap(&monitor);
    }
}
END_TEST

/* The slack is 0.5 rad of a joint, 1 m and 1 rad; in 0.5 s at the limits of speed come 0.25 to each. */
START_TEST(jumps_are_beyond_the_fastest_motion) {
    init();
    lh_state state = standing();
    ck_assert(lh_monitor_believes(&monitor, &task.robot, &state));
    state.actuator_position[2] = 0.74f;
    ck_assert(lh_monitor_believes(&monitor, &task.robot, &state));
    state.actuator_position[2] = 1.5f;
    ck_assert(!lh_monitor_believes(&monitor, &task.robot, &state));
    state.actuator_position[2] = 0.74f;
    state.position[0] = 1.24f;
    ck_assert(lh_monitor_believes(&monitor, &task.robot, &state));
    state.position[0] = 2.5f;
    ck_assert(!lh_monitor_believes(&monitor, &task.robot, &state));
    state.position[0] = 1.24f;
    state.orientation = lh_quat_about((lh_vec3){0.0f, 0.0f, 1.0f}, 1.24f);
    ck_assert(lh_monitor_believes(&monitor, &task.robot, &state));
    state.orientation = lh_quat_about((lh_vec3){0.0f, 0.0f, 1.0f}, 2.5f);
    ck_assert(!lh_monitor_believes(&monitor, &task.robot, &state));
}
END_TEST

START_TEST(a_hold_is_of_all_that_is_controlled) {
    init();
    memset(velocity, 0x5a, sizeof velocity);
    lh_monitor_hold(&monitor, &task, LH_HAZARD_JUMP, &intervention, velocity);
    ck_assert_uint_eq(intervention.hazards, LH_HAZARD_JUMP);
    expect_executed(STILL, STILL, STILL, STILL, 0x1e);
    ck_assert(!monitor.moving);
}
END_TEST

START_TEST(each_hazard_is_counted) {
    init();
    lh_state state = standing();
    state.actuator_failed[1] = 1;
    state.actuator_position[4] = 0.0f;
    check(&state, action_of(FORWARD, STILL, STILL, FORWARD));
    check(&state, action_of(FORWARD, STILL, STILL, STILL));
    check(&state, action_of(STILL, FORWARD, STILL, STILL));
    lh_monitor_hold(&monitor, &task, LH_HAZARD_INVALID, &intervention, velocity);
    const uint64_t expected[LH_HAZARDS] = {[0] = 1, [7] = 1, [8] = 2}; /* invalid, stop, failed */
    ck_assert_mem_eq(monitor.counts.hazards, expected, sizeof expected);
    ck_assert_uint_eq(monitor.counts.decisions, 3);
    ck_assert_uint_eq(monitor.counts.actuators, 2 + 1 + 4);
}
END_TEST

/* --- any states --- */

static float between(lh_random *random, float low, float high) {
    return low + (high - low) * lh_random_uniform(random);
}

static lh_state any_state(lh_random *random, const lh_state *near) {
    lh_state state = *near;
    const lh_vec3 axis = {between(random, -1.0f, 1.0f), between(random, -1.0f, 1.0f), 0.0f};
    state.orientation = lh_quat_multiply(
        lh_quat_about((lh_vec3){0.0f, 0.0f, 1.0f}, between(random, -3.0f, 3.0f)),
        lh_quat_about(lh_vec3_scale(axis, 1.0f / (lh_vec3_norm(axis) + 1e-6f)), between(random, 0.0f, 1.3f)));
    for (int32_t k = 2; k < 5; k++) {
        const lh_actuator *joint = &task.robot.actuators[k];
        state.actuator_position[k] = between(random, joint->low - 0.1f, joint->high + 0.1f);
        state.actuator_failed[k] = lh_random_next(random) % 16 == 0;
    }
    return state;
}

/* Whatever is sensed and proposed, executed is a part of it, and keeps the rules as computed here anew. */
START_TEST(any_states) {
    lh_monitor_config config = lh_monitor_config_default();
    config.slack = (lh_jump_limits){1e6f, 1e6f, 1e6f};
    config.crawler.acceleration = 1.0f;
    config.margin_floor = 0.1f;
    init_with(&config);
    monitor.shapes = crawler_shapes();
    lh_random random;
    lh_random_init(&random, 11);
    float before[LH_MAX_ACTUATORS] = {0.0f};
    for (int32_t i = 0; i < 20000; i++) {
        const lh_state origin = standing();
        const lh_state state = any_state(&random, &origin);
        const int32_t action = (int32_t)(lh_random_next(&random) % 81);
        int8_t proposed[4];
        int8_t executed[4];
        check(&state, action);
        lh_action_levels(action, 4, proposed);
        lh_action_levels(intervention.action, 4, executed);
        uint32_t stilled = 0;
        for (int32_t k = 0; k < 4; k++) {
            ck_assert(executed[k] == proposed[k] || executed[k] == STILL);
            stilled |= executed[k] != proposed[k] ? 1u << (k + 1) : 0;
            ck_assert_float_eq(velocity[k + 1], 0.3f * (float)(executed[k] - 1));
            if (executed[k] != STILL) {
                const lh_actuator *actuator = &task.robot.actuators[k + 1];
                const float ahead = state.actuator_position[k + 1] + 0.5f * velocity[k + 1];
                ck_assert(k == RIGHT || (velocity[k + 1] > 0.0f ? ahead <= actuator->high : ahead >= actuator->low));
                ck_assert(state.actuator_failed[k + 1] == 0);
                ck_assert_float_le(lh_quat_tilt(lh_quat_normalise(state.orientation)), 1.0472f);
            }
        }
        ck_assert_float_le(fabsf(velocity[1] - before[1]), executed[RIGHT] == STILL ? 0.3f : 0.5f);
        ck_assert_uint_eq(intervention.stilled, stilled);
        ck_assert(stilled == 0 || intervention.hazards != 0);
        memcpy(before, velocity, sizeof before);
    }
    for (int32_t i = 0; i < LH_HAZARDS; i++) {
        const uint32_t bit = 1u << i;
        const uint32_t never = LH_HAZARD_INVALID | LH_HAZARD_STALE | LH_HAZARD_JUMP | LH_HAZARD_SPEED;
        ck_assert((bit & never) != 0 ? monitor.counts.hazards[i] == 0
                                     : bit == LH_HAZARD_STUCK || monitor.counts.hazards[i] > 50);
    }
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("monitor");
    TCase *t = tcase_create("configuration");
    tcase_add_test(t, the_default_is_off_and_valid);
    tcase_add_test(t, bad_fields_are_named);
    suite_add_tcase(s, t);
    t = tcase_create("rules");
    tcase_add_test(t, a_safe_action_passes);
    tcase_add_test(t, speeds_have_limits_by_kind);
    tcase_add_test(t, accelerations_are_from_what_was_executed);
    tcase_add_test(t, no_command_into_a_stop);
    tcase_add_test(t, the_margin_keeps_above_its_floor);
    tcase_add_test(t, the_arm_is_not_lowered_on_a_crawler);
    tcase_add_test(t, what_is_executed_keeps_parts_apart);
    tcase_add_test(t, a_tilted_robot_does_not_move);
    tcase_add_test(t, a_failed_actuator_is_still);
    tcase_add_test(t, a_joint_that_does_not_move_is_found);
    tcase_add_test(t, a_gap_tells_nothing_of_the_joints);
    tcase_add_test(t, jumps_are_beyond_the_fastest_motion);
    tcase_add_test(t, a_hold_is_of_all_that_is_controlled);
    tcase_add_test(t, each_hazard_is_counted);
    suite_add_tcase(s, t);
    t = tcase_create("any states");
    tcase_add_test(t, any_states);
    suite_add_tcase(s, t);
    return s;
}
