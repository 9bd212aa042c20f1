#include "limphome/safety/stuck.h"

#include "test.h"

static lh_stuck stuck;

/* Decisions in which joint 3 was to go 0.15 rad that way and went `gone`. */
static void watch(int32_t decisions, float way, float gone) {
    for (int32_t i = 0; i < decisions; i++) {
        lh_stuck_watch(&stuck, 3, way, gone);
    }
}

START_TEST(a_joint_that_moves_in_neither_direction_is_stuck) {
    lh_stuck_begin(&stuck);
    watch(3, 0.15f, 0.0f);
    watch(2, -0.15f, 0.014f);
    ck_assert(!lh_stuck_is(&stuck, 3));
    watch(1, -0.15f, -0.014f);
    ck_assert(lh_stuck_is(&stuck, 3));
    ck_assert(!lh_stuck_is(&stuck, 2) && !lh_stuck_is(&stuck, 4));
}
END_TEST

/* It presses against something, and can go back. */
START_TEST(one_that_is_stopped_on_one_side_is_not) {
    lh_stuck_begin(&stuck);
    watch(200, 0.15f, 0.0f);
    ck_assert(!lh_stuck_is(&stuck, 3));
    watch(2, -0.15f, 0.0f);
    ck_assert(!lh_stuck_is(&stuck, 3));
    watch(1, -0.15f, -0.016f);
    watch(2, 0.15f, 0.0f);
    watch(3, -0.15f, 0.0f);
    ck_assert(!lh_stuck_is(&stuck, 3));
    watch(1, 0.15f, 0.0f);
    ck_assert(lh_stuck_is(&stuck, 3));
}
END_TEST

START_TEST(one_that_is_not_to_move_tells_nothing) {
    lh_stuck_begin(&stuck);
    watch(3, 0.15f, 0.0f);
    watch(3, -0.15f, 0.0f);
    watch(9, 0.0f, 1.0f);
    ck_assert(lh_stuck_is(&stuck, 3));
    lh_stuck_begin(&stuck);
    watch(9, 0.0f, 0.0f);
    ck_assert(!lh_stuck_is(&stuck, 3));
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("stuck");
    TCase *t = tcase_create("stuck");
    tcase_add_test(t, a_joint_that_moves_in_neither_direction_is_stuck);
    tcase_add_test(t, one_that_is_stopped_on_one_side_is_not);
    tcase_add_test(t, one_that_is_not_to_move_tells_nothing);
    suite_add_tcase(s, t);
    return s;
}
