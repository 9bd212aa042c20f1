#include "limphome/task/observation.h"

#include "limphome/base/elementary.h"

float lh_observation_scale(float value, float low, float high, int32_t *clamped) {
    if (value < low) {
        (*clamped)++;
        return 0.0f;
    }
    if (value > high) {
        (*clamped)++;
        return 1.0f;
    }
    return (value - low) / (high - low);
}

void lh_observation_range(const lh_actuator *actuator, float *low, float *high) {
    bool is_joint = actuator->kind == LH_JOINT;
    *low = is_joint ? actuator->low : -actuator->effort_limit;
    *high = is_joint ? actuator->high : actuator->effort_limit;
}

int32_t lh_observation(const lh_robot *robot, const lh_controlled *controlled, const lh_state *state, lh_quat attitude,
                       float *inputs) {
    int32_t clamped = 0;
    for (int32_t k = 0; k < controlled->count; k++) {
        int32_t index = controlled->index[k];
        const lh_actuator *actuator = &robot->actuators[index];
        float value = actuator->kind == LH_JOINT ? state->actuator_position[index] : state->actuator_effort[index];
        float low;
        float high;
        lh_observation_range(actuator, &low, &high);
        inputs[k] = lh_observation_scale(value, low, high, &clamped);
    }
    float *angles = inputs + controlled->count;
    angles[0] = lh_observation_scale(lh_quat_roll(attitude), -0.5f * LH_PI, 0.5f * LH_PI, &clamped);
    angles[1] = lh_observation_scale(lh_quat_pitch(attitude), -0.5f * LH_PI, 0.5f * LH_PI, &clamped);
    return clamped;
}

lh_error lh_state_validate(const lh_state *state, const lh_robot *robot) {
    bool good = state->num_actuators == robot->num_actuators;
    for (int32_t i = 0; i < 3; i++) {
        good = good && lh_within(state->position[i], -1e6f, 1e6f);
    }
    const lh_quat *q = &state->orientation;
    float length = lh_sqrt(q->w * q->w + q->x * q->x + q->y * q->y + q->z * q->z);
    good = good && lh_within(length, 0.9f, 1.1f);
    for (int32_t k = 0; good && k < robot->num_actuators; k++) {
        float largest = robot->actuators[k].kind == LH_JOINT ? LH_ANGLE_LIMIT : FLT_MAX;
        good = lh_within(state->actuator_position[k], -largest, largest) && lh_finite(state->actuator_effort[k]);
    }
    return good ? LH_OK : LH_ERROR_STATE;
}
