/* Which states are answered anew, again or not at all. */
#include <stdlib.h>

#include "session.h"
#include "suite.h"

enum { LOCKSTEP = 1, REAL_TIME = 0 };
enum { FIRST = 100, SECOND = 200, THIRD = 300 };
static const double timeout = 2;

/* A tracker that has heard FIRST, asked for a reset and got SECOND, seq 0, at time 0. */
static session_tracker begun(void) {
    session_tracker t;
    session_init(&t, timeout);
    ck_assert_int_eq(session_judge(&t, FIRST, 17, LOCKSTEP, 0), SESSION_RESET);
    ck_assert_int_eq(session_judge(&t, FIRST, 17, LOCKSTEP, 0), SESSION_RESET);
    ck_assert_int_eq(session_judge(&t, SECOND, 0, LOCKSTEP, 0), SESSION_NEW);
    return t;
}

START_TEST(first_plant_heard_is_reset) {
    begun();
}
END_TEST

START_TEST(each_state_is_new_once) {
    session_tracker t = begun();
    for (int seq = 1; seq < 10; seq++) {
        ck_assert_int_eq(session_judge(&t, SECOND, seq, LOCKSTEP, 0), SESSION_NEW);
        ck_assert_int_eq(session_judge(&t, SECOND, seq, LOCKSTEP, 0), SESSION_REPEATED);
        ck_assert_int_eq(session_judge(&t, SECOND, seq - 1, LOCKSTEP, 0), SESSION_OLD);
    }
}
END_TEST

START_TEST(lockstep_takes_only_the_next_state) {
    session_tracker t = begun();
    ck_assert_int_eq(session_judge(&t, SECOND, 2, LOCKSTEP, 0), SESSION_OLD);
    ck_assert_int_eq(session_judge(&t, SECOND, 1, LOCKSTEP, 0), SESSION_NEW);
}
END_TEST

START_TEST(real_time_may_lose_states) {
    session_tracker t = begun();
    ck_assert_int_eq(session_judge(&t, SECOND, 5, REAL_TIME, 0), SESSION_NEW);
    ck_assert_int_eq(session_judge(&t, SECOND, 4, REAL_TIME, 0), SESSION_OLD);
    session_reset(&t);
    ck_assert_int_eq(session_judge(&t, THIRD, 3, REAL_TIME, 0), SESSION_NEW);
    ck_assert_int_eq(session_judge(&t, THIRD, 3, REAL_TIME, 0), SESSION_REPEATED);
}
END_TEST

START_TEST(reset_is_asked_for_until_the_session_changes) {
    session_tracker t = begun();
    session_reset(&t);
    ck_assert_int_eq(session_judge(&t, SECOND, 0, LOCKSTEP, 0), SESSION_RESET);
    ck_assert_int_eq(session_judge(&t, SECOND, 0, LOCKSTEP, 1), SESSION_RESET);
    ck_assert_int_eq(session_judge(&t, THIRD, 0, LOCKSTEP, 1), SESSION_NEW);
    ck_assert_int_eq(session_judge(&t, SECOND, 0, LOCKSTEP, 1), SESSION_OTHER);
    ck_assert(!t.restarted);
}
END_TEST

START_TEST(another_session_is_dropped_while_ours_lives) {
    session_tracker t = begun();
    ck_assert_int_eq(session_judge(&t, THIRD, 0, LOCKSTEP, 1.9), SESSION_OTHER);
    ck_assert_int_eq(session_judge(&t, SECOND, 1, LOCKSTEP, 1.9), SESSION_NEW);
    ck_assert_int_eq(session_judge(&t, THIRD, 0, LOCKSTEP, 3.8), SESSION_OTHER);
}
END_TEST

START_TEST(a_restarted_plant_is_taken_up_from_a_reset) {
    session_tracker t = begun();
    ck_assert_int_eq(session_judge(&t, THIRD, 0, LOCKSTEP, 2.1), SESSION_RESET);
    ck_assert(t.restarted);
    ck_assert_int_eq(session_judge(&t, THIRD, 0, LOCKSTEP, 2.2), SESSION_RESET);
    ck_assert_int_eq(session_judge(&t, FIRST, 0, LOCKSTEP, 2.3), SESSION_NEW);
}
END_TEST

START_TEST(a_session_that_is_over_is_not_waited_for) {
    session_tracker t = begun();
    session_over(&t, FIRST); /* of long ago */
    ck_assert_int_eq(session_judge(&t, THIRD, 0, LOCKSTEP, 0.1), SESSION_OTHER);
    session_over(&t, SECOND);
    ck_assert_int_eq(session_judge(&t, SECOND, 0, LOCKSTEP, 0.2), SESSION_REPEATED); /* a late one */
    ck_assert_int_eq(session_judge(&t, THIRD, 0, LOCKSTEP, 0.2), SESSION_RESET);
    ck_assert(t.restarted);
    ck_assert_int_eq(session_judge(&t, FIRST, 0, LOCKSTEP, 0.3), SESSION_NEW);
    ck_assert_int_eq(session_judge(&t, THIRD, 0, LOCKSTEP, 0.4), SESSION_OTHER);
}
END_TEST

/* A plant in lockstep behind a link that loses, doubles and reorders: every state is decided upon exactly once, in
 * order. */
START_TEST(a_bad_link_costs_time_only) {
    session_tracker t = begun();
    int64_t decided = 0; /* seq of the newest decision */
    int64_t held = -1;   /* a repetition that overtakes */
    srand(_i + 1);
    for (int64_t seq = 1; seq <= 2000;) {
        const int fate = rand() % 4;
        const int64_t heard = fate == 1 && held >= 0 ? held : seq;
        held = seq;
        if (fate == 0) { /* lost on its way to us: the plant repeats it */
            continue;
        }
        const session_verdict verdict = session_judge(&t, SECOND, heard, LOCKSTEP, 0);
        if (verdict == SESSION_NEW) {
            ck_assert_int_eq(heard, decided + 1);
            decided = heard;
        }
        const int arrived = rand() % 3 != 0; /* or our answer was lost */
        if (arrived && heard == seq && (verdict == SESSION_NEW || verdict == SESSION_REPEATED)) {
            ck_assert_int_eq(decided, seq);
            seq++;
        }
    }
    ck_assert_int_eq(decided, 2000);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("session");
    tcase_add_test(cases, first_plant_heard_is_reset);
    tcase_add_test(cases, each_state_is_new_once);
    tcase_add_test(cases, lockstep_takes_only_the_next_state);
    tcase_add_test(cases, real_time_may_lose_states);
    tcase_add_test(cases, reset_is_asked_for_until_the_session_changes);
    tcase_add_test(cases, another_session_is_dropped_while_ours_lives);
    tcase_add_test(cases, a_restarted_plant_is_taken_up_from_a_reset);
    tcase_add_test(cases, a_session_that_is_over_is_not_waited_for);
    tcase_add_loop_test(cases, a_bad_link_costs_time_only, 0, 10);
    return run_suite("session", cases);
}
