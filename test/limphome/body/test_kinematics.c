#include "limphome/body/kinematics.h"

#include "crawler.h"
#include "reference.h"
#include "test.h"

static const lh_quat level = {1.0f, 0.0f, 0.0f, 0.0f};

static void expect_vector(lh_vec3 actual, const double *expected) {
    expect_near(actual.x, expected[0], 2e-6);
    expect_near(actual.y, expected[1], 2e-6);
    expect_near(actual.z, expected[2], 2e-6);
}

START_TEST(postures_against_reference) {
    const lh_robot robot = crawler_robot();
    for (int32_t k = 0; k < COUNT(posture_angles); k++) {
        const float *q = posture_attitude[k];
        float angles[LH_MAX_ACTUATORS] = {NAN, NAN}; /* crawlers are not read */
        memcpy(&angles[2], posture_angles[k], sizeof posture_angles[k]);
        lh_posture posture;
        lh_kinematics_posture(&robot, (lh_quat){q[0], q[1], q[2], q[3]}, angles, &posture);
        expect_vector(posture.centre_of_mass, posture_mass[k]);
        for (int32_t i = 0; i < robot.num_supports; i++) {
            expect_vector(posture.supports[i], posture_supports[k][i]);
        }
    }
}
END_TEST

START_TEST(links_may_be_turned_against_their_parents) {
    /* a single joint about x on a link that is turned by a quarter about z: its axis is the body's y */
    lh_robot robot = crawler_robot();
    robot.num_links = 2;
    robot.links[1] = (lh_link){
        .parent = 0,
        .actuator = 2,
        .origin = {1.0f, 0.0f, 0.5f},
        .rotation = lh_quat_about((lh_vec3){0, 0, 1}, 1.57079633f),
        .axis = {1, 0, 0},
        .mass = 1.0f,
        .centre = {0.0f, -2.0f, 0.0f},
    };
    robot.links[0].mass = 0.0f;
    robot.supports[4].link = 1;
    ck_assert_int_eq(lh_robot_validate(&robot), LH_OK);
    lh_posture posture;
    const float angles[] = {0, 0, 0.5f, 0, 0};
    lh_kinematics_posture(&robot, level, angles, &posture);
    /* (0, -2, 0) points along the body's x, and turns down about its y */
    expect_vector(posture.centre_of_mass, (double[]){1.0 + 2.0 * cos(0.5), 0.0, 0.5 - 2.0 * sin(0.5)});
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("kinematics");
    TCase *t = tcase_create("posture");
    tcase_add_test(t, postures_against_reference);
    tcase_add_test(t, links_may_be_turned_against_their_parents);
    suite_add_tcase(s, t);
    return s;
}
