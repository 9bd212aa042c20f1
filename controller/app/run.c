#include "run.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "convert.h"

/* The settings that decide what is learned, and the robot. */
static int64_t hash_of(const run *r) {
    return (int64_t)(settings_hash(&r->settings) * 1099511628211u ^ r->robot.hash);
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

/* Reads what the run follows from: the robot, the settings that fit it, and what was learned before, if anything. */
static bool read_inputs(run *r, const command_line *line, run_folder_place *place) {
    memset(r, 0, sizeof *r);
    r->settings = line->settings;
    r->last = (int32_t)r->settings.learning.episodes;
    if (!urdf_read(&r->robot, line->robot, r->error)) {
        return false;
    }
    r->config = convert_config(&r->settings);
    const lh_error bad = lh_config_validate(&r->config);
    if (bad != LH_OK) {
        return fail_with(r->error, "settings: %s", lh_error_text(bad));
    }
    r->hash = hash_of(r);
    r->evaluating = line->evaluate != NULL;
    if (line->resume && !run_folder_find(line->out, r->hash, place, &r->learned, r->error)) {
        return false;
    }
    r->resuming = line->resume && place->episodes > 0;
    r->finished = line->resume ? place->episodes : 0;
    return !r->evaluating || open_policy(r, line->evaluate);
}

bool run_check(run *r, const command_line *line) {
    run_folder_place place;
    const bool good = read_inputs(r, line, &place);
    if (good && line->resume) {
        printf("goes on after episode %" PRId32 "\n", place.episodes);
    }
    return good;
}

bool run_open(run *r, const command_line *line) {
    run_folder_place place;
    if (!read_inputs(r, line, &place) ||
        !bus_open(&r->bus, line->lcm_url, &r->folder.recording, r->error)) { /* before there is a folder in the way */
        return false;
    }
    if (!(line->resume ? run_folder_resume(&r->folder, line->out, &place, r->error)
                       : run_folder_create(&r->folder, line->out, r->error))) {
        run_folder_close(&r->folder, r->error);
        bus_close(&r->bus);
        return false;
    }
    session_init(&r->session, r->settings.link.sender_timeout_s);
    r->started = bus_now();
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
    lh_error error = lh_controller_init(&r->controller, &r->config, &r->robot.robot, &controlled);
    if (error == LH_OK && state->num_actuators != r->robot.robot.num_actuators) {
        error = LH_ERROR_STATE;
    }
    if (error != LH_OK) {
        return fail_with(r->error, "the plant's robot and ours do not go together: %s", lh_error_text(error));
    }
    r->learner_ready = restore_learner(r);
    rollback_keep(&r->kept, &r->controller, r->finished, &r->folder);
    return r->learner_ready;
}

static void send_reset(run *r) {
    const int32_t episode = r->learner_ready ? r->controller.task.episode.number : r->finished + 1;
    bus_send_reset(&r->bus, r->session.session, r->session.seq, episode, r->reset_sent);
    r->reset_sent = true;
}

/* What has been learned so far, as message and in r->learned. */
static void tell_learned(run *r) {
    learned_save(&r->learned, &r->controller, r->finished, r->utime, r->hash);
    bus_send_policy(&r->bus, &r->learned);
}

/* An episode has ended: a row, a message, and a checkpoint where the plant is about to be reset for one. */
static void finish_episode(run *r, const lh_summary *summary, const limphome_robot_state_t *state) {
    r->finished = summary->number;
    const limphome_episode_t episode =
        convert_episode(&r->controller, summary, state, r->settings.episode.decision_period_s);
    bus_send_episode(&r->bus, &episode);
    run_folder_episode(&r->folder, &episode, r->error);
    if (!r->evaluating && summary->number % r->config.task.episode.reset_every == 0) {
        tell_learned(r);
        run_folder_checkpoint(&r->folder, &r->learned, r->error);
    }
}

/* Decides on a new state and answers it. The command goes out first: the plant works on while we write the rest. */
static void decide(run *r, const limphome_robot_state_t *state) {
    if (!r->learner_ready && !begin_learner(r, state)) {
        return;
    }
    const lh_state sensed = convert_state(state);
    lh_decision decision = {.velocity = {0}};
    const lh_error error = lh_controller_step(&r->controller, &sensed, &decision);
    if (error != LH_OK) { /* hold still; the next state may be better */
        fprintf(stderr, "state %" PRId64 ": %s; holding still\n", state->seq, lh_error_text(error));
    }
    const lh_observed *observed = &decision.observed;
    const bool ended = observed->outcome != LH_OUTCOME_NONE;
    const bool last = ended && observed->summary.number >= r->last;
    r->reset_sent = false;
    if (observed->reset && !last) {
        session_reset(&r->session);
        send_reset(r);
    } else if (!last) {
        r->command = (limphome_velocity_command_t){.utime = bus_now_us(),
                                                   .session = state->session,
                                                   .seq = state->seq,
                                                   .sender = r->bus.sender,
                                                   .num_actuators = state->num_actuators};
        for (int i = 0; i < state->num_actuators; i++) {
            r->command.velocity[i] = (double)decision.velocity[i];
        }
        bus_send_command(&r->bus, &r->command, false);
    }
    bus_record_state(&r->bus, state);
    r->decisions++;
    r->utime = state->utime;
    if (error == LH_OK) {
        const limphome_decision_t message = convert_decision(&r->controller, &decision, state);
        bus_send_decision(&r->bus, &message);
    }
    if (ended) {
        finish_episode(r, &observed->summary, state);
    }
    if (observed->reset && !last) {
        run_folder_thin(&r->folder, r->settings.recording.limit_mb, r->error);
        rollback_keep(&r->kept, &r->controller, r->finished, &r->folder);
    }
}

/* The plant has put the robot back without being asked to. A simulation that diverged would do so again: its episode
 * begins anew. Of a simulator that is another process now, all since it was last reset is done again. */
static void begin_again(run *r, bool lockstep) {
    if (!r->learner_ready) {
        return;
    }
    if (lockstep && !r->diverged) {
        rollback_return(&r->kept, &r->controller, &r->folder, r->error);
        r->finished = r->kept.place.episodes;
        fprintf(stderr, "the plant has started anew; back to the end of episode %d\n", r->finished);
    } else {
        lh_controller_begin(&r->controller);
        rollback_keep(&r->kept, &r->controller, r->finished, &r->folder);
        fprintf(stderr, "the plant has put the robot back; the episode begins anew\n");
    }
    r->diverged = false;
}

static void handle_state(run *r, const limphome_robot_state_t *state) {
    switch (session_judge(&r->session, state->session, state->seq, state->lockstep != 0, bus_now())) {
        case SESSION_NEW:
            decide(r, state);
            break;
        case SESSION_REPEATED:
            r->repeated++;
            bus_send_command(&r->bus, &r->command, true);
            break;
        case SESSION_RESET:
            if (r->session.restarted) {
                r->session.restarted = false;
                r->reset_sent = false;
                begin_again(r, state->lockstep != 0);
            }
            send_reset(r);
            break;
        case SESSION_OLD:
        case SESSION_OTHER:
        default:
            r->stale++;
            break;
    }
}

static void send_status(run *r, int8_t condition) {
    limphome_status_t status = r->bus.counts;
    status.utime = bus_now_us();
    status.process = LIMPHOME_STATUS_T_CONTROLLER;
    status.condition = condition;
    status.session = r->session.session;
    status.seq = r->session.seq;
    status.wall_time = bus_now() - r->started;
    status.wait_time = r->bus.wait_time;
    status.decisions = r->decisions;
    status.episodes = r->finished;
    status.rejected_session = r->stale;
    status.duplicates += r->repeated;
    convert_limits(&r->controller, &status);
    bus_send_status(&r->bus, &status);
}

bool run_decide(run *r, const volatile sig_atomic_t *stop) {
    while (*stop == 0 && r->error[0] == '\0' && r->finished < r->last) {
        if (!bus_wait(&r->bus, r->settings.link.resend_s)) {
            return fail_with(r->error, "the bus is broken");
        }
        int64_t ended;
        if (bus_take_fault(&r->bus, &ended)) {
            session_over(&r->session, ended);
            r->diverged = r->session.over;
        }
        limphome_robot_state_t state;
        if (bus_take(&r->bus, &state)) {
            handle_state(r, &state);
        }
        if (!recording_good(&r->folder.recording, r->error)) {
            return false;
        }
        if (bus_now() >= r->status_at) {
            send_status(r, r->learner_ready ? LIMPHOME_STATUS_T_RUNNING : LIMPHOME_STATUS_T_WAITING);
            r->status_at = bus_now() + 1;
        }
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
    }
    send_status(r, failed ? LIMPHOME_STATUS_T_FAULT : LIMPHOME_STATUS_T_FINISHED);
    run_folder_close(&r->folder, r->error);
    bus_close(&r->bus);
    return r->error[0] == '\0';
}
