/* lh_controller_init: any bit pattern of configuration, robot and choice of actuators is either refused or gives a
 * controller that is sound for any bit pattern of states. */
#include <string.h>

#include "crawler.h"
#include "sound.h"

typedef struct setup {
    lh_config config;
    lh_robot robot;
    lh_controlled controlled;
} setup;

/* A bool of C is 0 or 1; another bit pattern is not a value that a caller can give. */
static void make_bool(bool *flag) {
    uint8_t byte;
    memcpy(&byte, flag, 1);
    *flag = (byte & 1) != 0;
}

static void make_bools(lh_config *config) {
    make_bool(&config->learner.learn);
    make_bool(&config->learner.greedy);
    make_bool(&config->task.reward.heading_error);
    make_bool(&config->learner.q_learning.network.exact_gradient);
    make_bool(&config->learner.planner.mechanics);
    make_bool(&config->monitor.active);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static lh_controller controller;
    setup given;
    memset(&given, 0, sizeof given);
    given.config = lh_config_default();
    given.config.learner.planner.sweeps = 0; /* slow, and no more than what steps do */
    given.robot = crawler_robot();
    given.controlled = crawler_controlled();
    fuzz_input in = {data, size};
    given.config.learner.kind = (fuzz_byte(&in) & 1) != 0 ? LH_PLANNER : LH_Q_LEARNING;
    fuzz_patch(&in, &given, sizeof given, sizeof(float));
    make_bools(&given.config);
    if (lh_controller_init(&controller, &given.config, &given.robot, &given.controlled) == LH_OK) {
        lh_state good = crawler_state(0.0f, 0.0f, 1.5f);
        good.num_actuators = given.robot.num_actuators;
        fuzz_steps(&in, &controller, &good);
    }
    return 0;
}
