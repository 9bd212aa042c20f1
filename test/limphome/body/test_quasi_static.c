#include "limphome/body/quasi_static.h"

#include "crawler.h"
#include "limphome/base/random.h"
#include "limphome/body/kinematics.h"
#include "test.h"

static const lh_vec3 level = {0.0f, 0.0f, 1.0f};
static const float travel[LH_MAX_ACTUATORS] = {0.15f, 0.15f, 0.15f, 0.15f, 0.15f}; /* of a decision of 0.5 s */

enum { LEFT, RIGHT, SWING, BOOM, ARM, ACTUATORS };

#define FRICTION 0.7f
/* How near the motion comes to the one that loses the least power, in longest travels: on the crawlers alone; on a
 * slope, where gravity makes the most of friction that is soft; and where the tip carries, which as a rule sticks where
 * it was thrust, so that friction there bends sharply. */
#define ACCURACY_ON_CRAWLERS 0.004
#define ACCURACY_ON_SLOPES 0.06
#define ACCURACY_BRACED 0.15

typedef struct stance {
    lh_rest rest;
    lh_footing footing;
    lh_posture posture; /* as it rests */
} stance;

static stance stand(const lh_robot *robot, float swing, float boom, float arm, lh_vec3 up) {
    const float angle[LH_MAX_ACTUATORS] = {NAN, NAN, swing, boom, arm}; /* crawlers are not read */
    stance s;
    lh_rest_find(robot, angle, up, &s.rest);
    lh_footing_find(robot, angle, &s.rest, up, travel, FRICTION, &s.footing);
    lh_kinematics_posture(robot, lh_rest_upright(s.rest.normal), angle, &s.posture);
    return s;
}

/* On its crawlers alone, with as much weight on the left as on the right. */
static stance stand_flat(lh_vec3 up) {
    const lh_robot robot = crawler_robot();
    return stand(&robot, 0.0f, 0.6f, -1.0f, up);
}

/* The same with the arm thrust on the ground to the left, ahead. */
static stance stand_braced(void) {
    const lh_robot robot = crawler_robot();
    return stand(&robot, 1.3f, -0.5f, -0.9f, level);
}

/* --- reference: power lost by sliding less that gained downhill, in double precision --- */

static double power(const lh_footing *f, const float *share, const double *twist) {
    double sum = -(f->pull_x * twist[0] + f->pull_y * twist[1]);
    for (int32_t i = 0; i < f->count; i++) {
        double slip_x = twist[0] - twist[2] * f->y[i];
        double slip_y = twist[1] + twist[2] * f->x[i];
        for (int32_t k = 0; k < ACTUATORS; k++) {
            slip_x += (double)share[k] * f->shift_x[k][i];
            slip_y += (double)share[k] * f->shift_y[k][i];
        }
        sum += f->load[i] * hypot(slip_x, slip_y);
    }
    return sum;
}

/* Tries steps along the axes, between them and in many others, ever shorter ones; the power is convex, so that the
 * least that is found is the least there is. */
static double least_power(const lh_footing *f, const float *share, double *twist) {
    lh_random random;
    lh_random_init(&random, 4);
    twist[0] = twist[1] = twist[2] = 0.0;
    double least = power(f, share, twist);
    for (double size = 0.3; size > 1e-6; size *= 0.7) {
        for (int32_t i = 0; i < 60; i++) {
            double tried[3];
            for (int32_t k = 0; k < 3; k++) {
                tried[k] = twist[k] + size * (2.0 * lh_random_uniform(&random) - 1.0);
            }
            const double found = power(f, share, tried);
            if (found < least) {
                least = found;
                memcpy(twist, tried, sizeof tried);
                i = 0;
            }
        }
    }
    return least;
}

/* By how much the motion differs from the one of least power, in longest travels. */
static double difference(const lh_footing *f, const float *share) {
    double best[3];
    least_power(f, share, best);
    const lh_twist t = lh_quasi_static_motion(f, ACTUATORS, share);
    return fmax(fabs(t.forward - best[0]), fmax(fabs(t.sideways - best[1]), fabs(t.turn - best[2]))) / f->travel;
}

/* --- what it stands on --- */

static void expect_balance(const stance *s) {
    double sum = 0.0;
    double x = 0.0;
    double y = 0.0;
    for (int32_t i = 0; i < s->footing.count; i++) {
        ck_assert_float_ge(s->footing.load[i], 0.0f);
        sum += s->footing.load[i];
        x += s->footing.load[i] * s->footing.x[i];
        y += s->footing.load[i] * s->footing.y[i];
    }
    expect_near(sum, 1.0, 1e-5);
    expect_near(x, s->posture.centre_of_mass.x, 1e-4);
    expect_near(y, s->posture.centre_of_mass.y, 1e-4);
}

START_TEST(loads_hold_the_centre_of_mass) {
    const stance flat = stand_flat(level);
    ck_assert_int_eq(flat.footing.count, 4);
    expect_balance(&flat);
    const stance braced = stand_braced();
    ck_assert_int_eq(braced.footing.count, 3);
    ck_assert(braced.rest.braced);
    expect_balance(&braced);
}
END_TEST

/* Above a corner of the rectangle a plane of loads would hold the opposite corner down. */
START_TEST(no_support_pulls) {
    lh_robot robot = crawler_robot();
    robot.links[0].mass = 1e6f;
    robot.links[0].centre = (lh_vec3){0.6f, 0.6f, 0.3f};
    const stance s = stand(&robot, 0.0f, 0.6f, -1.0f, level);
    ck_assert_int_eq(s.footing.count, 4);
    ck_assert_float_eq(s.footing.load[2], 0.0f); /* behind, to the right */
    double sum = 0.0;
    for (int32_t i = 0; i < 4; i++) {
        ck_assert_float_ge(s.footing.load[i], 0.0f);
        sum += s.footing.load[i];
    }
    expect_near(sum, 1.0, 1e-5);
}
END_TEST

START_TEST(belts_run_backwards_below) {
    const stance s = stand_braced();
    for (int32_t i = 0; i < s.footing.count; i++) {
        const int32_t support = s.rest.carrying[i];
        const bool is_left = support == 0 || support == 1;
        const bool is_right = support == 2 || support == 3;
        ck_assert_float_eq(s.footing.shift_x[LEFT][i], is_left ? -travel[LEFT] : 0.0f);
        ck_assert_float_eq(s.footing.shift_x[RIGHT][i], is_right ? -travel[RIGHT] : 0.0f);
        ck_assert_float_eq(s.footing.shift_y[LEFT][i], 0.0f);
        ck_assert_float_eq(s.footing.shift_y[RIGHT][i], 0.0f);
    }
    ck_assert_float_eq(s.footing.travel, 0.15f);
}
END_TEST

/* Against kinematics a small turn either way. */
START_TEST(joints_move_the_tip) {
    const lh_robot robot = crawler_robot();
    const stance s = stand_braced();
    const int32_t tip = s.footing.count - 1;
    ck_assert_int_eq(s.rest.carrying[tip], 4);
    for (int32_t joint = SWING; joint < ACTUATORS; joint++) {
        lh_posture posture[2];
        for (int32_t i = 0; i < 2; i++) {
            float angle[LH_MAX_ACTUATORS] = {0.0f, 0.0f, 1.3f, -0.5f, -0.9f};
            angle[joint] += i == 0 ? -0.01f : 0.01f;
            lh_kinematics_posture(&robot, lh_rest_upright(s.rest.normal), angle, &posture[i]);
        }
        const double x = (posture[1].supports[4].x - posture[0].supports[4].x) / 0.02 * 0.15;
        const double y = (posture[1].supports[4].y - posture[0].supports[4].y) / 0.02 * 0.15;
        ck_assert_double_gt(hypot(x, y), 0.03);
        expect_near(s.footing.shift_x[joint][tip], x, 0.005);
        expect_near(s.footing.shift_y[joint][tip], y, 0.005);
        for (int32_t i = 0; i < tip; i++) {
            expect_near(s.footing.shift_x[joint][i], 0.0, 1e-6);
            expect_near(s.footing.shift_y[joint][i], 0.0, 1e-6);
        }
    }
}
END_TEST

START_TEST(an_arm_in_the_air_moves_nothing) {
    const stance s = stand_flat(level);
    const float share[LH_MAX_ACTUATORS] = {0.0f, 0.0f, 1.0f, -1.0f, 1.0f};
    const lh_twist t = lh_quasi_static_motion(&s.footing, ACTUATORS, share);
    ck_assert_float_eq(t.forward, 0.0f);
    ck_assert_float_eq(t.sideways, 0.0f);
    ck_assert_float_eq(t.turn, 0.0f);
}
END_TEST

START_TEST(nothing_is_predicted_of_what_rests_nowhere) {
    lh_robot robot = crawler_robot();
    robot.links[0].centre = (lh_vec3){-5.0f, 0.0f, 0.3f};
    const stance s = stand(&robot, 0.0f, 0.6f, -1.0f, (lh_vec3){0.6f, 0.0f, 0.8f});
    ck_assert_int_eq(s.footing.count, 0);
    const float share[LH_MAX_ACTUATORS] = {1.0f, 1.0f};
    const lh_twist t = lh_quasi_static_motion(&s.footing, ACTUATORS, share);
    ck_assert(t.forward == 0.0f && t.sideways == 0.0f && t.turn == 0.0f);
}
END_TEST

/* --- motions --- */

START_TEST(both_crawlers_alike_drive_straight_without_slip) {
    const stance s = stand_flat(level);
    for (int32_t way = -1; way <= 1; way += 2) {
        const float share[LH_MAX_ACTUATORS] = {(float)way, (float)way};
        const lh_twist t = lh_quasi_static_motion(&s.footing, ACTUATORS, share);
        expect_near(t.forward, 0.15 * way, 1e-5);
        expect_near(t.sideways, 0.0, 1e-5);
        expect_near(t.turn, 0.0, 1e-5);
    }
}
END_TEST

/* As much weight on either side: the middle moves by the mean of the two. */
START_TEST(crawlers_against_each_other_turn_on_the_spot) {
    const stance s = stand_flat(level);
    const float share[LH_MAX_ACTUATORS] = {-1.0f, 1.0f};
    const lh_twist t = lh_quasi_static_motion(&s.footing, ACTUATORS, share);
    expect_near(t.forward, 0.0, 1e-5);
    ck_assert_float_gt(t.turn, 0.1f); /* to the left */
    ck_assert_double_lt(difference(&s.footing, share), ACCURACY_ON_CRAWLERS);
}
END_TEST

/* How many are found at a time changes no bit. */
START_TEST(several_at_a_time_are_what_each_is_alone) {
    const stance s = stand_flat(level);
    const lh_shares shares[LH_MOTIONS] = {{{1.0f, 0.0f}}, {{-1.0f, 0.5f}}, {{0.25f, 1.0f}}, {{0.0f, -1.0f}}};
    for (int32_t count = 1; count <= LH_MOTIONS; count++) {
        lh_twist several[LH_MOTIONS];
        lh_quasi_static_motions(&s.footing, ACTUATORS, count, shares, several);
        for (int32_t m = 0; m < count; m++) {
            const lh_twist alone = lh_quasi_static_motion(&s.footing, ACTUATORS, shares[m].of);
            ck_assert_mem_eq(&several[m], &alone, sizeof alone);
            ck_assert(alone.turn != 0.0f);
        }
    }
}
END_TEST

START_TEST(a_locked_crawler_turns_it_to_its_side) {
    const stance s = stand_flat(level);
    for (int32_t crawler = LEFT; crawler <= RIGHT; crawler++) {
        float share[LH_MAX_ACTUATORS] = {0.0f};
        share[crawler] = 1.0f;
        const lh_twist t = lh_quasi_static_motion(&s.footing, ACTUATORS, share);
        expect_near(t.forward, 0.075, 1e-4);
        ck_assert_float_gt(crawler == RIGHT ? t.turn : -t.turn, 0.05f);
        ck_assert_double_lt(difference(&s.footing, share), ACCURACY_ON_CRAWLERS);
    }
}
END_TEST

static void draw_actions(lh_random *random, float *share) {
    for (int32_t k = 0; k < ACTUATORS; k++) {
        share[k] = (float)((int32_t)(3.0f * lh_random_uniform(random)) - 1);
    }
}

START_TEST(the_motion_loses_least_power) {
    const lh_robot robot = crawler_robot();
    lh_random random;
    lh_random_init(&random, 5);
    int32_t braced = 0;
    double sum = 0.0;
    for (int32_t i = 0; i < 30; i++) {
        const float swing = -2.6f + 5.2f * lh_random_uniform(&random);
        const float boom = -0.6f + 0.6f * lh_random_uniform(&random);
        const float arm = -2.4f * lh_random_uniform(&random);
        const stance s = stand(&robot, swing, boom, arm, level);
        float share[LH_MAX_ACTUATORS] = {0.0f};
        draw_actions(&random, share);
        const double error = difference(&s.footing, share);
        ck_assert_double_lt(error, s.rest.braced ? ACCURACY_BRACED : ACCURACY_ON_CRAWLERS);
        braced += s.rest.braced;
        sum += s.rest.braced ? error : 0.0;
    }
    ck_assert_int_gt(braced, 8);
    ck_assert_double_lt(sum / braced, 0.05);
}
END_TEST

START_TEST(the_opposite_of_an_action_does_the_opposite) {
    const stance s = stand_braced();
    ck_assert(s.footing.level);
    lh_random random;
    lh_random_init(&random, 6);
    for (int32_t i = 0; i < 20; i++) {
        float share[LH_MAX_ACTUATORS] = {0.0f};
        draw_actions(&random, share);
        const lh_twist there = lh_quasi_static_motion(&s.footing, ACTUATORS, share);
        for (int32_t k = 0; k < ACTUATORS; k++) {
            share[k] = -share[k];
        }
        const lh_twist back = lh_quasi_static_motion(&s.footing, ACTUATORS, share);
        expect_near(back.forward, -there.forward, 1e-6);
        expect_near(back.sideways, -there.sideways, 1e-6);
        expect_near(back.turn, -there.turn, 1e-6);
    }
}
END_TEST

/* All supports in a point or in a line: what they do not hold is left as it is. */
START_TEST(supports_in_a_line_or_a_point_give_numbers) {
    const float share[LH_MAX_ACTUATORS] = {1.0f};
    for (int32_t count = 1; count <= 3; count++) {
        lh_footing footing = {.count = count, .level = true, .travel = 0.15f};
        for (int32_t i = 0; i < count; i++) {
            footing.x[i] = 0.5f * (float)i;
            footing.load[i] = 1.0f / (float)count;
            footing.shift_x[0][i] = -0.15f;
        }
        const lh_twist t = lh_quasi_static_motion(&footing, 1, share);
        expect_near(t.forward, 0.15, 0.01);
        expect_near(t.sideways, 0.0, 1e-4);
        expect_near(t.turn, 0.0, 1e-4);
    }
}
END_TEST

/* --- slopes --- */

static lh_vec3 uphill(double slope, double direction) {
    return (lh_vec3){(float)(sin(slope) * cos(direction)), (float)(sin(slope) * sin(direction)), (float)cos(slope)};
}

START_TEST(gravity_pulls_downhill) {
    const stance flat = stand_flat(uphill(0.02, 0.0)); /* taken to be level */
    ck_assert(flat.footing.level);
    ck_assert(flat.footing.pull_x == 0.0f && flat.footing.pull_y == 0.0f);
    const stance s = stand_flat(uphill(0.2, 0.5));
    ck_assert(!s.footing.level);
    expect_near(s.footing.pull_x, -tan(0.2) * cos(0.5) / FRICTION, 1e-5);
    expect_near(s.footing.pull_y, -tan(0.2) * sin(0.5) / FRICTION, 1e-5);
}
END_TEST

/* Below the angle of friction, atan 0.7 = 35 degrees, nothing slides of itself. */
START_TEST(friction_holds_it_on_a_slope) {
    const float still[LH_MAX_ACTUATORS] = {0.0f};
    for (int32_t i = 0; i < 8; i++) {
        const stance s = stand_flat(uphill(0.1745, 0.785 * i)); /* 10 degrees */
        const lh_twist t = lh_quasi_static_motion(&s.footing, ACTUATORS, still);
        expect_near(t.forward, 0.0, 0.005);
        expect_near(t.sideways, 0.0, 0.005);
        expect_near(t.turn, 0.0, 0.005);
    }
}
END_TEST

START_TEST(turning_on_a_slope_it_slides_downhill) {
    const float share[LH_MAX_ACTUATORS] = {0.0f, 1.0f};
    const stance flat = stand_flat(level);
    const lh_twist on_flat = lh_quasi_static_motion(&flat.footing, ACTUATORS, share);
    for (int32_t i = 0; i < 4; i++) {
        const double direction = M_PI_2 * i;
        const stance s = stand_flat(uphill(0.1745, direction));
        ck_assert_int_eq(s.footing.count, 4);
        const lh_twist t = lh_quasi_static_motion(&s.footing, ACTUATORS, share);
        const double down =
            (t.forward - on_flat.forward) * cos(direction) + (t.sideways - on_flat.sideways) * sin(direction);
        ck_assert_double_lt(down, -0.005);
        ck_assert_double_lt(difference(&s.footing, share), ACCURACY_ON_SLOPES);
    }
}
END_TEST

/* What is steeper than friction holds has no least power: each step goes as far as it may, downhill. */
START_TEST(a_slide_is_bounded) {
    stance s = stand_flat(level);
    s.footing.level = false;
    s.footing.pull_x = -5.0f;
    const float still[LH_MAX_ACTUATORS] = {0.0f};
    const lh_twist t = lh_quasi_static_motion(&s.footing, ACTUATORS, still);
    ck_assert_float_lt(t.forward, -0.15f);
    ck_assert_float_ge(t.forward, -5.0f * 0.1501f);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("quasi_static");
    TCase *t = tcase_create("footing");
    tcase_add_test(t, loads_hold_the_centre_of_mass);
    tcase_add_test(t, no_support_pulls);
    tcase_add_test(t, belts_run_backwards_below);
    tcase_add_test(t, joints_move_the_tip);
    tcase_add_test(t, an_arm_in_the_air_moves_nothing);
    tcase_add_test(t, nothing_is_predicted_of_what_rests_nowhere);
    suite_add_tcase(s, t);
    t = tcase_create("motion");
    tcase_add_test(t, both_crawlers_alike_drive_straight_without_slip);
    tcase_add_test(t, crawlers_against_each_other_turn_on_the_spot);
    tcase_add_test(t, several_at_a_time_are_what_each_is_alone);
    tcase_add_test(t, a_locked_crawler_turns_it_to_its_side);
    tcase_add_test(t, the_motion_loses_least_power);
    tcase_add_test(t, the_opposite_of_an_action_does_the_opposite);
    tcase_add_test(t, supports_in_a_line_or_a_point_give_numbers);
    suite_add_tcase(s, t);
    t = tcase_create("slopes");
    tcase_add_test(t, gravity_pulls_downhill);
    tcase_add_test(t, friction_holds_it_on_a_slope);
    tcase_add_test(t, turning_on_a_slope_it_slides_downhill);
    tcase_add_test(t, a_slide_is_bounded);
    suite_add_tcase(s, t);
    return s;
}
