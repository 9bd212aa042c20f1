/* The robot of the paper as the library has it. */
#include <math.h>
#include <string.h>

#include "robot_of.h"

START_TEST(crawler_has_its_actuators) {
    const lh_robot robot = robot_of(CONFIG_DIR "/crawler.urdf");
    ck_assert_int_eq(robot.num_actuators, 5);
    for (int i = 0; i < 5; i++) {
        ck_assert_int_eq(robot.actuators[i].kind, i < 2 ? LH_CRAWLER : LH_JOINT);
    }
    ck_assert_float_eq(robot.actuators[0].effort_limit, 1000);
    ck_assert_float_eq(robot.actuators[3].low, -0.6F);
    ck_assert_float_eq(robot.actuators[3].high, 1.2F);
}
END_TEST

START_TEST(crawler_has_its_links) {
    const lh_robot robot = robot_of(CONFIG_DIR "/crawler.urdf");
    ck_assert_int_eq(robot.num_links, 6);
    static const struct {
        int parent, actuator;
        float x, mass, centre;
    } links[] = {{-1, -1, 0, 498, 0},    {0, -1, -0.62F, 1, 0},   {0, -1, -0.62F, 1, 0},
                 {0, 2, 0, 350, -0.10F}, {3, 3, 0.4F, 60, 0.55F}, {4, 4, 1.1F, 35, 0.4F}};
    for (int i = 0; i < 6; i++) {
        ck_assert_int_eq(robot.links[i].parent, links[i].parent);
        ck_assert_int_eq(robot.links[i].actuator, links[i].actuator);
        ck_assert_float_eq(robot.links[i].origin.x, links[i].x);
        ck_assert_float_eq(robot.links[i].rotation.w, 1);
        ck_assert_float_eq(robot.links[i].mass, links[i].mass);
        ck_assert_float_eq_tol(robot.links[i].centre.x, links[i].centre, 1e-7F);
    }
    ck_assert_float_eq(robot.links[5].axis.y, -1);
}
END_TEST

/* The tip and four ends of crawlers. */
START_TEST(crawler_has_its_supports) {
    const lh_robot robot = robot_of(CONFIG_DIR "/crawler.urdf");
    ck_assert_int_eq(robot.num_supports, 5);
    ck_assert_int_eq(robot.supports[0].link, 5);
    ck_assert_float_eq(robot.supports[0].radius, 0.08F);
    ck_assert_int_eq(robot.supports[4].link, 0);
    ck_assert_float_eq(robot.supports[4].point.y, -0.625F);
}
END_TEST

/* What the reader accepts may still be more than a small library takes. */
START_TEST(a_robot_that_the_library_cannot_take_is_refused) {
    robot_description read;
    lh_robot robot, before;
    char error[ERROR_LENGTH] = "";
    ck_assert(robot_file_load(CONFIG_DIR "/crawler.urdf", NULL, &read));
    memset(&robot, 7, sizeof robot);
    before = robot;
    read.num_bodies = LH_MAX_LINKS + 1;
    ck_assert(!convert_robot(&read, &robot, error));
    ck_assert_ptr_nonnull(strstr(error, "robot crawler: has 5 actuators"));
    read.num_bodies = 6;
    read.bodies[3].mass = -1;
    error[0] = '\0';
    ck_assert(!convert_robot(&read, &robot, error));
    ck_assert_ptr_nonnull(strstr(error, "robot crawler: "));
    ck_assert_mem_eq(&robot, &before, sizeof robot);
}
END_TEST

static bool is_at(lh_vec3 v, float x, float y, float z) {
    return fabsf(v.x - x) < 1e-6F && fabsf(v.y - y) < 1e-6F && fabsf(v.z - z) < 1e-6F;
}

/* Belts, then the arm's from the tip on, then the base's. */
START_TEST(crawler_has_its_shapes) {
    robot_description read;
    lh_shapes shapes;
    ck_assert(robot_file_load(CONFIG_DIR "/crawler.urdf", NULL, &read));
    ck_assert_int_eq(convert_shapes(&read, &shapes), 0);
    const lh_robot robot = robot_of(CONFIG_DIR "/crawler.urdf");
    ck_assert_int_eq(lh_shapes_validate(&shapes, &robot), LH_OK);
    ck_assert_int_eq(shapes.count, 8);
    static const int links[] = {0, 0, 5, 3, 4, 4, 5, 0};
    for (int i = 0; i < 8; i++) {
        ck_assert_int_eq(shapes.shape[i].link, links[i]);
    }
    const uint32_t expected[] = {1u << 4 | 1u << 5, 0, 0, 1u << 5, 1u << 0, 1u << 0 | 1u << 3};
    ck_assert_mem_eq(shapes.may_meet, expected, sizeof expected);

    const lh_shape *belt = &shapes.shape[1];
    ck_assert(belt->disc && is_at(belt->centre, 0, -0.475F, 0.18F) && is_at(belt->half, 0.62F, 0, 0.15F));
    ck_assert_float_eq(belt->radius, 0.18F);
    ck_assert(is_at(lh_quat_rotate(belt->rotation, (lh_vec3){0, 0, 1}), 0, 1, 0));
    ck_assert(is_at(lh_quat_rotate(belt->rotation, (lh_vec3){1, 0, 0}), 1, 0, 0));
    const lh_shape *tip = &shapes.shape[2];
    ck_assert(!tip->disc && is_at(tip->centre, 0.8F, 0, 0) && is_at(tip->half, 0, 0, 0));
    const lh_shape *cabin = &shapes.shape[3];
    ck_assert(is_at(cabin->centre, -0.1F, 0, 0.43F) && is_at(cabin->half, 0.5F, 0.4F, 0.43F));
    ck_assert(cabin->radius == 0.0F);
}
END_TEST

START_TEST(shapes_beyond_the_room_are_left_out) {
    robot_description read;
    lh_shapes shapes;
    ck_assert(robot_file_load(CONFIG_DIR "/crawler.urdf", NULL, &read));
    while (read.num_shapes < ROBOT_MAX_SHAPES) {
        read.shapes[read.num_shapes] = read.shapes[1];
        read.shapes[read.num_shapes++].kind = ROBOT_CYLINDER;
    }
    ck_assert_int_eq(convert_shapes(&read, &shapes), ROBOT_CRAWLERS + ROBOT_MAX_SHAPES - LH_MAX_SHAPES);
    ck_assert_int_eq(shapes.count, LH_MAX_SHAPES);
    ck_assert(shapes.shape[LH_MAX_SHAPES - 1].disc);
    memset(read.may_meet, false, sizeof read.may_meet);
    ck_assert_int_eq(convert_shapes(&read, &shapes), 0);
    ck_assert_int_eq(shapes.count, 0);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("convert_robot");
    tcase_add_test(cases, crawler_has_its_actuators);
    tcase_add_test(cases, crawler_has_its_links);
    tcase_add_test(cases, crawler_has_its_supports);
    tcase_add_test(cases, crawler_has_its_shapes);
    tcase_add_test(cases, shapes_beyond_the_room_are_left_out);
    tcase_add_test(cases, a_robot_that_the_library_cannot_take_is_refused);
    return run_suite("convert_robot", cases);
}
