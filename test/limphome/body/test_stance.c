#include "limphome/body/stance.h"

#include <string.h>

#include "crawler.h"
#include "limphome/base/random.h"
#include "limphome/body/rest.h"
#include "limphome/body/stability.h"
#include "test.h"

static const lh_vec3 x_axis = {1.0f, 0.0f, 0.0f};
static const lh_vec3 y_axis = {0.0f, 1.0f, 0.0f};

enum { TIP = 4 };

/* The stance, and its margin. */
typedef struct standing {
    lh_posture posture;
    lh_stance stance;
    float margin;
} standing;

static standing stand(const lh_robot *robot, float swing, float boom, float arm, lh_quat attitude) {
    const float angle[LH_MAX_ACTUATORS] = {NAN, NAN, swing, boom, arm}; /* crawlers are not read */
    standing s;
    memset(&s, 0, sizeof s);
    lh_kinematics_posture(robot, attitude, angle, &s.posture);
    lh_stance_find(robot, &s.posture, &s.stance);
    s.margin = lh_stability_margin(s.stance.points, s.stance.count, s.posture.centre_of_mass);
    return s;
}

static void expect_carrying(const lh_stance *stance, int32_t count, const int32_t *expected) {
    ck_assert_int_eq(stance->count, count);
    for (int32_t i = 0; i < count; i++) {
        ck_assert_int_eq(stance->carrying[i], expected[i]);
    }
}

/* Margin of the robot on its crawlers, whose centre of mass is at `c` in the body's frame, on an incline by these
 * angles uphill ahead and with the left side up: about each edge, by turning it until the centre of mass is highest. */
static double margin_on_crawlers(lh_vec3 c, double ahead, double left_up) {
    const double up[3] = {sin(ahead), cos(ahead) * sin(left_up), cos(ahead) * cos(left_up)};
    const double edge[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}}; /* outward */
    double least = 1e9;
    for (int32_t i = 0; i < 4; i++) {
        const double *out = edge[i];
        const double reach = fabs(out[0]) * 0.62 + fabs(out[1]) * 0.625;
        /* the centre of mass in the plane across the edge: so far outward, and above */
        const double outward = out[0] * c.x + out[1] * c.y - reach;
        const double radius = hypot(outward, c.z);
        const double up_outward = out[0] * up[0] + out[1] * up[1];
        const double highest = radius * hypot(up_outward, up[2]);
        least = fmin(least, highest - (outward * up_outward + c.z * up[2]));
    }
    return least;
}

/* --- which supports carry --- */

START_TEST(on_inclines_it_stands_on_its_crawlers) {
    const lh_robot robot = crawler_robot();
    const lh_vec3 centre = stand(&robot, 1.0f, 0.6f, -1.0f, (lh_quat){1, 0, 0, 0}).posture.centre_of_mass;
    for (int32_t heading = -3; heading <= 3; heading++) {
        for (int32_t ahead = -20; ahead <= 20; ahead += 5) {
            for (int32_t left_up = -20; left_up <= 20; left_up += 5) {
                const double degree = 0.017453292519943295;
                const lh_quat attitude =
                    lh_quat_multiply(lh_quat_about((lh_vec3){0, 0, 1}, (float)heading),
                                     lh_quat_multiply(lh_quat_about(y_axis, (float)(-ahead * degree)),
                                                      lh_quat_about(x_axis, (float)(left_up * degree))));
                const standing s = stand(&robot, 1.0f, 0.6f, -1.0f, attitude);
                expect_carrying(&s.stance, 4, (int32_t[]){0, 1, 2, 3});
                expect_near(s.margin, margin_on_crawlers(centre, ahead * degree, left_up * degree), 2e-6);
            }
        }
    }
}
END_TEST

/* Pressed down ahead, the tip lifts the front: the robot pitches about the crawlers' rear ends until the ball round the
 * tip touches the ground, on an incline too. */
START_TEST(a_tip_pressed_down_lifts_the_front_on_any_slope) {
    const lh_robot robot = crawler_robot();
    const lh_posture flat = stand(&robot, 0.0f, -0.3f, -1.0f, (lh_quat){1, 0, 0, 0}).posture;
    /* the ball's middle from the rear ends, and how the line that touches both is pitched against the body's x axis */
    const double dx = flat.supports[TIP].x + 0.62;
    const double dz = flat.supports[TIP].z + 0.08;
    const double length = sqrt(dx * dx + dz * dz - 0.08 * 0.08);
    const double down = atan2(-dz, dx) + atan2(0.08, length);
    ck_assert_double_gt(down, 0.05);
    for (int32_t degrees = -20; degrees <= 20; degrees += 5) {
        const double uphill = 0.017453292519943295 * degrees;
        const standing s = stand(&robot, 0.0f, -0.3f, -1.0f, lh_quat_about(y_axis, (float)(-uphill - down)));
        expect_carrying(&s.stance, 3, (int32_t[]){1, 2, TIP});
        const double out_x = s.stance.points[2].x - s.stance.points[0].x;
        const double out_z = s.stance.points[2].z - s.stance.points[0].z;
        expect_near(out_x, length * cos(uphill), 1e-4);
        expect_near(out_z, length * sin(uphill), 1e-4);
    }
}
END_TEST

/* An arm that is pressed down aside lifts that crawler, off the ground or, by less than it gives way, not. */
START_TEST(a_crawler_that_is_lifted_does_not_carry) {
    const lh_robot robot = crawler_robot();
    const float swing = 1.57079633f;
    for (float boom = -0.3f; boom < 0.0f; boom += 0.01f) {
        const float angle[] = {NAN, NAN, swing, boom, -1.2f};
        lh_rest rest;
        lh_rest_find(&robot, angle, (lh_vec3){0, 0, 1}, &rest);
        const standing s = stand(&robot, swing, boom, -1.2f, lh_rest_upright(rest.normal));
        const double lifted = 1.25 * rest.normal.y; /* its outer edge: the ground is lower on the left */
        if (lifted > 0.006) {
            expect_carrying(&s.stance, 3, (int32_t[]){2, 3, TIP});
        } else if (lifted < 0.004 && lifted > 0.0) {
            ck_assert_int_eq(s.stance.count, 5);
        }
    }
}
END_TEST

/* --- against a search of its own in double precision --- */

typedef struct point {
    double x, y, z;
} point;

/* Slope and height of the plane through three points, as z = height + a x + b y; false if it is none. */
static bool plane_through(const point p[3], double plane[3]) {
    const double ux = p[1].x - p[0].x, uy = p[1].y - p[0].y, uz = p[1].z - p[0].z;
    const double vx = p[2].x - p[0].x, vy = p[2].y - p[0].y, vz = p[2].z - p[0].z;
    const double area = ux * vy - uy * vx;
    plane[0] = (uz * vy - uy * vz) / area;
    plane[1] = (ux * vz - uz * vx) / area;
    plane[2] = p[0].z - plane[0] * p[0].x - plane[1] * p[0].y;
    return fabs(area) > 1e-6;
}

/* The ground is the plane below which no support is that is highest under the centre of mass: linear programming, by
 * trying all corners. Fills carries[]; false where it leaves open what carries: no bound, or a support at the limit. */
static bool ground_by_programming(const lh_robot *robot, const lh_posture *posture, bool *carries) {
    const lh_vec3 *s = posture->supports;
    double best[3] = {0, 0, -1e9};
    double highest = -1e9;
    for (int32_t i = 0; i < robot->num_supports; i++) {
        for (int32_t j = i + 1; j < robot->num_supports; j++) {
            for (int32_t k = j + 1; k < robot->num_supports; k++) {
                const point p[3] = {{s[i].x, s[i].y, s[i].z}, {s[j].x, s[j].y, s[j].z}, {s[k].x, s[k].y, s[k].z}};
                double plane[3];
                bool below = plane_through(p, plane);
                for (int32_t m = 0; m < robot->num_supports; m++) {
                    below = below && plane[0] * s[m].x + plane[1] * s[m].y + plane[2] < s[m].z + 1e-6;
                }
                const double height =
                    plane[0] * posture->centre_of_mass.x + plane[1] * posture->centre_of_mass.y + plane[2];
                if (below && height > highest) {
                    highest = height;
                    memcpy(best, plane, sizeof best);
                }
            }
        }
    }
    bool clear = highest > -1e9;
    for (int32_t m = 0; m < robot->num_supports; m++) {
        const double above =
            (s[m].z - best[0] * s[m].x - best[1] * s[m].y - best[2]) / sqrt(1 + best[0] * best[0] + best[1] * best[1]);
        carries[m] = above <= 0.005;
        clear = clear && fabs(above - 0.005) > 1e-5;
    }
    return clear;
}

/* Whether the vertical through the centre of mass leads between the supports, seen from above. */
static bool is_between(const lh_robot *robot, const lh_posture *posture) {
    double widest = 0.0; /* gap between the directions to neighbouring supports */
    for (int32_t i = 0; i < robot->num_supports; i++) {
        double gap = 2 * M_PI;
        for (int32_t k = 0; k < robot->num_supports; k++) {
            const lh_vec3 c = posture->centre_of_mass;
            const double a = atan2(posture->supports[i].y - c.y, posture->supports[i].x - c.x);
            const double b = atan2(posture->supports[k].y - c.y, posture->supports[k].x - c.x);
            const double next = fmod(b - a + 4 * M_PI, 2 * M_PI);
            gap = k != i ? fmin(gap, next) : gap;
        }
        widest = fmax(widest, gap);
    }
    return widest < M_PI - 1e-3;
}

START_TEST(against_linear_programming) {
    lh_robot robot = crawler_robot();
    robot.supports[TIP].radius = 0.0f; /* the same points of the robot on any slope */
    lh_random random;
    lh_random_init(&random, 5);
    int32_t compared = 0;
    int32_t on_tip = 0;
    for (int32_t i = 0; i < 2000; i++) {
        const lh_quat attitude = lh_quat_multiply(lh_quat_about(x_axis, lh_random_uniform(&random) - 0.5f),
                                                  lh_quat_about(y_axis, lh_random_uniform(&random) - 0.5f));
        const standing s =
            stand(&robot, -2.6f + 5.2f * lh_random_uniform(&random), -0.6f + 0.9f * lh_random_uniform(&random),
                  -2.4f * lh_random_uniform(&random), attitude);
        bool carries[LH_MAX_SUPPORTS] = {false};
        if (!is_between(&robot, &s.posture) || !ground_by_programming(&robot, &s.posture, carries)) {
            continue;
        }
        compared++;
        on_tip += carries[TIP];
        int32_t count = 0;
        for (int32_t m = 0; m < robot.num_supports; m++) {
            if (carries[m]) {
                ck_assert_int_eq(s.stance.carrying[count], m);
                ck_assert_mem_eq(&s.stance.points[count], &s.posture.supports[m], sizeof(lh_vec3));
                count++;
            }
        }
        ck_assert_int_eq(s.stance.count, count);
    }
    ck_assert_int_gt(compared, 1500);
    ck_assert_int_gt(on_tip, 300);
}
END_TEST

/* --- size --- */

START_TEST(size_does_not_matter) {
    const lh_robot robot = crawler_robot();
    const lh_quat attitude = lh_quat_about(x_axis, 0.15f);
    lh_random random;
    lh_random_init(&random, 6);
    for (int32_t i = 0; i < 200; i++) {
        const float swing = -2.6f + 5.2f * lh_random_uniform(&random);
        const float boom = -0.6f + 0.9f * lh_random_uniform(&random);
        const float arm = -2.4f * lh_random_uniform(&random);
        const standing s = stand(&robot, swing, boom, arm, attitude);
        for (float scale = 0.1f; scale < 11.0f; scale *= 100.0f) {
            const lh_robot other = scaled_robot(&robot, scale);
            const standing scaled = stand(&other, swing, boom, arm, attitude);
            expect_carrying(&scaled.stance, s.stance.count, s.stance.carrying);
            expect_near(scaled.margin, scale * s.margin, 1e-5 * scale);
        }
    }
}
END_TEST

/* Of a robot a tenth of the size whose tip is 1 cm above the ground, which is 10 cm for the large one: it stands on its
 * crawlers. By a tolerance of 3 cm it would stand on its tip as well, and seem half as stable again. */
START_TEST(a_small_robot_does_not_stand_on_a_tip_in_the_air) {
    const lh_robot large = crawler_robot();
    const lh_robot robot = scaled_robot(&large, 0.1f);
    const standing s = stand(&robot, 0.0f, 0.12f, -1.2f, (lh_quat){1, 0, 0, 0});
    expect_near(s.posture.supports[TIP].z, 0.0135, 0.005);
    const lh_vec3 c = s.posture.centre_of_mass;
    const double ahead = hypot(0.062 - c.x, c.z) - c.z;
    const double aside = hypot(0.0625, c.z) - c.z;
    expect_carrying(&s.stance, 4, (int32_t[]){0, 1, 2, 3});
    expect_near(s.margin, fmin(ahead, aside), 1e-6);
}
END_TEST

/* --- where there is no triangle --- */

START_TEST(a_robot_that_tips_over_stands_on_what_is_lowest) {
    const lh_robot robot = crawler_robot();
    const standing s = stand(&robot, 0.0f, 0.6f, -1.5f, lh_quat_about(x_axis, 1.0f));
    expect_carrying(&s.stance, 2, (int32_t[]){2, 3});
    ck_assert_float_lt(s.margin, 0.0f);
}
END_TEST

START_TEST(supports_in_a_line_are_no_triangle) {
    lh_robot robot = crawler_robot();
    robot.num_supports = 3;
    for (int32_t i = 0; i < 3; i++) {
        robot.supports[i].point = (lh_vec3){(float)(i - 1), 0.0f, 0.0f};
    }
    robot.supports[2].point.z = 0.1f;
    const standing s = stand(&robot, 0.0f, 0.6f, -1.5f, (lh_quat){1, 0, 0, 0});
    expect_carrying(&s.stance, 2, (int32_t[]){0, 1});
    ck_assert_float_le(s.margin, 0.0f);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("stance");
    TCase *t = tcase_create("carrying");
    tcase_add_test(t, on_inclines_it_stands_on_its_crawlers);
    tcase_add_test(t, a_tip_pressed_down_lifts_the_front_on_any_slope);
    tcase_add_test(t, a_crawler_that_is_lifted_does_not_carry);
    tcase_add_test(t, against_linear_programming);
    suite_add_tcase(s, t);
    t = tcase_create("size");
    tcase_add_test(t, size_does_not_matter);
    tcase_add_test(t, a_small_robot_does_not_stand_on_a_tip_in_the_air);
    suite_add_tcase(s, t);
    t = tcase_create("no triangle");
    tcase_add_test(t, a_robot_that_tips_over_stands_on_what_is_lowest);
    tcase_add_test(t, supports_in_a_line_are_no_triangle);
    suite_add_tcase(s, t);
    return s;
}
