#include "limphome/controller.h"
#include "steps.h"

enum { LEFT, RIGHT, SWING, BOOM, TIP, ACTUATORS };

/* Too large for some stacks. */
static lh_controller controller;

static const int8_t still[LH_MAX_ACTUATORS];
static const int8_t ahead[LH_MAX_ACTUATORS] = {1, 1};
static const int8_t all[LH_MAX_ACTUATORS] = {1, 1, 1, 1, 1};

static void begin(lh_learner_kind kind, bool monitored) {
    lh_config config = lh_config_default();
    config.learner.kind = kind;
    config.learner.planner.sweeps = 0;
    config.monitor.active = monitored;
    init(&controller, &config);
}

static lh_decision drive(const lh_state *state, const int8_t *direction) {
    lh_decision decision;
    ck_assert_int_eq(lh_controller_drive(&controller, state, direction, &decision), LH_OK);
    return decision;
}

static lh_decision drive_at(float x, float y, const int8_t *direction) {
    const lh_state state = crawler_state(x, y, facing_y);
    return drive(&state, direction);
}

static void expect_velocities(const lh_decision *d, const float expected[ACTUATORS]) {
    for (int32_t k = 0; k < ACTUATORS; k++) {
        ck_assert_float_eq(d->velocity[k], expected[k]);
    }
}

/* The left crawler is not controlled, so that nothing is said of it. */
START_TEST(each_actuator_goes_where_it_is_told) {
    begin(LH_Q_LEARNING, false);
    const int8_t direction[LH_MAX_ACTUATORS] = {1, 1, -1, 0, -1};
    const lh_decision d = drive_at(0.0f, 0.0f, direction);
    expect_velocities(&d, (float[]){0.0f, 0.3f, -0.3f, 0.0f, -0.3f});
    ck_assert_int_eq(d.choice.action, 2 + 0 * 3 + 1 * 9 + 0 * 27);
    ck_assert_int_eq(d.intervention.action, d.choice.action);
    ck_assert_uint_eq(d.intervention.hazards, 0);
    ck_assert(!d.choice.learned && d.choice.probability == 0.0f && d.choice.q == 0.0f);
    ck_assert_int_eq(d.observed.num_inputs, 6);
}
END_TEST

START_TEST(what_is_no_direction_is_still) {
    begin(LH_Q_LEARNING, false);
    const int8_t bad[LH_MAX_ACTUATORS] = {2, -2, 3, INT8_MAX, INT8_MIN, 1, 1, 1};
    const lh_decision d = drive_at(0.0f, 0.0f, bad);
    expect_velocities(&d, (float[ACTUATORS]){0.0f});
    ck_assert_int_eq(d.choice.action, 40);
}
END_TEST

/* With the monitor off for the learner, too. */
START_TEST(what_has_failed_is_not_commanded) {
    for (int32_t monitored = 0; monitored < 2; monitored++) {
        begin(LH_Q_LEARNING, monitored);
        lh_state state = crawler_state(0.0f, 0.0f, facing_y);
        state.actuator_failed[RIGHT] = state.actuator_failed[BOOM] = 1;
        const lh_decision d = drive(&state, (int8_t[LH_MAX_ACTUATORS]){0, 1, 1, 1, -1});
        expect_velocities(&d, (float[]){0.0f, 0.0f, 0.3f, 0.0f, -0.3f});
        ck_assert_uint_eq(d.intervention.hazards, LH_HAZARD_FAILED);
        ck_assert_uint_eq(d.intervention.stilled, 1u << RIGHT | 1u << BOOM);
        ck_assert_int_eq(d.choice.action, 2 + 2 * 3 + 2 * 9 + 0 * 27);
        ck_assert_int_eq(d.intervention.action, 1 + 2 * 3 + 1 * 9 + 0 * 27);
    }
}
END_TEST

START_TEST(the_monitor_stills_a_person_too) {
    begin(LH_Q_LEARNING, true);
    lh_state state = crawler_state(0.0f, 0.0f, facing_y);
    state.actuator_position[SWING] = 2.5f; /* of 2.6 */
    const lh_decision stop = drive(&state, (int8_t[LH_MAX_ACTUATORS]){0, 1, 1});
    expect_velocities(&stop, (float[]){0.0f, 0.3f, 0.0f, 0.0f, 0.0f});
    ck_assert_uint_eq(stop.intervention.hazards, LH_HAZARD_STOP);
    const lh_decision back = drive(&state, (int8_t[LH_MAX_ACTUATORS]){0, 1, -1});
    ck_assert_uint_eq(back.intervention.hazards, 0);
    ck_assert_uint_eq(controller.monitor.counts.decisions, 1);
    state.position[0] += 300.0f;
    const lh_decision jump = drive(&state, all);
    expect_velocities(&jump, (float[ACTUATORS]){0.0f});
    ck_assert_uint_eq(jump.intervention.hazards, LH_HAZARD_JUMP);
}
END_TEST

START_TEST(an_invalid_state_holds_the_robot) {
    begin(LH_Q_LEARNING, false);
    drive_at(0.0f, 0.0f, all);
    lh_state state = crawler_state(0.0f, 0.0f, facing_y);
    state.actuator_position[SWING] = NAN;
    lh_decision d;
    ck_assert_int_eq(lh_controller_drive(&controller, &state, all, &d), LH_ERROR_STATE);
    expect_velocities(&d, (float[ACTUATORS]){0.0f});
    ck_assert_uint_eq(d.intervention.hazards, LH_HAZARD_INVALID);
}
END_TEST

/* A person drives beyond the goal line and about; the learner then knows, and will draw, what it would have before. */
START_TEST(a_person_changes_nothing_of_what_was_learned) {
    static lh_learned before, after;
    for (int32_t kind = 0; kind < 2; kind++) {
        begin(kind == 0 ? LH_Q_LEARNING : LH_PLANNER, true);
        for (int32_t i = 0; i < 3; i++) {
            step_at(&controller, 0.0f, 0.1f * (float)i);
        }
        lh_learner_save(&controller.learner, &before);
        for (int32_t i = 0; i < 30; i++) {
            const lh_decision d = drive_at(0.0f, 0.1f * (float)i, ahead);
            ck_assert(!d.observed.stepped && d.observed.outcome == LH_OUTCOME_NONE && !d.observed.reset);
        }
        lh_learner_save(&controller.learner, &after);
        ck_assert_mem_eq(&before, &after, sizeof before);
        const lh_decision first = step_at(&controller, 0.0f, 3.0f);
        ck_assert(!first.choice.learned);
    }
}
END_TEST

/* The episode that was under way is forgotten with all its steps; it begins anew where the learner takes over. */
START_TEST(the_episode_begins_anew_where_it_is_handed_over) {
    begin(LH_Q_LEARNING, false);
    for (int32_t i = 0; i < 5; i++) {
        step_at(&controller, 0.0f, 0.1f * (float)i);
    }
    const lh_decision driven = drive_at(0.2f, 2.5f, ahead);
    ck_assert_int_eq(driven.observed.episode, 1);
    ck_assert_int_eq(driven.observed.step, 0);
    expect_near(driven.observed.goal_distance, 2.0, 1e-6);
    const lh_state turned = crawler_state(1.0f, 3.0f, 0.0f);
    drive(&turned, still);
    const lh_decision first = step(&controller, &turned);
    ck_assert_int_eq(first.observed.episode, 1);
    ck_assert_int_eq(first.observed.step, 0);
    expect_near(first.observed.goal_distance, 2.0, 1e-6);
    expect_near(first.observed.heading_error, 0.0, 1e-6);
    const lh_state goal = crawler_state(3.01f, 3.0f, 0.0f);
    const lh_decision second = step(&controller, &goal);
    ck_assert(second.observed.stepped && second.choice.learned);
    ck_assert_int_eq(second.observed.outcome, LH_OUTCOME_GOAL);
    ck_assert_int_eq(second.observed.summary.steps, 1);
    expect_near(second.observed.summary.start.x, 1.0, 1e-6);
}
END_TEST

/* A line that stays is what the robot limps home along. */
START_TEST(a_path_that_stays_is_gone_on_with) {
    lh_config config = lh_config_default();
    config.task.path.kind = LH_PATH_AHEAD;
    init(&controller, &config);
    step_at(&controller, 0.0f, 0.0f);
    drive_at(0.5f, 3.0f, ahead);
    const lh_decision first = step_at(&controller, 1.5f, 4.0f);
    expect_near(first.observed.lateral_error, -1.5, 1e-6);
    expect_near(first.observed.goal_distance, 2.0, 1e-6);
}
END_TEST

/* As the learner's is; the path then begins where the robot is put. */
START_TEST(a_robot_that_has_tumbled_is_put_back) {
    lh_config config = lh_config_default();
    config.task.path.kind = LH_PATH_AHEAD;
    config.monitor.active = true;
    init(&controller, &config);
    step_at(&controller, 0.0f, 0.0f);
    drive_at(0.0f, 0.4f, ahead);
    const lh_state lying = tumbled_state((lh_vec3){1.0f, 0.0f, 0.0f});
    for (int32_t i = 0; i < 3; i++) { /* until it is believed */
        const lh_decision d = drive(&lying, ahead);
        expect_velocities(&d, (float[ACTUATORS]){0.0f});
        if (d.observed.reset) {
            break;
        }
        ck_assert_int_lt(i, 2);
    }
    const lh_decision first = step_at(&controller, 7.0f, 7.0f);
    ck_assert_uint_eq(first.intervention.hazards, 0);
    ck_assert_int_eq(first.observed.episode, 1);
    expect_near(first.observed.lateral_error, 0.0, 1e-6);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("drive");
    TCase *t = tcase_create("by hand");
    tcase_add_test(t, each_actuator_goes_where_it_is_told);
    tcase_add_test(t, what_is_no_direction_is_still);
    tcase_add_test(t, what_has_failed_is_not_commanded);
    tcase_add_test(t, the_monitor_stills_a_person_too);
    tcase_add_test(t, an_invalid_state_holds_the_robot);
    suite_add_tcase(s, t);
    t = tcase_create("the learner");
    tcase_add_test(t, a_person_changes_nothing_of_what_was_learned);
    tcase_add_test(t, the_episode_begins_anew_where_it_is_handed_over);
    tcase_add_test(t, a_path_that_stays_is_gone_on_with);
    tcase_add_test(t, a_robot_that_has_tumbled_is_put_back);
    suite_add_tcase(s, t);
    return s;
}
