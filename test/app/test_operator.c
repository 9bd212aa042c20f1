/* Who has the robot by hand, and what takes it from him. */
#include "operator.h"

#include "limphome_decision_t.h"
#include "suite.h"

#define LEARNER LIMPHOME_DECISION_T_LEARNER
#define OPERATOR LIMPHOME_DECISION_T_OPERATOR
#define NOBODY LIMPHOME_DECISION_T_NOBODY

enum { ME = 5, ANOTHER = 6, SESSION = 77 };

static const double timeout = 3, period = 0.5; /* [s] */

static operator_lease lease;
static operator_place place;
static int64_t utime;

static void begin(void) {
    operator_init(&lease, timeout, period);
    place = (operator_place){.session = SESSION, .seq = 100, .num_actuators = 5};
    utime = 0;
}

/* One that is sent now and is as it should be. */
static limphome_operate_t message(int64_t sender, int8_t action) {
    utime++;
    return (limphome_operate_t){.utime = utime,
                                .sender = sender,
                                .session = place.session,
                                .seq = place.seq,
                                .action = action,
                                .num_actuators = 5,
                                .direction = {0, 1, -1}};
}

static operator_verdict hear(const limphome_operate_t *m, double now) {
    return operator_hear(&lease, m, &place, now);
}

static operator_verdict say(int64_t sender, int8_t action, double now) {
    const limphome_operate_t m = message(sender, action);
    return hear(&m, now);
}

static int8_t in_charge(double now) {
    return operator_in_charge(&lease, place.lockstep, now);
}

START_TEST(taken_driven_and_given_back) {
    begin();
    ck_assert_int_eq(in_charge(1), LEARNER);
    ck_assert_int_eq(operator_sender(&lease), 0);
    ck_assert_int_eq(operator_directions(&lease)[1], 0);
    ck_assert_int_eq(say(ME, LIMPHOME_OPERATE_T_TAKE, 1), OPERATOR_OBEYED);
    ck_assert_int_eq(in_charge(1), OPERATOR);
    ck_assert_int_eq(operator_sender(&lease), ME);
    ck_assert_int_eq(operator_directions(&lease)[1], 1);
    ck_assert_int_eq(operator_directions(&lease)[2], -1);
    ck_assert_int_eq(say(ME, LIMPHOME_OPERATE_T_GIVE, 2), OPERATOR_OBEYED);
    ck_assert_int_eq(in_charge(2), LEARNER);
    ck_assert_int_eq(operator_sender(&lease), 0);
    ck_assert_int_eq(operator_directions(&lease)[1], 0);
    ck_assert_int_eq(say(ANOTHER, LIMPHOME_OPERATE_T_TAKE, 3), OPERATOR_OBEYED);
    ck_assert_int_eq(operator_sender(&lease), ANOTHER);
}
END_TEST

/* A robot in real time stands still until somebody says what is to happen. */
START_TEST(silence_leaves_a_real_robot_to_nobody) {
    begin();
    say(ME, LIMPHOME_OPERATE_T_TAKE, 1);
    ck_assert_int_eq(in_charge(1 + timeout), OPERATOR);
    ck_assert_int_eq(in_charge(1.01 + timeout), NOBODY);
    ck_assert_int_eq(in_charge(1000), NOBODY);
    ck_assert_int_eq(operator_sender(&lease), 0);
    ck_assert_int_eq(operator_directions(&lease)[1], 0);
    ck_assert_int_eq(say(ANOTHER, LIMPHOME_OPERATE_T_TAKE, 1001), OPERATOR_OBEYED);
    ck_assert_int_eq(in_charge(1001), OPERATOR);
    ck_assert_int_eq(in_charge(2000), NOBODY);
    ck_assert_int_eq(say(7, LIMPHOME_OPERATE_T_GIVE, 2001), OPERATOR_OBEYED);
    ck_assert_int_eq(in_charge(2001), LEARNER);
    ck_assert_int_eq(in_charge(3000), LEARNER);
}
END_TEST

START_TEST(silence_in_lockstep_lets_the_learner_go_on) {
    begin();
    place.lockstep = true;
    say(ME, LIMPHOME_OPERATE_T_TAKE, 1);
    ck_assert_int_eq(in_charge(1.01 + timeout), LEARNER);
    ck_assert_int_eq(operator_directions(&lease)[1], 0);
}
END_TEST

START_TEST(who_has_it_keeps_it_while_he_keeps_it_up) {
    begin();
    say(ME, LIMPHOME_OPERATE_T_TAKE, 1);
    ck_assert_int_eq(say(ANOTHER, LIMPHOME_OPERATE_T_TAKE, 2), OPERATOR_DENIED);
    ck_assert_int_eq(say(ANOTHER, LIMPHOME_OPERATE_T_GIVE, 2), OPERATOR_DENIED);
    ck_assert_int_eq(operator_sender(&lease), ME);
    ck_assert_int_eq(say(ME, LIMPHOME_OPERATE_T_TAKE, 3), OPERATOR_OBEYED);
    ck_assert_int_eq(say(ANOTHER, LIMPHOME_OPERATE_T_TAKE, 3 + timeout), OPERATOR_DENIED);
    ck_assert_int_eq(say(ANOTHER, LIMPHOME_OPERATE_T_TAKE, 3.01 + timeout), OPERATOR_OBEYED);
    ck_assert_int_eq(operator_sender(&lease), ANOTHER);
}
END_TEST

/* An echo is of our session, and of a state of the last three seconds. */
START_TEST(what_echoes_no_fresh_state_is_refused) {
    const struct {
        int64_t session, seq;
        operator_verdict verdict;
    } cases[] = {
        {SESSION, 100, OPERATOR_OBEYED},      {SESSION, 94, OPERATOR_OBEYED},       {SESSION, 93, OPERATOR_STALE},
        {SESSION, 101, OPERATOR_STALE},       {SESSION + 1, 100, OPERATOR_STALE},   {SESSION, -1, OPERATOR_STALE},
        {SESSION, INT64_MAX, OPERATOR_STALE}, {SESSION, INT64_MIN, OPERATOR_STALE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        begin();
        limphome_operate_t m = message(ME, LIMPHOME_OPERATE_T_TAKE);
        m.session = cases[i].session;
        m.seq = cases[i].seq;
        ck_assert_int_eq(hear(&m, 1), cases[i].verdict);
        ck_assert_int_eq(in_charge(1), cases[i].verdict == OPERATOR_OBEYED ? OPERATOR : LEARNER);
    }
    begin();
    place.num_actuators = 0; /* while there is no session of ours */
    ck_assert_int_eq(say(ME, LIMPHOME_OPERATE_T_TAKE, 1), OPERATOR_STALE);
    begin();
    place.num_actuators = 4;
    ck_assert_int_eq(say(ME, LIMPHOME_OPERATE_T_TAKE, 1), OPERATOR_MALFORMED);
    ck_assert_int_eq(in_charge(1), LEARNER);
}
END_TEST

/* Said again, neither keeps the robot up nor takes or gives it: not at once, and not when it is old. */
START_TEST(what_was_said_before_is_refused) {
    begin();
    const limphome_operate_t take = message(ME, LIMPHOME_OPERATE_T_TAKE);
    const limphome_operate_t give = message(ME, LIMPHOME_OPERATE_T_GIVE);
    ck_assert_int_eq(hear(&take, 1), OPERATOR_OBEYED);
    ck_assert_int_eq(hear(&take, 2), OPERATOR_REPEATED);
    ck_assert_int_eq(in_charge(1.01 + timeout), NOBODY);
    begin();
    hear(&take, 1);
    ck_assert_int_eq(hear(&give, 1), OPERATOR_OBEYED);
    ck_assert_int_eq(hear(&take, 1), OPERATOR_REPEATED);
    ck_assert_int_eq(in_charge(1), LEARNER);
    utime = 10;
    say(ME, LIMPHOME_OPERATE_T_TAKE, 1);
    ck_assert_int_eq(hear(&give, 1), OPERATOR_REPEATED);
    place.seq += 7;
    ck_assert_int_eq(hear(&give, 1), OPERATOR_STALE);
    ck_assert_int_eq(in_charge(1), OPERATOR);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("operator");
    tcase_add_test(cases, taken_driven_and_given_back);
    tcase_add_test(cases, silence_leaves_a_real_robot_to_nobody);
    tcase_add_test(cases, silence_in_lockstep_lets_the_learner_go_on);
    tcase_add_test(cases, who_has_it_keeps_it_while_he_keeps_it_up);
    tcase_add_test(cases, what_echoes_no_fresh_state_is_refused);
    tcase_add_test(cases, what_was_said_before_is_refused);
    return run_suite("operator", cases);
}
