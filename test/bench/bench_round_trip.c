/* Sends a state and waits for the command that answers it, as the plant does in lockstep; a second process answers.
 * Prints the median and the 99th percentile of the round trips [s]. Usage: bench_round_trip LCM_URL */
#include <lcm/lcm.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "limphome_channels.h"
#include "limphome_robot_state_t.h"
#include "limphome_velocity_command_t.h"

enum { ROUND_TRIPS = 5000, REPEAT_MS = 5 };

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void on_state(const lcm_recv_buf_t *buffer, const char *channel, const limphome_robot_state_t *state,
                     void *lcm) {
    (void)buffer;
    (void)channel;
    limphome_velocity_command_t command = {.session = state->session, .seq = state->seq};
    limphome_velocity_command_t_publish(lcm, LIMPHOME_CHANNEL_COMMAND, &command);
}

static void on_command(const lcm_recv_buf_t *buffer, const char *channel, const limphome_velocity_command_t *command,
                       void *seq) {
    (void)buffer;
    (void)channel;
    *(int64_t *)seq = command->seq;
}

static int answer(const char *url) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    lcm_t *lcm = lcm_create(url);
    if (lcm == NULL || limphome_robot_state_t_subscribe(lcm, LIMPHOME_CHANNEL_STATE, on_state, lcm) == NULL) {
        return EXIT_FAILURE;
    }
    while (lcm_handle(lcm) == 0) {
    }
    return EXIT_FAILURE;
}

/* Publishes state `seq` until it is answered. */
static double round_trip(lcm_t *lcm, int64_t seq, const int64_t *answered) {
    limphome_robot_state_t state = {.seq = seq};
    const double start = now();
    while (*answered != seq) {
        limphome_robot_state_t_publish(lcm, LIMPHOME_CHANNEL_STATE, &state);
        while (*answered != seq && lcm_handle_timeout(lcm, REPEAT_MS) > 0) {
        }
    }
    return now() - start;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int measure(const char *url) {
    int64_t answered = 0;
    lcm_t *lcm = lcm_create(url);
    if (lcm == NULL ||
        limphome_velocity_command_t_subscribe(lcm, LIMPHOME_CHANNEL_COMMAND, on_command, &answered) == NULL) {
        fprintf(stderr, "no LCM on %s\n", url);
        return EXIT_FAILURE;
    }
    round_trip(lcm, 1, &answered); /* waits for the other process */
    static double seconds[ROUND_TRIPS];
    for (int i = 0; i < ROUND_TRIPS; i++) {
        seconds[i] = round_trip(lcm, 2 + i, &answered);
    }
    qsort(seconds, ROUND_TRIPS, sizeof *seconds, ascending);
    printf("%.6g %.6g\n", seconds[ROUND_TRIPS / 2], seconds[ROUND_TRIPS - ROUND_TRIPS / 100]);
    lcm_destroy(lcm);
    return EXIT_SUCCESS;
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: bench_round_trip LCM_URL\n");
        return 2;
    }
    const pid_t other = fork();
    if (other < 0) {
        perror("fork");
        return EXIT_FAILURE;
    }
    if (other == 0) {
        return answer(argv[1]);
    }
    const int result = measure(argv[1]);
    kill(other, SIGTERM);
    waitpid(other, NULL, 0);
    return result;
}
