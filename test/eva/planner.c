/* What Frama-C's EVA analyses of a planner: any number of decisions, as step.c has them, with a crawler and a joint of
 * the arm under control, and one node backed up in turn. */
#include <__fc_builtin.h>

#include "crawler.h"

static lh_controller controller; /* also what EVA starts from: all 0 */

static void restore(void) {
    static lh_learned learned;
    Frama_C_make_unknown((char *)&learned, sizeof learned);
    lh_controller_restore(&controller, &learned, Frama_C_interval(INT32_MIN, INT32_MAX));
}

static void step(void) {
    lh_state state;
    lh_decision decision;
    Frama_C_make_unknown((char *)&state, sizeof state);
    if (lh_controller_step(&controller, &state, &decision) == LH_OK && !decision.observed.reset) {
        //@ assert 0 <= decision.choice.action < 9;
        //@ assert 0 <= decision.intervention.action < 9;
    }
}

static void hold(void) {
    lh_decision decision;
    lh_controller_hold(&controller, &decision);
}

int main(void) {
    lh_config config = lh_config_default();
    config.learner.kind = LH_PLANNER;
    config.monitor.active = Frama_C_interval(0, 1);
    config.learner.learn = Frama_C_interval(0, 1);
    config.learner.greedy = Frama_C_interval(0, 1);
    config.learner.planner.mechanics = Frama_C_interval(0, 1);
    config.learner.planner.candidates = 2;
    config.learner.planner.sweeps = 0;
    config.learner.planner.backups = 1;
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = {.count = 2, .index = {1, 3}};
    if (lh_controller_init(&controller, &config, &robot, &controlled) != LH_OK) {
        return 1;
    }
    const lh_shapes shapes = crawler_shapes();
    if (lh_controller_keep_apart(&controller, &shapes) != LH_OK) {
        return 1;
    }
    //@ loop unroll 0; loop widen_hints controller.task.episode.steps, 1999;
    while (Frama_C_interval(0, 1)) {
        switch (Frama_C_interval(0, 5)) {
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
            default:
                step();
                break;
        }
    }
    return 0;
}
