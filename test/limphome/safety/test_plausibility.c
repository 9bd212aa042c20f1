#include "limphome/safety/plausibility.h"

#include "crawler.h"
#include "test.h"

static const lh_jump_limits limits = {.position = 1.0f, .attitude = 0.5f, .joint = 0.25f};
static lh_plausibility plausibility;
static lh_robot robot;

static bool check(const lh_state *state) {
    return lh_plausibility_check(&plausibility, &robot, &limits, state);
}

static bool check_at(float x) {
    const lh_state state = crawler_state(x, 0.0f, 0.0f);
    return check(&state);
}

static void begin(void) {
    robot = crawler_robot();
    lh_plausibility_begin(&plausibility);
    ck_assert(check_at(0.0f)); /* nothing is known before */
}

/* Whether `state` can follow on the robot at the origin. */
static bool follows(const lh_state *state) {
    begin();
    return check(state);
}

START_TEST(positions) {
    lh_state state = crawler_state(0.6f, 0.0f, 0.0f);
    state.position[1] = -0.64f;
    state.position[2] = 0.479f; /* the length is 1.0 */
    ck_assert(follows(&state));
    state.position[2] = 0.481f;
    ck_assert(!follows(&state));
    const lh_state spike = crawler_state(300.0f, 0.0f, 0.0f);
    ck_assert(!follows(&spike));
}
END_TEST

START_TEST(attitudes) {
    for (int i = 0; i < 3; i++) {
        const lh_vec3 axis = {i == 0, i == 1, i == 2};
        lh_state state = crawler_state(0.0f, 0.0f, 0.0f);
        state.orientation = lh_quat_about(axis, 0.49f);
        ck_assert(follows(&state));
        state.orientation = lh_quat_about(axis, 0.51f);
        ck_assert(!follows(&state));
        state.orientation = lh_quat_about(axis, -0.49f);
        state.orientation = (lh_quat){-state.orientation.w, -state.orientation.x, -state.orientation.y,
                                      -state.orientation.z}; /* the same rotation */
        ck_assert(follows(&state));
    }
}
END_TEST

START_TEST(joints) {
    for (int32_t k = 0; k < 5; k++) {
        lh_state state = crawler_state(0.0f, 0.0f, 0.0f);
        state.actuator_position[k] += 0.24f;
        ck_assert(follows(&state));
        state.actuator_position[k] -= 0.5f;
        ck_assert(follows(&state) == (k < 2)); /* of crawlers no position is read */
        state.actuator_failed[k] = 1;          /* it may swing */
        state.actuator_position[k] += 2.0f;
        ck_assert(follows(&state));
        state.actuator_position[k] -= 1.0f;
        ck_assert(check(&state));
    }
}
END_TEST

START_TEST(a_spike_is_passed_over) {
    begin();
    ck_assert(!check_at(300.0f));
    ck_assert(check_at(0.1f)); /* from 0 on */
    ck_assert(!check_at(-2.0f));
    ck_assert(!check_at(-4.0f)); /* not with the one before, either */
    ck_assert(!check_at(-6.0f));
    ck_assert(check_at(1.0f));
}
END_TEST

START_TEST(three_that_agree_are_believed) {
    begin();
    ck_assert(!check_at(5.0f));
    ck_assert(!check_at(5.5f));
    ck_assert(check_at(6.0f));
    ck_assert(check_at(7.0f)); /* from there on */
    ck_assert(!check_at(9.0f));
    ck_assert(!check_at(9.1f));
    ck_assert(!check_at(20.0f)); /* begins to count again */
    ck_assert(!check_at(20.1f));
    ck_assert(check_at(20.2f));
}
END_TEST

START_TEST(anywhere_after_it_was_put_elsewhere) {
    begin();
    ck_assert(!check_at(5.0f));
    lh_plausibility_begin(&plausibility);
    ck_assert(check_at(-50.0f));
    ck_assert(!check_at(0.0f));
}
END_TEST

Suite *suite(void) {
    Suite *s = suite_create("plausibility");
    TCase *t = tcase_create("plausibility");
    tcase_add_test(t, positions);
    tcase_add_test(t, attitudes);
    tcase_add_test(t, joints);
    tcase_add_test(t, a_spike_is_passed_over);
    tcase_add_test(t, three_that_agree_are_believed);
    tcase_add_test(t, anywhere_after_it_was_put_elsewhere);
    suite_add_tcase(s, t);
    return s;
}
