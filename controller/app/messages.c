#include "messages.h"

#include <limits.h>
#include <math.h>
#include <stdbool.h>

#include "checksum.h"
#include "limphome/learning/planner.h"

enum { WIRE_ACTUATORS = 8, WIRE_UNITS = 64, WIRE_INPUTS = 18 };
enum { WIRE_JOINTS = 3, WIRE_ACTIONS = 243, WIRE_SAMPLES = 1024, WIRE_NODES = 1200 };
_Static_assert(LH_MAX_ACTUATORS <= WIRE_ACTUATORS, "robot_state_t carries 8 actuators");
_Static_assert(LH_MAX_UNITS <= WIRE_UNITS, "policy_t carries 64 units");
_Static_assert(LH_MAX_INPUTS <= WIRE_INPUTS, "policy_t carries 18 inputs");
_Static_assert(LH_PLANNED_JOINTS == WIRE_JOINTS && LH_MOTION_PARTS == 4 && LH_STEERINGS == 9, "as planner_t has them");
_Static_assert(LH_PLANNED_ACTIONS <= WIRE_ACTIONS, "planner_t names 243 actions");
_Static_assert(LH_MAX_SAMPLES <= WIRE_SAMPLES, "planner_t carries 1024 samples");
_Static_assert(LH_MAX_POSTURES <= WIRE_NODES, "planner_t carries 1200 nodes");

static bool finite_doubles(const double *values, int count) {
    bool finite = true;
    for (int i = 0; i < count; i++) {
        finite = finite && isfinite(values[i]);
    }
    return finite;
}

static bool finite_floats(const float *values, int count) {
    bool finite = true;
    for (int i = 0; i < count; i++) {
        finite = finite && isfinite(values[i]);
    }
    return finite;
}

static bool within(int32_t value, int32_t low, int32_t high) {
    return value >= low && value <= high;
}

message_verdict message_decode_state(const void *data, size_t size, limphome_robot_state_t *state) {
    if (size > INT_MAX || limphome_robot_state_t_decode(data, 0, (int)size, state) != (int)size ||
        !within(state->num_actuators, 1, WIRE_ACTUATORS)) {
        return MESSAGE_MALFORMED;
    }
    const bool finite = finite_doubles(state->position, 3) && finite_doubles(state->orientation, 4) &&
                        finite_doubles(state->actuator_position, state->num_actuators) &&
                        finite_doubles(state->actuator_velocity, state->num_actuators) &&
                        finite_doubles(state->actuator_effort, state->num_actuators);
    return finite ? MESSAGE_GOOD : MESSAGE_NON_FINITE;
}

message_verdict message_decode_operate(const void *data, size_t size, limphome_operate_t *operate) {
    if (size > INT_MAX || limphome_operate_t_decode(data, 0, (int)size, operate) != (int)size || operate->sender == 0 ||
        !within(operate->action, LIMPHOME_OPERATE_T_GIVE, LIMPHOME_OPERATE_T_TAKE) ||
        !within(operate->num_actuators, 1, WIRE_ACTUATORS)) {
        return MESSAGE_MALFORMED;
    }
    for (int i = 0; i < operate->num_actuators; i++) {
        if (!within(operate->direction[i], -1, 1)) {
            return MESSAGE_MALFORMED;
        }
    }
    return MESSAGE_GOOD;
}

/* Counts within the wire's arrays, every value used finite. */
static message_verdict check_policy(const limphome_policy_t *policy) {
    if (!within(policy->num_actuators, 1, WIRE_ACTUATORS) ||
        !within(policy->num_controlled, 1, policy->num_actuators) || !within(policy->num_units, 1, WIRE_UNITS) ||
        policy->num_inputs != 2 * policy->num_controlled + 2 || policy->episode < 0) {
        return MESSAGE_MALFORMED;
    }
    bool finite = finite_floats(policy->weight, policy->num_units) && finite_floats(policy->width, policy->num_units) &&
                  finite_floats(policy->speed, policy->num_controlled) &&
                  finite_floats(policy->input_low, policy->num_controlled) &&
                  finite_floats(policy->input_high, policy->num_controlled);
    for (int j = 0; j < policy->num_units; j++) {
        finite = finite && finite_floats(policy->centre[j], policy->num_inputs);
    }
    return finite ? MESSAGE_GOOD : MESSAGE_NON_FINITE;
}

message_verdict message_decode_policy(const void *data, size_t size, limphome_policy_t *policy) {
    if (size > INT_MAX || limphome_policy_t_decode(data, 0, (int)size, policy) != (int)size) {
        return MESSAGE_MALFORMED;
    }
    if (!checksum_holds(data, size)) {
        return MESSAGE_DAMAGED;
    }
    return check_policy(policy);
}

message_verdict message_decode_checkpoint(const void *data, size_t size, limphome_checkpoint_t *checkpoint) {
    if (size > INT_MAX || limphome_checkpoint_t_decode(data, 0, (int)size, checkpoint) != (int)size) {
        return MESSAGE_MALFORMED;
    }
    if (!checksum_holds(data, size)) {
        return MESSAGE_DAMAGED;
    }
    const bool sound =
        checkpoint->learner == LIMPHOME_CHECKPOINT_T_Q_LEARNING && checkpoint->episode == checkpoint->policy.episode;
    return sound ? check_policy(&checkpoint->policy) : MESSAGE_MALFORMED;
}

static message_verdict check_planner(const limphome_planner_t *planner) {
    if (!within(planner->num_actuators, 1, WIRE_ACTUATORS) ||
        !within(planner->num_controlled, 1, planner->num_actuators) || planner->episode < 0 ||
        !within(planner->num_actions, 1, WIRE_ACTIONS) || !within(planner->num_joints, 0, WIRE_JOINTS) ||
        !within(planner->num_samples, 0, WIRE_SAMPLES) || !within(planner->num_nodes, 1, WIRE_NODES)) {
        return MESSAGE_MALFORMED;
    }
    const bool finite =
        finite_floats(planner->speed, planner->num_controlled) &&
        finite_floats(planner->joint_low, planner->num_controlled) &&
        finite_floats(planner->joint_high, planner->num_controlled) && finite_floats(&planner->decision_period, 1) &&
        finite_floats(planner->kernel_low, WIRE_JOINTS) && finite_floats(planner->kernel_width, WIRE_JOINTS) &&
        finite_floats(&planner->prior_weight, 1) && finite_floats(planner->node_low, WIRE_JOINTS) &&
        finite_floats(planner->node_spacing, WIRE_JOINTS) && finite_floats(planner->ground, 3);
    return finite ? MESSAGE_GOOD : MESSAGE_NON_FINITE;
}

message_verdict message_decode_planner(const void *data, size_t size, limphome_planner_t *planner) {
    if (size > INT_MAX || limphome_planner_t_decode(data, 0, (int)size, planner) != (int)size) {
        return MESSAGE_MALFORMED;
    }
    if (!checksum_holds(data, size)) {
        return MESSAGE_DAMAGED;
    }
    return check_planner(planner);
}

message_verdict message_decode_planner_checkpoint(const void *data, size_t size,
                                                  limphome_planner_checkpoint_t *checkpoint) {
    if (size > INT_MAX || limphome_planner_checkpoint_t_decode(data, 0, (int)size, checkpoint) != (int)size) {
        return MESSAGE_MALFORMED;
    }
    if (!checksum_holds(data, size)) {
        return MESSAGE_DAMAGED;
    }
    return checkpoint->episode == checkpoint->planner.episode ? check_planner(&checkpoint->planner) : MESSAGE_MALFORMED;
}

const char *message_verdict_text(message_verdict verdict) {
    switch (verdict) {
        case MESSAGE_GOOD:
            return "good";
        case MESSAGE_DAMAGED:
            return "does not match its checksum (damaged)";
        case MESSAGE_NON_FINITE:
            return "holds NaN or infinity";
        case MESSAGE_MALFORMED:
        default:
            return "is of another type, length or count";
    }
}
