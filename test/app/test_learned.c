/* What was learned, through messages and back: nothing is lost, and it fits only what it was learned for. */
#include <string.h>

#include "convert.h"
#include "learned.h"
#include "robot_of.h"
#include "suite.h"

/* large for a stack frame */
static lh_controller controller;
static learned message;
static lh_learned held, restored;

static const char *const kinds[] = {"learner.kind=q_learning", "learner.kind=planner"};
enum { KINDS = 2, DECISIONS = 40 };
#define PERIOD 0.5F

static void make_controller(int kind, const char *assignment) {
    const lh_robot robot = robot_of(CONFIG_DIR "/crawler.urdf");
    char error[ERROR_LENGTH] = "";
    settings s = settings_default();
    s.planner.sweeps = 0; /* slow, and the steps below change values too */
    ck_assert_msg(settings_set(&s, kinds[kind], error), "%s", error);
    ck_assert_msg(assignment == NULL || settings_set(&s, assignment, error), "%s", error);
    const lh_config config = convert_config(&s);
    const lh_controlled controlled = {.count = 4, .index = {1, 2, 3, 4}};
    ck_assert_int_eq(lh_controller_init(&controller, &config, &robot, &controlled), LH_OK);
}

/* A robot that moves as it is told, and turns a little with it. */
static void learn_something(void) {
    lh_state state = {.num_actuators = 5, .orientation = {1, 0, 0, 0}};
    for (int k = 0; k < DECISIONS; k++) {
        lh_decision decision;
        ck_assert_int_eq(lh_controller_step(&controller, &state, &decision), LH_OK);
        for (int i = 2; i < 5; i++) {
            state.actuator_position[i] += PERIOD * decision.velocity[i];
        }
        state.position[0] += PERIOD * decision.velocity[1];
        const lh_quat turn = lh_quat_about((lh_vec3){0, 0, 1}, 0.1F * decision.velocity[1]);
        state.orientation = lh_quat_multiply(state.orientation, turn);
    }
}

/* Of a controller of `kind` that has learned something, into `message`; what it holds into `held`. */
static void save_learned(int kind) {
    make_controller(kind, NULL);
    learn_something();
    memset(&held, 0, sizeof held);
    lh_learner_save(&controller.learner, &held);
    learned_save(&message, &controller, 7, 11, 99);
}

/* Whether `message` fits the controller; what it gives into `restored`. */
static bool restore(void) {
    memset(&restored, 0, sizeof restored);
    return learned_restore(&message, &controller, &restored);
}

START_TEST(a_checkpoint_gives_back_all_that_was_learned) {
    save_learned(_i);
    static unsigned char bytes[LEARNED_LARGEST];
    const int size = learned_encode_checkpoint(&message, bytes, sizeof bytes);
    ck_assert_int_gt(size, 0);
    memset(&message, 0xa5, sizeof message);
    ck_assert_int_eq(learned_decode_checkpoint(bytes, (size_t)size, &message), MESSAGE_GOOD);
    ck_assert_int_eq(message.kind, held.kind);
    ck_assert_int_eq(learned_episode(&message), 7);
    ck_assert_int_eq(learned_settings_hash(&message), 99);
    make_controller(_i, "learning.seed=2");
    ck_assert(restore());
    ck_assert_mem_eq(&restored, &held, sizeof held);
    ck_assert_int_eq(lh_controller_restore(&controller, &restored, 8), LH_OK);
}
END_TEST

/* Of a planner's, which is long, bits all over it. */
START_TEST(a_bit_that_has_turned_is_refused) {
    save_learned(_i);
    static unsigned char bytes[LEARNED_LARGEST];
    static learned decoded;
    for (int policy = 0; policy < 2; policy++) {
        const int size = policy ? learned_encode_policy(&message, bytes, sizeof bytes)
                                : learned_encode_checkpoint(&message, bytes, sizeof bytes);
        const int step = _i == LH_PLANNER ? 509 : 1;
        for (int bit = 0; bit < 8 * size; bit += step) {
            bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
            const message_verdict verdict = policy ? learned_decode_policy(bytes, (size_t)size, &decoded)
                                                   : learned_decode_checkpoint(bytes, (size_t)size, &decoded);
            ck_assert_msg(verdict != MESSAGE_GOOD, "bit %d of %d", bit, 8 * size);
            bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        }
        ck_assert_int_eq(policy ? learned_decode_policy(bytes, (size_t)size, &decoded)
                                : learned_decode_checkpoint(bytes, (size_t)size, &decoded),
                         MESSAGE_GOOD);
    }
}
END_TEST

/* A policy can be taken out of its checkpoint. */
START_TEST(the_policy_in_a_checkpoint_is_sealed_too) {
    save_learned(_i);
    static unsigned char bytes[LEARNED_LARGEST];
    static learned decoded;
    const int size = _i == LH_PLANNER ? limphome_planner_t_encode(bytes, 0, sizeof bytes, &message.as.planner.planner)
                                      : limphome_policy_t_encode(bytes, 0, sizeof bytes, &message.as.q_learning.policy);
    ck_assert_int_eq(learned_decode_policy(bytes, (size_t)size, &decoded), MESSAGE_GOOD);
}
END_TEST

/* The least that the steps above must have taught, or the test above would not mean much. */
START_TEST(a_planner_has_measured_something) {
    save_learned(LH_PLANNER);
    ck_assert_int_gt(message.as.planner.planner.num_samples, 10);
    ck_assert_int_eq(message.as.planner.planner.decisions, DECISIONS);
    ck_assert_int_eq(message.as.planner.planner.utime, 11);
    ck_assert_int_eq(message.as.planner.planner.num_joints, 3);
    ck_assert_float_eq(message.as.planner.planner.joint_high[2], 1.2F);
}
END_TEST

START_TEST(limits_that_acted_are_counted_on) {
    make_controller(LH_Q_LEARNING, NULL);
    controller.learner.as.q_learning.held = (lh_held){1, 2, 3};
    controller.learner.as.q_learning.floored = 4;
    learned_save(&message, &controller, 7, 0, 99);
    make_controller(LH_Q_LEARNING, NULL);
    ck_assert(restore());
    ck_assert_int_eq(restored.as.q_learning.held.weights, 1);
    ck_assert_int_eq(restored.as.q_learning.held.widths, 2);
    ck_assert_int_eq(restored.as.q_learning.held.centres, 3);
    ck_assert_int_eq(restored.as.q_learning.floored, 4);
}
END_TEST

/* Of Q-learning, what goes on by chance is as the controller has it. */
START_TEST(a_policy_is_what_it_takes_to_use_it) {
    save_learned(_i);
    static unsigned char bytes[LEARNED_LARGEST];
    const int size = learned_encode_policy(&message, bytes, sizeof bytes);
    ck_assert_int_gt(size, 0);
    memset(&message, 0xa5, sizeof message);
    ck_assert_int_eq(learned_decode_policy(bytes, (size_t)size, &message), MESSAGE_GOOD);
    ck_assert_int_eq(message.kind, held.kind);
    ck_assert_int_eq(learned_episode(&message), 7);
    make_controller(_i, "learning.seed=2");
    ck_assert(restore());
    if (held.kind == LH_Q_LEARNING) {
        ck_assert_mem_ne(&restored, &held, sizeof held);
        held.as.q_learning.random = controller.learner.as.q_learning.random;
        held.as.q_learning.held = controller.learner.as.q_learning.held;
        held.as.q_learning.floored = controller.learner.as.q_learning.floored;
    }
    ck_assert_mem_eq(&restored, &held, sizeof held);
    ck_assert_int_eq(learned_decode_checkpoint(bytes, (size_t)size, &message), MESSAGE_MALFORMED);
}
END_TEST

START_TEST(a_policy_of_another_learner_is_refused) {
    save_learned(_i);
    make_controller(1 - _i, NULL);
    ck_assert(!restore());
}
END_TEST

/* What it is for is told by the settings, and which learner of the two it matters to. */
static const struct {
    const char *assignment;
    bool matters[KINDS];
} purposes[] = {
    {"action.crawler_speed=0.2", {true, true}},
    {"action.joint_speed=0.2", {true, true}},
    {"episode.decision_period_s=0.505", {false, true}}, /* by which the lattice stays as it is */
    {"planner.mechanics=none", {false, true}},
    {"planner.steering=1", {false, false}},
    {"reward.forward=1", {false, false}},
};

START_TEST(what_was_learned_for_another_purpose_is_refused) {
    for (int kind = 0; kind < KINDS; kind++) {
        save_learned(kind);
        make_controller(kind, purposes[_i].assignment);
        ck_assert_int_eq(restore(), !purposes[_i].matters[kind]);
    }
}
END_TEST

START_TEST(what_another_robot_has_learned_is_refused) {
    save_learned(LH_Q_LEARNING);
    message.as.q_learning.policy.controlled[0] = 0;
    ck_assert(!restore());
    learned_save(&message, &controller, 7, 0, 99);
    message.as.q_learning.policy.input_high[3] = 1;
    ck_assert(!restore());

    save_learned(LH_PLANNER);
    message.as.planner.planner.controlled[0] = 0;
    ck_assert(!restore());
    learned_save(&message, &controller, 7, 0, 99);
    message.as.planner.planner.joint_low[1] = -1;
    ck_assert(!restore());
    learned_save(&message, &controller, 7, 0, 99);
    message.as.planner.planner.joint_high[3] = 1;
    ck_assert(!restore());
    learned_save(&message, &controller, 7, 0, 99);
    message.as.planner.planner.num_actuators = 6;
    ck_assert(!restore());
}
END_TEST

START_TEST(what_does_not_fit_is_not_encoded) {
    save_learned(_i);
    unsigned char bytes[64];
    ck_assert_int_lt(learned_encode_policy(&message, bytes, sizeof bytes), 0);
    ck_assert_int_lt(learned_encode_checkpoint(&message, bytes, sizeof bytes), 0);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("learned");
    tcase_add_loop_test(cases, a_checkpoint_gives_back_all_that_was_learned, 0, KINDS);
    tcase_add_loop_test(cases, a_bit_that_has_turned_is_refused, 0, KINDS);
    tcase_add_loop_test(cases, the_policy_in_a_checkpoint_is_sealed_too, 0, KINDS);
    tcase_add_test(cases, a_planner_has_measured_something);
    tcase_add_test(cases, limits_that_acted_are_counted_on);
    tcase_add_loop_test(cases, a_policy_is_what_it_takes_to_use_it, 0, KINDS);
    tcase_add_loop_test(cases, a_policy_of_another_learner_is_refused, 0, KINDS);
    tcase_add_loop_test(cases, what_was_learned_for_another_purpose_is_refused, 0,
                        sizeof purposes / sizeof purposes[0]);
    tcase_add_test(cases, what_another_robot_has_learned_is_refused);
    tcase_add_loop_test(cases, what_does_not_fit_is_not_encoded, 0, KINDS);
    return run_suite("learned", cases);
}
