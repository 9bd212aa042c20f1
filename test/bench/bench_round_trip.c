/* Sends a state and waits for the command that answers it, as the plant does in lockstep; a second process answers.
 * Prints the median and the 99th percentile of the round trips [s], on the programs' bus (udpm) and on liblcm's, one
 * after the other. Usage: bench_round_trip LCM_URL */
#include <lcm/lcm.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "limphome_channels.h"
#include "limphome_robot_state_t.h"
#include "limphome_velocity_command_t.h"
#include "timing.h"
#include "udpm.h"

enum { ROUND_TRIPS = 5000, REPEAT_MS = 5, SECOND = 1000 };

/* One of the two. */
typedef struct bus {
    lcm_t *liblcm; /* NULL: udpm */
    udpm udpm;
} bus;

static bool join(bus *b, bool liblcm, const char *url) {
    char error[ERROR_LENGTH] = "";
    b->liblcm = liblcm ? lcm_create(url) : NULL;
    const bool joined = liblcm ? b->liblcm != NULL : udpm_open(&b->udpm, url, error);
    if (!joined) {
        fprintf(stderr, "no bus on %s %s\n", url, error);
    }
    return joined;
}

static bool hear(bus *b, const char *channel, udpm_handler *handler, void *user) {
    return b->liblcm != NULL ? lcm_subscribe(b->liblcm, channel, handler, user) != NULL
                             : udpm_subscribe(&b->udpm, channel, handler, user);
}

static void leave(bus *b) {
    if (b->liblcm != NULL) {
        lcm_destroy(b->liblcm);
    } else {
        udpm_close(&b->udpm);
    }
}

static void say(bus *b, const char *channel, const void *bytes, int size) {
    if (b->liblcm != NULL) {
        lcm_publish(b->liblcm, channel, bytes, (unsigned)size);
    } else {
        udpm_publish(&b->udpm, channel, bytes, size);
    }
}

/* Waits for a message, as the programs do, and handles it; false if none came. */
static bool handle(bus *b, int milliseconds) {
    if (b->liblcm == NULL) {
        return udpm_wait(&b->udpm, milliseconds) > 0 && udpm_handle(&b->udpm);
    }
    struct pollfd waiting = {.fd = lcm_get_fileno(b->liblcm), .events = POLLIN};
    return poll(&waiting, 1, milliseconds) > 0 && lcm_handle(b->liblcm) == 0;
}

static void on_state(const lcm_recv_buf_t *buffer, const char *channel, void *user) {
    (void)channel;
    limphome_robot_state_t state;
    if (limphome_robot_state_t_decode(buffer->data, 0, (int)buffer->data_size, &state) > 0) {
        unsigned char bytes[1024];
        limphome_velocity_command_t command = {.session = state.session, .seq = state.seq};
        say(user, LIMPHOME_CHANNEL_COMMAND, bytes,
            limphome_velocity_command_t_encode(bytes, 0, sizeof bytes, &command));
    }
}

static void on_command(const lcm_recv_buf_t *buffer, const char *channel, void *seq) {
    (void)channel;
    limphome_velocity_command_t command;
    if (limphome_velocity_command_t_decode(buffer->data, 0, (int)buffer->data_size, &command) > 0) {
        *(int64_t *)seq = command.seq;
    }
}

/* The second process: answers until it is ended. */
static int answer(bool liblcm, const char *url) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    static bus b;
    if (!join(&b, liblcm, url) || !hear(&b, LIMPHOME_CHANNEL_STATE, on_state, &b)) {
        return EXIT_FAILURE;
    }
    for (;;) {
        handle(&b, SECOND);
    }
}

/* Publishes state `seq` until it is answered. */
static double round_trip(bus *b, int64_t seq, const int64_t *answered) {
    unsigned char bytes[1024];
    limphome_robot_state_t state = {.seq = seq};
    const double start = timing_now(CLOCK_MONOTONIC);
    while (*answered != seq) {
        say(b, LIMPHOME_CHANNEL_STATE, bytes, limphome_robot_state_t_encode(bytes, 0, sizeof bytes, &state));
        while (*answered != seq && handle(b, REPEAT_MS)) {
        }
    }
    return timing_now(CLOCK_MONOTONIC) - start;
}

static bool measure(bool liblcm, const char *url) {
    static bus b;
    static double seconds[ROUND_TRIPS];
    int64_t answered = 0;
    if (!join(&b, liblcm, url) || !hear(&b, LIMPHOME_CHANNEL_COMMAND, on_command, &answered)) {
        return false;
    }
    round_trip(&b, 1, &answered); /* waits for the other process */
    for (int i = 0; i < ROUND_TRIPS; i++) {
        seconds[i] = round_trip(&b, 2 + i, &answered);
    }
    leave(&b);
    const double median = timing_median(seconds, ROUND_TRIPS);
    printf("%s %.6g %.6g\n", liblcm ? "liblcm" : "udpm", median, seconds[ROUND_TRIPS - ROUND_TRIPS / 100]);
    return fflush(stdout) == 0;
}

static bool measure_with_other(bool liblcm, const char *url) {
    const pid_t other = fork();
    if (other < 0) {
        perror("fork");
        return false;
    }
    if (other == 0) {
        _exit(answer(liblcm, url));
    }
    const bool measured = measure(liblcm, url);
    kill(other, SIGTERM);
    waitpid(other, NULL, 0);
    return measured;
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: bench_round_trip LCM_URL\n");
        return 2;
    }
    /* liblcm last: its thread would not live in a second process */
    return measure_with_other(false, argv[1]) && measure_with_other(true, argv[1]) ? EXIT_SUCCESS : EXIT_FAILURE;
}
