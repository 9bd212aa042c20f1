/* Checked decoding: exact length, counts, finite numbers; any bytes may come. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "checksum.h"
#include "messages.h"
#include "suite.h"

enum { SIZE = 65536 };

static limphome_robot_state_t good_state(void) {
    limphome_robot_state_t state;
    memset(&state, 0, sizeof state);
    state.num_actuators = 5;
    state.orientation[0] = 1;
    state.session = 42;
    return state;
}

static limphome_policy_t good_policy(void) {
    limphome_policy_t policy;
    memset(&policy, 0, sizeof policy);
    policy.num_actuators = 5;
    policy.num_controlled = 4;
    policy.num_units = 50;
    policy.num_inputs = 10;
    return policy;
}

static limphome_planner_t good_planner(void) {
    limphome_planner_t planner;
    memset(&planner, 0, sizeof planner);
    planner.num_actuators = 5;
    planner.num_controlled = 4;
    planner.num_actions = 81;
    planner.num_joints = 3;
    planner.num_samples = 1024;
    planner.num_nodes = 1200;
    return planner;
}

static message_verdict judge_planner(const limphome_planner_t *planner, int surplus) {
    static unsigned char bytes[SIZE];
    static limphome_planner_t decoded;
    const int size = limphome_planner_t_encode(bytes, 0, SIZE, planner);
    checksum_seal(bytes, size);
    return message_decode_planner(bytes, (size_t)size + (size_t)surplus, &decoded);
}

static message_verdict judge_planner_checkpoint(const limphome_planner_t *planner, int32_t episode, int surplus) {
    static unsigned char bytes[SIZE];
    static limphome_planner_checkpoint_t checkpoint, decoded;
    checkpoint.planner = *planner;
    checkpoint.episode = episode;
    const int size = limphome_planner_checkpoint_t_encode(bytes, 0, SIZE, &checkpoint);
    checksum_seal(bytes, size);
    return message_decode_planner_checkpoint(bytes, (size_t)size + (size_t)surplus, &decoded);
}

static message_verdict judge_state(const limphome_robot_state_t *state, int surplus) {
    unsigned char bytes[SIZE] = {0};
    const int size = limphome_robot_state_t_encode(bytes, 0, SIZE, state);
    limphome_robot_state_t decoded;
    return message_decode_state(bytes, (size_t)size + (size_t)surplus, &decoded);
}

static message_verdict judge_policy(const limphome_policy_t *policy, int surplus) {
    unsigned char bytes[SIZE] = {0};
    const int size = limphome_policy_t_encode(bytes, 0, SIZE, policy);
    checksum_seal(bytes, size);
    limphome_policy_t decoded;
    return message_decode_policy(bytes, (size_t)size + (size_t)surplus, &decoded);
}

static limphome_operate_t good_operate(void) {
    return (limphome_operate_t){
        .sender = 7, .action = LIMPHOME_OPERATE_T_TAKE, .num_actuators = 5, .direction = {-1, 0, 1}};
}

static message_verdict judge_operate(const limphome_operate_t *operate, int surplus) {
    unsigned char bytes[SIZE] = {0};
    const int size = limphome_operate_t_encode(bytes, 0, SIZE, operate);
    limphome_operate_t decoded;
    return message_decode_operate(bytes, (size_t)size + (size_t)surplus, &decoded);
}

START_TEST(what_an_operator_wants_must_make_sense) {
    limphome_operate_t operate = good_operate();
    ck_assert_int_eq(judge_operate(&operate, 0), MESSAGE_GOOD);
    ck_assert_int_eq(judge_operate(&operate, 1), MESSAGE_MALFORMED);
    ck_assert_int_eq(judge_operate(&operate, -1), MESSAGE_MALFORMED);
#define BAD(field, value)                                                \
    do {                                                                 \
        operate = good_operate();                                        \
        operate.field = value;                                           \
        ck_assert_int_eq(judge_operate(&operate, 0), MESSAGE_MALFORMED); \
    } while (0)
    BAD(sender, 0);
    BAD(action, 2);
    BAD(action, -1);
    BAD(num_actuators, 0);
    BAD(num_actuators, 9);
    BAD(direction[0], 2);
    BAD(direction[4], -2);
#undef BAD
    operate = good_operate();
    operate.direction[5] = 100; /* not in use */
    ck_assert_int_eq(judge_operate(&operate, 0), MESSAGE_GOOD);
}
END_TEST

START_TEST(good_messages_pass) {
    const limphome_robot_state_t state = good_state();
    const limphome_policy_t policy = good_policy();
    ck_assert_int_eq(judge_state(&state, 0), MESSAGE_GOOD);
    ck_assert_int_eq(judge_policy(&policy, 0), MESSAGE_GOOD);
    const limphome_planner_t planner = good_planner();
    ck_assert_int_eq(judge_planner(&planner, 0), MESSAGE_GOOD);
    ck_assert_int_eq(judge_planner_checkpoint(&planner, 0, 0), MESSAGE_GOOD);
}
END_TEST

START_TEST(length_must_be_exact) {
    const limphome_robot_state_t state = good_state();
    const limphome_policy_t policy = good_policy();
    ck_assert_int_eq(judge_state(&state, 1), MESSAGE_MALFORMED);
    ck_assert_int_eq(judge_state(&state, -1), MESSAGE_MALFORMED);
    ck_assert_int_eq(judge_policy(&policy, 1), MESSAGE_MALFORMED);
    ck_assert_int_eq(judge_policy(&policy, -1), MESSAGE_MALFORMED);
    const limphome_planner_t planner = good_planner();
    for (int surplus = -1; surplus <= 1; surplus += 2) {
        ck_assert_int_eq(judge_planner(&planner, surplus), MESSAGE_MALFORMED);
        ck_assert_int_eq(judge_planner_checkpoint(&planner, 0, surplus), MESSAGE_MALFORMED);
    }
}
END_TEST

START_TEST(another_type_is_malformed) {
    const limphome_robot_state_t state = good_state();
    unsigned char bytes[SIZE] = {0};
    const int size = limphome_robot_state_t_encode(bytes, 0, SIZE, &state);
    bytes[0] ^= 1; /* of the type's fingerprint */
    limphome_robot_state_t decoded;
    ck_assert_int_eq(message_decode_state(bytes, (size_t)size, &decoded), MESSAGE_MALFORMED);
    limphome_policy_t policy;
    ck_assert_int_eq(message_decode_policy(bytes, (size_t)size, &policy), MESSAGE_MALFORMED);
}
END_TEST

START_TEST(counts_must_fit) {
    limphome_robot_state_t state = good_state();
    static const int32_t bad_actuators[] = {0, -1, 9, INT32_MAX, INT32_MIN};
    for (size_t i = 0; i < sizeof bad_actuators / sizeof bad_actuators[0]; i++) {
        state.num_actuators = bad_actuators[i];
        ck_assert_int_eq(judge_state(&state, 0), MESSAGE_MALFORMED);
    }
    limphome_policy_t policy = good_policy();
    policy.num_units = 65;
    ck_assert_int_eq(judge_policy(&policy, 0), MESSAGE_MALFORMED);
    policy = good_policy();
    policy.num_inputs = 11;
    ck_assert_int_eq(judge_policy(&policy, 0), MESSAGE_MALFORMED);
    policy = good_policy();
    policy.num_controlled = 6;
    ck_assert_int_eq(judge_policy(&policy, 0), MESSAGE_MALFORMED);
}
END_TEST

START_TEST(counts_of_a_planner_must_fit) {
    limphome_planner_t planner = good_planner();
    const struct {
        int32_t *count;
        int32_t bad;
    } cases[] = {
        {&planner.num_actuators, 0},  {&planner.num_actuators, 9}, {&planner.num_controlled, 0},
        {&planner.num_controlled, 6}, {&planner.num_actions, 0},   {&planner.num_actions, 244},
        {&planner.num_joints, -1},    {&planner.num_joints, 4},    {&planner.num_samples, -1},
        {&planner.num_samples, 1025}, {&planner.num_nodes, 0},     {&planner.num_nodes, 1201},
        {&planner.episode, -1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        planner = good_planner();
        *cases[i].count = cases[i].bad;
        ck_assert_int_eq(judge_planner(&planner, 0), MESSAGE_MALFORMED);
        ck_assert_int_eq(judge_planner_checkpoint(&planner, planner.episode, 0), MESSAGE_MALFORMED);
    }
    planner = good_planner();
    ck_assert_int_eq(judge_planner_checkpoint(&planner, 1, 0), MESSAGE_MALFORMED); /* two that differ */
}
END_TEST

START_TEST(numbers_of_a_planner_must_be_finite) {
    limphome_planner_t planner = good_planner();
    planner.speed[7] = planner.joint_low[4] = planner.joint_high[4] = NAN; /* not used: four are controlled */
    ck_assert_int_eq(judge_planner(&planner, 0), MESSAGE_GOOD);
    float *const used[] = {&planner.speed[3],        &planner.joint_low[0],  &planner.joint_high[3],
                           &planner.decision_period, &planner.kernel_low[0], &planner.kernel_width[2],
                           &planner.prior_weight,    &planner.node_low[1],   &planner.node_spacing[2],
                           &planner.ground[2]};
    for (size_t i = 0; i < sizeof used / sizeof used[0]; i++) {
        planner = good_planner();
        *used[i] = i % 2 == 0 ? NAN : INFINITY;
        ck_assert_int_eq(judge_planner(&planner, 0), MESSAGE_NON_FINITE);
    }
}
END_TEST

START_TEST(numbers_must_be_finite_where_they_are_used) {
    limphome_robot_state_t state = good_state();
    state.actuator_position[7] = NAN; /* not used: there are five */
    ck_assert_int_eq(judge_state(&state, 0), MESSAGE_GOOD);
    state.actuator_position[4] = NAN;
    ck_assert_int_eq(judge_state(&state, 0), MESSAGE_NON_FINITE);
    state = good_state();
    state.orientation[3] = INFINITY;
    ck_assert_int_eq(judge_state(&state, 0), MESSAGE_NON_FINITE);
    limphome_policy_t policy = good_policy();
    policy.centre[49][9] = NAN;
    ck_assert_int_eq(judge_policy(&policy, 0), MESSAGE_NON_FINITE);
    policy = good_policy();
    policy.width[0] = INFINITY;
    ck_assert_int_eq(judge_policy(&policy, 0), MESSAGE_NON_FINITE);
}
END_TEST

START_TEST(any_bytes_are_survived) {
    srand(1);
    const limphome_robot_state_t state = good_state();
    unsigned char bytes[SIZE];
    const int size = limphome_robot_state_t_encode(bytes, 0, SIZE, &state);
    for (int round = 0; round < 2000; round++) {
        bytes[8 + rand() % (size - 8)] = (unsigned char)rand();
        limphome_robot_state_t decoded;
        if (message_decode_state(bytes, (size_t)size, &decoded) == MESSAGE_GOOD) {
            ck_assert_int_ge(decoded.num_actuators, 1);
            ck_assert_int_le(decoded.num_actuators, 8);
        }
    }
    for (size_t length = 0; length < 64; length++) {
        limphome_robot_state_t decoded;
        ck_assert_int_eq(message_decode_state(bytes, length, &decoded), MESSAGE_MALFORMED);
    }
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("messages");
    tcase_add_test(cases, good_messages_pass);
    tcase_add_test(cases, what_an_operator_wants_must_make_sense);
    tcase_add_test(cases, length_must_be_exact);
    tcase_add_test(cases, another_type_is_malformed);
    tcase_add_test(cases, counts_must_fit);
    tcase_add_test(cases, counts_of_a_planner_must_fit);
    tcase_add_test(cases, numbers_of_a_planner_must_be_finite);
    tcase_add_test(cases, numbers_must_be_finite_where_they_are_used);
    tcase_add_test(cases, any_bytes_are_survived);
    return run_suite("messages", cases);
}
