#include "limphome/safety/plausibility.h"

#include <string.h>

#include "limphome/base/elementary.h"

void lh_place_of(const lh_robot *robot, const lh_state *state, const lh_place *before, lh_place *place) {
    memset(place, 0, sizeof *place);
    memcpy(place->position, state->position, sizeof place->position);
    place->attitude = lh_quat_normalise(state->orientation);
    for (int32_t k = 0; k < robot->num_actuators; k++) {
        if (robot->actuators[k].kind == LH_JOINT) {
            place->joint[k] = state->actuator_failed[k] == 0 ? state->actuator_position[k] : before->joint[k];
        }
    }
}

static float square_of_way(const float *a, const float *b) {
    float x = b[0] - a[0];
    float y = b[1] - a[1];
    float z = b[2] - a[2];
    return x * x + y * y + z * z;
}

/* Whether the rotation from one to the other is by no more than `limit`, whichever sign either has. */
static bool is_turned_within(lh_quat a, lh_quat b, float limit) {
    float cosine = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z; /* of half the angle */
    return lh_magnitude(cosine) >= lh_cos(0.5f * lh_clip(limit, 0.0f, LH_PI));
}

bool lh_place_follows(const lh_robot *robot, const lh_jump_limits *limits, const lh_place *a, const lh_place *b) {
    bool follows = square_of_way(a->position, b->position) <= limits->position * limits->position &&
                   is_turned_within(a->attitude, b->attitude, limits->attitude);
    for (int32_t k = 0; k < robot->num_actuators; k++) {
        follows = follows && lh_magnitude(b->joint[k] - a->joint[k]) <= limits->joint;
    }
    return follows;
}

void lh_plausibility_begin(lh_plausibility *plausibility) {
    plausibility->known = false;
    plausibility->agreeing = 0;
}

bool lh_plausibility_check(lh_plausibility *plausibility, const lh_robot *robot, const lh_jump_limits *limits,
                           const lh_state *state) {
    lh_place place;
    lh_place_of(robot, state, &plausibility->believed, &place);
    if (plausibility->known && !lh_place_follows(robot, limits, &plausibility->believed, &place)) {
        bool agrees = plausibility->agreeing > 0 && lh_place_follows(robot, limits, &plausibility->doubtful, &place);
        plausibility->agreeing = agrees ? plausibility->agreeing + 1 : 1;
        plausibility->doubtful = place;
        if (plausibility->agreeing < LH_AGREEING_STATES) {
            return false;
        }
    }
    plausibility->known = true;
    plausibility->agreeing = 0;
    plausibility->believed = place;
    return true;
}
