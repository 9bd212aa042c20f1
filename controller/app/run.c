#include "run.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "convert.h"
#include "convert_robot.h"

/* The settings that decide what is learned, and the robot. */
static int64_t hash_of(const run *r, const robot_description *robot) {
    return (int64_t)(settings_hash(&r->settings) * 1099511628211u ^ robot->hash);
}

/* An evaluation goes on from the episode after the policy's, so that T of (4) and what is drawn for an episode are
 * those that more training would have met. */
static bool open_policy(run *r, const char *path) {
    if (!run_folder_read_policy(path, &r->learned, r->error)) {
        return false;
    }
    if (r->learned.kind != r->config.learner.kind) {
        return fail_with(r->error, "%.200s: is of another kind than [learner] kind", path);
    }
    const int32_t episode = learned_episode(&r->learned);
    if (episode > LH_LAST_EPISODE - r->last) {
        return fail_with(r->error, "%.200s: is of episode %" PRId32 ", beyond what can be counted", path, episode);
    }
    r->finished = episode;
    r->last += r->finished;
    return true;
}

/* What the run follows from: the robot, the settings that fit it, and what was learned before, if anything. */
static bool read_inputs(run *r, const command_line *line, const robot_description *robot, run_folder_place *place) {
    memset(r, 0, sizeof *r);
    r->settings = line->settings;
    r->last = (int32_t)r->settings.learning.episodes;
    if (!convert_robot(robot, &r->robot, r->error)) {
        return false;
    }
    r->config = convert_config(&r->settings);
    const int left_out = convert_shapes(robot, &r->shapes);
    if (left_out > 0) {
        fprintf(stderr, "robot %s: the monitor knows no collision of %d shapes, for which it has no room\n",
                robot->name, left_out);
    }
    const lh_error bad = lh_config_validate(&r->config);
    if (bad != LH_OK) {
        return fail_with(r->error, "settings: %s", lh_error_text(bad));
    }
    r->hash = hash_of(r, robot);
    r->evaluating = line->evaluate != NULL;
    const int32_t reset_every = r->config.task.episode.reset_every;
    if (line->resume && !run_folder_find(line->out, r->hash, reset_every, place, &r->learned, r->error)) {
        return false;
    }
    r->resuming = line->resume && place->episodes > 0;
    r->finished = line->resume ? place->episodes : 0;
    return !r->evaluating || open_policy(r, line->evaluate);
}

bool run_check(run *r, const command_line *line, const robot_description *robot) {
    run_folder_place place = {0};
    const bool good = read_inputs(r, line, robot, &place);
    if (good && line->resume) {
        printf("goes on after episode %" PRId32 "\n", place.episodes);
    }
    return good;
}

bool run_open(run *r, const command_line *line, const robot_description *robot) {
    run_folder_place place = {0};
    if (!read_inputs(r, line, robot, &place) ||
        !plant_link_open(&r->link, line->lcm_url, &r->settings, &r->folder.recording,
                         r->error)) { /* before there is a folder in the way */
        return false;
    }
    if (!(line->resume ? run_folder_resume(&r->folder, line->out, &place, r->error)
                       : run_folder_create(&r->folder, line->out, r->error))) {
        run_folder_close(&r->folder, r->error);
        bus_close(&r->link.bus);
        return false;
    }
    r->started = bus_now();
    trouble_init(&r->trouble, &r->settings, r->started);
    return true;
}

/* Takes up what was learned before, if anything. */
static bool restore_learner(run *r) {
    if (!r->evaluating && !r->resuming) {
        return true;
    }
    lh_learned restored;
    if (!learned_restore(&r->learned, &r->controller, &restored)) {
        return fail_with(r->error, "what was learned is for other actuators, speeds, ranges, periods or mechanics");
    }
    const lh_error error = lh_controller_restore(&r->controller, &restored, r->finished + 1);
    return error == LH_OK || fail_with(r->error, "what was learned cannot be taken up: %s", lh_error_text(error));
}

/* The first state tells which actuators obey; now the learner can be set up, or taken up where it was left. */
static bool begin_learner(run *r, const limphome_robot_state_t *state) {
    const lh_controlled controlled = convert_controlled(state);
    r->config.learner.learn = !r->evaluating;
    r->config.learner.greedy = r->evaluating && r->settings.evaluation.selection == SETTINGS_GREEDY;
    lh_error error = lh_controller_init(&r->controller, &r->config, &r->robot, &controlled);
    if (error == LH_OK) {
        error = lh_controller_keep_apart(&r->controller, &r->shapes);
    }
    if (error == LH_OK && state->num_actuators != r->robot.num_actuators) {
        error = LH_ERROR_STATE;
    }
    if (error != LH_OK) {
        return fail_with(r->error, "the plant's robot and ours do not go together: %s", lh_error_text(error));
    }
    r->learner_ready = restore_learner(r);
    rollback_keep(&r->kept, &r->controller, r->finished, &r->folder);
    return r->learner_ready;
}

/* The episode that a reset would be followed by. */
static int32_t next_episode(const run *r) {
    return r->learner_ready ? r->controller.task.episode.number : r->finished + 1;
}

/* What has been learned so far, as message and in r->learned. */
static void tell_learned(run *r) {
    learned_save(&r->learned, &r->controller, r->finished, r->utime, r->hash);
    bus_send_policy(&r->link.bus, &r->learned);
}

/* An episode has ended: a row, a message, and a checkpoint where the plant is about to be reset for one. */
static void finish_episode(run *r, const lh_summary *summary, const limphome_robot_state_t *state) {
    r->finished = summary->number;
    const limphome_episode_t episode =
        convert_episode(&r->controller, summary, state, r->settings.episode.decision_period_s);
    bus_send_episode(&r->link.bus, &episode);
    run_folder_episode(&r->folder, &episode, r->error);
    if (!r->evaluating && summary->number % r->config.task.episode.reset_every == 0) {
        tell_learned(r);
        run_folder_checkpoint(&r->folder, &r->learned, r->error);
    }
}

/* A session begins: the robot is where an episode begins, or was put there without our asking, or has stayed where it
 * was. */
static void begin_session(run *r, const limphome_robot_state_t *state) {
    if (state->reset == LIMPHOME_ROBOT_STATE_T_WHERE_IT_IS) {
        lh_controller_resume(&r->controller, next_episode(r));
    } else if (r->restarted) {
        lh_controller_begin(&r->controller);
        rollback_keep(&r->kept, &r->controller, r->finished, &r->folder);
    }
    r->restarted = r->gap = false;
}

/* Nobody puts back a robot that cannot be carried: one that has tumbled lies until somebody has righted it. */
static bool lies(const run *r, const limphome_robot_state_t *state) {
    const lh_state sensed = convert_state(state);
    return state->reset == LIMPHOME_ROBOT_STATE_T_WHERE_IT_IS && !r->controller.task.acting &&
           lh_quat_tilt(lh_quat_normalise(sensed.orientation)) > r->config.task.episode.tumble_tilt;
}

/* Why no decision is due on a state; a constant of status_t. */
static int8_t reason_to_rest(const run *r, const limphome_robot_state_t *state) {
    if (state->lockstep == 0 && state->armed == 0) {
        return LIMPHOME_STATUS_T_NOT_ARMED;
    }
    return lies(r, state) ? LIMPHOME_STATUS_T_TUMBLED : LIMPHOME_STATUS_T_NONE;
}

/* Answers a state, as a sign of life, by rest. */
static void hold(run *r, const limphome_robot_state_t *state) {
    static const float rest[LH_MAX_ACTUATORS];
    plant_link_command(&r->link, state, rest);
    bus_record_state(&r->link.bus, state);
    r->gap = true;
}

/* What he who is in charge decides. */
static lh_error decide_in_charge(run *r, const limphome_robot_state_t *state, lh_decision *decision) {
    const lh_state sensed = convert_state(state);
    const int8_t in_charge = operator_in_charge(&r->link.hand, state->lockstep != 0, bus_now());
    if (in_charge == LIMPHOME_DECISION_T_LEARNER) {
        return lh_controller_step(&r->controller, &sensed, decision);
    }
    return lh_controller_drive(&r->controller, &sensed, operator_directions(&r->link.hand), decision);
}

/* One call of the library. If it refuses the state the robot holds still; the next one may be better. */
static void step(run *r, const limphome_robot_state_t *state, lh_decision *decision) {
    if (r->gap) {
        lh_controller_gap(&r->controller);
    }
    if (state->lockstep == 0) { /* a plant in real time is watched, whatever the settings say */
        lh_controller_guard(&r->controller);
    }
    const lh_error error = decide_in_charge(r, state, decision);
    r->gap = error != LH_OK;
    if (error != LH_OK) {
        r->link.invalid = bus_now();
        notice_print(&r->invalid, bus_now(), "state %" PRId64 ": %s; holding still", state->seq, lh_error_text(error));
    } else {
        const bool nobody = r->link.hand.in_charge == LIMPHOME_DECISION_T_NOBODY;
        trouble_useful(&r->trouble, nobody ? LIMPHOME_STATUS_T_OPERATOR_SILENT : LIMPHOME_STATUS_T_NONE, bus_now());
    }
}

/* Decides on a new state and answers it. The command goes out first: the plant works on while we write the rest. */
static void decide(run *r, const limphome_robot_state_t *state) {
    lh_decision decision = {.velocity = {0}};
    step(r, state, &decision);
    const lh_observed *observed = &decision.observed;
    const bool ended = observed->outcome != LH_OUTCOME_NONE;
    const bool last = ended && observed->summary.number >= r->last;
    if (observed->reset && !last) {
        plant_link_reset(&r->link, next_episode(r));
    } else if (!last) {
        plant_link_command(&r->link, state, decision.velocity);
    }
    bus_record_state(&r->link.bus, state);
    r->decisions++;
    r->utime = state->utime;
    limphome_decision_t message = convert_decision(&r->controller, &decision, state);
    message.in_charge = r->link.hand.in_charge;
    message.operator_sender = operator_sender(&r->link.hand);
    bus_send_decision(&r->link.bus, &message);
    if (ended) {
        finish_episode(r, &observed->summary, state);
    }
    if (observed->reset && !last) {
        run_folder_thin(&r->folder, r->settings.recording.limit_mb, r->error);
        rollback_keep(&r->kept, &r->controller, r->finished, &r->folder);
    }
}

static void handle_state(run *r, const plant_state *taken) {
    if (!r->learner_ready && !begin_learner(r, &taken->state)) {
        return;
    }
    if (taken->begins) {
        begin_session(r, &taken->state);
    }
    r->gap = r->gap || taken->gap;
    const int8_t reason = reason_to_rest(r, &taken->state);
    if (reason != LIMPHOME_STATUS_T_NONE) {
        hold(r, &taken->state);
        trouble_useful(&r->trouble, reason, bus_now());
    } else {
        decide(r, &taken->state);
    }
}

static const char *cause(session_break broken) {
    switch (broken) {
        case SESSION_FAULTED:
            return "the plant has put the robot back after a fault";
        case SESSION_TAKEN:
            return "another controller has taken the plant over";
        case SESSION_ENDED:
            return "the plant has begun anew";
        case SESSION_MISPLACED:
            return "the plant has obeyed something else";
        case SESSION_UNBROKEN:
        default:
            return "";
    }
}

/* The session has ended without our asking. Of a simulation, all since it was last reset is done again, so that the run
 * ends as if unbroken; but one that diverged would do so again, and what happened to a real machine has happened: there
 * the episode begins anew. */
static void handle_break(run *r) {
    const session_break broken = plant_link_broken(&r->link);
    const limphome_robot_state_t *newest = &r->link.newest;
    if (broken == SESSION_UNBROKEN || !r->learner_ready) {
        return;
    }
    if (broken != SESSION_FAULTED && newest->lockstep != 0 && newest->reset == LIMPHOME_ROBOT_STATE_T_TO_INITIAL_POSE) {
        rollback_return(&r->kept, &r->controller, &r->folder, r->error);
        r->finished = r->kept.place.episodes;
        r->gap = false;
        notice_print(&r->restarts, bus_now(), "%s; back to the end of episode %" PRId32, cause(broken), r->finished);
    } else {
        r->restarted = true;
        notice_print(&r->restarts, bus_now(), "%s; the episode begins anew", cause(broken));
    }
}

static void send_status(run *r, int8_t condition) {
    limphome_status_t status = r->link.bus.counts;
    status.utime = bus_now_us();
    status.process = LIMPHOME_STATUS_T_CONTROLLER;
    status.condition = condition;
    status.reason = r->trouble.reason;
    status.in_charge = operator_in_charge(&r->link.hand, r->link.newest.lockstep != 0, bus_now());
    status.operator_sender = operator_sender(&r->link.hand);
    status.session = r->link.session.session;
    status.seq = r->link.session.seq;
    status.wall_time = bus_now() - r->started;
    status.wait_time = r->link.bus.wait_time;
    status.decisions = r->decisions;
    status.episodes = r->finished;
    convert_limits(&r->controller, &status);
    bus_send_status(&r->link.bus, &status);
}

/* That another is in charge is told at once. Of nobody the trouble tells. */
static void tell_in_charge(run *r) {
    const int8_t in_charge = operator_in_charge(&r->link.hand, r->link.newest.lockstep != 0, bus_now());
    if (in_charge == r->in_charge) {
        return;
    }
    r->in_charge = in_charge;
    r->status_at = 0;
    if (in_charge != LIMPHOME_DECISION_T_NOBODY) {
        const bool by_hand = in_charge == LIMPHOME_DECISION_T_OPERATOR;
        notice_print(
            &r->handovers, bus_now(),
            by_hand ? "an operator has taken the robot by hand" : "the learner goes on from where the robot is");
    }
}

static void send_status_each_second(run *r) {
    if (bus_now() >= r->status_at) {
        const int8_t condition = r->learner_ready ? LIMPHOME_STATUS_T_RUNNING : LIMPHOME_STATUS_T_WAITING;
        send_status(r, trouble_condition(&r->trouble, condition));
        r->status_at = bus_now() + 1;
    }
}

bool run_decide(run *r, const volatile sig_atomic_t *stop) {
    while (*stop == 0 && r->error[0] == '\0' && r->finished < r->last) {
        session_paused(&r->link.session, trouble_look(&r->trouble, &r->link, bus_now()));
        if (!plant_link_wait(&r->link, r->settings.link.resend_s)) {
            return fail_with(r->error, "the bus is broken");
        }
        handle_break(r);
        plant_link_answer(&r->link, next_episode(r));
        plant_state taken;
        if (plant_link_take(&r->link, &taken)) {
            handle_state(r, &taken);
        }
        tell_in_charge(r);
        send_status_each_second(r);
        r->gave_up = recording_good(&r->folder.recording, r->error) && !trouble_bears(&r->trouble, bus_now(), r->error);
    }
    return r->error[0] == '\0' && r->finished >= r->last;
}

bool run_close(run *r, bool complete) {
    const bool failed = r->error[0] != '\0';
    if (r->learner_ready && !r->evaluating) {
        tell_learned(r);
        run_folder_policy(&r->folder, &r->learned, r->error);
        /* An interrupted run is gone on with from where the plant was last reset: there alone it is repeatable. */
        if (complete) {
            run_folder_checkpoint(&r->folder, &r->learned, r->error);
        }
    } else if (r->resuming && complete) { /* it ended between its last checkpoint and its policy */
        run_folder_policy(&r->folder, &r->learned, r->error);
    }
    send_status(r, failed ? LIMPHOME_STATUS_T_FAULT : LIMPHOME_STATUS_T_FINISHED);
    run_folder_close(&r->folder, r->error);
    bus_close(&r->link.bus);
    return r->error[0] == '\0';
}
