#include "limphome/task/action.h"

int32_t lh_action_count(int32_t n) {
    int32_t count = 1;
    for (int32_t k = 0; k < n; k++) {
        count *= LH_ACTION_LEVELS;
    }
    return count;
}

void lh_action_levels(int32_t index, int32_t n, int8_t *levels) {
    for (int32_t k = 0; k < n; k++) {
        levels[k] = (int8_t)(index % LH_ACTION_LEVELS);
        index /= LH_ACTION_LEVELS;
    }
}

int32_t lh_action_index(const int8_t *levels, int32_t n) {
    int32_t index = 0;
    for (int32_t k = n - 1; k >= 0; --k) {
        index = index * LH_ACTION_LEVELS + levels[k];
    }
    return index;
}

float lh_action_input(int8_t level) {
    return 0.5f * (float)level;
}

void lh_action_inputs(int32_t index, int32_t n, float *inputs) {
    int8_t levels[LH_MAX_ACTUATORS];
    lh_action_levels(index, n, levels);
    for (int32_t k = 0; k < n; k++) {
        inputs[k] = lh_action_input(levels[k]);
    }
}

float lh_action_velocity(int8_t level, float speed) {
    return (float)(level - 1) * speed;
}
