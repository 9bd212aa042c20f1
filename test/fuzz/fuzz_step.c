/* lh_controller_step: any bit pattern of lh_state, step after step. */
#include "crawler.h"
#include "sound.h"

/* A path of any waypoints within 32 m. */
static lh_path_config varied_path(fuzz_input *in) {
    lh_path_config path = {.kind = (lh_path_kind)(fuzz_byte(in) % 3), .num_waypoints = 1 + fuzz_byte(in) % 3};
    for (int32_t i = 0; i < path.num_waypoints; i++) {
        path.waypoint[i].x = ((float)fuzz_byte(in) - 128.0f) / 4.0f;
        path.waypoint[i].y = ((float)fuzz_byte(in) - 128.0f) / 4.0f;
    }
    return path;
}

static lh_config varied(uint8_t choices) {
    lh_config config = lh_config_default();
    config.learner.learn = (choices & 1) == 0;
    config.learner.greedy = (choices & 2) != 0;
    config.learner.q_learning.network.exact_gradient = (choices & 4) != 0;
    config.task.reward.heading_error = (choices & 8) != 0;
    config.task.episode.step_limit = (choices & 16) != 0 ? 3 : 200;
    config.task.episode.reset_every = (choices & 32) != 0 ? 1 : 50;
    config.learner.q_learning.network.initial_weight = (choices & 64) != 0 ? -1e4f : 0.0f;
    config.learner.q_learning.network.rate_width = (choices & 128) != 0 ? 10.0f : 0.01f;
    return config;
}

/* One that plans little, as here it is the number of steps that counts. */
static lh_learner_config varied_planner(const lh_learner_config *standard, uint8_t choices) {
    lh_learner_config config = *standard;
    config.kind = (choices & 1) != 0 ? LH_PLANNER : LH_Q_LEARNING;
    config.planner.mechanics = (choices & 2) != 0;
    config.planner.caution = (choices & 8) != 0 ? LH_PLANNER_WEIGHT_MAX : 1.0f;
    config.planner.candidates = (choices & 4) != 0 ? 1 : 2;
    config.planner.sweeps = 0; /* slow, and no more than what steps do */
    config.planner.backups = 1;
    config.planner.steering = (choices & 16) != 0 ? LH_PLANNER_WEIGHT_MAX : 1.5f;
    config.planner.random_share = (choices & 32) != 0 ? 1.0f : 0.02f;
    config.planner.discount_rate = (choices & 64) != 0 ? LH_DISCOUNT_RATE_MAX : 0.99f;
    return config;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static lh_controller controller;
    fuzz_input in = {data, size};
    lh_config config = varied(fuzz_byte(&in));
    config.learner = varied_planner(&config.learner, fuzz_byte(&in));
    config.task.path = varied_path(&in);
    const lh_robot robot = crawler_robot();
    const lh_controlled controlled = crawler_controlled();
    FUZZ_EXPECT(lh_controller_init(&controller, &config, &robot, &controlled) == LH_OK);
    const lh_state good = crawler_state(0.0f, 0.0f, 1.5f);
    fuzz_steps(&in, &controller, &good);
    return 0;
}
