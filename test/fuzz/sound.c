#include "sound.h"

#include <string.h>

enum { LARGEST_NUMBER_OF_STEPS = 64 };

static bool finite(const float *values, int32_t count) {
    bool good = true;
    for (int32_t i = 0; i < count; i++) {
        good = good && lh_finite(values[i]);
    }
    return good;
}

/* Every term is finite where their sum is. */
static bool finite_reward(const lh_reward *reward) {
    return lh_finite(lh_reward_total(reward));
}

/* What it holds can be saved and taken up again: all of it is in range. */
static void expect_sound_planner(const lh_planner *planner) {
    static lh_planner other;
    static lh_planner_learned learned;
    memcpy(&other, planner, sizeof other);
    lh_planner_save(planner, &learned);
    FUZZ_EXPECT(lh_planner_restore(&other, &learned) == LH_OK);
    FUZZ_EXPECT(planner->action >= 0 && planner->action < planner->planned.num_actions);
}

/* What each kind of learner keeps to, beside what all do. */
static void expect_sound_learner(const lh_learner *learner, int32_t episode) {
    switch (learner->kind) {
        case LH_Q_LEARNING: {
            const lh_q_learning *kind = &learner->as.q_learning;
            FUZZ_EXPECT(lh_learner_temperature(learner, episode) >= kind->config.temperature_floor);
            FUZZ_EXPECT(lh_network_validate(&kind->network, &kind->config.network) == LH_OK);
            break;
        }
        case LH_PLANNER:
            FUZZ_EXPECT(lh_learner_temperature(learner, episode) == 0.0f);
            expect_sound_planner(&learner->as.planner);
            break;
    }
}

static void expect_sound_summary(const lh_controller *controller, const lh_summary *summary) {
    const float values[] = {summary->lateral_error,
                            summary->heading_change,
                            summary->start.x,
                            summary->start.y,
                            summary->start.heading,
                            summary->line_heading,
                            summary->start_lateral_error,
                            summary->goal_distance,
                            summary->waypoint_distance};
    FUZZ_EXPECT(finite(values, 9) && finite_reward(&summary->total));
    FUZZ_EXPECT(!summary->arrived || summary->outcome == LH_OUTCOME_GOAL);
    FUZZ_EXPECT(summary->steps >= 1 && summary->steps <= controller->task.config.episode.step_limit);
    FUZZ_EXPECT(summary->outcome > LH_OUTCOME_NONE && summary->outcome <= LH_OUTCOME_TIMEOUT);
    expect_sound_learner(&controller->learner, summary->number);
}

static void expect_sound_choice(const lh_controller *controller, const lh_decision *decision) {
    const lh_choice *choice = &decision->choice;
    FUZZ_EXPECT(choice->action >= 0 && choice->action < lh_action_count(controller->task.controlled.count));
    FUZZ_EXPECT(lh_finite(choice->q) && lh_finite(choice->q_max) && choice->q <= choice->q_max);
    FUZZ_EXPECT(choice->probability > 0.0f && choice->probability <= 1.0f);
    FUZZ_EXPECT(choice->temperature == lh_learner_temperature(&controller->learner, decision->observed.episode));
    FUZZ_EXPECT(decision->observed.num_inputs == controller->task.controlled.count + 2);
    for (int32_t k = 0; k < controller->task.robot.num_actuators; k++) {
        FUZZ_EXPECT(lh_within(decision->velocity[k], -2.0f, 2.0f));
    }
}

static void expect_sound(const lh_controller *controller, const lh_decision *decision) {
    FUZZ_EXPECT(finite_reward(&decision->observed.reward) && lh_finite(decision->choice.td_error));
    FUZZ_EXPECT(lh_finite(decision->observed.stability_margin) && lh_finite(decision->observed.goal_distance));
    FUZZ_EXPECT(lh_finite(decision->observed.lateral_error));
    FUZZ_EXPECT(lh_within(decision->observed.heading_error, -LH_PI, LH_PI));
    FUZZ_EXPECT(lh_finite(decision->observed.waypoint_distance));
    for (int32_t i = 0; i < decision->observed.num_inputs; i++) {
        FUZZ_EXPECT(lh_within(decision->observed.inputs[i], 0.0f, 1.0f));
    }
    if (decision->observed.outcome != LH_OUTCOME_NONE) {
        expect_sound_summary(controller, &decision->observed.summary);
    }
    if (!decision->observed.reset) {
        expect_sound_choice(controller, decision);
    }
    expect_sound_learner(&controller->learner, decision->observed.episode);
}

void fuzz_step(lh_controller *controller, const lh_state *state) {
    static lh_controller before; /* large for a stack */
    lh_decision decision;
    memset(&decision, 0xa5, sizeof decision);
    lh_decision untouched = decision;
    memcpy(&before, controller, sizeof before);
    if (lh_controller_step(controller, state, &decision) == LH_OK) {
        expect_sound(controller, &decision);
    } else {
        FUZZ_EXPECT(memcmp(controller, &before, sizeof before) == 0);
        FUZZ_EXPECT(memcmp(&decision, &untouched, sizeof decision) == 0);
    }
}

void fuzz_steps(fuzz_input *in, lh_controller *controller, const lh_state *good) {
    lh_state state = *good;
    for (int i = 0; i < LARGEST_NUMBER_OF_STEPS && in->size > 0; i++) {
        const uint8_t what = fuzz_byte(in);
        if (what & 1) {
            state = *good; /* else the words overwritten before stay */
        }
        if ((what & 14) == 2) {
            lh_controller_begin(controller);
        }
        fuzz_patch(in, &state, sizeof state, sizeof(float));
        fuzz_step(controller, &state);
    }
}
