/* Q(s, a) of all joint actions at once. Each phi_j of (14) is a product over the inputs, so with n actuators
 *
 *     Q(s, a) = sum_j [w_j m_j(s)] prod_k f_jk(a_k),
 *
 * where m_j is phi_j at the levels nearest to the unit's centre, its largest over the joint actions, and f_jk, up to 1,
 * what it loses by another level of actuator k. The levels are equally spaced, so one exponential for m_j, one for the
 * width and one per actuator give all factors of a unit: n + 2 instead of 3^n. */
#ifndef LIMPHOME_ACTION_VALUES_H
#define LIMPHOME_ACTION_VALUES_H

#include <stdint.h>

#include "limphome/learning/network.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Room to compute in; nothing in it lasts. */
typedef struct lh_action_scratch {
    float precision[LH_UNIT_SLOTS];                                 /* 1 / sigma_j^2 */
    float quarter[LH_UNIT_SLOTS];                                   /* e^(-1/4 sigma_j^2) */
    float square[LH_UNIT_SLOTS];                                    /* least ||x - mu_j||^2 over the joint actions */
    float factor[LH_FACTOR_SLOTS][LH_ACTION_LEVELS][LH_UNIT_SLOTS]; /* f_jk(level) */
    float row[LH_ACTION_LEVELS][LH_UNIT_SLOTS];                     /* w_j m_j f_j2(level) f_j3 f_j4 ... */
    float column[LH_MAX_UNITS][LH_COLUMN_SLOTS];                    /* f_j0(level) f_j1(level), unit by unit */
} lh_action_scratch;

/* Computes q[3^num_controlled] by (13)(14), in the order of action.h, at states[num_states]; the network has
 * num_states + num_controlled inputs. Returns the largest. */
float lh_action_values(const lh_network *network, const float *states, int32_t num_states, lh_action_scratch *scratch,
                       float *q);

#ifdef __cplusplus
}
#endif
#endif
