/* Between settings, messages and the library: nothing is lost or mixed up. */
#include <string.h>

#include "convert.h"
#include "robot_of.h"
#include "suite.h"

static lh_controller controller; /* too large for a comfortable stack frame */

static void make_controller(void) {
    const lh_robot robot = robot_of(CONFIG_DIR "/crawler.urdf");
    const settings s = settings_default();
    const lh_config config = convert_config(&s);
    const lh_controlled controlled = {.count = 4, .index = {1, 2, 3, 4}};
    ck_assert_int_eq(lh_controller_init(&controller, &config, &robot, &controlled), LH_OK);
}

START_TEST(default_settings_are_the_librarys_defaults) {
    const settings s = settings_default();
    const lh_config config = convert_config(&s);
    const lh_config standard = lh_config_default();
#define SAME(field) ck_assert_double_eq((double)config.field, (double)standard.field)
    SAME(task.crawler_speed);
    SAME(task.joint_speed);
    SAME(task.reward.forward);
    SAME(task.reward.sideways);
    SAME(task.reward.turn);
    SAME(task.reward.heading_error);
    SAME(task.reward.goal);
    SAME(task.reward.stability);
    SAME(task.reward.tumble);
    SAME(task.episode.goal_distance);
    SAME(task.episode.step_limit);
    SAME(task.episode.tumble_tilt);
    SAME(task.episode.reset_every);
    SAME(task.path.kind);
    SAME(learner.kind);
    SAME(learner.seed);
    SAME(learner.learn);
    SAME(learner.greedy);
    SAME(learner.q_learning.learning_rate);
    SAME(learner.q_learning.discount_rate);
    SAME(learner.q_learning.temperature_floor);
    SAME(learner.q_learning.network.units);
    SAME(learner.q_learning.network.inputs);
    SAME(learner.q_learning.network.rate_weight);
    SAME(learner.q_learning.network.rate_width);
    SAME(learner.q_learning.network.rate_centre);
    SAME(learner.q_learning.network.initial_weight);
    SAME(learner.q_learning.network.initial_width);
    SAME(learner.q_learning.network.width_floor);
    SAME(learner.q_learning.network.weight_limit);
    SAME(learner.q_learning.network.exact_gradient);
    SAME(learner.planner.decision_period);
    SAME(learner.planner.mechanics);
    SAME(learner.planner.steering);
    SAME(learner.planner.unsafe);
    SAME(learner.planner.caution);
    SAME(learner.planner.random_share);
    SAME(learner.planner.candidates);
    SAME(learner.planner.sweeps);
    SAME(learner.planner.backups);
    SAME(monitor.active);
    SAME(monitor.period);
    SAME(monitor.crawler.speed);
    SAME(monitor.crawler.acceleration);
    SAME(monitor.joint.speed);
    SAME(monitor.joint.acceleration);
    SAME(monitor.stop_clearance);
    SAME(monitor.margin_floor);
    SAME(monitor.tilt);
#undef SAME
    ck_assert_int_eq(lh_config_validate(&config), LH_OK);
}
END_TEST

/* One key is the discount rate of both learners, and its default the paper's. */
START_TEST(default_ini_is_a_planner_with_the_librarys_discount_rate) {
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    ck_assert_msg(settings_read(&s, CONFIG_DIR "/default.ini", error), "%s", error);
    const lh_config config = convert_config(&s);
    ck_assert_int_eq(config.learner.kind, LH_PLANNER);
    ck_assert_float_eq(config.learner.planner.discount_rate, lh_planner_config_default().discount_rate);
    ck_assert_int_eq(lh_config_validate(&config), LH_OK);
}
END_TEST

START_TEST(each_choice_of_a_planner_is_the_same_in_the_library) {
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    ck_assert(settings_set(&s, "episode.decision_period_s=0.25", error));
    ck_assert(settings_set(&s, "planner.mechanics=none", error));
    const lh_planner_config config = convert_config(&s).learner.planner;
    ck_assert_float_eq(config.decision_period, 0.25F);
    ck_assert(!config.mechanics);
}
END_TEST

START_TEST(a_path_is_the_same_in_the_library) {
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    ck_assert(settings_set(&s, "task.path=ahead", error));
    ck_assert_int_eq(convert_config(&s).task.path.kind, LH_PATH_AHEAD);
    ck_assert(settings_set(&s, "task.path=to 0.5 5, -3 4", error));
    const lh_path_config path = convert_config(&s).task.path;
    ck_assert_int_eq(path.kind, LH_PATH_WAYPOINTS);
    ck_assert_int_eq(path.num_waypoints, 2);
    ck_assert_float_eq(path.waypoint[0].x, 0.5F);
    ck_assert_float_eq(path.waypoint[0].y, 5);
    ck_assert_float_eq(path.waypoint[1].x, -3);
    ck_assert_float_eq(path.waypoint[1].y, 4);
}
END_TEST

START_TEST(each_limit_is_told) {
    make_controller();
    controller.task.clamped = (lh_clamped){.inputs = 1, .margins = 2};
    controller.learner.as.q_learning.floored = 4;
    controller.learner.as.q_learning.held = (lh_held){8, 16, 32};
    limphome_status_t status;
    memset(&status, 0, sizeof status);
    controller.monitor.counts = (lh_monitor_counts){.decisions = 64, .actuators = 128};
    convert_limits(&controller, &status);
    ck_assert_int_eq(status.clamped_inputs, 1);
    ck_assert_int_eq(status.clamped_margins, 2);
    ck_assert_int_eq(status.clamped_temperatures, 4);
    ck_assert_int_eq(status.clamped_weights, 8);
    ck_assert_int_eq(status.clamped_widths, 16);
    ck_assert_int_eq(status.clamped_centres, 32);
    ck_assert_int_eq(status.clamped, 63);
    ck_assert_int_eq(status.interventions, 64);
    ck_assert_int_eq(status.stilled_actuators, 128);
}
END_TEST

START_TEST(a_decision_tells_the_inputs_of_state_and_action) {
    make_controller();
    const limphome_robot_state_t state = {.num_actuators = 5, .orientation = {1}, .session = 3, .seq = 9};
    const lh_state sensed = convert_state(&state);
    lh_decision decision;
    ck_assert_int_eq(lh_controller_step(&controller, &sensed, &decision), LH_OK);
    limphome_decision_t message = convert_decision(&controller, &decision, &state);
    ck_assert_int_eq(message.session, 3);
    ck_assert_int_eq(message.seq, 9);
    ck_assert_int_eq(message.num_inputs, 10);
    int32_t action = 0;
    for (int k = 3; k >= 0; k--) { /* digit k of the number in base 3 */
        action = 3 * action + (int32_t)(2 * message.inputs[6 + k]);
    }
    ck_assert_int_eq(action, decision.choice.action);
    decision.observed.reset = true; /* no action follows */
    message = convert_decision(&controller, &decision, &state);
    ck_assert_int_eq(message.num_inputs, 6);
}
END_TEST

START_TEST(a_decision_tells_what_the_monitor_did) {
    make_controller();
    lh_controller_guard(&controller);
    limphome_robot_state_t state = {.num_actuators = 5, .orientation = {1}, .actuator_health = {1, 1, 1, 1, 1}};
    lh_decision decision;
    do { /* until it chooses to move */
        const lh_state sensed = convert_state(&state);
        ck_assert_int_eq(lh_controller_step(&controller, &sensed, &decision), LH_OK);
    } while (decision.intervention.hazards == 0);
    const limphome_decision_t message = convert_decision(&controller, &decision, &state);
    ck_assert_int_eq(message.action, 40);
    ck_assert_int_eq(message.proposed_action, decision.choice.action);
    ck_assert_int_eq(message.interventions & LIMPHOME_DECISION_T_FAILED, LIMPHOME_DECISION_T_FAILED);
    ck_assert_int_eq(message.stilled, (int32_t)decision.intervention.stilled);
    for (int k = 0; k < 4; k++) {
        ck_assert_float_eq(message.inputs[6 + k], 0.5F);
    }
}
END_TEST

START_TEST(limits_of_the_monitor_are_the_settings) {
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    const char *assignments[] = {"safety.monitor=on",
                                 "episode.decision_period_s=0.25",
                                 "safety.crawler_speed=1",
                                 "safety.joint_speed=2",
                                 "safety.crawler_acceleration=3",
                                 "safety.joint_acceleration=4",
                                 "safety.stop_clearance_rad=0.5",
                                 "safety.margin_floor_m=0.25",
                                 "safety.tilt_rad=0.75"};
    for (size_t i = 0; i < sizeof assignments / sizeof assignments[0]; i++) {
        ck_assert_msg(settings_set(&s, assignments[i], error), "%s", error);
    }
    const lh_monitor_config config = convert_config(&s).monitor;
    ck_assert(config.active);
    ck_assert_float_eq(config.period, 0.25F);
    ck_assert_float_eq(config.crawler.speed, 1);
    ck_assert_float_eq(config.joint.speed, 2);
    ck_assert_float_eq(config.crawler.acceleration, 3);
    ck_assert_float_eq(config.joint.acceleration, 4);
    ck_assert_float_eq(config.stop_clearance, 0.5F);
    ck_assert_float_eq(config.margin_floor, 0.25F);
    ck_assert_float_eq(config.tilt, 0.75F);
}
END_TEST

START_TEST(an_episode_tells_its_line) {
    make_controller();
    const limphome_robot_state_t state = {.num_actuators = 5, .orientation = {1}};
    const lh_summary summary = {.outcome = LH_OUTCOME_GOAL,
                                .start = {1, 2, 3},
                                .line_heading = 4,
                                .start_lateral_error = 5,
                                .goal_distance = 6,
                                .waypoint_distance = 7,
                                .arrived = true};
    const limphome_episode_t message = convert_episode(&controller, &summary, &state, 0.5);
    ck_assert_int_eq(message.outcome, LIMPHOME_EPISODE_T_GOAL);
    ck_assert_double_eq(message.start[1], 2);
    ck_assert_double_eq(message.start_heading, 3);
    ck_assert_double_eq(message.line_heading, 4);
    ck_assert_double_eq(message.start_lateral_error, 5);
    ck_assert_double_eq(message.goal_distance, 6);
    ck_assert_double_eq(message.waypoint_distance, 7);
    ck_assert_int_eq(message.arrived, 1);
}
END_TEST

START_TEST(what_has_failed_is_not_controlled) {
    limphome_robot_state_t message;
    memset(&message, 0, sizeof message);
    message.num_actuators = 5;
    message.actuator_health[0] = 1; /* failed */
    message.actuator_health[3] = 2; /* weak */
    const lh_controlled controlled = convert_controlled(&message);
    ck_assert_int_eq(controlled.count, 4);
    for (int i = 0; i < 4; i++) {
        ck_assert_int_eq(controlled.index[i], i + 1);
    }
}
END_TEST

START_TEST(state_keeps_position_attitude_angles_and_torque) {
    limphome_robot_state_t message;
    memset(&message, 0, sizeof message);
    message.num_actuators = 5;
    message.position[1] = 2.5;
    message.orientation[0] = 0.6;
    message.orientation[3] = 0.8;
    message.actuator_position[4] = -1.5;
    message.actuator_effort[1] = 300;
    message.actuator_health[2] = LIMPHOME_ROBOT_STATE_T_FAILED;
    message.actuator_health[3] = LIMPHOME_ROBOT_STATE_T_WEAK;
    const lh_state state = convert_state(&message);
    ck_assert_float_eq(state.position[1], 2.5F);
    ck_assert_float_eq(state.orientation.w, 0.6F);
    ck_assert_float_eq(state.orientation.z, 0.8F);
    ck_assert_float_eq(state.actuator_position[4], -1.5F);
    ck_assert_float_eq(state.actuator_effort[1], 300);
    ck_assert_int_eq(state.num_actuators, 5);
    for (int i = 0; i < 5; i++) {
        ck_assert_int_eq(state.actuator_failed[i], i == 2);
    }
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("convert");
    tcase_add_test(cases, default_settings_are_the_librarys_defaults);
    tcase_add_test(cases, default_ini_is_a_planner_with_the_librarys_discount_rate);
    tcase_add_test(cases, each_choice_of_a_planner_is_the_same_in_the_library);
    tcase_add_test(cases, a_path_is_the_same_in_the_library);
    tcase_add_test(cases, each_limit_is_told);
    tcase_add_test(cases, a_decision_tells_the_inputs_of_state_and_action);
    tcase_add_test(cases, a_decision_tells_what_the_monitor_did);
    tcase_add_test(cases, limits_of_the_monitor_are_the_settings);
    tcase_add_test(cases, an_episode_tells_its_line);
    tcase_add_test(cases, what_has_failed_is_not_controlled);
    tcase_add_test(cases, state_keeps_position_attitude_angles_and_torque);
    return run_suite("convert", cases);
}
