#include "limphome/task/observation.h"

#include <float.h>

#include "crawler.h"
#include "test.h"

START_TEST(scale_and_limit) {
    int32_t clamped = 0;
    ck_assert_float_eq(lh_observation_scale(-2.0f, -2.0f, 6.0f, &clamped), 0.0f);
    ck_assert_float_eq(lh_observation_scale(0.0f, -2.0f, 6.0f, &clamped), 0.25f);
    ck_assert_float_eq(lh_observation_scale(6.0f, -2.0f, 6.0f, &clamped), 1.0f);
    ck_assert_int_eq(clamped, 0);
    ck_assert_float_eq(lh_observation_scale(-2.001f, -2.0f, 6.0f, &clamped), 0.0f);
    ck_assert_int_eq(clamped, 1);
    ck_assert_float_eq(lh_observation_scale(FLT_MAX, -2.0f, 6.0f, &clamped), 1.0f);
    ck_assert_float_eq(lh_observation_scale(-FLT_MAX, -2.0f, 6.0f, &clamped), 0.0f);
    ck_assert_int_eq(clamped, 3);
}
END_TEST

START_TEST(ranges_of_actuators) {
    const lh_robot robot = crawler_robot();
    float low;
    float high;
    lh_observation_range(&robot.actuators[1], &low, &high);
    ck_assert_float_eq(low, -1000.0f);
    ck_assert_float_eq(high, 1000.0f);
    lh_observation_range(&robot.actuators[3], &low, &high);
    ck_assert_float_eq(low, -0.6f);
    ck_assert_float_eq(high, 1.2f);
}
END_TEST

START_TEST(inputs_of_the_paper) {
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    lh_state state = crawler_state(5.0f, 6.0f, 0.7f);
    state.actuator_effort[0] = 9.0f; /* not controlled */
    state.actuator_effort[1] = 500.0f;
    state.actuator_effort[3] = 77.0f;  /* a joint's torque is not read */
    state.actuator_position[1] = 3.0f; /* a crawler's travel is not read */
    state.actuator_position[2] = -1.3f;
    state.actuator_position[3] = 0.3f;
    state.actuator_position[4] = -2.4f;
    const lh_quat roll = lh_quat_about((lh_vec3){1, 0, 0}, 0.4f);
    const lh_quat pitch = lh_quat_about((lh_vec3){0, 1, 0}, -0.3f);
    state.orientation = lh_quat_multiply(state.orientation, lh_quat_multiply(pitch, roll));
    float inputs[6];
    ck_assert_int_eq(lh_observation(&robot, &controlled, &state, state.orientation, inputs), 0);
    expect_near(inputs[0], 0.75, 1e-6);
    expect_near(inputs[1], 0.25, 1e-6);
    expect_near(inputs[2], 0.5, 1e-6);
    expect_near(inputs[3], 0.0, 1e-6);
    expect_near(inputs[4], 0.5 + 0.4 / M_PI, 1e-6);
    expect_near(inputs[5], 0.5 - 0.3 / M_PI, 1e-6);

    /* a quaternion that is not quite of unit length is the same attitude */
    state.orientation.w *= 1.05f;
    state.orientation.x *= 1.05f;
    state.orientation.y *= 1.05f;
    state.orientation.z *= 1.05f;
    float again[6];
    lh_observation(&robot, &controlled, &state, lh_quat_normalise(state.orientation), again);
    for (int32_t i = 0; i < 6; i++) {
        expect_near(again[i], inputs[i], 1e-6);
    }
}
END_TEST

START_TEST(values_beyond_their_range_are_counted) {
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    lh_state state = crawler_state(0.0f, 0.0f, 0.0f);
    state.actuator_effort[0] = 1e6f; /* not controlled, not counted */
    state.actuator_effort[1] = -1001.0f;
    state.actuator_position[4] = 0.001f;
    state.orientation = lh_quat_about((lh_vec3){1, 0, 0}, 2.0f); /* on its back */
    float inputs[6];
    ck_assert_int_eq(lh_observation(&robot, &controlled, &state, state.orientation, inputs), 3);
    ck_assert_float_eq(inputs[0], 0.0f);
    ck_assert_float_eq(inputs[3], 1.0f);
    ck_assert_float_eq(inputs[4], 1.0f);
    for (int32_t i = 0; i < 6; i++) {
        ck_assert(inputs[i] >= 0.0f && inputs[i] <= 1.0f);
    }
}
END_TEST

START_TEST(bad_states_are_refused) {
    const lh_robot robot = crawler_robot();
    const lh_state good = crawler_state(1.0f, 2.0f, 0.3f);
    ck_assert_int_eq(lh_state_validate(&good, &robot), LH_OK);
#define CHECK(place, value, error)                                  \
    do {                                                            \
        lh_state state = good;                                      \
        state.place = value;                                        \
        ck_assert_int_eq(lh_state_validate(&state, &robot), error); \
    } while (0)
    CHECK(position[0], NAN, LH_ERROR_STATE);
    CHECK(position[1], 1.1e6f, LH_ERROR_STATE);
    CHECK(position[2], -INFINITY, LH_ERROR_STATE);
    CHECK(orientation.w, 0.0f, LH_ERROR_STATE);
    CHECK(orientation.x, NAN, LH_ERROR_STATE);
    CHECK(orientation.y, 0.6f, LH_ERROR_STATE);
    CHECK(orientation.z, INFINITY, LH_ERROR_STATE);
    CHECK(num_actuators, 4, LH_ERROR_STATE);
    CHECK(num_actuators, 6, LH_ERROR_STATE);
    CHECK(num_actuators, INT32_MIN, LH_ERROR_STATE);
    CHECK(actuator_position[0], NAN, LH_ERROR_STATE);
    CHECK(actuator_position[4], INFINITY, LH_ERROR_STATE);
    CHECK(actuator_position[4], -101.0f, LH_ERROR_STATE);
    CHECK(actuator_effort[4], NAN, LH_ERROR_STATE);
    CHECK(actuator_effort[0], -INFINITY, LH_ERROR_STATE);
    /* what is beyond the robot's actuators is not looked at, and a crawler may have travelled far */
    CHECK(actuator_position[5], NAN, LH_OK);
    CHECK(actuator_position[0], 1e5f, LH_OK);
    CHECK(position[1], 1e6f, LH_OK);
    CHECK(orientation.y, 0.4f, LH_OK);
#undef CHECK
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("observation");
    TCase *t = tcase_create("inputs");
    tcase_add_test(t, scale_and_limit);
    tcase_add_test(t, ranges_of_actuators);
    tcase_add_test(t, inputs_of_the_paper);
    tcase_add_test(t, values_beyond_their_range_are_counted);
    suite_add_tcase(s, t);
    t = tcase_create("validation");
    tcase_add_test(t, bad_states_are_refused);
    suite_add_tcase(s, t);
    return s;
}
