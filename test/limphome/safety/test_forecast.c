#include "limphome/safety/forecast.h"

#include "limphome/body/rest.h"
#include "test.h"

static const lh_quat level = {1.0f, 0.0f, 0.0f, 0.0f};
static const lh_vec3 pitch_axis = {0.0f, 1.0f, 0.0f};

/* A base of 2 m by 4 m, and a mast of the same mass that swings a weight round at 0.6 m, both 0.5 m high: the centre of
 * mass is 0.3 m from the middle, ahead at angle 0. */
static lh_robot swinging(void) {
    lh_robot robot = {
        .num_actuators = 1,
        .num_links = 2,
        .num_supports = 4,
        .actuators = {{LH_JOINT, -4.0f, 4.0f, 100.0f}},
        .supports = {{0, {1.0f, 2.0f, 0.0f}, 0.0f},
                     {0, {1.0f, -2.0f, 0.0f}, 0.0f},
                     {0, {-1.0f, 2.0f, 0.0f}, 0.0f},
                     {0, {-1.0f, -2.0f, 0.0f}, 0.0f}},
    };
    robot.links[0] = (lh_link){.parent = -1, .actuator = -1, .mass = 100.0f, .centre = {0.0f, 0.0f, 0.5f}};
    robot.links[1] = (lh_link){.parent = 0,
                               .actuator = 0,
                               .rotation = {1.0f, 0.0f, 0.0f, 0.0f},
                               .axis = {0.0f, 0.0f, 1.0f},
                               .mass = 100.0f,
                               .centre = {0.6f, 0.0f, 0.5f}};
    ck_assert_int_eq(lh_robot_validate(&robot), LH_OK);
    return robot;
}

static lh_forecast forecast(lh_quat attitude, float angle, float next) {
    const lh_robot robot = swinging();
    return lh_forecast_margin(&robot, attitude, &angle, &next);
}

/* Rise of a centre of mass 0.5 m high over an edge that lies `ahead` of it, on a slope that falls towards the edge. */
static double rise(double ahead, double slope) {
    return sqrt(ahead * ahead + 0.25) - (0.5 * cos(slope) + ahead * sin(slope));
}

START_TEST(on_level_ground) {
    const lh_forecast ahead_to_side = forecast(level, 0.0f, 1.5f);
    expect_near(ahead_to_side.still, rise(0.7, 0.0), 1e-6);
    expect_near(ahead_to_side.moving, rise(1.0 - 0.3 * cos(1.5), 0.0), 1e-6);
}
END_TEST

/* Nose down the edge ahead is the weaker one, whichever way the robot faces; turning the weight back helps. */
START_TEST(on_a_slope_that_the_attitude_tells) {
    for (int i = 0; i < 4; i++) {
        const lh_quat heading = lh_quat_about((lh_vec3){0.0f, 0.0f, 1.0f}, (float)i);
        const lh_quat attitude = lh_quat_multiply(heading, lh_quat_about(pitch_axis, 0.3f));
        const lh_forecast back = forecast(attitude, 0.0f, (float)M_PI);
        expect_near(back.still, rise(0.7, 0.3), 2e-6);
        expect_near(back.moving, fmin(rise(1.3, 0.3), rise(0.7, -0.3)), 2e-6);
        ck_assert_float_gt(back.moving, back.still);
    }
}
END_TEST

/* Down a slope of 60 degrees it would tip over its front edge: there is no rest. */
START_TEST(where_it_cannot_rest) {
    const lh_forecast tipping = forecast(lh_quat_about(pitch_axis, 1.0f), 0.0f, (float)M_PI);
    ck_assert_float_eq(tipping.still, LH_NO_REST_MARGIN);
    expect_near(tipping.moving, rise(1.3, 1.0), 2e-6);
}
END_TEST

/* Too steep for ground: the robot falls, and its attitude tells nothing of what is below it. */
START_TEST(steeper_than_ground) {
    const lh_forecast falling = forecast(lh_quat_about(pitch_axis, 1.2f), 0.0f, 0.0f);
    expect_near(falling.still, rise(0.7, 0.0), 1e-6);
    ck_assert_float_eq(falling.moving, falling.still);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("forecast");
    TCase *t = tcase_create("forecast");
    tcase_add_test(t, on_level_ground);
    tcase_add_test(t, on_a_slope_that_the_attitude_tells);
    tcase_add_test(t, where_it_cannot_rest);
    tcase_add_test(t, steeper_than_ground);
    suite_add_tcase(s, t);
    return s;
}
