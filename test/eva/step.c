/* What Frama-C's EVA analyses: any number of decisions, each on a state of which every bit is unknown, with beginnings
 * anew and restored networks and random states, of which every bit is unknown too, in between. */
#include <__fc_builtin.h>

#include "crawler.h"

static lh_controller controller; /* also what EVA starts from: all 0 */

static void restore(void) {
    static lh_learned learned;
    Frama_C_make_unknown((char *)&learned, sizeof learned);
    lh_controller_restore(&controller, &learned, Frama_C_interval(INT32_MIN, INT32_MAX));
}

/* Any path that is valid: taken by the controller as it is, since a check of it would part the states needlessly. */
static void choose_path(lh_path_config *path) {
    path->kind = Frama_C_interval(LH_PATH_ROLLING, LH_PATH_WAYPOINTS);
    path->num_waypoints = Frama_C_interval(1, LH_MAX_WAYPOINTS);
    for (int i = 0; i < LH_MAX_WAYPOINTS; i++) {
        path->waypoint[i].x = Frama_C_float_interval(-LH_WAYPOINT_MAX, LH_WAYPOINT_MAX);
        path->waypoint[i].y = Frama_C_float_interval(-LH_WAYPOINT_MAX, LH_WAYPOINT_MAX);
    }
}

static void step(void) {
    lh_state state;
    lh_decision decision;
    Frama_C_make_unknown((char *)&state, sizeof state);
    if (lh_controller_step(&controller, &state, &decision) == LH_OK && !decision.observed.reset) {
        //@ assert 0 <= decision.choice.action < controller.learner.as.q_learning.num_actions;
        //@ assert 0 <= decision.intervention.action < controller.learner.as.q_learning.num_actions;
    }
}

static void drive(void) {
    lh_state state;
    lh_decision decision;
    int8_t direction[LH_MAX_ACTUATORS];
    Frama_C_make_unknown((char *)&state, sizeof state);
    Frama_C_make_unknown((char *)direction, sizeof direction);
    if (lh_controller_drive(&controller, &state, direction, &decision) == LH_OK) {
        //@ assert 0 <= decision.choice.action < controller.learner.as.q_learning.num_actions;
    }
}

static void hold(void) {
    lh_decision decision;
    lh_controller_hold(&controller, &decision);
}

int main(void) {
    lh_config config = lh_config_default();
    config.monitor.active = Frama_C_interval(0, 1);
    config.learner.learn = Frama_C_interval(0, 1);
    config.learner.greedy = Frama_C_interval(0, 1);
    config.task.reward.heading_error = Frama_C_interval(0, 1);
    config.learner.q_learning.network.exact_gradient = Frama_C_interval(0, 1);
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    if (lh_controller_init(&controller, &config, &robot, &controlled) != LH_OK) {
        return 1;
    }
    const lh_shapes shapes = crawler_shapes();
    if (lh_controller_keep_apart(&controller, &shapes) != LH_OK) {
        return 1;
    }
    choose_path(&controller.task.config.path);
    /* not unrolled, as it has no end; a bound for EVA to try, below the limit of steps */
    //@ loop unroll 0; loop widen_hints controller.task.episode.steps, 1999;
    while (Frama_C_interval(0, 1)) {
        switch (Frama_C_interval(0, 6)) {
            case 0:
                lh_controller_begin(&controller);
                break;
            case 1:
                restore();
                break;
            case 2:
                lh_controller_gap(&controller);
                break;
            case 3:
                lh_controller_resume(&controller, Frama_C_interval(1, LH_LAST_EPISODE));
                break;
            case 4:
                hold();
                break;
            case 5:
                drive();
                break;
            default:
                step();
                break;
        }
    }
    return 0;
}
