/* What brings parts of the robot together: on the paper's robot, whose arm reaches its crawlers, and on a swing with a
 * post in its way, where all distances are known. */
#include "limphome/safety/collision.h"

#include "crawler.h"
#include "test.h"

enum { SWING = 1 << 2, BOOM = 1 << 3, ARM = 1 << 4 };

static lh_robot robot;
static lh_shapes shapes;

static uint32_t joints(float clearance, const float now[3], const float then[3]) {
    const float angle[5] = {0, 0, now[0], now[1], now[2]};
    const float next[5] = {9, -9, then[0], then[1], then[2]}; /* belts may run */
    return lh_collision_joints(&robot, &shapes, clearance, angle, next);
}

static void use_crawler(void) {
    robot = crawler_robot();
    shapes = crawler_shapes();
    ck_assert_int_eq(shapes.count, 8);
    ck_assert_int_eq(lh_shapes_validate(&shapes, &robot), LH_OK);
}

/* Ball on the boom, 1 m from the swing's axis, which is horizontal at 0, and a post of a millimetre at half a radian.
 */
static void use_post(void) {
    robot = crawler_robot();
    robot.links[4].origin = (lh_vec3){0.0f, 0.0f, 0.0f};
    shapes = (lh_shapes){.count = 2, .may_meet = {[0] = 1u << 4, [4] = 1u << 0}};
    const lh_quat still = {1.0f, 0.0f, 0.0f, 0.0f};
    shapes.shape[0] = (lh_shape){.link = 4, .centre = {1.0f, 0.0f, 0.0f}, .rotation = still, .radius = 0.05f};
    shapes.shape[1] = (lh_shape){.link = 0,
                                 .centre = {cosf(0.5f), sinf(0.5f), 0.5f},
                                 .rotation = still,
                                 .half = {0.0f, 0.0f, 0.5f},
                                 .radius = 0.001f,
                                 .disc = true};
    ck_assert_int_eq(lh_shapes_validate(&shapes, &robot), LH_OK);
}

START_TEST(bad_shapes_are_refused) {
    use_crawler();
#define BAD(field, value)                                                   \
    do {                                                                    \
        lh_shapes bad = shapes;                                             \
        bad.field = value;                                                  \
        ck_assert_int_eq(lh_shapes_validate(&bad, &robot), LH_ERROR_ROBOT); \
    } while (0)
    BAD(count, -1);
    BAD(count, LH_MAX_SHAPES + 1);
    BAD(shape[1].link, -1);
    BAD(shape[1].link, 6);
    BAD(shape[1].rotation.w, 1.1f);
    BAD(shape[1].centre.x, 1001.0f);
    BAD(shape[1].centre.y, NAN);
    BAD(shape[1].centre.z, -1001.0f);
    BAD(shape[1].half.x, -0.1f);
    BAD(shape[1].half.y, 1001.0f);
    BAD(shape[1].half.z, NAN);
    BAD(shape[7].radius, -0.1f);
#undef BAD
}
END_TEST

/* Folded, the arm stands in front of the crawlers; turned aside and lowered it comes down on one of them. */
START_TEST(the_arm_is_kept_from_the_crawlers) {
    use_crawler();
    const float aside[3] = {0.6f, 0.1f, -2.4f};
    ck_assert_uint_eq(joints(0.02f, aside, (float[]){0.6f, -0.05f, -2.4f}), BOOM);
    ck_assert_uint_eq(joints(0.02f, aside, (float[]){0.75f, -0.05f, -2.25f}), SWING | BOOM | ARM);
    ck_assert_uint_eq(joints(0.02f, aside, (float[]){0.6f, 0.25f, -2.4f}), 0);
    ck_assert_uint_eq(joints(0.02f, aside, aside), 0);
    const float mirrored[3] = {-0.6f, 0.1f, -2.4f}; /* the other crawler */
    ck_assert_uint_eq(joints(0.02f, mirrored, (float[]){-0.6f, -0.05f, -2.4f}), BOOM);
    const float home[3] = {0.0f, 0.6f, -1.5f};
    ck_assert_uint_eq(joints(0.02f, home, (float[]){0.15f, 0.45f, -1.65f}), 0);
}
END_TEST

START_TEST(what_may_meet_or_is_unknown_is_no_collision) {
    use_crawler();
    const float aside[3] = {0.6f, 0.1f, -2.4f};
    const float down[3] = {0.6f, -0.05f, -2.4f};
    shapes.count = 0;
    ck_assert_uint_eq(joints(0.02f, aside, down), 0);
    use_crawler();
    memset(shapes.may_meet, 0, sizeof shapes.may_meet);
    ck_assert_uint_eq(joints(0.02f, aside, down), 0);
}
END_TEST

/* The ball is 5 cm in radius, 1 m out: at 0.42 rad it is 2 * sin(0.04) m from the middle of the post. */
START_TEST(the_clearance_is_kept_and_no_more) {
    use_post();
    const float start[3] = {0.3f, 0, 0};
    const float end[3] = {0.42f, 0, 0};
    const float left = 2 * sinf(0.04f) - 0.051f;
    ck_assert_uint_eq(joints(left - 1e-5f, start, end), 0);
    ck_assert_uint_eq(joints(left + 1e-5f, start, end), SWING);
}
END_TEST

/* Nearer than the clearance it may go away, or stay as near as it is. */
START_TEST(only_what_comes_nearer_is_found) {
    use_post();
    const float near[3] = {0.44f, 0, 0};
    ck_assert_uint_eq(joints(0.1f, near, (float[]){0.43f, 0, 0}), 0);
    ck_assert_uint_eq(joints(0.1f, near, (float[]){0.45f, 0, 0}), SWING);
    ck_assert_uint_eq(joints(0.1f, near, (float[]){0.44f, 0, -1.0f}), 0); /* the arm beyond takes no part */
    ck_assert_uint_eq(joints(0.1f, near, (float[]){0.45f, 0, -1.0f}), SWING);
    /* inside it, outwards either way */
    const float inside[3] = {0.49f, 0, 0};
    ck_assert_uint_eq(joints(0.1f, inside, (float[]){0.47f, 0, 0}), 0);
    ck_assert_uint_eq(joints(0.1f, inside, (float[]){0.495f, 0, 0}), SWING);
}
END_TEST

/* Start and end are clear, the way is not: 0.12 rad are 12 cm, the ball and the post 10 cm. */
START_TEST(nothing_is_jumped_over) {
    use_post();
    for (float from = 0.2f; from < 0.43f; from += 0.01f) {
        ck_assert_uint_eq(joints(0.0f, (float[]){from, 0, 0}, (float[]){0.58f, 0, 0}), SWING);
        ck_assert_uint_eq(joints(0.0f, (float[]){1.0f - from, 0, 0}, (float[]){0.42f, 0, 0}), SWING);
    }
    ck_assert_uint_eq(joints(0.0f, (float[]){-2.0f, 0, 0}, (float[]){2.0f, 0, 0}), SWING);  /* a long way */
    ck_assert_uint_eq(joints(0.0f, (float[]){-60.0f, 0, 0}, (float[]){0.5f, 0, 0}), SWING); /* the longest */
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("collision");
    TCase *t = tcase_create("collision");
    tcase_add_test(t, bad_shapes_are_refused);
    tcase_add_test(t, the_arm_is_kept_from_the_crawlers);
    tcase_add_test(t, what_may_meet_or_is_unknown_is_no_collision);
    tcase_add_test(t, the_clearance_is_kept_and_no_more);
    tcase_add_test(t, only_what_comes_nearer_is_found);
    tcase_add_test(t, nothing_is_jumped_over);
    suite_add_tcase(s, t);
    return s;
}
