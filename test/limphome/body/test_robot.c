#include "limphome/body/robot.h"

#include "crawler.h"
#include "test.h"

START_TEST(crawler_is_good) {
    const lh_robot robot = crawler_robot();
    ck_assert_int_eq(lh_robot_validate(&robot), LH_OK);
}
END_TEST

START_TEST(one_link_is_enough) {
    lh_robot robot = crawler_robot();
    robot.num_links = 1;
    robot.num_supports = 4; /* those of the crawlers */
    ck_assert_int_eq(lh_robot_validate(&robot), LH_OK);
}
END_TEST

START_TEST(broken_rules_are_named) {
#define BAD(place, value, error)                            \
    do {                                                    \
        lh_robot robot = crawler_robot();                   \
        robot.place = value;                                \
        ck_assert_int_eq(lh_robot_validate(&robot), error); \
    } while (0)
    BAD(num_actuators, 0, LH_ERROR_ACTUATORS);
    BAD(num_actuators, LH_MAX_ACTUATORS + 1, LH_ERROR_ACTUATORS);
    BAD(actuators[0].effort_limit, 0.0f, LH_ERROR_ACTUATORS);
    BAD(actuators[0].effort_limit, INFINITY, LH_ERROR_ACTUATORS);
    BAD(actuators[4].effort_limit, NAN, LH_ERROR_ACTUATORS);
    BAD(actuators[1].effort_limit, 1.001f * LH_EFFORT_LIMIT, LH_ERROR_ACTUATORS); /* twice it must be finite */
    BAD(actuators[2].high, -2.6f, LH_ERROR_ACTUATORS);
    BAD(actuators[2].low, NAN, LH_ERROR_ACTUATORS);
    BAD(actuators[2].low, -101.0f, LH_ERROR_ACTUATORS);
    BAD(actuators[2].high, 101.0f, LH_ERROR_ACTUATORS);
    BAD(actuators[4].kind, LH_CRAWLER, LH_ERROR_ACTUATORS); /* after a joint */
    BAD(actuators[1].kind, (lh_actuator_kind)2, LH_ERROR_ACTUATORS);
    BAD(num_links, 0, LH_ERROR_ROBOT);
    BAD(num_links, LH_MAX_LINKS + 1, LH_ERROR_ROBOT);
    BAD(num_supports, 2, LH_ERROR_ROBOT);
    BAD(num_supports, LH_MAX_SUPPORTS + 1, LH_ERROR_ROBOT);
    BAD(links[0].parent, 0, LH_ERROR_ROBOT);
    BAD(links[0].actuator, 2, LH_ERROR_ROBOT);
    BAD(links[3].parent, -1, LH_ERROR_ROBOT);
    BAD(links[3].parent, 3, LH_ERROR_ROBOT); /* itself */
    BAD(links[3].actuator, 5, LH_ERROR_ROBOT);
    BAD(links[3].actuator, -2, LH_ERROR_ROBOT);
    BAD(links[3].actuator, 0, LH_ERROR_ROBOT); /* a crawler */
    BAD(links[3].axis.z, 0.9f, LH_ERROR_ROBOT);
    BAD(links[3].axis.x, NAN, LH_ERROR_ROBOT);
    BAD(links[3].rotation.w, 0.0f, LH_ERROR_ROBOT);
    BAD(links[3].origin.y, INFINITY, LH_ERROR_ROBOT);
    BAD(links[3].mass, -1.0f, LH_ERROR_ROBOT);
    BAD(links[3].mass, NAN, LH_ERROR_ROBOT);
    BAD(links[3].centre.z, 1001.0f, LH_ERROR_ROBOT);
    BAD(supports[4].link, 6, LH_ERROR_ROBOT);
    BAD(supports[4].link, -1, LH_ERROR_ROBOT);
    BAD(supports[4].radius, -0.1f, LH_ERROR_ROBOT);
    BAD(supports[4].point.x, NAN, LH_ERROR_ROBOT);
#undef BAD
}
END_TEST

START_TEST(total_mass_must_have_a_finite_reciprocal) {
    lh_robot robot = crawler_robot();
    for (int32_t i = 0; i < robot.num_links; i++) {
        robot.links[i].mass = 0.0f;
    }
    ck_assert_int_eq(lh_robot_validate(&robot), LH_ERROR_ROBOT);
    robot.links[5].mass = 1e-44f;
    ck_assert_int_eq(lh_robot_validate(&robot), LH_ERROR_ROBOT);
    robot.links[5].mass = LH_LEAST_MASS;
    ck_assert_int_eq(lh_robot_validate(&robot), LH_OK);
}
END_TEST

START_TEST(scale_is_that_of_the_base) {
    lh_robot robot = crawler_robot();
    ck_assert_float_eq(lh_robot_scale(&robot), 1.0f); /* to the bit: the paper's robot is the measure */
    for (float factor = 0.1f; factor < 11.0f; factor *= 10.0f) {
        const lh_robot scaled = scaled_robot(&robot, factor);
        expect_near(lh_robot_scale(&scaled), factor, 1e-6 * factor);
    }
    robot.supports[4].point.x = 99.0f; /* the arm's */
    ck_assert_float_eq(lh_robot_scale(&robot), 1.0f);
    robot.supports[1].point.x = -3.125f; /* longer than wide */
    expect_near(lh_robot_scale(&robot), 5.0, 1e-6);
}
END_TEST

START_TEST(scale_is_bounded) {
    lh_robot robot = crawler_robot();
    robot.supports[0].point.x = LH_LENGTH_LIMIT;
    robot.supports[1].point.x = -LH_LENGTH_LIMIT;
    ck_assert_float_eq(lh_robot_scale(&robot), LH_SCALE_MAX);
    for (int32_t i = 0; i < robot.num_supports; i++) {
        robot.supports[i].link = 5; /* none on the base */
    }
    ck_assert_float_eq(lh_robot_scale(&robot), LH_SCALE_MIN);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("robot");
    TCase *t = tcase_create("rules");
    tcase_add_test(t, crawler_is_good);
    tcase_add_test(t, one_link_is_enough);
    tcase_add_test(t, broken_rules_are_named);
    tcase_add_test(t, total_mass_must_have_a_finite_reciprocal);
    suite_add_tcase(s, t);
    t = tcase_create("scale");
    tcase_add_test(t, scale_is_that_of_the_base);
    tcase_add_test(t, scale_is_bounded);
    suite_add_tcase(s, t);
    return s;
}
