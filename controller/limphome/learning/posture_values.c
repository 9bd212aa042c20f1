#include "limphome/learning/posture_values.h"

#include <string.h>

#include "limphome/base/elementary.h"

#define VALUE_UNITS 256.0f
#define COST_UNITS 1024.0f

/* 0, +-3, +-8, +-20, +-50 degrees */
static const float steerings[LH_STEERINGS] = {-0.8726646f, -0.3490659f, -0.1396263f, -0.0523599f, 0.0f,
                                              0.0523599f,  0.1396263f,  0.3490659f,  0.8726646f};
static const float sines[LH_STEERINGS] = {-0.766044443f, -0.342020143f, -0.139173101f, -0.052335956f, 0.0f,
                                          0.052335956f,  0.139173101f,  0.342020143f,  0.766044443f};
static const float cosines[LH_STEERINGS] = {0.642787610f, 0.939692621f, 0.990268069f, 0.998629535f, 1.000000000f,
                                            0.998629535f, 0.990268069f, 0.939692621f, 0.642787610f};
/* of the distance from each to the next */
static const float reciprocals[LH_STEERINGS - 1] = {1.9098593f, 4.7746483f, 11.459156f, 19.098593f,
                                                    19.098593f, 11.459156f, 4.7746483f, 1.9098593f};

float lh_posture_steering(int32_t k) {
    return steerings[k];
}

float lh_posture_sine(int32_t k) {
    return sines[k];
}

float lh_posture_cosine(int32_t k) {
    return cosines[k];
}

static int32_t nodes_along(float low, float high, float spacing) {
    return (int32_t)((high - low) / spacing + 0.5f) + 1;
}

static int32_t count_nodes(lh_posture_values *values, const float *low, const float *high, float spacing) {
    int32_t total = 1;
    for (int32_t k = 0; k < LH_PLANNED_JOINTS; k++) {
        values->count[k] = k < values->num_joints ? nodes_along(low[k], high[k], spacing) : 1;
        total *= values->count[k];
        if (total > LH_MAX_POSTURES) {
            return total;
        }
    }
    return total;
}

void lh_posture_values_init(lh_posture_values *values, int32_t num_joints, const float *low, const float *high,
                            float spacing) {
    memset(values, 0, sizeof *values);
    values->num_joints = num_joints;
    float widened = spacing;
    while (count_nodes(values, low, high, widened) > LH_MAX_POSTURES) {
        widened *= 1.05f;
    }
    values->num_nodes = values->count[0] * values->count[1] * values->count[2];
    for (int32_t k = 0; k < num_joints; k++) {
        values->low[k] = low[k];
        values->spacing[k] = (high[k] - low[k]) / (float)(values->count[k] > 1 ? values->count[k] - 1 : 1);
    }
}

void lh_posture_angles(const lh_posture_values *values, int32_t node, float *angle) {
    for (int32_t k = values->num_joints - 1; k >= 0; k--) {
        angle[k] = values->low[k] + (float)(node % values->count[k]) * values->spacing[k];
        node /= values->count[k];
    }
}

int32_t lh_posture_neighbour(const lh_posture_values *values, int32_t node, const int8_t *level) {
    int32_t next = 0;
    int32_t stride = 1;
    for (int32_t k = values->num_joints - 1; k >= 0; k--) {
        int32_t place = node % values->count[k] + level[k] - 1;
        node /= values->count[k];
        if (place < 0 || place >= values->count[k]) {
            return LH_NO_NODE;
        }
        next += place * stride;
        stride *= values->count[k];
    }
    return next;
}

void lh_posture_cell(const lh_posture_values *values, const float *angle, lh_cell *cell) {
    cell->node[0] = 0;
    cell->weight[0] = 1.0f;
    int32_t corners = 1;
    for (int32_t k = 0; k < LH_PLANNED_JOINTS; k++) {
        int32_t place = 0;
        float share = 0.0f;
        int32_t next = 0;
        if (k < values->num_joints && values->count[k] > 1) {
            float scaled = (angle[k] - values->low[k]) / values->spacing[k];
            float last = (float)(values->count[k] - 1);
            scaled = lh_clip(scaled, 0.0f, last);
            place = (int32_t)scaled;
            place = place > values->count[k] - 2 ? values->count[k] - 2 : place;
            share = scaled - (float)place;
            next = 1;
        }
        for (int32_t c = 0; c < corners; c++) {
            int32_t node = cell->node[c] * values->count[k] + place;
            cell->node[corners + c] = node + next;
            cell->weight[corners + c] = cell->weight[c] * share;
            cell->node[c] = node;
            cell->weight[c] *= 1.0f - share;
        }
        corners *= 2;
    }
}

int32_t lh_posture_nearest(const lh_cell *cell) {
    int32_t best = 0;
    for (int32_t c = 1; c < LH_CORNERS; c++) {
        best = cell->weight[c] > cell->weight[best] ? c : best;
    }
    return cell->node[best];
}

float lh_posture_cost(const lh_posture_values *values, const lh_cell *cell) {
    float sum = 0.0f;
    for (int32_t c = 0; c < LH_CORNERS; c++) {
        sum += cell->weight[c] * (float)values->cost[cell->node[c]];
    }
    return sum * (1.0f / COST_UNITS);
}

/* Where `steering` lies between column k and the next, 0 to 1. */
static float share_of_next(int32_t k, float steering) {
    float x = (steering - steerings[k]) * reciprocals[k];
    return lh_clip(x, 0.0f, 1.0f);
}

/* Columns round `steering`: the first of the two and the share of the second. */
static int32_t column(float steering, float *share) {
    int32_t k = 0;
    for (int32_t i = 1; i < LH_STEERINGS - 1; i++) {
        k = steering >= steerings[i] ? i : k;
    }
    *share = share_of_next(k, steering);
    return k;
}

float lh_posture_value(const lh_posture_values *values, const lh_cell *cell, float steering) {
    float share;
    int32_t k = column(steering, &share);
    float low = 0.0f;
    float high = 0.0f;
    for (int32_t c = 0; c < LH_CORNERS; c++) {
        const int16_t *value = values->value[cell->node[c]];
        low += cell->weight[c] * (float)value[k];
        high += cell->weight[c] * (float)value[k + 1];
    }
    return (low + share * (high - low)) * (1.0f / VALUE_UNITS);
}

float lh_posture_node_cost(const lh_posture_values *values, int32_t node) {
    return (float)values->cost[node] * (1.0f / COST_UNITS);
}

float lh_posture_node_value(const lh_posture_values *values, int32_t node, int32_t near, float steering) {
    int32_t k = near < LH_STEERINGS - 1 ? near : LH_STEERINGS - 2;
    while (k > 0 && steering < steerings[k]) {
        k--;
    }
    while (k < LH_STEERINGS - 2 && steering >= steerings[k + 1]) {
        k++;
    }
    float share = share_of_next(k, steering);
    const int16_t *value = values->value[node];
    float low = (float)value[k];
    return (low + share * ((float)value[k + 1] - low)) * (1.0f / VALUE_UNITS);
}

void lh_posture_set_value(lh_posture_values *values, int32_t node, int32_t k, float value) {
    values->value[node][k] = lh_round_16(value * VALUE_UNITS);
}

void lh_posture_set_cost(lh_posture_values *values, int32_t node, float cost) {
    values->cost[node] = lh_round_16(cost * COST_UNITS);
}

bool lh_posture_values_fit(const lh_posture_values *saved, const lh_posture_values *values) {
    bool fits = saved->num_joints == values->num_joints && saved->num_nodes == values->num_nodes;
    for (int32_t k = 0; k < LH_PLANNED_JOINTS; k++) {
        fits = fits && saved->count[k] == values->count[k] && saved->low[k] == values->low[k] &&
               saved->spacing[k] == values->spacing[k];
    }
    return fits;
}
