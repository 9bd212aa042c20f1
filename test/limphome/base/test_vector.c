#include "limphome/base/vector.h"

#include "limphome/base/elementary.h"
#include "reference.h"
#include "test.h"

static lh_quat reference_quaternion(int32_t k) {
    const float *q = rotation_quaternion[k];
    return (lh_quat){q[0], q[1], q[2], q[3]};
}

static void expect_vector(lh_vec3 actual, const double expected[3], double tolerance) {
    expect_near(actual.x, expected[0], tolerance);
    expect_near(actual.y, expected[1], tolerance);
    expect_near(actual.z, expected[2], tolerance);
}

START_TEST(vector_operations) {
    const lh_vec3 a = {1.0f, -2.0f, 3.0f};
    const lh_vec3 b = {4.0f, 5.0f, -6.0f};
    expect_vector(lh_vec3_add(a, b), (double[]){5, 3, -3}, 1e-9);
    expect_vector(lh_vec3_sub(a, b), (double[]){-3, -7, 9}, 1e-9);
    expect_vector(lh_vec3_scale(a, 2.0f), (double[]){2, -4, 6}, 1e-9);
    expect_vector(lh_vec3_cross(a, b), (double[]){-3, 18, 13}, 1e-9);
    ck_assert_float_eq(lh_vec3_dot(a, b), -24.0f);
    ck_assert_float_eq(lh_vec3_norm((lh_vec3){2.0f, 3.0f, 6.0f}), 7.0f);
}
END_TEST

START_TEST(rotation_against_matrices) {
    const lh_vec3 v = {rotation_vector[0], rotation_vector[1], rotation_vector[2]};
    for (int32_t k = 0; k < COUNT(rotation_quaternion); k++) {
        expect_vector(lh_quat_rotate(reference_quaternion(k), v), rotation_turned[k], 1e-6);
    }
}
END_TEST

START_TEST(product_applies_the_right_one_first) {
    const lh_vec3 v = {rotation_vector[0], rotation_vector[1], rotation_vector[2]};
    for (int32_t k = 0; k < COUNT(rotation_angles); k++) {
        const double *angles = rotation_angles[k];
        const lh_quat yaw = lh_quat_about((lh_vec3){0, 0, 1}, (float)angles[0]);
        const lh_quat pitch = lh_quat_about((lh_vec3){0, 1, 0}, (float)angles[1]);
        const lh_quat roll = lh_quat_about((lh_vec3){1, 0, 0}, (float)angles[2]);
        const lh_quat q = lh_quat_multiply(yaw, lh_quat_multiply(pitch, roll));
        expect_vector(lh_quat_rotate(q, v), rotation_turned[k], 1e-6);
    }
}
END_TEST

START_TEST(angles_against_matrices) {
    for (int32_t k = 0; k < COUNT(rotation_angles); k++) {
        const lh_quat q = reference_quaternion(k);
        /* the angles are ill-conditioned where the nose points straight up or down */
        const double tolerance = 2e-6 / cos(rotation_angles[k][1]);
        expect_near(lh_quat_heading(q), rotation_angles[k][0], tolerance);
        expect_near(lh_quat_pitch(q), rotation_angles[k][1], 2e-6);
        expect_near(lh_quat_roll(q), rotation_angles[k][2], tolerance);
        expect_near(lh_quat_tilt(q), rotation_tilt[k], 2e-6);
    }
}
END_TEST

START_TEST(sign_of_a_quaternion_does_not_matter) {
    for (int32_t k = 0; k < COUNT(rotation_angles); k++) {
        const lh_quat q = reference_quaternion(k);
        const lh_quat negative = {-q.w, -q.x, -q.y, -q.z};
        ck_assert_float_eq(lh_quat_heading(q), lh_quat_heading(negative));
        ck_assert_float_eq(lh_quat_pitch(q), lh_quat_pitch(negative));
        ck_assert_float_eq(lh_quat_roll(q), lh_quat_roll(negative));
        ck_assert_float_eq(lh_quat_tilt(q), lh_quat_tilt(negative));
    }
}
END_TEST

/* i i = j j = k k = -1, i j = k, j k = i, k i = j; the other way round the signs turn. */
START_TEST(product_by_its_rules) {
    const lh_quat unit[] = {{0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (int32_t a = 0; a < 3; a++) {
        const lh_quat square = lh_quat_multiply(unit[a], unit[a]);
        ck_assert(square.w == -1.0f && square.x == 0.0f && square.y == 0.0f && square.z == 0.0f);
        const lh_quat third = unit[(a + 2) % 3];
        const lh_quat product = lh_quat_multiply(unit[a], unit[(a + 1) % 3]);
        ck_assert(product.w == 0.0f && product.x == third.x && product.y == third.y && product.z == third.z);
        const lh_quat reversed = lh_quat_multiply(unit[(a + 1) % 3], unit[a]);
        ck_assert(reversed.w == 0.0f && reversed.x == -third.x && reversed.y == -third.y && reversed.z == -third.z);
    }
}
END_TEST

START_TEST(signs_of_the_angles) {
    const lh_vec3 forward = {1, 0, 0};
    const lh_vec3 left = {0, 1, 0};
    ck_assert_float_lt(lh_quat_rotate(lh_quat_about(left, 0.2f), forward).z, 0.0f); /* nose down */
    expect_near(lh_quat_pitch(lh_quat_about(left, 0.2f)), 0.2, 1e-6);
    ck_assert_float_gt(lh_quat_rotate(lh_quat_about(forward, 0.2f), left).z, 0.0f); /* left side up */
    expect_near(lh_quat_roll(lh_quat_about(forward, 0.2f)), 0.2, 1e-6);
}
END_TEST

START_TEST(angles_at_their_ends) {
    const lh_quat upright = {1, 0, 0, 0};
    ck_assert_float_eq(lh_quat_tilt(upright), 0.0f);
    expect_near(lh_quat_tilt((lh_quat){0, 1, 0, 0}), M_PI, 1e-6);
    expect_near(lh_quat_roll((lh_quat){0, 1, 0, 0}), M_PI, 1e-6);
    expect_near(lh_quat_pitch(lh_quat_about((lh_vec3){0, 1, 0}, 0.5f * LH_PI)), M_PI_2, 1e-6);
    expect_near(lh_quat_pitch(lh_quat_about((lh_vec3){0, 1, 0}, -0.5f * LH_PI)), -M_PI_2, 1e-6);
    /* facing backwards is pi, whichever side rounding falls on */
    for (int32_t k = -20; k <= 20; k++) {
        const lh_quat q = {(float)k * 1e-8f, 0, 0, 1};
        ck_assert(lh_quat_heading(q) > -LH_PI && lh_quat_heading(q) <= LH_PI);
    }
}
END_TEST

START_TEST(normalised_to_unit_length) {
    const lh_quat q = lh_quat_normalise((lh_quat){2.0f, -4.0f, 4.0f, 0.0f});
    expect_near(q.w, 1.0 / 3.0, 1e-7);
    expect_near(q.x, -2.0 / 3.0, 1e-7);
    expect_near(q.y, 2.0 / 3.0, 1e-7);
    ck_assert_float_eq(q.z, 0.0f);
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("vector");
    TCase *t = tcase_create("vectors and rotations");
    tcase_add_test(t, vector_operations);
    tcase_add_test(t, rotation_against_matrices);
    tcase_add_test(t, product_applies_the_right_one_first);
    tcase_add_test(t, angles_against_matrices);
    tcase_add_test(t, sign_of_a_quaternion_does_not_matter);
    tcase_add_test(t, product_by_its_rules);
    tcase_add_test(t, signs_of_the_angles);
    tcase_add_test(t, angles_at_their_ends);
    tcase_add_test(t, normalised_to_unit_length);
    suite_add_tcase(s, t);
    return s;
}
