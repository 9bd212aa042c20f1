/* A controller of the crawler, and steps of it that must succeed. */
#ifndef LIMPHOME_TEST_STEPS_H
#define LIMPHOME_TEST_STEPS_H

#include "crawler.h"
#include "test.h"

static const float facing_y = (float)M_PI_2;

static inline void init(lh_controller *c, const lh_config *config) {
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    ck_assert_int_eq(lh_controller_init(c, config, &robot, &controlled), LH_OK);
}

static inline lh_decision step(lh_controller *c, const lh_state *state) {
    lh_decision decision;
    ck_assert_int_eq(lh_controller_step(c, state, &decision), LH_OK);
    return decision;
}

/* The level robot at (x, y) facing +y. */
static inline lh_decision step_at(lh_controller *c, float x, float y) {
    const lh_state state = crawler_state(x, y, facing_y);
    return step(c, &state);
}

/* 0.5 m ahead, turned about an axis of the body by 1.2 rad. */
static inline lh_state tumbled_state(lh_vec3 axis) {
    lh_state state = crawler_state(0.0f, 0.5f, facing_y);
    state.orientation = lh_quat_multiply(state.orientation, lh_quat_about(axis, 1.2f));
    return state;
}

static inline const lh_network *network_of(const lh_controller *c) {
    return &c->learner.as.q_learning.network;
}

#endif
