#include "limphome/body/stability.h"

#include "limphome/base/elementary.h"
#include "reference.h"
#include "test.h"

static lh_vec3 vector(const float *v) {
    return (lh_vec3){v[0], v[1], v[2]};
}

/* A rectangle of 2 m by 1 m on the ground, counter-clockwise. */
static const lh_vec3 rectangle[4] = {{1, 0.5f, 0}, {-1, 0.5f, 0}, {-1, -0.5f, 0}, {1, -0.5f, 0}};

/* All points turned about the origin. */
static float margin_turned(lh_quat q, lh_vec3 shift, const lh_vec3 *points, int32_t count, lh_vec3 mass) {
    lh_vec3 turned[LH_MAX_SUPPORTS];
    for (int32_t i = 0; i < count; i++) {
        turned[i] = lh_vec3_add(lh_quat_rotate(q, points[i]), shift);
    }
    return lh_stability_margin(turned, count, lh_vec3_add(lh_quat_rotate(q, mass), shift));
}

START_TEST(edge_against_brute_force_rotation) {
    for (int32_t k = 0; k < COUNT(edge); k++) {
        const lh_vec3 a = vector(edge[k][0]);
        const lh_vec3 b = vector(edge[k][1]);
        const lh_vec3 g = vector(edge[k][2]);
        expect_near(lh_stability_edge(a, b, g), edge_rise[k], 3e-6);
        expect_near(lh_stability_edge(b, a, g), edge_rise[k], 3e-6);
    }
}
END_TEST

START_TEST(edge_by_hand) {
    const lh_vec3 a = {0, 0, 0};
    const lh_vec3 b = {3, 0, 0};
    /* 0.4 m beside and 0.3 m above a level edge: it rises to 0.5 m */
    expect_near(lh_stability_edge(a, b, (lh_vec3){1, 0.4f, 0.3f}), 0.2, 1e-6);
    expect_near(lh_stability_edge(a, b, (lh_vec3){1, -0.4f, 0.3f}), 0.2, 1e-6);
    expect_near(lh_stability_edge(a, b, (lh_vec3){1, 0.4f, -0.3f}), 0.8, 1e-6); /* below the edge */
    expect_near(lh_stability_edge(a, b, (lh_vec3){1, 0.0f, 0.3f}), 0.0, 1e-6);  /* above it: balanced */
    expect_near(lh_stability_edge(a, b, (lh_vec3){1, 0.0f, -0.3f}), 0.6, 1e-6); /* hanging from it */
    expect_near(lh_stability_edge(a, b, (lh_vec3){77, 0.4f, 0.3f}), 0.2, 1e-5); /* place along it */
    expect_near(lh_stability_edge(a, b, (lh_vec3){1, 0.0f, 0.0f}), 0.0, 1e-6);  /* on it */
}
END_TEST

START_TEST(edge_inclined_and_vertical) {
    const lh_vec3 a = {0, 0, 0};
    const lh_vec3 g = {0.1f, 0.4f, 0.2f};
    ck_assert_float_eq(lh_stability_edge(a, (lh_vec3){0, 0, 1}, g), 0.0f);
    ck_assert_float_eq(lh_stability_edge(a, (lh_vec3){0, 0, -2}, g), 0.0f);
    ck_assert_float_eq(lh_stability_edge(a, a, g), 0.0f);
    /* at 60 degrees, 0.4 m square to the side: |p| cos 60 */
    const lh_vec3 steep = {(float)cos(M_PI / 3), 0, (float)sin(M_PI / 3)};
    expect_near(lh_stability_edge(a, steep, (lh_vec3){0, 0.4f, 0}), 0.2, 1e-6);
    ck_assert_float_ge(lh_stability_edge(a, (lh_vec3){1e-6f, 0, 1}, g), 0.0f);
}
END_TEST

START_TEST(balanced_over_an_edge_is_not_below_zero) {
    lh_vec3 b = {0.3f, 0.9f, 0.0f};
    for (b.z = -1.0f; b.z < 1.0f; b.z += 0.013f) {
        for (float height = 0.1f; height < 1.0f; height += 0.037f) {
            const lh_vec3 g = {0.5f * b.x, 0.5f * b.y, 0.5f * b.z + height};
            const float rise = lh_stability_edge((lh_vec3){0, 0, 0}, b, g);
            ck_assert_float_ge(rise, 0.0f);
            expect_near(rise, 0.0, 3e-7);
        }
    }
}
END_TEST

START_TEST(margin_against_reference) {
    for (int32_t k = 0; k < COUNT(hull_points); k++) {
        lh_vec3 points[6];
        for (int32_t i = 0; i < 6; i++) {
            points[i] = vector(hull_points[k][i]);
        }
        expect_near(lh_stability_margin(points, 6, vector(hull_mass[k])), hull_margin[k], 3e-6);
    }
}
END_TEST

START_TEST(margin_of_a_rectangle) {
    const double height = 0.6;
    const lh_vec3 mass = {0.2f, 0.1f, (float)height};
    const double nearest = hypot(0.4, height) - height;
    expect_near(lh_stability_margin(rectangle, 4, mass), nearest, 1e-6);
    /* outside of the left side, and of the left and the front side */
    expect_near(lh_stability_margin(rectangle, 4, (lh_vec3){0.2f, 0.7f, (float)height}), -(hypot(0.2, height) - height),
                1e-6);
    expect_near(lh_stability_margin(rectangle, 4, (lh_vec3){1.1f, 0.7f, (float)height}), -(hypot(0.1, height) - height),
                1e-6);
    /* over the side itself */
    expect_near(lh_stability_margin(rectangle, 4, (lh_vec3){0.2f, 0.5f, (float)height}), 0.0, 1e-6);
    /* below the ground it is safer than above */
    expect_near(lh_stability_margin(rectangle, 4, (lh_vec3){0, 0, -0.6f}), hypot(0.5, 0.6) + 0.6, 1e-6);
}
END_TEST

START_TEST(order_duplicates_and_inner_points_do_not_matter) {
    const lh_vec3 mass = {0.2f, 0.1f, 0.6f};
    const float expected = lh_stability_margin(rectangle, 4, mass);
    const lh_vec3 more[] = {{0, 0, 0},       rectangle[2], {0, 0.5f, 0}, rectangle[0], {0.5f, -0.25f, 0}, rectangle[1],
                            {-1, 0.125f, 0}, rectangle[3], rectangle[0], {1, 0, 0},    rectangle[2],      {0, 0, 0}};
    ck_assert_float_eq(lh_stability_margin(more, COUNT(more), mass), expected);
    /* every order of the corners and a point on a side between two of them */
    const lh_vec3 corners[] = {rectangle[0], rectangle[1], rectangle[2], rectangle[3], {-1, 0.25f, 0}};
    for (int32_t order = 0; order < 5 * 5 * 5 * 5 * 5; order++) {
        lh_vec3 points[5];
        uint32_t used = 0;
        for (int32_t i = 0, digits = order; i < 5; i++, digits /= 5) {
            points[i] = corners[digits % 5];
            used |= 1u << (digits % 5);
        }
        if (used == 31u) {
            ck_assert_float_eq(lh_stability_margin(points, 5, mass), expected);
        }
    }
}
END_TEST

START_TEST(degenerate_supports_carry_nothing) {
    const lh_vec3 mass = {0.2f, 0.1f, 0.6f};
    const lh_vec3 line[] = {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0.5f, 0, 0}};
    const lh_vec3 same[] = {{1, 1, 0}, {1, 1, 0}, {1, 1, 0}};
    const lh_vec3 stacked[] = {{1, 1, 0}, {1, 1, 1}, {1, 1, 2}};
    ck_assert_float_eq(lh_stability_margin(line, 0, mass), 0.0f);
    ck_assert_float_eq(lh_stability_margin(line, 1, mass), 0.0f);
    ck_assert_float_eq(lh_stability_margin(same, 3, mass), 0.0f);
    ck_assert_float_eq(lh_stability_margin(stacked, 3, mass), 0.0f);
    const double fall = -(hypot(0.1, 0.6) - 0.6);
    expect_near(lh_stability_margin(line, 2, mass), fall, 1e-6);
    expect_near(lh_stability_margin(line, 4, mass), fall, 1e-6);
    /* straight above the line, and hanging below it */
    expect_near(lh_stability_margin(line, 4, (lh_vec3){0.2f, 0, 0.6f}), 0.0, 1e-6);
    ck_assert_float_le(lh_stability_margin(line, 4, (lh_vec3){0.2f, 0, -0.6f}), 0.0f);
}
END_TEST

START_TEST(three_points_are_enough) {
    const lh_vec3 triangle[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    expect_near(lh_stability_margin(triangle, 3, (lh_vec3){0.25f, 0.25f, 0.5f}), hypot(0.25, 0.5) - 0.5, 1e-6);
}
END_TEST

START_TEST(invariant_under_yaw_and_translation) {
    const lh_vec3 mass = {0.2f, 0.1f, 0.6f};
    const lh_vec3 shift = {-7.0f, 3.0f, 1.5f};
    const float expected = lh_stability_margin(rectangle, 4, mass);
    for (float yaw = -3.0f; yaw < 3.2f; yaw += 0.1f) {
        const lh_quat q = lh_quat_about((lh_vec3){0, 0, 1}, yaw);
        expect_near(margin_turned(q, shift, rectangle, 4, mass), expected, 3e-6);
    }
}
END_TEST

/* Turned about a level edge, its own rise follows from the angle; that of an edge across is scaled by the cosine. */
START_TEST(pitch_about_a_level_edge) {
    const lh_vec3 a = {1, -0.5f, 0};
    const lh_vec3 b = {1, 0.5f, 0};
    const lh_vec3 along = {-1, 0.5f, 0}; /* b to along is the edge across */
    const lh_vec3 g = {0.2f, 0.1f, 0.6f};
    const double radius = hypot(0.8, 0.6);
    for (float pitch = -0.6f; pitch < 0.65f; pitch += 0.1f) {
        const lh_quat q = lh_quat_about((lh_vec3){0, 1, 0}, pitch);
        const lh_vec3 ta = lh_quat_rotate(q, a);
        const lh_vec3 tb = lh_quat_rotate(q, b);
        const lh_vec3 tg = lh_quat_rotate(q, g);
        expect_near(lh_stability_edge(ta, tb, tg), radius * (1.0 - sin(atan2(0.6, 0.8) + (double)pitch)), 2e-6);
        const double level = lh_stability_edge(b, along, g);
        expect_near(lh_stability_edge(tb, lh_quat_rotate(q, along), tg), level * cos((double)pitch), 2e-6);
    }
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("stability");
    TCase *t = tcase_create("edge (10)");
    tcase_add_test(t, edge_against_brute_force_rotation);
    tcase_add_test(t, edge_by_hand);
    tcase_add_test(t, edge_inclined_and_vertical);
    tcase_add_test(t, balanced_over_an_edge_is_not_below_zero);
    tcase_add_test(t, pitch_about_a_level_edge);
    suite_add_tcase(s, t);
    t = tcase_create("margin (11)");
    tcase_add_test(t, margin_against_reference);
    tcase_add_test(t, margin_of_a_rectangle);
    tcase_add_test(t, order_duplicates_and_inner_points_do_not_matter);
    tcase_add_test(t, degenerate_supports_carry_nothing);
    tcase_add_test(t, three_points_are_enough);
    tcase_add_test(t, invariant_under_yaw_and_translation);
    suite_add_tcase(s, t);
    return s;
}
