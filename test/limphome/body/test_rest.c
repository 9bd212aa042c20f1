#include "limphome/body/rest.h"

#include "crawler.h"
#include "limphome/base/random.h"
#include "limphome/body/kinematics.h"
#include "limphome/body/stability.h"
#include "test.h"

static const lh_vec3 level = {0.0f, 0.0f, 1.0f};
static const lh_quat no_rotation = {1.0f, 0.0f, 0.0f, 0.0f};

enum { TIP = 4 };

/* The crawler robot, which stands on the very tip of its arm, not on a ball round it: then the supports are the same
 * points of the robot however it lies. */
static lh_robot pointed_robot(void) {
    lh_robot robot = crawler_robot();
    robot.supports[TIP].radius = 0.0f;
    return robot;
}

static lh_rest rest_at(const lh_robot *robot, float swing, float boom, float arm, lh_vec3 up) {
    const float angle[LH_MAX_ACTUATORS] = {NAN, NAN, swing, boom, arm}; /* crawlers are not read */
    lh_rest rest;
    lh_rest_find(robot, angle, up, &rest);
    return rest;
}

static lh_posture posture_at(const lh_robot *robot, float swing, float boom, float arm, lh_quat attitude) {
    const float angle[LH_MAX_ACTUATORS] = {NAN, NAN, swing, boom, arm};
    lh_posture posture;
    lh_kinematics_posture(robot, attitude, angle, &posture);
    return posture;
}

static void expect_nowhere(const lh_rest *rest) {
    ck_assert_int_eq(rest->num_carrying, 0);
    ck_assert(!rest->braced);
    ck_assert_float_eq(rest->margin, LH_NO_REST_MARGIN);
    ck_assert_float_eq(rest->normal.x, 0.0f);
    ck_assert_float_eq(rest->normal.y, 0.0f);
    ck_assert_float_eq(rest->normal.z, 1.0f);
}

START_TEST(upright_turns_to_the_vertical_by_the_shortest_way) {
    lh_random random;
    lh_random_init(&random, 1);
    for (int32_t i = 0; i < 100; i++) {
        lh_vec3 from = {lh_random_uniform(&random) - 0.5f, lh_random_uniform(&random) - 0.5f,
                        lh_random_uniform(&random) - 0.4f};
        from = lh_vec3_scale(from, 1.0f / lh_vec3_norm(from));
        if (from.z < -0.9f) {
            continue;
        }
        const lh_quat turn = lh_rest_upright(from);
        const lh_vec3 turned = lh_quat_rotate(turn, from);
        expect_near(turned.x, 0.0, 1e-6);
        expect_near(turned.y, 0.0, 1e-6);
        expect_near(turned.z, 1.0, 1e-6);
        expect_near(turn.z, 0.0, 1e-7); /* about a level axis */
        expect_near(2.0 * acos(fmin(turn.w, 1.0)), acos(from.z), 2e-3);
    }
    const lh_quat none = lh_rest_upright(level);
    ck_assert(none.w == 1.0f && none.x == 0.0f && none.y == 0.0f && none.z == 0.0f);
}
END_TEST

START_TEST(with_the_arm_up_it_stands_on_its_crawlers) {
    const lh_robot robot = crawler_robot();
    const lh_rest rest = rest_at(&robot, 0.0f, 0.6f, -1.0f, level);
    ck_assert_int_eq(rest.num_carrying, 4);
    for (int32_t i = 0; i < 4; i++) {
        ck_assert_int_eq(rest.carrying[i], i);
    }
    ck_assert(!rest.braced);
    expect_near(rest.normal.x, 0.0, 1e-7);
    expect_near(rest.normal.y, 0.0, 1e-7);
    expect_near(rest.normal.z, 1.0, 1e-7);
    /* tipping forwards over the crawlers' front ends or sideways over either of them */
    const lh_vec3 centre = posture_at(&robot, 0.0f, 0.6f, -1.0f, no_rotation).centre_of_mass;
    const double ahead = hypot(0.62 - centre.x, centre.z) - centre.z;
    const double aside = hypot(0.625, centre.z) - centre.z;
    expect_near(rest.margin, fmin(ahead, aside), 1e-6);
}
END_TEST

/* A tip pressed down ahead lifts the front: the robot pitches about the crawlers' rear ends. */
START_TEST(a_tip_pressed_down_ahead_lifts_the_front) {
    const lh_robot robot = pointed_robot();
    const lh_posture flat = posture_at(&robot, 0.0f, -0.3f, -1.0f, no_rotation);
    const double dx = flat.supports[TIP].x + 0.62;
    const double dz = flat.supports[TIP].z;
    ck_assert_double_lt(dz, -0.1);
    const lh_rest rest = rest_at(&robot, 0.0f, -0.3f, -1.0f, level);
    ck_assert_int_eq(rest.num_carrying, 3);
    ck_assert_int_eq(rest.carrying[0], 1);
    ck_assert_int_eq(rest.carrying[1], 2);
    ck_assert_int_eq(rest.carrying[2], TIP);
    ck_assert(rest.braced);
    expect_near(rest.normal.x, -dz / hypot(dx, dz), 1e-6);
    expect_near(rest.normal.y, 0.0, 1e-6);
    expect_near(rest.normal.z, dx / hypot(dx, dz), 1e-6);
}
END_TEST

/* What is found is what kinematics and stability say of the robot when it lies like that. */
START_TEST(it_lies_as_kinematics_has_it) {
    const lh_robot robot = pointed_robot();
    lh_random random;
    lh_random_init(&random, 2);
    int32_t braced = 0;
    for (int32_t i = 0; i < 100; i++) {
        const float swing = -2.6f + 5.2f * lh_random_uniform(&random);
        const float boom = -0.6f + 0.9f * lh_random_uniform(&random);
        const float arm = -2.4f * lh_random_uniform(&random);
        const lh_rest rest = rest_at(&robot, swing, boom, arm, level);
        if (rest.num_carrying == 0) {
            continue;
        }
        braced += rest.braced;
        const lh_posture posture = posture_at(&robot, swing, boom, arm, lh_rest_upright(rest.normal));
        float lowest = 1e9f;
        for (int32_t k = 0; k < robot.num_supports; k++) {
            lowest = fminf(lowest, posture.supports[k].z);
        }
        lh_vec3 carrying[LH_MAX_SUPPORTS];
        bool on_tip = false;
        int32_t count = 0;
        for (int32_t k = 0; k < robot.num_supports; k++) {
            if (posture.supports[k].z - lowest <= 0.03f) {
                ck_assert_int_eq(rest.carrying[count], k);
                carrying[count++] = posture.supports[k];
                on_tip = on_tip || k == TIP;
            }
        }
        ck_assert_int_eq(rest.num_carrying, count);
        ck_assert_int_eq(rest.braced, on_tip);
        expect_near(rest.margin, lh_stability_margin(carrying, rest.num_carrying, posture.centre_of_mass), 1e-5);
    }
    ck_assert_int_gt(braced, 20);
}
END_TEST

/* --- against a search of its own in double precision --- */

typedef struct point {
    double x, y, z;
} point;

static point in_double(lh_vec3 v) {
    return (point){v.x, v.y, v.z};
}

static point minus(point a, point b) {
    return (point){a.x - b.x, a.y - b.y, a.z - b.z};
}

static double dot(point a, point b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static point cross(point a, point b) {
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* Whether p, along the normal of the triangle, lies over it; on its edge it is anybody's guess. */
static bool is_over(point p, const point corner[3], point normal) {
    for (int32_t i = 0; i < 3; i++) {
        const point side = minus(corner[(i + 1) % 3], corner[i]);
        if (dot(cross(side, minus(p, corner[i])), normal) < 0.0) {
            return false;
        }
    }
    return true;
}

/* The lowest way for the centre of mass to lie over three of the tips of the legs with no other below, into *normal;
 * false if there is none. It is over three tips of four or more in a plane whenever it is over all of them. */
static bool lowest_rest(const lh_posture *posture, int32_t count, point *normal) {
    double lowest = 1e9;
    for (int32_t i = 0; i < count; i++) {
        for (int32_t j = 0; j < count; j++) {
            for (int32_t k = 0; k < count; k++) {
                const point corner[3] = {in_double(posture->supports[i]), in_double(posture->supports[j]),
                                         in_double(posture->supports[k])};
                point up = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
                const double length = sqrt(dot(up, up));
                if (length < 1e-6 || up.z / length < 0.3) {
                    continue; /* in a line, or the other way round */
                }
                up = (point){up.x / length, up.y / length, up.z / length};
                bool stands = is_over(in_double(posture->centre_of_mass), corner, up);
                for (int32_t m = 0; m < count; m++) {
                    stands = stands && dot(minus(in_double(posture->supports[m]), corner[0]), up) > -0.005;
                }
                const double height = dot(minus(in_double(posture->centre_of_mass), corner[0]), up);
                if (stands && height < lowest) {
                    lowest = height;
                    *normal = up;
                }
            }
        }
    }
    return lowest < 1e9;
}

START_TEST(against_a_search_in_double_precision) {
    const lh_robot robot = crawler_robot();
    lh_random random;
    lh_random_init(&random, 3);
    int32_t tilted = 0;
    for (int32_t i = 0; i < 100; i++) {
        const float swing = -2.6f + 5.2f * lh_random_uniform(&random);
        const float boom = -0.6f + 1.8f * lh_random_uniform(&random);
        const float arm = -2.4f * lh_random_uniform(&random);
        const lh_posture posture = posture_at(&robot, swing, boom, arm, no_rotation);
        const lh_rest rest = rest_at(&robot, swing, boom, arm, level);
        point normal = {0.0, 0.0, 0.0};
        ck_assert(lowest_rest(&posture, robot.num_supports, &normal));
        expect_near(rest.normal.x, normal.x, 1e-5);
        expect_near(rest.normal.y, normal.y, 1e-5);
        expect_near(rest.normal.z, normal.z, 1e-5);
        tilted += normal.z < 0.999;
    }
    ck_assert_int_gt(tilted, 20);
}
END_TEST

/* A robot of another size rests as the same robot does, in proportion. */
START_TEST(size_does_not_matter) {
    lh_random random;
    lh_random_init(&random, 4);
    const lh_robot robot = crawler_robot();
    for (int32_t i = 0; i < 100; i++) {
        const float swing = -2.6f + 5.2f * lh_random_uniform(&random);
        const float boom = -0.6f + 0.9f * lh_random_uniform(&random);
        const float arm = -2.4f * lh_random_uniform(&random);
        const lh_rest rest = rest_at(&robot, swing, boom, arm, level);
        for (float scale = 0.1f; scale < 11.0f; scale *= 100.0f) {
            const lh_robot other = scaled_robot(&robot, scale);
            const lh_rest scaled = rest_at(&other, swing, boom, arm, level);
            ck_assert_int_eq(scaled.num_carrying, rest.num_carrying);
            ck_assert_mem_eq(scaled.carrying, rest.carrying, sizeof *rest.carrying * (size_t)rest.num_carrying);
            expect_near(scaled.margin, scale * rest.margin, 1e-5 * scale);
            expect_near(scaled.normal.z, rest.normal.z, 1e-5);
        }
    }
}
END_TEST

/* --- slopes --- */

START_TEST(on_a_slope_the_margin_is_less_downhill) {
    const lh_robot robot = crawler_robot();
    const lh_vec3 centre = posture_at(&robot, 1.57079633f, 0.6f, -1.0f, no_rotation).centre_of_mass;
    for (int32_t i = 0; i < 20; i++) {
        const double slope = -0.5 + 0.05 * i; /* uphill ahead where positive */
        const lh_vec3 up = {(float)sin(slope), 0.0f, (float)cos(slope)};
        const lh_rest rest = rest_at(&robot, 1.57079633f, 0.6f, -1.0f, up);
        /* over the ends, a turn about a level axis; over the sides, about an inclined one */
        double expected = 1e9;
        for (int32_t end = -1; end <= 1; end += 2) {
            const double dx = centre.x - 0.62 * end;
            const double dy = centre.y - 0.625 * end;
            expected = fmin(expected, hypot(dx, centre.z) - (dx * sin(slope) + centre.z * cos(slope)));
            expected = fmin(expected, (hypot(dy, centre.z) - centre.z) * cos(slope));
        }
        ck_assert_int_eq(rest.num_carrying, 4);
        expect_near(rest.margin, expected, 1e-5);
    }
}
END_TEST

START_TEST(on_too_steep_a_slope_it_rests_nowhere) {
    const lh_robot robot = crawler_robot();
    const lh_rest rest = rest_at(&robot, 0.0f, 1.2f, -1.0f, (lh_vec3){0.0f, 0.9f, 0.43588989f});
    expect_nowhere(&rest);
}
END_TEST

/* --- where there is no rest --- */

START_TEST(with_its_mass_beside_all_supports_it_rests_nowhere) {
    lh_robot robot = crawler_robot();
    robot.links[0].centre = (lh_vec3){-5.0f, 0.0f, 0.3f};
    const lh_rest rest = rest_at(&robot, 0.0f, 0.6f, -1.0f, level);
    expect_nowhere(&rest);
}
END_TEST

START_TEST(supports_in_a_line_carry_nothing) {
    lh_robot robot = crawler_robot();
    robot.num_supports = 3;
    for (int32_t i = 0; i < 3; i++) {
        robot.supports[i].point = (lh_vec3){(float)(i - 1), 0.0f, 0.0f};
    }
    const lh_rest rest = rest_at(&robot, 0.0f, 0.6f, -1.0f, level);
    expect_nowhere(&rest);
}
END_TEST

/* Three supports that can be stood upon by lying on the side only: z of the normal is 0.29, the least is 0.3. */
START_TEST(it_does_not_lie_on_its_side) {
    lh_robot robot = crawler_robot();
    robot.num_supports = 3;
    robot.links[0].centre = (lh_vec3){0.0f, 0.0f, 0.0f};
    robot.links[0].mass = 1e6f; /* all the others do not count */
    for (int32_t i = 0; i < 2; i++) {
        const float sine = i == 0 ? 0.957f : 0.95f; /* of the plane's slope */
        const float cosine = (float)sqrt(1.0 - (double)sine * sine);
        robot.supports[0].point = (lh_vec3){1.0f, -cosine + sine, -sine - cosine};
        robot.supports[1].point = (lh_vec3){-1.0f, -cosine + sine, -sine - cosine};
        robot.supports[2].point = (lh_vec3){0.0f, cosine + sine, sine - cosine};
        /* the plane is 1 m below the centre of mass, across its normal */
        const lh_rest rest = rest_at(&robot, 0.0f, 0.6f, -1.0f, level);
        if (i == 0) {
            expect_nowhere(&rest);
        } else {
            ck_assert_int_eq(rest.num_carrying, 3);
            expect_near(rest.normal.z, cosine, 1e-5);
        }
    }
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("rest");
    TCase *t = tcase_create("level ground");
    tcase_add_test(t, upright_turns_to_the_vertical_by_the_shortest_way);
    tcase_add_test(t, with_the_arm_up_it_stands_on_its_crawlers);
    tcase_add_test(t, a_tip_pressed_down_ahead_lifts_the_front);
    tcase_add_test(t, it_lies_as_kinematics_has_it);
    tcase_add_test(t, against_a_search_in_double_precision);
    tcase_add_test(t, size_does_not_matter);
    suite_add_tcase(s, t);
    t = tcase_create("slopes");
    tcase_add_test(t, on_a_slope_the_margin_is_less_downhill);
    tcase_add_test(t, on_too_steep_a_slope_it_rests_nowhere);
    suite_add_tcase(s, t);
    t = tcase_create("no rest");
    tcase_add_test(t, with_its_mass_beside_all_supports_it_rests_nowhere);
    tcase_add_test(t, supports_in_a_line_carry_nothing);
    tcase_add_test(t, it_does_not_lie_on_its_side);
    suite_add_tcase(s, t);
    return s;
}
