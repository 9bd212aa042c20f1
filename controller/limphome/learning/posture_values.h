/* Values of postures: a lattice over the arm's joint ranges, and at each node, for each of a few steering errors, the
 * discounted planning reward that can be had from there; between them it is interpolated. */
#ifndef LIMPHOME_POSTURE_VALUES_H
#define LIMPHOME_POSTURE_VALUES_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/base/capacity.h"

#ifdef __cplusplus
extern "C" {
#endif

#define LH_STEERINGS 9 /* steering errors at which values are kept, 0 in the middle */
#define LH_CORNERS 8   /* of a cell of the lattice */
#define LH_NO_NODE (-1)

typedef struct lh_posture_values {
    int32_t num_joints;                           /* 0 to LH_PLANNED_JOINTS */
    int32_t num_nodes;                            /* 1 to LH_MAX_POSTURES */
    int32_t count[LH_PLANNED_JOINTS];             /* of nodes along each joint, 1 where there is no joint */
    float low[LH_PLANNED_JOINTS];                 /* angle of the first [rad] */
    float spacing[LH_PLANNED_JOINTS];             /* from one to the next [rad] */
    int16_t value[LH_MAX_POSTURES][LH_STEERINGS]; /* [num_nodes] in 1/256 of reward */
    int16_t cost[LH_MAX_POSTURES]; /* [num_nodes] of standing there for a decision, in 1/1024 of reward */
} lh_posture_values;

/* Where a posture lies in the lattice. */
typedef struct lh_cell {
    int32_t node[LH_CORNERS];
    float weight[LH_CORNERS]; /* sum 1 */
} lh_cell;

/* The steering error of column `k`, 0 to LH_STEERINGS - 1 [rad], its sine and cosine. */
float lh_posture_steering(int32_t k);
float lh_posture_sine(int32_t k);
float lh_posture_cosine(int32_t k);

/* A lattice over [low, high] of each joint, about `spacing` apart, or wider where the nodes would be more than
 * LH_MAX_POSTURES; all values and costs 0. */
void lh_posture_values_init(lh_posture_values *values, int32_t num_joints, const float *low, const float *high,
                            float spacing);

/* Angles of a node, into angle[num_joints] [rad]. */
void lh_posture_angles(const lh_posture_values *values, int32_t node, float *angle);

/* The node one step away by level[num_joints] of action.h, LH_NO_NODE if that is off the lattice. */
int32_t lh_posture_neighbour(const lh_posture_values *values, int32_t node, const int8_t *level);

/* angle[num_joints] is limited to the lattice. */
void lh_posture_cell(const lh_posture_values *values, const float *angle, lh_cell *cell);

/* The node nearest to what the cell was made of. */
int32_t lh_posture_nearest(const lh_cell *cell);

/* Interpolated between the corners. */
float lh_posture_cost(const lh_posture_values *values, const lh_cell *cell);

/* Interpolated between corners and steering errors; beyond the outermost, that of the outermost. */
float lh_posture_value(const lh_posture_values *values, const lh_cell *cell, float steering);

/* Both at one node; `near` is a column not far from `steering`, where the search begins. */
float lh_posture_node_cost(const lh_posture_values *values, int32_t node);
float lh_posture_node_value(const lh_posture_values *values, int32_t node, int32_t near, float steering);

void lh_posture_set_value(lh_posture_values *values, int32_t node, int32_t k, float value);
void lh_posture_set_cost(lh_posture_values *values, int32_t node, float cost);

/* Whether `saved` is of the lattice of `values`. */
bool lh_posture_values_fit(const lh_posture_values *saved, const lh_posture_values *values);

#ifdef __cplusplus
}
#endif
#endif
