#include "limphome/task/path.h"

#include "test.h"

static const lh_pose2 start = {3.0f, -1.0f, (float)M_PI_2}; /* facing +y */

/* An L: 5 m ahead of `start`, then 5 m to the right. */
static const lh_path_config corner = {
    .kind = LH_PATH_WAYPOINTS, .num_waypoints = 2, .waypoint = {{3.0f, 4.0f}, {8.0f, 4.0f}}};

static lh_pose2 at(float x, float y) {
    return (lh_pose2){x, y, 0.3f};
}

/* The path after the robot has been at `pose`. */
static void advance(lh_path *path, const lh_path_config *config, float x, float y) {
    const lh_pose2 pose = at(x, y);
    lh_path_advance(path, config, &pose);
}

START_TEST(the_default_rolls) {
    const lh_path_config config = lh_path_config_default();
    ck_assert_int_eq(config.kind, LH_PATH_ROLLING);
    ck_assert_int_eq(lh_path_config_validate(&config), LH_OK);
}
END_TEST

START_TEST(bad_fields_are_named) {
    ck_assert_int_eq(lh_path_config_validate(&corner), LH_OK);
#define BAD(field, value)                                                  \
    do {                                                                   \
        lh_path_config config = corner;                                    \
        config.field = value;                                              \
        ck_assert_int_eq(lh_path_config_validate(&config), LH_ERROR_PATH); \
    } while (0)
    BAD(kind, (lh_path_kind)3);
    BAD(kind, (lh_path_kind)-1);
    BAD(num_waypoints, 0);
    BAD(num_waypoints, LH_MAX_WAYPOINTS + 1);
    BAD(waypoint[0].x, NAN);
    BAD(waypoint[1].y, 1000.1f);
    BAD(waypoint[1].x, -1000.1f);
#undef BAD
    lh_path_config config = corner;
    config.waypoint[2].x = NAN; /* not used */
    ck_assert_int_eq(lh_path_config_validate(&config), LH_OK);
    config.waypoint[0].x = NAN;
    config.kind = LH_PATH_AHEAD;
    ck_assert_int_eq(lh_path_config_validate(&config), LH_OK);
}
END_TEST

START_TEST(along_and_lateral_are_a_rotation) {
    const lh_pose2 line = {0.5f, -0.25f, 2.0f};
    for (int i = 0; i < 8; i++) { /* 3 m away in every direction */
        const double direction = 0.7 * i;
        const lh_pose2 pose = at((float)(0.5 + 3.0 * cos(direction)), (float)(-0.25 + 3.0 * sin(direction)));
        expect_near(lh_line_along(&line, &pose), 3.0 * cos(direction - 2.0), 3e-6);
        expect_near(lh_line_lateral(&line, &pose), 3.0 * sin(direction - 2.0), 3e-6);
    }
}
END_TEST

static void check_leg_without_an_end(lh_path_kind kind) {
    const lh_path_config config = {.kind = kind};
    lh_path path;
    lh_path_begin(&path, &config, &start);
    ck_assert_mem_eq(&path.leg, &start, sizeof start);
    ck_assert_float_eq(lh_path_goal(&path, &start, 2.0f), 2.0f);
    const lh_pose2 far = at(0.0f, 9e5f);
    lh_path_advance(&path, &config, &far);
    ck_assert_mem_eq(&path.leg, &start, sizeof start);
    ck_assert(!lh_path_over(&path, &config, &far));
    ck_assert_float_eq(lh_path_waypoint_distance(&path, &config, &far), 0.0f);
    const lh_pose2 back = at(4.0f, -2.5f);
    expect_near(lh_path_goal(&path, &back, 2.0f), 0.5, 1e-6);
}

/* A rolling path is begun anew for each episode. */
START_TEST(lines_without_an_end) {
    check_leg_without_an_end(LH_PATH_ROLLING);
    check_leg_without_an_end(LH_PATH_AHEAD);
}
END_TEST

START_TEST(goal_lines_of_a_corner) {
    lh_path path;
    lh_path_begin(&path, &corner, &start);
    expect_near(path.length, 5.0, 1e-6);
    expect_near(path.leg.heading, M_PI_2, 1e-6);
    expect_near(lh_path_goal(&path, &start, 2.0f), 2.0, 1e-6);
    const lh_pose2 near_the_corner = at(2.5f, 3.5f);
    expect_near(lh_path_goal(&path, &near_the_corner, 2.0f), 5.0, 1e-6); /* not 6.5 */
    expect_near(lh_path_waypoint_distance(&path, &corner, &near_the_corner), sqrt(0.5), 1e-6);

    advance(&path, &corner, 3.5f, 3.99f);
    ck_assert_int_eq(path.next, 0);
    advance(&path, &corner, 3.5f, 4.01f);
    ck_assert_int_eq(path.next, 1);
    expect_near(path.length, 5.0, 1e-6);
    expect_near(path.leg.heading, 0.0, 1e-6);
    const lh_pose2 after = at(3.5f, 4.01f);
    expect_near(lh_line_lateral(&path.leg, &after), 0.01, 1e-6);
    expect_near(lh_path_goal(&path, &after, 2.0f), 2.5, 1e-6); /* from the corner, where the leg begins */
}
END_TEST

/* A waypoint counts as passed beside it, too, and the path is over with the last alone. */
START_TEST(passing_beside) {
    lh_path path;
    lh_path_begin(&path, &corner, &start);
    const lh_pose2 beside = at(-7.0f, 4.0f); /* on the line across the leg at its end */
    ck_assert(!lh_path_over(&path, &corner, &beside));
    lh_path_advance(&path, &corner, &beside);
    ck_assert_int_eq(path.next, 1);
    const lh_pose2 before = at(7.999f, 14.0f);
    const lh_pose2 beyond = at(8.001f, 14.0f);
    ck_assert(!lh_path_over(&path, &corner, &before));
    ck_assert(lh_path_over(&path, &corner, &beyond));
    lh_path_advance(&path, &corner, &beyond);
    ck_assert_int_eq(path.next, 1); /* there is no leg behind */
    expect_near(lh_path_waypoint_distance(&path, &corner, &beyond), 10.0, 1e-5);
}
END_TEST

/* Beyond the end of the next leg, too, when the one before it ends. */
START_TEST(a_leg_already_passed_is_skipped) {
    const lh_path_config config = {
        .kind = LH_PATH_WAYPOINTS, .num_waypoints = 3, .waypoint = {{3.0f, 4.0f}, {3.5f, 4.0f}, {3.5f, 9.0f}}};
    lh_path path;
    lh_path_begin(&path, &config, &start);
    advance(&path, &config, 3.6f, 4.1f);
    ck_assert_int_eq(path.next, 2);
    expect_near(path.leg.x, 3.5, 1e-6);
    expect_near(path.leg.heading, M_PI_2, 1e-6);
}
END_TEST

START_TEST(a_target_behind) {
    const lh_path_config config = {.kind = LH_PATH_WAYPOINTS, .num_waypoints = 1, .waypoint = {{3.0f, -7.0f}}};
    lh_path path;
    lh_path_begin(&path, &config, &start);
    expect_near(fabs((double)path.leg.heading + M_PI_2), 0.0, 1e-6);
    const lh_pose2 away = at(3.0f, 50.0f);
    ck_assert(!lh_path_over(&path, &config, &away));
    expect_near(lh_path_goal(&path, &away, 2.0f), -49.0, 1e-4);
    const lh_pose2 there = at(3.2f, -7.1f);
    ck_assert(lh_path_over(&path, &config, &there));
    expect_near(lh_path_waypoint_distance(&path, &config, &there), sqrt(0.05), 1e-6);
}
END_TEST

/* A leg of no length has no direction of its own. */
START_TEST(a_waypoint_twice) {
    const lh_path_config config = {
        .kind = LH_PATH_WAYPOINTS, .num_waypoints = 3, .waypoint = {{3.0f, -1.0f}, {3.0f, 4.0f}, {3.0f, 4.0f}}};
    lh_path path;
    lh_path_begin(&path, &config, &start);
    ck_assert_float_eq(path.length, 0.0f);
    ck_assert_float_eq(path.leg.heading, start.heading);
    lh_path_advance(&path, &config, &start);
    ck_assert_int_eq(path.next, 1);
    const lh_pose2 there = at(2.9f, 4.01f);
    lh_path_advance(&path, &config, &there);
    ck_assert_int_eq(path.next, 2);
    expect_near(path.leg.heading, M_PI_2, 1e-6);
    ck_assert(lh_path_over(&path, &config, &there));
}
END_TEST

/* --- a robot that stands somewhere along the path --- */

/* From the origin 5 m ahead, 5 m to the right, and 5 m back. */
static const lh_path_config hook = {
    .kind = LH_PATH_WAYPOINTS, .num_waypoints = 3, .waypoint = {{0.0f, 5.0f}, {5.0f, 5.0f}, {5.0f, 0.0f}}};

/* The waypoint it then heads for. */
static int32_t resume_at(lh_path *path, const lh_path_config *config, float x, float y) {
    const lh_pose2 pose = at(x, y);
    lh_path_resume(path, config, &pose);
    return path->next;
}

START_TEST(resuming_enters_the_nearest_leg) {
    lh_path path;
    ck_assert_int_eq(resume_at(&path, &hook, 0.4f, 3.0f), 0);
    ck_assert_float_eq(path.leg.x, 0.0f);
    ck_assert_float_eq(path.leg.y, 0.0f);
    expect_near(path.leg.heading, M_PI_2, 1e-6);
    expect_near(path.length, 5.0, 1e-6);
    ck_assert_int_eq(resume_at(&path, &hook, -0.5f, -1.0f), 0); /* before its beginning */
    ck_assert_int_eq(resume_at(&path, &hook, 2.0f, 5.5f), 1);
    expect_near(path.leg.heading, 0.0, 1e-6);
    ck_assert_float_eq(path.leg.y, 5.0f);
    ck_assert_int_eq(resume_at(&path, &hook, 3.5f, 2.0f), 2); /* 1.5 m from the last, 3 m and more from the others */
    expect_near(path.leg.heading, -M_PI_2, 1e-6);
    const lh_pose2 pose = at(3.5f, 2.0f);
    expect_near(lh_path_goal(&path, &pose, 1.0f), 4.0, 1e-6);
}
END_TEST

/* Outside a corner its waypoint is the nearest point of both legs, and inside it may be as far to either. */
START_TEST(resuming_takes_the_later_of_two_legs) {
    lh_path path;
    ck_assert_int_eq(resume_at(&path, &hook, -1.0f, 6.0f), 1);
    ck_assert_int_eq(resume_at(&path, &hook, 0.0f, 5.0f), 1);
    ck_assert_int_eq(resume_at(&path, &hook, 1.0f, 4.0f), 1);
    ck_assert_int_eq(resume_at(&path, &hook, 6.3f, 5.9f), 2);
    const lh_path_config out_and_back = {
        .kind = LH_PATH_WAYPOINTS, .num_waypoints = 2, .waypoint = {{0.0f, 5.0f}, {0.0f, 0.0f}}};
    ck_assert_int_eq(resume_at(&path, &out_and_back, 0.5f, 3.0f), 1);
}
END_TEST

/* The leg that ends near by is over: on with the next, and from the end of the path with its beginning. */
START_TEST(resuming_drives_back_to_no_waypoint) {
    const lh_path_config ahead = {
        .kind = LH_PATH_WAYPOINTS, .num_waypoints = 3, .waypoint = {{0.0f, 5.0f}, {0.0f, 5.0f}, {0.0f, 9.0f}}};
    lh_path path;
    ck_assert_int_eq(resume_at(&path, &ahead, 0.1f, 5.01f), 2);
    ck_assert_int_eq(resume_at(&path, &ahead, 0.1f, 4.99f), 0);
    ck_assert_int_eq(resume_at(&path, &ahead, 0.1f, 9.1f), 0);
    expect_near(path.leg.y, 9.1, 1e-6); /* begins anew where the robot is */
    expect_near(path.length, 4.1, 1e-2);
}
END_TEST

START_TEST(resuming_paths_without_waypoints) {
    lh_path path;
    resume_at(&path, &(lh_path_config){.kind = LH_PATH_ROLLING}, 2.0f, 3.0f);
    const lh_pose2 pose = at(2.0f, 3.0f);
    ck_assert_mem_eq(&path.leg, &pose, sizeof pose);
    resume_at(&path, &(lh_path_config){.kind = LH_PATH_AHEAD}, 2.0f, 3.0f);
    expect_near(lh_line_along(&path.leg, &pose), 3.0, 1e-6);
    expect_near(lh_line_lateral(&path.leg, &pose), -2.0, 1e-6);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("path");
    TCase *t = tcase_create("path");
    tcase_add_test(t, the_default_rolls);
    tcase_add_test(t, bad_fields_are_named);
    tcase_add_test(t, along_and_lateral_are_a_rotation);
    tcase_add_test(t, lines_without_an_end);
    tcase_add_test(t, goal_lines_of_a_corner);
    tcase_add_test(t, passing_beside);
    tcase_add_test(t, a_leg_already_passed_is_skipped);
    tcase_add_test(t, a_target_behind);
    tcase_add_test(t, a_waypoint_twice);
    suite_add_tcase(s, t);
    t = tcase_create("resuming");
    tcase_add_test(t, resuming_enters_the_nearest_leg);
    tcase_add_test(t, resuming_takes_the_later_of_two_legs);
    tcase_add_test(t, resuming_drives_back_to_no_waypoint);
    tcase_add_test(t, resuming_paths_without_waypoints);
    suite_add_tcase(s, t);
    return s;
}
