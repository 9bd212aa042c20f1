/* Distances of solids: closed forms, and by brute force: between points of two solids, which are never nearer to each
 * other than the solids, and along directions, which never show more than there is. */
#include "limphome/safety/solid.h"

#include "limphome/base/random.h"
#include "test.h"

#define FAR 1e9f

static lh_solid at(float x, float y, float z) {
    return (lh_solid){.centre = {x, y, z}, .x = {1, 0, 0}, .y = {0, 1, 0}, .z = {0, 0, 1}};
}

static lh_solid box(float x, float y, float z, lh_vec3 half) {
    lh_solid s = at(x, y, z);
    s.half = half;
    return s;
}

static lh_solid ball(float x, float y, float z, float radius) {
    lh_solid s = at(x, y, z);
    s.radius = radius;
    return s;
}

static lh_solid cylinder(float x, float y, float z, float radius, float half) {
    lh_solid s = ball(x, y, z, radius);
    s.half.z = half;
    s.disc = true;
    return s;
}

static lh_solid turned(lh_solid s, lh_vec3 axis, float angle) {
    const lh_quat q = lh_quat_about(axis, angle);
    s.x = lh_quat_rotate(q, s.x);
    s.y = lh_quat_rotate(q, s.y);
    s.z = lh_quat_rotate(q, s.z);
    return s;
}

/* The same both ways round. */
static void expect(lh_solid a, lh_solid b, double distance) {
    ck_assert_double_eq_tol(lh_solid_distance(&a, &b, FAR), distance, 2e-6);
    ck_assert_double_eq_tol(lh_solid_distance(&b, &a, FAR), distance, 2e-6);
}

START_TEST(balls) {
    expect(ball(0, 0, 0, 0.25f), ball(3, 4, 0, 0.5f), 4.25);
    expect(ball(0, 0, 0, 0.25f), ball(0.3f, 0.4f, 0, 0.5f), -0.25);
    const lh_solid cube = box(0, 0, 0, (lh_vec3){1, 1, 1});
    expect(ball(2, 0.3f, 0.1f, 0.5f), cube, 0.5);
    expect(ball(1.3f, 1.4f, 0.1f, 0.1f), cube, 0.4); /* from an edge */
    expect(ball(2, 3, 3, 0.5f), cube, 2.5);          /* from a corner */
    expect(ball(1.3f, 1.4f, 0.1f, 0.6f), cube, -0.1);
    expect(ball(0.9f, 0, 0, 0.05f), cube, -0.15); /* inside */
}
END_TEST

START_TEST(boxes) {
    const lh_solid cube = box(0, 0, 0, (lh_vec3){1, 1, 1});
    const lh_vec3 y = {0, 1, 0};
    const lh_vec3 z = {0, 0, 1};
    expect(cube, box(2.5f, 0.5f, 0.9f, (lh_vec3){0.5f, 1, 1}), 1); /* faces */
    expect(cube, box(1.25f, 0, 0, (lh_vec3){0.5f, 1, 1}), -0.25);
    expect(cube, turned(box(3, 0, 0, (lh_vec3){1, 1, 1}), z, 0.785398163f), 2 - sqrt(2.0)); /* a face and an edge */
    /* edges across each other, each lying over the other at 45 degrees */
    const lh_solid upright = turned(cube, z, 0.785398163f);
    const lh_solid lying = turned(box(3, 0, 0, (lh_vec3){1, 1, 1}), y, 0.785398163f);
    expect(upright, lying, 3 - 2 * sqrt(2.0));
    expect(cube, box(0, 0, 0, (lh_vec3){0.5f, 0.5f, 0.5f}), -1.5); /* one in the other */
}
END_TEST

START_TEST(cylinders_and_belts) {
    const lh_vec3 y = {0, 1, 0};
    const lh_solid upright = cylinder(0, 0, 0, 0.5f, 1);
    expect(upright, cylinder(3, 4, 0, 0.5f, 1), 4);                                 /* side by side */
    expect(upright, cylinder(0.1f, 0, 3, 0.5f, 1), 1);                              /* one on the other */
    expect(upright, turned(cylinder(2, 0, 0, 0.5f, 1), y, 1.57079633f), 0.5);       /* an end and a side */
    expect(upright, turned(cylinder(0, 2, 0, 0.5f, 1), y, 1.57079633f), 1);         /* crosswise */
    expect(upright, box(3, 4, 0, (lh_vec3){0.1f, 0.1f, 2}), hypot(2.9, 3.9) - 0.5); /* from an edge */
    const lh_solid beside = ball(3, 4, 3, 0.5f);                                    /* from a rim */
    ck_assert_double_eq_tol(lh_solid_distance(&upright, &beside, FAR), hypot(4.5, 2) - 0.5, 1e-3);
    lh_solid belt = cylinder(0, 0, 0, 0.2f, 0.15f);
    belt.half.x = 0.6f;
    expect(belt, ball(0.3f, 0.5f, 0, 0.1f), 0.2);           /* over the flat */
    expect(belt, ball(0.6f + 0.3f, 0.4f, 0.1f, 0.1f), 0.2); /* before its end */
    expect(belt, box(0, 0.3f, 0, (lh_vec3){0.1f, 0.11f, 0.1f}), -0.01);
}
END_TEST

/* Only as much as is asked for, and never more than there is. */
START_TEST(enough_is_enough) {
    const lh_solid a = box(0, 0, 0, (lh_vec3){1, 1, 1});
    const lh_solid b = turned(box(3, 3, 0, (lh_vec3){1, 1, 1}), (lh_vec3){0, 0, 1}, 0.3f);
    const float all = lh_solid_distance(&a, &b, FAR);
    for (float enough = -1; enough < 2; enough += 0.1f) {
        const float distance = lh_solid_distance(&a, &b, enough);
        ck_assert_float_le(distance, all);
        ck_assert(distance >= enough || distance == all);
    }
}
END_TEST

/* --- brute force --- */

static float uniform(lh_random *random, float low, float high) {
    return low + (high - low) * lh_random_uniform(random);
}

static lh_vec3 any_direction(lh_random *random) {
    for (;;) {
        const lh_vec3 v = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
        const float norm = lh_vec3_norm(v);
        if (norm > 0.1f && norm <= 1) {
            return lh_vec3_scale(v, 1 / norm);
        }
    }
}

static lh_solid any_solid(lh_random *random) {
    lh_solid s = at(uniform(random, -0.8f, 0.8f), uniform(random, -0.8f, 0.8f), uniform(random, -0.8f, 0.8f));
    const float x = uniform(random, 0.05f, 0.5f);
    const float y = uniform(random, 0.05f, 0.5f);
    const float z = uniform(random, 0.05f, 0.5f);
    switch (lh_random_next(random) % 4) {
        case 0:
            s.radius = x;
            break;
        case 1:
            s.half = (lh_vec3){x, y, z};
            break;
        case 2:
            s.half.x = x;
            __attribute__((fallthrough));
        default:
            s.half.z = z;
            s.radius = y;
            s.disc = true;
            break;
    }
    return turned(s, any_direction(random), uniform(random, -3, 3));
}

/* Anywhere on the solid's surface, or within. */
static lh_vec3 any_point(lh_random *random, const lh_solid *s) {
    const float corner = lh_random_next(random) % 2 == 0 ? 1 : uniform(random, 0, 1);
    lh_vec3 p = {s->half.x * uniform(random, -1, 1), s->half.y * uniform(random, -1, 1),
                 s->half.z * uniform(random, -1, 1)};
    p.x = lh_random_next(random) % 2 == 0 ? copysignf(s->half.x * corner, p.x) : p.x;
    p.y = lh_random_next(random) % 2 == 0 ? copysignf(s->half.y * corner, p.y) : p.y;
    p.z = lh_random_next(random) % 2 == 0 ? copysignf(s->half.z * corner, p.z) : p.z;
    lh_vec3 round = any_direction(random);
    if (s->disc) {
        const float across = hypotf(round.x, round.y) + 1e-6f;
        round = (lh_vec3){round.x / across, round.y / across, 0};
    }
    p = lh_vec3_add(p, lh_vec3_scale(round, s->radius));
    const lh_vec3 flat = lh_vec3_add(lh_vec3_scale(s->x, p.x), lh_vec3_scale(s->y, p.y));
    return lh_vec3_add(s->centre, lh_vec3_add(flat, lh_vec3_scale(s->z, p.z)));
}

/* How far the solid reaches in that direction, in double precision. */
static double reach(const lh_solid *s, lh_vec3 n) {
    const double x = lh_vec3_dot(s->x, n);
    const double y = lh_vec3_dot(s->y, n);
    const double z = lh_vec3_dot(s->z, n);
    const double round = s->disc ? sqrt(x * x + y * y) : 1;
    return lh_vec3_dot(s->centre, n) + s->half.x * fabs(x) + s->half.y * fabs(y) + s->half.z * fabs(z) +
           s->radius * round;
}

/* What directions show: a distance that is there. */
static double shown(lh_random *random, const lh_solid *a, const lh_solid *b) {
    double most = -10;
    lh_vec3 best = {0, 0, 1};
    for (int32_t i = 0; i < 3000; i++) { /* at first anywhere, then about the best */
        const float share = i < 1000 ? 1 : 0.3f * (float)(3000 - i) / 2000;
        lh_vec3 n = lh_vec3_add(lh_vec3_scale(best, i < 1000 ? 0 : 1), lh_vec3_scale(any_direction(random), share));
        n = lh_vec3_scale(n, 1 / lh_vec3_norm(n));
        const double distance = -reach(a, n) - reach(b, lh_vec3_scale(n, -1));
        if (distance > most) {
            most = distance;
            best = n;
        }
    }
    return most;
}

START_TEST(any_solids) {
    lh_random random;
    lh_random_init(&random, 3);
    int32_t apart = 0;
    int32_t inside = 0;
    for (int32_t i = 0; i < 500; i++) {
        const lh_solid a = any_solid(&random);
        const lh_solid b = any_solid(&random);
        const double distance = lh_solid_distance(&a, &b, FAR);
        double nearest = 10;
        for (int32_t k = 0; k < 300; k++) {
            const lh_vec3 p = any_point(&random, &a);
            const lh_vec3 q = any_point(&random, &b);
            nearest = fmin(nearest, lh_vec3_norm(lh_vec3_sub(p, q)));
        }
        ck_assert_double_le(distance, nearest + 1e-5); /* never more than there is */
        const double found = shown(&random, &a, &b);
        if (found > 1e-3) {
            ck_assert_double_ge(distance, fmin(0.5 * found, found - 8e-3)); /* nor much less */
            apart++;
        }
        if (found < -1e-3) {
            ck_assert_double_le(distance, 3e-3);
            inside++;
        }
    }
    ck_assert_int_gt(apart, 175);
    ck_assert_int_gt(inside, 75);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("solid");
    TCase *t = tcase_create("distance");
    tcase_add_test(t, balls);
    tcase_add_test(t, boxes);
    tcase_add_test(t, cylinders_and_belts);
    tcase_add_test(t, enough_is_enough);
    tcase_add_test(t, any_solids);
    suite_add_tcase(s, t);
    return s;
}
