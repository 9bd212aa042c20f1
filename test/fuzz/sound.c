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
}

/* Each level that is executed is the one chosen, or still; only with a reason, which the mask tells of. */
static void expect_sound_intervention(const lh_controller *controller, const lh_decision *decision) {
    const lh_task *task = &controller->task;
    const lh_intervention *made = &decision->intervention;
    int8_t chosen[LH_MAX_ACTUATORS];
    int8_t executed[LH_MAX_ACTUATORS];
    float velocity[LH_MAX_ACTUATORS] = {0.0f};
    uint32_t stilled = 0;
    lh_action_levels(decision->choice.action, task->controlled.count, chosen);
    lh_action_levels(made->action, task->controlled.count, executed);
    for (int32_t k = 0; k < task->controlled.count; k++) {
        FUZZ_EXPECT(executed[k] == chosen[k] || executed[k] == LH_STILL);
        stilled |= executed[k] != chosen[k] ? (uint32_t)1 << task->controlled.index[k] : 0;
    }
    FUZZ_EXPECT(made->stilled == stilled && (made->hazards != 0 || made->action == decision->choice.action));
    lh_task_velocities(task, made->action, velocity);
    FUZZ_EXPECT(memcmp(decision->velocity, velocity, sizeof velocity) == 0);
}

static void expect_held(const lh_controller *controller, const lh_decision *decision, lh_hazard hazard) {
    static const float still[LH_MAX_ACTUATORS];
    FUZZ_EXPECT(memcmp(decision->velocity, still, sizeof still) == 0);
    FUZZ_EXPECT(decision->intervention.hazards == (uint32_t)hazard && decision->intervention.stilled != 0);
    FUZZ_EXPECT(!decision->choice.learned && !decision->observed.reset && !decision->observed.stepped);
    FUZZ_EXPECT(controller->task.gap);
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
        expect_sound_intervention(controller, decision);
    }
    expect_sound_learner(&controller->learner, decision->observed.episode);
}

void fuzz_step(lh_controller *controller, const lh_state *state) {
    static lh_controller before; /* large for a stack */
    lh_decision decision;
    memset(&decision, 0xa5, sizeof decision);
    memcpy(&before, controller, sizeof before);
    const bool valid = lh_controller_step(controller, state, &decision) == LH_OK;
    const bool held = !valid || (decision.intervention.hazards & LH_HAZARD_JUMP) != 0;
    if (held) {
        expect_held(controller, &decision, valid ? LH_HAZARD_JUMP : LH_HAZARD_INVALID);
        FUZZ_EXPECT(memcmp(&controller->learner, &before.learner, sizeof before.learner) == 0);
    } else {
        expect_sound(controller, &decision);
    }
}

/* What may come between two states. */
static void fuzz_between(lh_controller *controller, uint8_t what) {
    lh_decision decision;
    switch (what) {
        case 1:
            lh_controller_begin(controller);
            break;
        case 2:
            lh_controller_gap(controller);
            break;
        case 3:
            lh_controller_resume(controller, controller->task.episode.number);
            break;
        case 4:
            lh_controller_hold(controller, &decision);
            expect_held(controller, &decision, LH_HAZARD_STALE);
            break;
        case 5:
            lh_controller_guard(controller);
            break;
        default:
            break;
    }
}

void fuzz_steps(fuzz_input *in, lh_controller *controller, const lh_state *good) {
    lh_state state = *good;
    for (int i = 0; i < LARGEST_NUMBER_OF_STEPS && in->size > 0; i++) {
        const uint8_t what = fuzz_byte(in);
        if (what & 1) {
            state = *good; /* else the words overwritten before stay */
        }
        fuzz_between(controller, what >> 1 & 7);
        fuzz_patch(in, &state, sizeof state, sizeof(float));
        fuzz_step(controller, &state);
    }
}
