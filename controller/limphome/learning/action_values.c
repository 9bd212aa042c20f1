#include "limphome/learning/action_values.h"

#include <float.h>
#include <string.h>

#include "limphome/base/exponential.h"
#include "limphome/base/lanes.h"
#include "limphome/task/action.h"

/* Joint actions are computed in blocks of three rows, the levels of actuator 2, by nine columns, the levels of
 * actuators 0 and 1. */
#define COLUMNS (LH_ACTION_LEVELS * LH_ACTION_LEVELS)
#define BLOCK (LH_ACTION_LEVELS * COLUMNS)
#define BLOCK_ACTUATORS 3

_Static_assert(LH_ACTION_LEVELS == 3, "the inputs of the levels are 0, 1/2 and 1");

/* square[j] = ||s - mu_j||^2 over the state inputs; quarter[j] = e^(-1/4 sigma_j^2). */
static void measure_states(const lh_network *network, const float *states, int32_t num_states, int32_t end,
                           const float *restrict precision, float *restrict square, float *restrict quarter) {
    for (int32_t j = 0; j < end; j++) {
        square[j] = 0.0f;
        quarter[j] = lh_decay(0.25f * precision[j]);
    }
    for (int32_t i = 0; i < num_states; i++) {
        const float *restrict centre = network->centre[i];
        float input = states[i];
        for (int32_t j = 0; j < end; j++) {
            float difference = input - centre[j];
            square[j] += difference * difference;
        }
    }
}

/* f_jk of one actuator, and into square[j] the distance of its nearest level; one exponential for all levels.
 * Let a be the distance of the centre from level 1/2, p = 1 / sigma^2 and ratio = e^(-|a - 1/4| p), the Gaussian of the
 * second nearest over that of the nearest. The squares of the distances from level 1/2, the nearer end and the farther
 * end are a^2, (a - 1/2)^2 and (a + 1/2)^2; so the far end over the nearest is
 *     e^(-(a + 1/4) p) = quarter (quarter / ratio)   where level 1/2 is the nearest, a < 1/4,
 *     e^(-2 a p)       = (ratio quarter)^2           where the nearer end is,
 * in which nothing overflows, and nothing underflows that is not as small itself. */
static void relative_gaussians(const float *restrict centre, const float *restrict precision,
                               const float *restrict quarter, int32_t end, float *restrict square,
                               float *restrict reverse, float *restrict still, float *restrict forward) {
    for (int32_t j = 0; j < end; j++) {
        float beyond = centre[j] - 0.5f;
        float a = __builtin_fabsf(beyond);
        float gap = a - 0.25f;
        float ratio = lh_decay(__builtin_fabsf(gap) * precision[j]);
        float nearest, near_end, far_end;
        if (gap < 0.0f) {
            nearest = a;
            still[j] = 1.0f;
            near_end = ratio;
            far_end = quarter[j] * (quarter[j] / ratio);
        } else {
            float step = quarter[j] * ratio;
            nearest = a - 0.5f;
            still[j] = ratio;
            near_end = 1.0f;
            far_end = step * step;
        }
        square[j] += nearest * nearest;
        reverse[j] = beyond < 0.0f ? near_end : far_end;
        forward[j] = beyond < 0.0f ? far_end : near_end;
    }
}

static void multiply(const float *restrict a, const float *restrict b, int32_t end, float *restrict product) {
    for (int32_t j = 0; j < end; j++) {
        product[j] = a[j] * b[j];
    }
}

/* row[r] = product times the factor of actuator 2 at level r */
static void make_rows(const float *restrict product, lh_action_scratch *restrict scratch, int32_t end) {
    for (int32_t j = 0; j < end; j++) {
        scratch->row[0][j] = product[j] * scratch->factor[2][0][j];
        scratch->row[1][j] = product[j] * scratch->factor[2][1][j];
        scratch->row[2][j] = product[j] * scratch->factor[2][2][j];
    }
}

/* column[j][l0 + 3 l1] = factor of actuator 0 at level l0 times factor of actuator 1 at level l1. */
static void make_columns(lh_action_scratch *scratch, int32_t units) {
    for (int32_t j = 0; j < units; j++) {
        float *restrict column = scratch->column[j];
        float reverse = scratch->factor[0][0][j];
        float still = scratch->factor[0][1][j];
        float forward = scratch->factor[0][2][j];
        for (int32_t level = 0; level < LH_ACTION_LEVELS; level++) {
            float second = scratch->factor[1][level][j];
            *column++ = reverse * second;
            *column++ = still * second;
            *column++ = forward * second;
        }
    }
}

/* Vectors of a row whose sums go side by side: all of them, or three single floats where there are no vectors. */
#define SPAN (LH_VECTOR_WIDTH == 1 ? 3 : (COLUMNS + LH_VECTOR_WIDTH - 1) / LH_VECTOR_WIDTH)

_Static_assert(LH_VECTOR_WIDTH == 1 || SPAN * LH_VECTOR_WIDTH <= LH_COLUMN_SLOTS, "columns are read by whole vectors");

/* block[r][c] = sum over units of row[r][j] column[j][c], in the order of the units: a product of matrices whose sums
 * stay in registers. */
static void contract(const lh_action_scratch *scratch, int32_t units, float (*block)[LH_COLUMN_SLOTS]) {
    for (int32_t first = 0; first < COLUMNS; first += SPAN * LH_VECTOR_WIDTH) {
        lh_vector sum[LH_ACTION_LEVELS][SPAN];
        memset(sum, 0, sizeof sum);
        for (int32_t j = 0; j < units; j++) {
            const lh_vector *part = (const lh_vector *)&scratch->column[j][first];
#pragma GCC unroll 3
            for (int32_t r = 0; r < LH_ACTION_LEVELS; r++) {
#pragma GCC unroll 3
                for (int32_t v = 0; v < SPAN; v++) {
                    sum[r][v] += scratch->row[r][j] * part[v];
                }
            }
        }
        for (int32_t r = 0; r < LH_ACTION_LEVELS; r++) {
            memcpy(&block[r][first], sum[r], sizeof sum[r]);
        }
    }
}

/* f_jk of all levels and actuators, and weighted[j] = w_j m_j(s). */
static void factorise(const lh_network *network, const float *states, int32_t num_states, int32_t end,
                      lh_action_scratch *scratch, float *restrict weighted) {
    int32_t n = network->inputs - num_states;
    lh_network_precisions(network, scratch->precision);
    measure_states(network, states, num_states, end, scratch->precision, scratch->square, scratch->quarter);
    for (int32_t k = 0; k < n; k++) {
        relative_gaussians(network->centre[num_states + k], scratch->precision, scratch->quarter, end, scratch->square,
                           scratch->factor[k][0], scratch->factor[k][1], scratch->factor[k][2]);
    }
    /* an actuator that is not there has one level */
    for (int32_t k = n; k < BLOCK_ACTUATORS; k++) {
        memset(scratch->factor[k], 0, sizeof scratch->factor[k]);
        for (int32_t j = 0; j < end; j++) {
            scratch->factor[k][0][j] = 1.0f;
        }
    }
    for (int32_t j = 0; j < end; j++) {
        weighted[j] = network->weight[j] * lh_decay(scratch->square[j] * scratch->precision[j]);
    }
}

/* Copies what there is of a block to q[count]; returns the largest, or `largest`. */
static float copy_block(float (*block)[LH_COLUMN_SLOTS], int32_t count, float *q, float largest) {
    for (int32_t first = 0; first < BLOCK && first < count; first += COLUMNS) {
        const float *row = block[first / COLUMNS];
        for (int32_t c = 0; c < COLUMNS && first + c < count; c++) {
            largest = row[c] > largest ? row[c] : largest;
            q[first + c] = row[c];
        }
    }
    return largest;
}

/* Goes through the blocks like a counter whose digits are the levels of actuators 3 and up: where only lower digits
 * change, the products of the higher ones stay as they are. */
float lh_action_values(const lh_network *network, const float *states, int32_t num_states, lh_action_scratch *scratch,
                       float *q) {
    int32_t n = network->inputs - num_states;
    int32_t top = n > BLOCK_ACTUATORS ? n : BLOCK_ACTUATORS;
    int32_t end = lh_end_of_units(network->units);
    /* [k]: weight times the factors of actuators BLOCK_ACTUATORS + k to n - 1 */
    float product[LH_FACTOR_SLOTS + 1 - BLOCK_ACTUATORS][LH_UNIT_SLOTS];
    factorise(network, states, num_states, end, scratch, product[top - BLOCK_ACTUATORS]);
    make_columns(scratch, network->units);

    float largest = -FLT_MAX;
    int32_t num_actions = lh_action_count(n);
    int8_t levels[LH_FACTOR_SLOTS] = {0};
    int32_t changed = top - 1; /* the highest digit that differs from the last block */
    for (int32_t first = 0; first < num_actions; first += BLOCK) {
        for (int32_t k = changed; k >= BLOCK_ACTUATORS; --k) {
            multiply(product[k - BLOCK_ACTUATORS + 1], scratch->factor[k][levels[k]], end,
                     product[k - BLOCK_ACTUATORS]);
        }
        make_rows(product[0], scratch, end);
        float block[LH_ACTION_LEVELS][LH_COLUMN_SLOTS];
        contract(scratch, network->units, block);
        largest = copy_block(block, num_actions - first, &q[first], largest);
        changed = BLOCK_ACTUATORS;
        while (changed < top && ++levels[changed] == LH_ACTION_LEVELS) {
            levels[changed++] = 0;
        }
    }
    return largest;
}
