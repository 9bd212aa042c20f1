/* Between settings, messages and the library: nothing is lost or mixed up, and a policy fits only its own robot. */
#include <string.h>

#include "convert.h"
#include "suite.h"
#include "urdf.h"

static lh_controller controller; /* too large for a comfortable stack frame */

static void make_controller(void) {
    urdf_robot robot;
    char error[URDF_ERROR_LENGTH] = "";
    ck_assert_msg(urdf_read(&robot, CONFIG_DIR "/crawler.urdf", error) == 0, "%s", error);
    const settings s = settings_default();
    const lh_config config = convert_config(&s);
    const lh_controlled controlled = {.count = 4, .index = {1, 2, 3, 4}};
    ck_assert_int_eq(lh_controller_init(&controller, &config, &robot.robot, &controlled), LH_OK);
}

START_TEST(default_settings_are_the_librarys_defaults) {
    const settings s = settings_default();
    const lh_config config = convert_config(&s);
    const lh_config standard = lh_config_default();
    ck_assert_float_eq(config.reward.forward, standard.reward.forward);
    ck_assert_float_eq(config.reward.sideways, standard.reward.sideways);
    ck_assert_float_eq(config.reward.turn, standard.reward.turn);
    ck_assert_float_eq(config.reward.goal, standard.reward.goal);
    ck_assert_float_eq(config.reward.stability, standard.reward.stability);
    ck_assert_float_eq(config.reward.tumble, standard.reward.tumble);
    ck_assert_int_eq(config.reward.heading_error, standard.reward.heading_error);
    ck_assert_float_eq(config.episode.goal_distance, standard.episode.goal_distance);
    ck_assert_float_eq(config.episode.tumble_tilt, standard.episode.tumble_tilt);
    ck_assert_int_eq(config.episode.step_limit, standard.episode.step_limit);
    ck_assert_int_eq(config.episode.reset_every, standard.episode.reset_every);
    ck_assert_float_eq(config.learner.learning_rate, standard.learner.learning_rate);
    ck_assert_float_eq(config.learner.discount_rate, standard.learner.discount_rate);
    ck_assert_float_eq(config.learner.network.width_floor, standard.learner.network.width_floor);
    ck_assert_float_eq(config.learner.network.weight_limit, standard.learner.network.weight_limit);
    ck_assert_float_eq(config.learner.network.rate_centre, standard.learner.network.rate_centre);
    ck_assert_int_eq(config.learner.network.units, standard.learner.network.units);
    ck_assert_int_eq(lh_config_validate(&config), LH_OK);
}
END_TEST

START_TEST(a_policy_gives_back_the_network) {
    make_controller();
    const limphome_policy_t policy = convert_policy(&controller, 7, 0);
    ck_assert_int_eq(policy.episode, 7);
    ck_assert_int_eq(policy.num_inputs, 10);
    ck_assert_int_eq(policy.controlled[0], 1);
    ck_assert_float_eq(policy.input_low[0], -1000);
    ck_assert_float_eq(policy.input_high[2], 1.2F);
    lh_network network;
    ck_assert(convert_network(&policy, &controller, &network));
    ck_assert_mem_eq(&network, &controller.learner.network, sizeof network);
}
END_TEST

START_TEST(a_policy_of_another_robot_is_refused) {
    make_controller();
    lh_network network;
    limphome_policy_t policy = convert_policy(&controller, 7, 0);
    policy.controlled[0] = 0;
    ck_assert(!convert_network(&policy, &controller, &network));
    policy = convert_policy(&controller, 7, 0);
    policy.speed[1] = 0.2F;
    ck_assert(!convert_network(&policy, &controller, &network));
    policy = convert_policy(&controller, 7, 0);
    policy.input_high[3] = 1;
    ck_assert(!convert_network(&policy, &controller, &network));
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
    const lh_state state = convert_state(&message);
    ck_assert_float_eq(state.position[1], 2.5F);
    ck_assert_float_eq(state.orientation.w, 0.6F);
    ck_assert_float_eq(state.orientation.z, 0.8F);
    ck_assert_float_eq(state.actuator_position[4], -1.5F);
    ck_assert_float_eq(state.actuator_effort[1], 300);
    ck_assert_int_eq(state.num_actuators, 5);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("convert");
    tcase_add_test(cases, default_settings_are_the_librarys_defaults);
    tcase_add_test(cases, a_policy_gives_back_the_network);
    tcase_add_test(cases, a_policy_of_another_robot_is_refused);
    tcase_add_test(cases, what_has_failed_is_not_controlled);
    tcase_add_test(cases, state_keeps_position_attitude_angles_and_torque);
    return run_suite("convert", cases);
}
