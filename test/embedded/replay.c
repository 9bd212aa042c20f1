/* Takes the decisions of a recorded run again: decisions.bin receives each of them, learner.bin all that the learner
 * holds after the last. On every platform both must have the same bytes. */
#include <stddef.h>
#include <string.h>

#include "limphome/task/action.h"
#include "platform.h"
#include "recording.h"

static recorded_decision record(const lh_decision *d, int32_t num_controlled) {
    recorded_decision r = {
        .episode = d->observed.episode,
        .step = d->observed.step,
        .learned = d->choice.learned,
        .action = d->choice.action,
        .q = d->choice.q,
        .q_max = d->choice.q_max,
        .probability = d->choice.probability,
        .temperature = d->choice.temperature,
        .td_error = d->choice.td_error,
        .reward_motion = d->observed.reward.motion,
        .reward_goal = d->observed.reward.goal,
        .reward_stability = d->observed.reward.stability,
        .reward_tumble = d->observed.reward.tumble,
        .stability_margin = d->observed.stability_margin,
        .goal_distance = d->observed.goal_distance,
        .lateral_error = d->observed.lateral_error,
        .heading_error = d->observed.heading_error,
    };
    memcpy(r.inputs, d->observed.inputs, sizeof d->observed.inputs);
    if (!d->observed.reset) {
        lh_action_inputs(d->choice.action, num_controlled, r.inputs + d->observed.num_inputs);
    }
    return r;
}

/* All that Q-learning holds but the configuration, whose padding has no definite value, and the scratch, whose layout
 * may differ. */
static bool write_q_learning(int file, const lh_q_learning *learner) {
    const size_t begin = offsetof(lh_q_learning, num_states);
    return platform_write(file, (const char *)learner + begin, offsetof(lh_q_learning, scratch) - begin);
}

static bool save_learner(const lh_learner *learner) {
    const int file = platform_open("learner.bin", true);
    switch (learner->kind) {
        case LH_Q_LEARNING:
            return write_q_learning(file, &learner->as.q_learning);
        case LH_PLANNER:
            return platform_write(file, &learner->as.planner.learned, sizeof learner->as.planner.learned);
    }
    return false;
}

int main(void) {
    static lh_controller controller; /* too large for a comfortable stack */
    int32_t count;
    const int states = recording_open(&controller, &count);
    if (states < 0) {
        return 1;
    }
    const int decisions = platform_open("decisions.bin", true);
    for (int i = 0; i < count; i++) {
        lh_state state;
        lh_decision decision;
        if (!recording_next(states, &state) || lh_controller_step(&controller, &state, &decision) != LH_OK) {
            platform_say("a state is missing or not valid\n");
            return 1;
        }
        const recorded_decision recorded = record(&decision, controller.task.controlled.count);
        if (!platform_write(decisions, &recorded, sizeof recorded)) {
            platform_say("cannot write\n");
            return 1;
        }
    }
    return save_learner(&controller.learner) ? 0 : 1;
}
