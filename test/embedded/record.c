/* record RUN DECISIONS: makes recording.bin of the first decisions of a run folder, and published.bin of what the
 * controller's process said of each of them, as replay.c writes it. Both in the working directory. */
#include <lcm/lcm.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "convert_robot.h"
#include "limphome_channels.h"
#include "recording.h"
#include "robot_file.h"
#include "settings.h"

static FILE *create(const char *name) {
    FILE *file = fopen(name, "wb");
    if (file == NULL) {
        perror(name);
        exit(1);
    }
    return file;
}

static void put(FILE *file, const void *data, size_t size) {
    if (fwrite(data, size, 1, file) != 1) {
        perror("cannot write");
        exit(1);
    }
}

static recording_header make_header(const char *run, int32_t decisions) {
    char path[4096];
    char error[ERROR_LENGTH] = "";
    settings s = settings_default();
    snprintf(path, sizeof path, "%s/config.ini", run);
    if (!settings_read(&s, path, error)) {
        fprintf(stderr, "%s\n", error);
        exit(1);
    }
    robot_description robot;
    snprintf(path, sizeof path, "%s/robot.urdf", run);
    if (!robot_file_load(path, NULL, &robot)) {
        exit(1);
    }
    recording_header header;
    memset(&header, 0, sizeof header);
    header.header_size = sizeof header;
    header.state_size = sizeof(lh_state);
    header.decisions = decisions;
    header.config = convert_config(&s);
    header.config.learner.learn = true;
    if (!convert_robot(&robot, &header.robot, error)) {
        fprintf(stderr, "%s\n", error);
        exit(1);
    }
    return header;
}

static recorded_decision published(const limphome_decision_t *d) {
    recorded_decision r = {
        .episode = d->episode,
        .step = d->step,
        .learned = d->learned,
        .action = d->action,
        .q = d->q,
        .q_max = d->q_max,
        .probability = d->probability,
        .temperature = d->temperature,
        .td_error = d->td_error,
        .reward_motion = d->reward_motion,
        .reward_goal = d->reward_goal,
        .reward_stability = d->reward_stability,
        .reward_tumble = d->reward_tumble,
        .stability_margin = d->stability_margin,
        .goal_distance = d->goal_distance,
        .lateral_error = d->lateral_error,
        .heading_error = d->heading_error,
    };
    memcpy(r.inputs, d->inputs, sizeof r.inputs);
    return r;
}

/* Next message on `channel`, decoded by `decode` into `message`; false at the end of the log. */
typedef int decoder(const void *data, int offset, int size, void *message);

static int decode_state(const void *data, int offset, int size, void *message) {
    return limphome_robot_state_t_decode(data, offset, size, message);
}

static int decode_decision(const void *data, int offset, int size, void *message) {
    return limphome_decision_t_decode(data, offset, size, message);
}

static bool next(lcm_eventlog_t *log, const char *channel, decoder *decode, void *message) {
    lcm_eventlog_event_t *event;
    while ((event = lcm_eventlog_read_next_event(log)) != NULL) {
        const bool wanted = strcmp(event->channel, channel) == 0;
        const bool decoded = wanted && decode(event->data, 0, event->datalen, message) == event->datalen;
        lcm_eventlog_free_event(event);
        if (wanted) {
            return decoded;
        }
    }
    return false;
}

int main(int argc, char **argv) {
    const int decisions = argc == 3 ? atoi(argv[2]) : 0;
    if (decisions < 1) {
        fprintf(stderr, "usage: record RUN DECISIONS\n");
        return 2;
    }
    recording_header header = make_header(argv[1], decisions);
    char path[4096];
    snprintf(path, sizeof path, "%s/messages.lcmlog", argv[1]);
    lcm_eventlog_t *log = lcm_eventlog_create(path, "r");
    if (log == NULL) {
        perror(path);
        return 1;
    }
    FILE *recording = create(RECORDING_FILE);
    FILE *told = create("published.bin");
    for (int i = 0; i < decisions; i++) {
        limphome_robot_state_t state;
        limphome_decision_t decision;
        if (!next(log, LIMPHOME_CHANNEL_STATE, decode_state, &state) ||
            !next(log, LIMPHOME_CHANNEL_DECISION, decode_decision, &decision) || decision.session != state.session ||
            decision.seq != state.seq) {
            fprintf(stderr, "%s: %d decisions are needed, and the state before each\n", path, decisions);
            return 1;
        }
        if (i == 0) {
            header.controlled = convert_controlled(&state);
            put(recording, &header, sizeof header);
        }
        const lh_state sensed = convert_state(&state);
        const recorded_decision line = published(&decision);
        put(recording, &sensed, sizeof sensed);
        put(told, &line, sizeof line);
    }
    lcm_eventlog_destroy(log);
    return fclose(recording) == 0 && fclose(told) == 0 ? 0 : 1;
}
