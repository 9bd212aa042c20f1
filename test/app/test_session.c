/* Which states are answered anew, again or not at all. */
#include <stdlib.h>

#include "session.h"
#include "suite.h"

enum { LOCKSTEP = 1, REAL_TIME = 0 };
enum { OURS = 7, ANOTHERS = 8, NOBODYS = 0 };
enum { FIRST = 100, SECOND = 200, THIRD = 300, FOURTH = 400 };
static const double timeout = 2;
static const double period = 0.5;

/* A state of a session that began by our newest request. */
static session_verdict ours(session_tracker *t, int64_t session, int64_t seq, bool lockstep, double now) {
    const session_label label = {session, seq, OURS, t->nonce, lockstep};
    return session_judge(t, &label, now);
}

/* One of a session that began by an earlier request of ours. */
static session_verdict earlier(session_tracker *t, int64_t session, int64_t seq, int64_t nonce, double now) {
    const session_label label = {session, seq, OURS, nonce, LOCKSTEP};
    return session_judge(t, &label, now);
}

/* One of a session that we did not ask for. */
static session_verdict other(session_tracker *t, int64_t session, int64_t seq, int64_t sender, double now) {
    const session_label label = {session, seq, sender, sender == NOBODYS ? 0 : 99, LOCKSTEP};
    return session_judge(t, &label, now);
}

/* A tracker that has heard FIRST, asked for a reset and got SECOND, seq 0, at time 0. */
static session_tracker begun(void) {
    session_tracker t;
    session_init(&t, OURS, 1, timeout, period);
    ck_assert_int_eq(other(&t, FIRST, 17, NOBODYS, 0), SESSION_RESET);
    ck_assert_int_eq(other(&t, FIRST, 17, NOBODYS, 0), SESSION_RESET);
    ck_assert_int_eq(ours(&t, SECOND, 0, LOCKSTEP, 0), SESSION_NEW);
    return t;
}

START_TEST(first_plant_heard_is_reset) {
    begun();
}
END_TEST

START_TEST(each_state_is_new_once) {
    session_tracker t = begun();
    for (int seq = 1; seq < 10; seq++) {
        ck_assert_int_eq(ours(&t, SECOND, seq, LOCKSTEP, 0), SESSION_NEW);
        ck_assert_int_eq(ours(&t, SECOND, seq, LOCKSTEP, 0), SESSION_REPEATED);
        ck_assert_int_eq(ours(&t, SECOND, seq - 1, LOCKSTEP, 0), SESSION_OLD);
    }
}
END_TEST

START_TEST(lockstep_takes_only_the_next_state) {
    session_tracker t = begun();
    ck_assert_int_eq(ours(&t, SECOND, 2, LOCKSTEP, 0), SESSION_AHEAD);
    ck_assert_int_eq(ours(&t, SECOND, INT64_MAX, LOCKSTEP, 0), SESSION_AHEAD);
    ck_assert_int_eq(ours(&t, SECOND, INT64_MIN, LOCKSTEP, 0), SESSION_OLD);
    ck_assert_int_eq(ours(&t, SECOND, 1, LOCKSTEP, 0), SESSION_NEW);
}
END_TEST

/* A state ahead of its turn, or one behind, time and again and for as long as silence would be borne. */
START_TEST(a_plant_that_is_elsewhere_is_asked_anew) {
    session_tracker t = begun();
    const int64_t nonce = t.nonce;
    ck_assert_int_eq(ours(&t, SECOND, 1, LOCKSTEP, 1), SESSION_NEW);
    const int64_t seq = _i;
    for (int i = 0; i < 10; i++) {
        ck_assert_int_ne(ours(&t, SECOND, seq, LOCKSTEP, 1.1), SESSION_RESET);
    }
    ck_assert_int_eq(t.broken, SESSION_UNBROKEN);
    ck_assert_int_eq(ours(&t, SECOND, seq, LOCKSTEP, 3), SESSION_RESET);
    ck_assert_int_eq(t.broken, SESSION_MISPLACED);
    ck_assert(t.nonce != nonce);
    ck_assert_int_eq(ours(&t, THIRD, 0, LOCKSTEP, 3.1), SESSION_NEW);
}
END_TEST

START_TEST(late_copies_prove_nothing_while_the_plant_is_heard) {
    session_tracker t = begun();
    ck_assert_int_eq(ours(&t, SECOND, 1, LOCKSTEP, 0), SESSION_NEW);
    for (int i = 0; i < 100; i++) {
        ck_assert_int_eq(ours(&t, SECOND, 0, LOCKSTEP, 0.1 * i), SESSION_OLD);
        ck_assert_int_eq(ours(&t, SECOND, 1, LOCKSTEP, 0.1 * i), SESSION_REPEATED);
    }
}
END_TEST

START_TEST(real_time_may_lose_states) {
    session_tracker t = begun();
    ck_assert_int_eq(ours(&t, SECOND, 5, REAL_TIME, 2.5), SESSION_NEW);
    ck_assert_int_eq(ours(&t, SECOND, 4, REAL_TIME, 2.5), SESSION_OLD);
    session_reset(&t, 3);
    ck_assert_int_eq(ours(&t, THIRD, 3, REAL_TIME, 4.5), SESSION_NEW);
    ck_assert_int_eq(ours(&t, THIRD, 3, REAL_TIME, 4.5), SESSION_REPEATED);
}
END_TEST

/* The plant cannot be further ahead than the time that has passed, and a few. */
START_TEST(real_time_does_not_run_ahead_of_the_clock) {
    session_tracker t = begun();
    ck_assert_int_eq(ours(&t, SECOND, INT64_MAX, REAL_TIME, 0.5), SESSION_AHEAD);
    ck_assert_int_eq(ours(&t, SECOND, 6, REAL_TIME, 1), SESSION_AHEAD);
    ck_assert_int_eq(ours(&t, SECOND, 5, REAL_TIME, 1), SESSION_NEW);
    session_reset(&t, 1);
    ck_assert_int_eq(ours(&t, THIRD, INT64_MAX, REAL_TIME, 1.1), SESSION_AHEAD);
    ck_assert_int_eq(ours(&t, THIRD, 1, REAL_TIME, 1.2), SESSION_NEW);
    session_paused(&t, 100); /* the plant went on meanwhile */
    ck_assert_int_eq(ours(&t, THIRD, 200, REAL_TIME, 101.2), SESSION_NEW);
}
END_TEST

START_TEST(reset_is_asked_for_until_the_session_changes) {
    session_tracker t = begun();
    session_reset(&t, 0);
    const int64_t nonce = t.nonce;
    ck_assert_int_eq(ours(&t, SECOND, 0, LOCKSTEP, 0), SESSION_RESET);
    ck_assert_int_eq(ours(&t, SECOND, 0, LOCKSTEP, 1), SESSION_RESET);
    ck_assert_int_eq(t.nonce, nonce);
    ck_assert_int_eq(ours(&t, THIRD, 0, LOCKSTEP, 1), SESSION_NEW);
    ck_assert_int_eq(ours(&t, SECOND, 0, LOCKSTEP, 1), SESSION_OLD);
    ck_assert_int_eq(t.broken, SESSION_UNBROKEN);
}
END_TEST

/* A late copy of state 0 of a session that is over has an old nonce, and is not taken for the answer. */
START_TEST(a_late_copy_of_an_old_session_is_no_answer) {
    session_tracker t = begun();
    const int64_t old = t.nonce;
    session_reset(&t, 0);
    ck_assert_int_eq(ours(&t, THIRD, 0, LOCKSTEP, 0), SESSION_NEW);
    session_reset(&t, 0);
    ck_assert_int_eq(earlier(&t, SECOND, 0, old, 0.1), SESSION_OLD);
    ck_assert_int_eq(earlier(&t, FOURTH, 0, old, 0.1), SESSION_OTHER); /* one never taken up */
    ck_assert_int_eq(t.session, THIRD);                                /* which alone is asked for */
    ck_assert_int_eq(ours(&t, FIRST + 1, 0, LOCKSTEP, 0.2), SESSION_NEW);
}
END_TEST

START_TEST(a_session_that_is_over_is_not_asked_for) {
    session_tracker t = begun();
    const int64_t old = t.nonce;
    session_reset(&t, 0);
    ck_assert_int_eq(ours(&t, THIRD, 0, LOCKSTEP, 0), SESSION_NEW);
    for (int i = 0; i < 2; i++) { /* silence of ours, and late copies of another of ours and of nobody's */
        ck_assert_int_eq(earlier(&t, SECOND, 0, old, 5), SESSION_OLD);
    }
    ck_assert_int_eq(t.session, THIRD);
    ck_assert_int_eq(other(&t, FOURTH, 0, NOBODYS, 5), SESSION_RESET);
    ck_assert_int_eq(t.session, FOURTH);
}
END_TEST

START_TEST(the_session_of_another_is_asked_for_but_not_obeyed) {
    session_tracker t;
    session_init(&t, OURS, 1, timeout, period);
    for (int seq = 0; seq < 100; seq++) {
        ck_assert_int_eq(other(&t, FIRST, seq, ANOTHERS, 0.1 * seq), SESSION_DENIED);
    }
    ck_assert_int_eq(t.seq, 99);
    ck_assert_int_eq(ours(&t, SECOND, 0, LOCKSTEP, 10), SESSION_NEW);
}
END_TEST

START_TEST(another_session_is_dropped_while_ours_lives) {
    session_tracker t = begun();
    ck_assert_int_eq(other(&t, THIRD, 0, ANOTHERS, 1.9), SESSION_OTHER);
    ck_assert_int_eq(ours(&t, SECOND, 1, LOCKSTEP, 1.9), SESSION_NEW);
    ck_assert_int_eq(other(&t, THIRD, 0, NOBODYS, 3.8), SESSION_OTHER);
    ck_assert_int_eq(other(&t, SECOND, 2, ANOTHERS, 3.8), SESSION_OTHER); /* in the name of ours */
    ck_assert_int_eq(t.seq, 1);
}
END_TEST

START_TEST(a_restarted_plant_is_taken_up_from_a_reset) {
    session_tracker t = begun();
    ck_assert_int_eq(other(&t, THIRD, 0, NOBODYS, 2.1), SESSION_RESET);
    ck_assert_int_eq(t.broken, SESSION_ENDED);
    ck_assert_int_eq(other(&t, THIRD, 0, NOBODYS, 2.2), SESSION_RESET);
    ck_assert_int_eq(ours(&t, FOURTH, 0, LOCKSTEP, 2.3), SESSION_NEW);
}
END_TEST

/* What we have not heard while we were stopped is no silence. */
START_TEST(a_pause_of_ours_is_no_silence) {
    session_tracker t = begun();
    session_paused(&t, 100);
    ck_assert_int_eq(other(&t, THIRD, 0, NOBODYS, 101), SESSION_OTHER);
    ck_assert_int_eq(ours(&t, SECOND, 1, LOCKSTEP, 101), SESSION_NEW);
}
END_TEST

START_TEST(a_session_that_is_over_is_not_waited_for) {
    session_tracker t = begun();
    session_over(&t, FIRST, SESSION_FAULTED); /* of long ago */
    ck_assert_int_eq(other(&t, THIRD, 0, NOBODYS, 0.1), SESSION_OTHER);
    session_over(&t, SECOND, SESSION_FAULTED);
    ck_assert_int_eq(other(&t, THIRD, 0, NOBODYS, 0.2), SESSION_RESET);
    ck_assert_int_eq(t.broken, SESSION_FAULTED);
    ck_assert_int_eq(ours(&t, FOURTH, 0, LOCKSTEP, 0.3), SESSION_NEW);
    ck_assert_int_eq(other(&t, THIRD, 0, NOBODYS, 0.4), SESSION_OLD);
}
END_TEST

/* Then what was done in it is done again, which it is not after a fault. */
START_TEST(a_plant_that_tells_that_it_begins_anew_has_no_fault) {
    session_tracker t = begun();
    session_over(&t, SECOND, SESSION_ENDED);
    ck_assert_int_eq(other(&t, THIRD, 0, NOBODYS, 0.2), SESSION_RESET);
    ck_assert_int_eq(t.broken, SESSION_ENDED);
    ck_assert_int_eq(ours(&t, FOURTH, 0, LOCKSTEP, 0.3), SESSION_NEW);
}
END_TEST

START_TEST(a_session_that_is_wrongly_told_to_be_over_goes_on) {
    session_tracker t = begun();
    session_over(&t, SECOND, SESSION_FAULTED);
    ck_assert_int_eq(ours(&t, SECOND, 1, LOCKSTEP, 0.2), SESSION_NEW);
    ck_assert_int_eq(other(&t, THIRD, 0, NOBODYS, 0.3), SESSION_OTHER);
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
        const session_verdict verdict = ours(&t, SECOND, heard, LOCKSTEP, 0);
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

/* Requests differ in their nonces, and 0 is none. */
START_TEST(nonces_differ) {
    session_tracker t = begun();
    int64_t nonces[100];
    for (int i = 0; i < 100; i++) {
        session_reset(&t, 0);
        nonces[i] = t.nonce;
        ck_assert(nonces[i] != 0);
        for (int j = 0; j < i; j++) {
            ck_assert(nonces[i] != nonces[j]);
        }
    }
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("session");
    tcase_add_test(cases, first_plant_heard_is_reset);
    tcase_add_test(cases, each_state_is_new_once);
    tcase_add_test(cases, lockstep_takes_only_the_next_state);
    tcase_add_loop_test(cases, a_plant_that_is_elsewhere_is_asked_anew, 0, 1);
    tcase_add_loop_test(cases, a_plant_that_is_elsewhere_is_asked_anew, 3, 5);
    tcase_add_test(cases, late_copies_prove_nothing_while_the_plant_is_heard);
    tcase_add_test(cases, real_time_may_lose_states);
    tcase_add_test(cases, real_time_does_not_run_ahead_of_the_clock);
    tcase_add_test(cases, reset_is_asked_for_until_the_session_changes);
    tcase_add_test(cases, a_late_copy_of_an_old_session_is_no_answer);
    tcase_add_test(cases, a_session_that_is_over_is_not_asked_for);
    tcase_add_test(cases, the_session_of_another_is_asked_for_but_not_obeyed);
    tcase_add_test(cases, another_session_is_dropped_while_ours_lives);
    tcase_add_test(cases, a_restarted_plant_is_taken_up_from_a_reset);
    tcase_add_test(cases, a_pause_of_ours_is_no_silence);
    tcase_add_test(cases, a_session_that_is_over_is_not_waited_for);
    tcase_add_test(cases, a_plant_that_tells_that_it_begins_anew_has_no_fault);
    tcase_add_test(cases, a_session_that_is_wrongly_told_to_be_over_goes_on);
    tcase_add_loop_test(cases, a_bad_link_costs_time_only, 0, 10);
    tcase_add_test(cases, nonces_differ);
    return run_suite("session", cases);
}
