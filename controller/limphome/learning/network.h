/* The RBF network that stands for Q: y = sum_j w_j phi_j(x) (13),
 * phi_j(x) = exp(-sum_i (x_i - mu_ij)^2 / sigma_j^2) (14), learning by (19)-(21). */
#ifndef LIMPHOME_NETWORK_H
#define LIMPHOME_NETWORK_H

#include <stdbool.h>
#include <stdint.h>

#include "limphome/base/capacity.h"
#include "limphome/base/error.h"
#include "limphome/base/random.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bounds of what can be learned, far outside what is useful, so that no value can overflow. */
#define LH_WIDTH_LIMIT 1000.0f  /* largest sigma_j */
#define LH_CENTRE_LIMIT 1000.0f /* largest |mu_ij| */

/* Ranges of lh_network_config. */
#define LH_NETWORK_RATE_MAX 10.0f   /* of alpha_w, alpha_sigma and alpha_mu; at least 0 */
#define LH_INITIAL_WIDTH_MAX 100.0f /* of sigma_j; at least width_floor */
#define LH_WIDTH_FLOOR_MIN 0.01f
#define LH_WIDTH_FLOOR_MAX 1.0f
#define LH_WEIGHT_LIMIT_MIN 1.0f
#define LH_WEIGHT_LIMIT_MAX 1e6f

typedef struct lh_network_config {
    int32_t units;        /* 1 to LH_MAX_UNITS; paper: 50 */
    int32_t inputs;       /* 1 to LH_MAX_INPUTS; paper: 10 */
    float rate_weight;    /* alpha_w of (19), 0 to LH_NETWORK_RATE_MAX; paper: 0.1 */
    float rate_width;     /* alpha_sigma of (20), 0 to LH_NETWORK_RATE_MAX; paper: 0.01 */
    float rate_centre;    /* alpha_mu of (21), 0 to LH_NETWORK_RATE_MAX; paper: 0.1 */
    float initial_weight; /* w_j, |.| up to weight_limit; default 0 */
    float initial_width;  /* sigma_j, width_floor to LH_INITIAL_WIDTH_MAX; paper: 1.0 */
    float width_floor;    /* least sigma_j, LH_WIDTH_FLOOR_MIN to LH_WIDTH_FLOOR_MAX; default 0.05 */
    float weight_limit;   /* largest |w_j|, LH_WEIGHT_LIMIT_MIN to LH_WEIGHT_LIMIT_MAX; default 1e4 */
    /* true, the default: the derivative of (15) by (13)(14), which has alpha delta for alpha^2 delta in all three and a
     * factor 2 in (20) and (21). false: (19)-(21) as printed. */
    bool exact_gradient;
} lh_network_config;

/* Parameters that are learned, side by side for all units. Only the first `inputs` rows and `units` columns are used;
 * the rest is 0 and takes part in the computations without an effect, as loops of constant length are vector code. */
typedef struct lh_network {
    int32_t units;
    int32_t inputs;
    float weight[LH_UNIT_SLOTS];                /* w_j [units] */
    float width[LH_UNIT_SLOTS];                 /* sigma_j [units], width_floor to LH_WIDTH_LIMIT */
    float centre[LH_MAX_INPUTS][LH_UNIT_SLOTS]; /* mu_ij [inputs][units], |.| up to LH_CENTRE_LIMIT */
} lh_network;

/* Table 2, with 50 units and 10 inputs. */
lh_network_config lh_network_config_default(void);

/* LH_OK, or the error of the first bad field. */
lh_error lh_network_config_validate(const lh_network_config *config);

/* All weights and widths at their initial value, centres uniform in [0, 1), drawn unit by unit.
 * An invalid configuration is returned as its error and nothing is changed. */
lh_error lh_network_init(lh_network *network, const lh_network_config *config, lh_random *random);

/* LH_OK if `network` fits the configuration every parameter is finite and within its limits, and the rest is
 * 0. */
lh_error lh_network_validate(const lh_network *network, const lh_network_config *config);

/* What (13) and (19)-(21) need of every unit at one input x; beyond the last unit precision and phi are 0. */
typedef struct lh_activation {
    float precision[LH_UNIT_SLOTS]; /* 1 / sigma_j^2 */
    float distance[LH_UNIT_SLOTS];  /* ||x - mu_j||^2 */
    float phi[LH_UNIT_SLOTS];       /* phi_j(x) of (14) */
} lh_activation;

/* y of (13) at x[inputs]; fills *at. */
float lh_network_value(const lh_network *network, const float *x, lh_activation *at);

/* Fills precision[LH_UNIT_SLOTS] with 1 / sigma_j^2, and 0 beyond the last unit. */
void lh_network_precisions(const lh_network *network, float *precision);

/* How many parameters were held at a limit, or left as they were. */
typedef struct lh_held {
    uint64_t weights;
    uint64_t widths;
    uint64_t centres;
} lh_held;

/* One step of (19)-(21) towards y + alpha * delta at x[inputs]: `learning_rate` is alpha of (2), `td_error` delta of
 * (1), and *at is what lh_network_value gave at x. All three use the values from before the step. Parameters that would
 * leave their limits are held there; all are left as they are where y would change by more than 1e20 or is not finite.
 * Returns how many were held or left. */
lh_held lh_network_learn(lh_network *network, const lh_network_config *config, const float *x, const lh_activation *at,
                         float learning_rate, float td_error);

#ifdef __cplusplus
}
#endif
#endif
