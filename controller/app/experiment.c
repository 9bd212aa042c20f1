#include "experiment.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "convert.h"

/* The settings that decide what is learned, and the robot. */
static int64_t experiment_hash(const experiment *e) {
    return (int64_t)(settings_hash(&e->settings) * 1099511628211u ^ e->robot.hash);
}

/* Takes what there is to begin with: nothing, a policy to be used, or a checkpoint to go on from. */
static bool open_folder(experiment *e, const command_line *line) {
    e->evaluating = line->evaluate != NULL;
    e->resuming = line->resume;
    if (e->evaluating && !run_folder_read_policy(line->evaluate, &e->policy)) {
        return false;
    }
    if (!e->resuming) {
        return run_folder_create(&e->folder, line->out);
    }
    if (!run_folder_resume(&e->folder, line->out, &e->checkpoint)) {
        return false;
    }
    if (e->checkpoint.settings_hash != e->hash) {
        fprintf(stderr, "%s: was made with other settings or another robot; it cannot be gone on with\n", line->out);
        run_folder_close(&e->folder);
        return false;
    }
    e->policy = e->checkpoint.policy;
    e->finished = e->policy.episode;
    return true;
}

bool experiment_open(experiment *e, const command_line *line) {
    memset(e, 0, sizeof *e);
    e->settings = line->settings;
    char error[URDF_ERROR_LENGTH];
    if (urdf_read(&e->robot, line->robot, error) != 0) {
        fprintf(stderr, "%s\n", error);
        return false;
    }
    e->config = convert_config(&e->settings);
    const lh_error bad = lh_config_validate(&e->config);
    if (bad != LH_OK) {
        fprintf(stderr, "settings: %s\n", lh_error_text(bad));
        return false;
    }
    e->hash = experiment_hash(e);
    if (!open_folder(e, line)) {
        return false;
    }
    char log[RUN_FOLDER_PATH_LENGTH + 32];
    snprintf(log, sizeof log, "%s/messages.lcmlog", e->folder.path);
    if (!bus_open(&e->bus, line->lcm_url, e->folder.path[0] == '\0' ? NULL : log, e->resuming)) {
        run_folder_close(&e->folder);
        return false;
    }
    session_init(&e->session, e->settings.link.sender_timeout_s);
    e->started = bus_now();
    return true;
}

/* The first state tells which actuators obey; now the learner can be set up, or taken up where it was left. */
static bool begin_learner(experiment *e, const limphome_robot_state_t *state) {
    const lh_controlled controlled = convert_controlled(state);
    e->config.learn = !e->evaluating;
    e->config.greedy = e->evaluating;
    lh_error error = lh_controller_init(&e->controller, &e->config, &e->robot.robot, &controlled);
    if (error == LH_OK && state->num_actuators != e->robot.robot.num_actuators) {
        error = LH_ERROR_STATE;
    }
    if (error == LH_OK && (e->evaluating || e->resuming)) {
        lh_network network;
        uint32_t random_state[4];
        memcpy(random_state,
               e->resuming ? (const uint32_t *)e->checkpoint.random_state : e->controller.learner.random.s,
               sizeof random_state);
        error = convert_network(&e->policy, &e->controller, &network)
                    ? lh_controller_restore(&e->controller, &network, random_state, e->finished + 1)
                    : LH_ERROR_NETWORK;
    }
    if (error != LH_OK) {
        fprintf(stderr, "the plant's robot and ours do not go together: %s\n", lh_error_text(error));
        return false;
    }
    if (e->resuming) {
        e->controller.learner.held = (lh_held){
            .weights = (uint64_t)e->checkpoint.clamped_weights,
            .widths = (uint64_t)e->checkpoint.clamped_widths,
            .centres = (uint64_t)e->checkpoint.clamped_centres,
        };
    }
    e->learner_ready = true;
    return true;
}

static void send_reset(experiment *e) {
    const int32_t episode = e->learner_ready ? e->controller.episode.number : e->finished + 1;
    bus_send_reset(&e->bus, e->session.session, e->session.seq, episode, e->reset_sent);
    e->reset_sent = true;
}

static limphome_checkpoint_t make_checkpoint(const experiment *e) {
    limphome_checkpoint_t checkpoint;
    memset(&checkpoint, 0, sizeof checkpoint);
    checkpoint.policy = convert_policy(&e->controller, e->finished, e->utime);
    memcpy(checkpoint.random_state, e->controller.learner.random.s, sizeof checkpoint.random_state);
    const lh_held *held = &e->controller.learner.held;
    checkpoint.clamped_weights = (int64_t)held->weights;
    checkpoint.clamped_widths = (int64_t)held->widths;
    checkpoint.clamped_centres = (int64_t)held->centres;
    checkpoint.settings_hash = e->hash;
    return checkpoint;
}

/* An episode has ended: a row, a message, and a checkpoint where the plant is about to be reset for one. */
static void finish_episode(experiment *e, const lh_summary *summary, const limphome_robot_state_t *state) {
    e->finished = summary->number;
    const limphome_episode_t episode = convert_episode(summary, state, e->settings.episode.decision_period_s);
    bus_send_episode(&e->bus, &episode);
    e->failed = !run_folder_episode(&e->folder, summary, e->settings.episode.decision_period_s) || e->failed;
    if (!e->evaluating && summary->number % e->config.episode.reset_every == 0) {
        const limphome_checkpoint_t checkpoint = make_checkpoint(e);
        bus_send_policy(&e->bus, &checkpoint.policy);
        e->failed = !run_folder_checkpoint(&e->folder, &checkpoint) || e->failed;
    }
}

/* Decides on a new state and answers it. The command goes out first: the plant works on while we write the rest. */
static void decide(experiment *e, const limphome_robot_state_t *state) {
    if (!e->learner_ready && !begin_learner(e, state)) {
        e->failed = true;
        return;
    }
    const lh_state sensed = convert_state(state);
    lh_decision decision;
    const lh_error error = lh_controller_step(&e->controller, &sensed, &decision);
    if (error != LH_OK) { /* hold still; the next state may be better */
        fprintf(stderr, "state %" PRId64 ": %s; holding still\n", state->seq, lh_error_text(error));
        memset(&decision, 0, sizeof decision);
    }
    const bool last = decision.ended && decision.summary.number >= e->settings.learning.episodes;
    e->reset_sent = false;
    if (decision.reset && !last) {
        session_reset(&e->session);
        send_reset(e);
    } else if (!last) {
        e->command = (limphome_velocity_command_t){.utime = bus_now_us(),
                                                   .session = state->session,
                                                   .seq = state->seq,
                                                   .sender = e->bus.sender,
                                                   .num_actuators = state->num_actuators};
        for (int i = 0; i < state->num_actuators; i++) {
            e->command.velocity[i] = (double)decision.velocity[i];
        }
        bus_send_command(&e->bus, &e->command, false);
    }
    bus_record_state(&e->bus, state);
    e->decisions++;
    e->utime = state->utime;
    if (error == LH_OK) {
        const limphome_decision_t message = convert_decision(&decision, state);
        bus_send_decision(&e->bus, &message);
    }
    if (decision.ended) {
        finish_episode(e, &decision.summary, state);
    }
}

static void handle_state(experiment *e, const limphome_robot_state_t *state) {
    switch (session_judge(&e->session, state->session, state->seq, state->lockstep != 0, bus_now())) {
        case SESSION_NEW:
            decide(e, state);
            break;
        case SESSION_REPEATED:
            e->repeated++;
            bus_send_command(&e->bus, &e->command, true);
            break;
        case SESSION_RESET:
            if (e->session.restarted) {
                fprintf(stderr, "the plant has started anew; so does the episode\n");
                e->session.restarted = false;
                e->reset_sent = false;
                if (e->learner_ready) {
                    lh_controller_begin(&e->controller);
                }
            }
            send_reset(e);
            break;
        case SESSION_OLD:
        case SESSION_OTHER:
        default:
            e->stale++;
            break;
    }
}

static void count_clamped(const lh_controller *controller, limphome_status_t *status) {
    status->clamped_inputs = (int64_t)controller->clamped.inputs;
    status->clamped_temperatures = (int64_t)controller->clamped.temperatures;
    status->clamped_margins = (int64_t)controller->clamped.margins;
    status->clamped_weights = (int64_t)controller->learner.held.weights;
    status->clamped_widths = (int64_t)controller->learner.held.widths;
    status->clamped_centres = (int64_t)controller->learner.held.centres;
    status->clamped = status->clamped_inputs + status->clamped_temperatures + status->clamped_margins +
                      status->clamped_weights + status->clamped_widths + status->clamped_centres;
}

static void send_status(experiment *e, int8_t condition) {
    limphome_status_t status = e->bus.counts;
    status.utime = bus_now_us();
    status.process = LIMPHOME_STATUS_T_CONTROLLER;
    status.condition = condition;
    status.session = e->session.session;
    status.seq = e->session.seq;
    status.wall_time = bus_now() - e->started;
    status.wait_time = e->bus.wait_time;
    status.decisions = e->decisions;
    status.episodes = e->finished;
    status.rejected_session = e->stale;
    status.duplicates += e->repeated;
    count_clamped(&e->controller, &status);
    bus_send_status(&e->bus, &status);
}

bool experiment_run(experiment *e, const volatile sig_atomic_t *stop) {
    while (*stop == 0 && !e->failed && e->finished < e->settings.learning.episodes) {
        if (!bus_wait(&e->bus, e->settings.link.resend_s)) {
            fprintf(stderr, "the bus is broken\n");
            return false;
        }
        int64_t ended;
        if (bus_take_fault(&e->bus, &ended)) {
            session_over(&e->session, ended);
        }
        limphome_robot_state_t state;
        if (bus_take(&e->bus, &state)) {
            handle_state(e, &state);
        }
        if (bus_now() >= e->status_at) {
            send_status(e, e->learner_ready ? LIMPHOME_STATUS_T_RUNNING : LIMPHOME_STATUS_T_WAITING);
            e->status_at = bus_now() + 1;
        }
    }
    return !e->failed && e->finished >= e->settings.learning.episodes;
}

bool experiment_close(experiment *e, bool complete) {
    bool good = true;
    if (e->learner_ready && !e->evaluating) {
        const limphome_checkpoint_t checkpoint = make_checkpoint(e);
        bus_send_policy(&e->bus, &checkpoint.policy);
        good = run_folder_policy(&e->folder, &checkpoint.policy);
        /* An interrupted run is gone on with from where the plant was last reset: there alone it is repeatable. */
        good = (!complete || run_folder_checkpoint(&e->folder, &checkpoint)) && good;
    }
    send_status(e, e->failed ? LIMPHOME_STATUS_T_FAULT : LIMPHOME_STATUS_T_FINISHED);
    good = run_folder_close(&e->folder) && good;
    if (!bus_close(&e->bus)) {
        fprintf(stderr, "messages.lcmlog is not complete\n");
        good = false;
    }
    return good;
}
