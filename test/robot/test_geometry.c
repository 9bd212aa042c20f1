/* Rotations, frames and eigenvalues against what is known of them. */
#include <math.h>

#include "geometry.h"
#include "suite.h"

#define PI 3.14159265358979323846

static void expect_vector(vector v, double x, double y, double z) {
    ck_assert_double_eq_tol(v.x, x, 1e-15);
    ck_assert_double_eq_tol(v.y, y, 1e-15);
    ck_assert_double_eq_tol(v.z, z, 1e-15);
}

/* Roll, pitch, yaw about fixed axes, in this order. */
START_TEST(rpy_is_that_of_urdf) {
    const frame yawed = frame_from_rpy((vector){1, 2, 3}, (vector){0, 0, PI / 2});
    expect_vector(frame_apply(&yawed, (vector){1, 0, 0}), 1, 3, 3);
    const frame all = frame_from_rpy((vector){0, 0, 0}, (vector){PI / 2, PI / 2, PI / 2});
    expect_vector(frame_apply(&all, (vector){1, 0, 0}), 0, 0, -1); /* pitched down, and left there by the yaw */
    expect_vector(frame_apply(&all, (vector){0, 1, 0}), 0, 1, 0);  /* up, then forward, then left */
}
END_TEST

START_TEST(a_frame_and_its_inverse_cancel) {
    const frame f = frame_from_rpy((vector){0.3, -2, 5}, (vector){0.4, -1.1, 2.7});
    const frame inverse = frame_inverse(&f);
    expect_vector(frame_apply(&inverse, frame_apply(&f, (vector){0.1, 0.2, 0.3})), 0.1, 0.2, 0.3);
}
END_TEST

/* Each of the four cases, by which component of the quaternion is largest. */
START_TEST(a_pose_is_its_frame) {
    static const vector turns[] = {{0.1, 0.2, 0.3}, {3, 0.1, 0.1}, {0.1, 0.2, 3.1}, {PI, 0.1, PI}, {-1.5, 1.2, -2.9}};
    const vector rpy = turns[_i];
    const frame f = frame_from_rpy((vector){1, 2, 3}, rpy);
    const robot_pose pose = frame_pose(&f);
    double norm = 0;
    for (int i = 0; i < 4; i++) {
        norm += pose.rotation[i] * pose.rotation[i];
    }
    ck_assert_double_eq_tol(norm, 1, 1e-15);
    const frame again = frame_of(&pose);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            ck_assert_double_eq_tol(again.axes.at[i][k], f.axes.at[i][k], 2e-15);
        }
    }
}
END_TEST

START_TEST(what_is_not_turned_is_exact) {
    const frame f = frame_from_rpy((vector){0.1, 0.2, 0.3}, (vector){0, 0, 0});
    const robot_pose pose = frame_pose(&f);
    ck_assert_double_eq(pose.rotation[0], 1);
    ck_assert_double_eq(pose.rotation[3], 0);
    const vector p = frame_apply(&f, (vector){0.7, 0, 0});
    ck_assert_double_eq(p.x, 0.7 + 0.1);
}
END_TEST

/* Turning a matrix leaves its eigenvalues. */
START_TEST(eigenvalues_are_those_of_the_diagonal) {
    const matrix diagonal = {{{5, 0, 0}, {0, 0.25, 0}, {0, 0, 2}}};
    const frame turn = frame_from_rpy((vector){0, 0, 0}, (vector){0.4, -1.1, 2.7});
    const matrix back = matrix_transpose(&turn.axes);
    const matrix half = matrix_multiply(&turn.axes, &diagonal);
    const matrix turned = matrix_multiply(&half, &back);
    double values[3];
    matrix_eigenvalues(&turned, values);
    ck_assert_double_eq_tol(values[0], 0.25, 1e-14);
    ck_assert_double_eq_tol(values[1], 2, 1e-14);
    ck_assert_double_eq_tol(values[2], 5, 1e-14);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("geometry");
    tcase_add_test(cases, rpy_is_that_of_urdf);
    tcase_add_test(cases, a_frame_and_its_inverse_cancel);
    tcase_add_loop_test(cases, a_pose_is_its_frame, 0, 5);
    tcase_add_test(cases, what_is_not_turned_is_exact);
    tcase_add_test(cases, eigenvalues_are_those_of_the_diagonal);
    return run_suite("geometry", cases);
}
