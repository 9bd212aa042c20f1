/* What Frama-C's EVA analyses: any number of decisions, each on a state of which every bit is unknown. */
#include <__fc_builtin.h>

#include "crawler.h"

static lh_controller controller; /* also what EVA starts from: all 0 */

int main(void) {
    lh_config config = lh_config_default();
    config.learn = Frama_C_interval(0, 1);
    config.greedy = Frama_C_interval(0, 1);
    config.reward.heading_error = Frama_C_interval(0, 1);
    config.learner.network.exact_gradient = Frama_C_interval(0, 1);
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    if (lh_controller_init(&controller, &config, &robot, &controlled) != LH_OK) {
        return 1;
    }
    /*@ loop unroll 0; */
    while (Frama_C_interval(0, 1)) {
        lh_state state;
        lh_decision decision;
        Frama_C_make_unknown((char *)&state, sizeof state);
        lh_controller_step(&controller, &state, &decision);
    }
    return 0;
}
