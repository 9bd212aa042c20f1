#include "limphome/safety/interlock.h"

#include "limphome/base/random.h"
#include "test.h"

enum { REVERSE, STILL, FORWARD };

/* Driving forward or up at 0.3, far from every limit. */
static lh_guarded free_joint(void) {
    return (lh_guarded){.level = FORWARD,
                        .is_joint = true,
                        .velocity = 0.3f,
                        .change = 0.3f,
                        .speed_limit = 0.5f,
                        .change_limit = 1.0f,
                        .angle = 0.0f,
                        .ahead = 0.15f,
                        .low = -1.0f,
                        .high = 1.0f};
}

static lh_guarded mirrored(lh_guarded a) {
    a.level = (int8_t)(FORWARD - a.level);
    a.velocity = -a.velocity;
    a.change = -a.change;
    a.angle = -a.angle;
    a.ahead = -a.ahead;
    return a;
}

/* The same both ways. */
static uint32_t hazards_of(lh_guarded a) {
    const lh_guarded b = mirrored(a);
    const uint32_t found = lh_interlock_hazards(&a, false);
    ck_assert_uint_eq(lh_interlock_hazards(&b, false), found);
    return found;
}

START_TEST(nothing_is_found_within_all_limits) {
    ck_assert_uint_eq(hazards_of(free_joint()), 0);
}
END_TEST

START_TEST(a_speed_at_its_limit_passes) {
    lh_guarded a = free_joint();
    a.speed_limit = 0.3f;
    ck_assert_uint_eq(hazards_of(a), 0);
    a.speed_limit = nextafterf(0.3f, 0.0f);
    ck_assert_uint_eq(hazards_of(a), LH_HAZARD_SPEED);
}
END_TEST

START_TEST(a_change_at_its_limit_passes) {
    lh_guarded a = free_joint();
    a.change = 0.6f; /* it went the other way before */
    a.change_limit = 0.6f;
    ck_assert_uint_eq(hazards_of(a), 0);
    a.change_limit = 0.59f;
    ck_assert_uint_eq(hazards_of(a), LH_HAZARD_ACCELERATION);
}
END_TEST

START_TEST(no_joint_is_driven_into_its_stop) {
    lh_guarded a = free_joint();
    a.angle = 0.85f;
    a.ahead = 1.0f; /* just to it */
    ck_assert_uint_eq(hazards_of(a), 0);
    a.ahead = 1.01f;
    ck_assert_uint_eq(hazards_of(a), LH_HAZARD_STOP);
    a.ahead = 0.5f;
    a.angle = 1.0f; /* it is there, whatever lies ahead */
    ck_assert_uint_eq(hazards_of(a), LH_HAZARD_STOP);
    a.is_joint = false; /* a belt has no stop */
    ck_assert_uint_eq(hazards_of(a), 0);
    lh_guarded away = free_joint(); /* from a stop it may always go */
    away.angle = -1.2f;
    away.ahead = -1.05f;
    ck_assert_uint_eq(hazards_of(away), 0);
}
END_TEST

START_TEST(what_is_out_of_order_is_told) {
    lh_guarded a = free_joint();
    a.failed = true;
    ck_assert_uint_eq(hazards_of(a), LH_HAZARD_FAILED);
    a.stuck = true;
    a.speed_limit = 0.0f;
    ck_assert_uint_eq(hazards_of(a), LH_HAZARD_FAILED | LH_HAZARD_STUCK | LH_HAZARD_SPEED);
    a.level = STILL; /* nothing to forbid */
    ck_assert_uint_eq(lh_interlock_hazards(&a, true), 0);
}
END_TEST

START_TEST(what_would_collide_is_told) {
    lh_guarded a = free_joint();
    a.collides = true;
    ck_assert_uint_eq(hazards_of(a), LH_HAZARD_COLLISION);
    a.stuck = true;
    ck_assert_uint_eq(hazards_of(a), LH_HAZARD_COLLISION | LH_HAZARD_STUCK);
    a.level = STILL;
    ck_assert_uint_eq(hazards_of(a), 0);
}
END_TEST

START_TEST(an_unsafe_margin_is_the_joints) {
    lh_guarded a = free_joint();
    ck_assert_uint_eq(lh_interlock_hazards(&a, true), LH_HAZARD_MARGIN);
    a.is_joint = false;
    ck_assert_uint_eq(lh_interlock_hazards(&a, true), 0);
}
END_TEST

START_TEST(no_number_is_within_no_limit) {
    lh_guarded a = free_joint();
    a.velocity = NAN;
    a.change = NAN;
    ck_assert_uint_eq(lh_interlock_hazards(&a, false), LH_HAZARD_SPEED | LH_HAZARD_ACCELERATION);
    a = free_joint();
    a.speed_limit = NAN;
    ck_assert_uint_eq(lh_interlock_hazards(&a, false), LH_HAZARD_SPEED);
}
END_TEST

/* A crawler forward, a joint that is at its stop, one that is still, one down. */
static void four(lh_guarded *guarded) {
    for (int32_t k = 0; k < 4; k++) {
        guarded[k] = free_joint();
    }
    guarded[0].is_joint = false;
    guarded[1].angle = 1.0f;
    guarded[2].level = STILL;
    guarded[2].velocity = 0.0f;
    guarded[3] = mirrored(guarded[3]);
}

static void expect_levels(const lh_verdict *v, int8_t a, int8_t b, int8_t c, int8_t d) {
    const int8_t expected[] = {a, b, c, d};
    for (int32_t k = 0; k < LH_MAX_ACTUATORS; k++) {
        const int8_t level = k < 4 ? expected[k] : STILL;
        ck_assert_int_eq(v->level[k], level);
        ck_assert_float_eq(v->velocity[k], 0.3f * (float)(level - 1));
    }
}

START_TEST(each_actuator_is_judged_by_itself) {
    lh_guarded guarded[4];
    lh_verdict v;
    four(guarded);
    lh_interlock(guarded, 4, 0, false, &v);
    expect_levels(&v, FORWARD, STILL, STILL, REVERSE);
    ck_assert_uint_eq(v.hazards, LH_HAZARD_STOP);
    ck_assert_uint_eq(v.stilled, 1u << 1);
}
END_TEST

START_TEST(joints_stop_together) {
    lh_guarded guarded[4];
    lh_verdict v;
    four(guarded);
    lh_interlock(guarded, 4, 0, true, &v);
    expect_levels(&v, FORWARD, STILL, STILL, STILL);
    ck_assert_uint_eq(v.hazards, LH_HAZARD_STOP | LH_HAZARD_MARGIN);
    ck_assert_uint_eq(v.stilled, 1u << 1 | 1u << 3);
}
END_TEST

START_TEST(the_whole_robot_stops) {
    lh_guarded guarded[4];
    lh_verdict v;
    four(guarded);
    guarded[1].angle = 0.0f;
    lh_interlock(guarded, 4, LH_HAZARD_TILT, false, &v);
    expect_levels(&v, STILL, STILL, STILL, STILL);
    ck_assert_uint_eq(v.hazards, LH_HAZARD_TILT);
    ck_assert_uint_eq(v.stilled, 1u << 0 | 1u << 1 | 1u << 3);
}
END_TEST

START_TEST(still_has_no_velocity) {
    lh_guarded guarded[4];
    lh_verdict v;
    four(guarded);
    guarded[2].velocity = 9.0f;
    lh_interlock(guarded, 4, 0, false, &v);
    expect_levels(&v, FORWARD, STILL, STILL, REVERSE);
}
END_TEST

static float any_of(lh_random *random) {
    static const float values[] = {0.0f,  0.1f,  -0.1f,  0.3f,     -0.3f,     1.0f,
                                   -1.0f, 1e30f, -1e30f, INFINITY, -INFINITY, NAN};
    return values[lh_random_next(random) % COUNT(values)];
}

/* Whatever goes in: each level is the one proposed or still, nothing unsafe moves, and what is safe is left alone. */
START_TEST(any_inputs) {
    lh_random random;
    lh_random_init(&random, 7);
    int32_t passed = 0;
    int32_t stilled = 0;
    for (int32_t i = 0; i < 200000; i++) {
        lh_guarded guarded[LH_MAX_ACTUATORS];
        const int32_t count = (int32_t)(lh_random_next(&random) % (LH_MAX_ACTUATORS + 1));
        const uint32_t whole = lh_random_next(&random) % 4 == 0 ? LH_HAZARD_JUMP : 0;
        const bool joints_unsafe = lh_random_next(&random) % 4 == 0;
        for (int32_t k = 0; k < count; k++) {
            guarded[k] = (lh_guarded){.level = (int8_t)(lh_random_next(&random) % 3),
                                      .is_joint = lh_random_next(&random) % 2 == 0,
                                      .failed = lh_random_next(&random) % 8 == 0,
                                      .stuck = lh_random_next(&random) % 8 == 0,
                                      .velocity = any_of(&random),
                                      .change = any_of(&random),
                                      .speed_limit = fabsf(any_of(&random)),
                                      .change_limit = fabsf(any_of(&random)),
                                      .angle = any_of(&random),
                                      .ahead = any_of(&random),
                                      .low = any_of(&random),
                                      .high = any_of(&random)};
        }
        lh_verdict v;
        memset(&v, 0x5a, sizeof v);
        lh_interlock(guarded, count, whole, joints_unsafe, &v);
        for (int32_t k = 0; k < LH_MAX_ACTUATORS; k++) {
            if (v.level[k] == STILL) {
                ck_assert_float_eq(v.velocity[k], 0.0f);
            } else {
                const lh_guarded *a = &guarded[k];
                ck_assert(k < count && whole == 0 && !a->failed && !a->stuck && !(joints_unsafe && a->is_joint));
                ck_assert_int_eq(v.level[k], a->level);
                ck_assert_float_eq(v.velocity[k], a->velocity);
                ck_assert_float_le(fabsf(v.velocity[k]), a->speed_limit);
                ck_assert_float_le(fabsf(a->change), a->change_limit);
                ck_assert(!(a->is_joint && v.velocity[k] > 0.0f && (a->angle >= a->high || a->ahead > a->high)));
                ck_assert(!(a->is_joint && v.velocity[k] < 0.0f && (a->angle <= a->low || a->ahead < a->low)));
                passed++;
            }
            const bool is_stilled = k < count && guarded[k].level != STILL && v.level[k] == STILL;
            ck_assert_uint_eq(v.stilled >> k & 1u, is_stilled);
            stilled += is_stilled;
            if (is_stilled && whole == 0) {
                ck_assert((lh_interlock_hazards(&guarded[k], joints_unsafe) & v.hazards) != 0);
            }
        }
    }
    ck_assert_int_gt(passed, 10000);
    ck_assert_int_gt(stilled, 10000);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("interlock");
    TCase *t = tcase_create("one actuator");
    tcase_add_test(t, nothing_is_found_within_all_limits);
    tcase_add_test(t, a_speed_at_its_limit_passes);
    tcase_add_test(t, a_change_at_its_limit_passes);
    tcase_add_test(t, no_joint_is_driven_into_its_stop);
    tcase_add_test(t, what_is_out_of_order_is_told);
    tcase_add_test(t, what_would_collide_is_told);
    tcase_add_test(t, an_unsafe_margin_is_the_joints);
    tcase_add_test(t, no_number_is_within_no_limit);
    suite_add_tcase(s, t);
    t = tcase_create("the robot");
    tcase_add_test(t, each_actuator_is_judged_by_itself);
    tcase_add_test(t, joints_stop_together);
    tcase_add_test(t, the_whole_robot_stops);
    tcase_add_test(t, still_has_no_velocity);
    tcase_add_test(t, any_inputs);
    suite_add_tcase(s, t);
    return s;
}
