#include "limphome/learning/motion_model.h"

#include <string.h>

#include "limphome/base/elementary.h"

#define UNITS_PER_WIDTH 512.0f                 /* of a coordinate of a posture, per width of the kernel */
#define UNIT_SQUARE (1.0f / (512.0f * 512.0f)) /* brings a squared distance to kernel widths */
#define NARROW_SQUARE (512u * 512u)            /* squared distance where the narrow kernel ends: 1 width */
#define WIDE_SQUARE (4u * 512u * 512u)         /* and the wide one: 2 widths */
#define SAME_SQUARE (9u * 512u * 512u / 100u)  /* within it a measurement is of the same posture: 0.3 widths */
#define MOTION_UNITS 16384.0f                  /* of a motion, per m, rad or 1 */
#define COORDINATE_MAX 32000.0f                /* so that the sum of three squares fits into 32 bits */
#define WIDE_WEIGHT 0.1f                       /* of the wide kernel's answer against the narrow one */
#define BLOCK 16                               /* samples whose distances are taken at a time: vector code */

_Static_assert(LH_MAX_SAMPLES % BLOCK == 0, "a block lies within the samples");

void lh_motion_model_init(lh_motion_model *model, int32_t num_actions, int32_t num_joints, const float *low,
                          const float *width, float prior_weight) {
    memset(model, 0, sizeof *model);
    model->prior_weight = prior_weight;
    model->num_actions = num_actions;
    model->num_joints = num_joints;
    for (int32_t k = 0; k < num_joints; k++) {
        model->low[k] = low[k];
        model->width[k] = width[k];
    }
}

static void coordinates(const lh_motion_model *model, const float *angle, int16_t *posture) {
    for (int32_t k = 0; k < LH_PLANNED_JOINTS; k++) {
        posture[k] = 0;
        if (k < model->num_joints) {
            float scaled = (angle[k] - model->low[k]) / model->width[k] * UNITS_PER_WIDTH;
            posture[k] = lh_round_16(lh_clip(scaled, -UNITS_PER_WIDTH, COORDINATE_MAX));
        }
    }
}

/* Squared distances of BLOCK samples from `first` on, in units of a coordinate. */
static inline void distances(const lh_motion_model *model, const int16_t *posture, int32_t first, uint32_t *square) {
    for (int32_t i = 0; i < BLOCK; i++) {
        uint32_t d0 = (uint32_t)(model->posture[0][first + i] - posture[0]);
        uint32_t d1 = (uint32_t)(model->posture[1][first + i] - posture[1]);
        uint32_t d2 = (uint32_t)(model->posture[2][first + i] - posture[2]);
        square[i] = d0 * d0 + d1 * d1 + d2 * d2; /* of negative ones, too, modulo 2^32 */
    }
}

/* The sample of `action` nearest to `posture` within SAME_SQUARE, or -1. */
static int32_t find_same(const lh_motion_model *model, int32_t action, const int16_t *posture) {
    uint32_t least = SAME_SQUARE;
    int32_t found = -1;
    for (int32_t first = 0; first < model->num_samples; first += BLOCK) {
        uint32_t square[BLOCK];
        distances(model, posture, first, square);
        for (int32_t i = 0; i < BLOCK && first + i < model->num_samples; i++) {
            if (square[i] < least && model->action[first + i] == action) {
                least = square[i];
                found = first + i;
            }
        }
    }
    return found;
}

static int32_t place_for_new(lh_motion_model *model) {
    if (model->num_samples < LH_MAX_SAMPLES) {
        return model->num_samples++;
    }
    int32_t oldest = 0;
    for (int32_t i = 1; i < LH_MAX_SAMPLES; i++) {
        oldest = model->updated[i] < model->updated[oldest] ? i : oldest;
    }
    return oldest;
}

static int16_t towards(int16_t from, int16_t to, float share) {
    return lh_round_16((float)from + share * (float)(to - from));
}

void lh_motion_model_insert(lh_motion_model *model, int32_t action, const float *angle, const lh_motion *difference,
                            int32_t now) {
    int16_t posture[LH_PLANNED_JOINTS];
    coordinates(model, angle, posture);
    const float parts[LH_MOTION_PARTS] = {difference->forward, difference->sideways, difference->turn,
                                          difference->moved};

    int32_t place = find_same(model, action, posture);
    if (place < 0) {
        place = place_for_new(model);
        model->action[place] = (int16_t)action;
        model->count[place] = 0;
    }
    float share = 1.0f / (float)(model->count[place] + 1);
    for (int32_t k = 0; k < LH_PLANNED_JOINTS; k++) {
        model->posture[k][place] = towards(model->posture[k][place], posture[k], share);
    }
    for (int32_t k = 0; k < LH_MOTION_PARTS; k++) {
        int16_t part = lh_round_16(lh_clip(parts[k], -1.99f, 1.99f) * MOTION_UNITS);
        model->motion[k][place] = towards(model->motion[k][place], part, share);
    }
    if (model->count[place] < LH_SAMPLE_COUNT_MAX) {
        model->count[place]++;
    }
    model->updated[place] = now;
}

static inline void add_sample(const lh_motion_model *model, int32_t sample, uint32_t square, lh_motion_sums *sums) {
    float count = (float)model->count[sample];
    float distance = (float)square * UNIT_SQUARE;
    float wide = 1.0f - 0.25f * distance;
    wide *= wide * count;
    sums->wide_weight += wide;
    for (int32_t k = 0; k < LH_MOTION_PARTS; k++) {
        sums->wide[k] += wide * (float)model->motion[k][sample];
    }
    if (square < NARROW_SQUARE) {
        float narrow = 1.0f - distance;
        narrow *= narrow * count;
        sums->narrow_weight += narrow;
        for (int32_t k = 0; k < LH_MOTION_PARTS; k++) {
            sums->narrow[k] += narrow * (float)model->motion[k][sample];
        }
    }
}

void lh_motion_model_gather(const lh_motion_model *model, const float *angle, lh_motion_sums *sums) {
    memset(sums, 0, sizeof sums[0] * (size_t)model->num_actions);
    int16_t posture[LH_PLANNED_JOINTS];
    coordinates(model, angle, posture);
    for (int32_t first = 0; first < model->num_samples; first += BLOCK) {
        uint32_t square[BLOCK];
        distances(model, posture, first, square);
        for (int32_t i = 0; i < BLOCK && first + i < model->num_samples; i++) {
            if (square[i] < WIDE_SQUARE) {
                add_sample(model, first + i, square[i], &sums[model->action[first + i]]);
            }
        }
    }
}

void lh_motion_model_correct(const lh_motion_model *model, const lh_motion_sums *sums, lh_motion *motion) {
    float *part[LH_MOTION_PARTS] = {&motion->forward, &motion->sideways, &motion->turn, &motion->moved};
    float wide_share = WIDE_WEIGHT / (model->prior_weight + sums->wide_weight);
    float narrow_share = 1.0f / ((WIDE_WEIGHT + sums->narrow_weight) * MOTION_UNITS);
    for (int32_t k = 0; k < LH_MOTION_PARTS; k++) {
        *part[k] += (wide_share * sums->wide[k] + sums->narrow[k]) * narrow_share;
    }
}

static bool is_of_same_kind(const lh_motion_model *saved, const lh_motion_model *model) {
    bool same = saved->num_actions == model->num_actions && saved->num_joints == model->num_joints &&
                saved->prior_weight == model->prior_weight;
    for (int32_t k = 0; k < LH_PLANNED_JOINTS; k++) {
        same = same && saved->low[k] == model->low[k] && saved->width[k] == model->width[k];
    }
    return same;
}

bool lh_motion_model_fits(const lh_motion_model *saved, const lh_motion_model *model) {
    if (!is_of_same_kind(saved, model) || saved->num_samples < 0 || saved->num_samples > LH_MAX_SAMPLES) {
        return false;
    }
    /* those that are not used, too, so that each is in range by itself */
    for (int32_t i = 0; i < LH_MAX_SAMPLES; i++) {
        int32_t least_count = 0;
        if (i < saved->num_samples) {
            least_count = 1;
        }
        if (saved->action[i] < 0 || saved->action[i] >= model->num_actions || saved->count[i] < least_count ||
            saved->count[i] > LH_SAMPLE_COUNT_MAX) {
            return false;
        }
        for (int32_t k = 0; k < LH_PLANNED_JOINTS; k++) {
            if (saved->posture[k][i] < -(int16_t)UNITS_PER_WIDTH || saved->posture[k][i] > (int16_t)COORDINATE_MAX) {
                return false;
            }
        }
    }
    return true;
}
