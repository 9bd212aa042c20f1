#include "bus.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>
#include <time.h>

#include "limphome_channels.h"
#include "messages.h"

enum { LARGEST_MESSAGE = 16384 };
enum { MOST_RECORDED = 20 /* of a kind in a second */ };
enum { MOST_MESSAGES = 128 /* handled at once: some 0.3 ms */ };

double bus_now(void) {
    return (double)bus_now_us() * 1e-6;
}

int64_t bus_now_us(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

static void receive_state(const lcm_recv_buf_t *buffer, const char *channel, void *user) {
    (void)channel;
    bus *b = user;
    limphome_robot_state_t state;
    b->counts.received++;
    switch (message_decode_state(buffer->data, buffer->data_size, &state)) {
        case MESSAGE_GOOD:
            b->listener.state(b->listener.user, &state);
            break;
        case MESSAGE_NON_FINITE:
            b->counts.rejected_non_finite++;
            break;
        case MESSAGE_MALFORMED:
        default:
            b->counts.rejected_malformed++;
            break;
    }
}

static bool may_record(bus_share *share) {
    const double now = bus_now();
    if (now - share->second >= 1) {
        *share = (bus_share){.second = now};
    }
    return share->recorded++ < MOST_RECORDED;
}

static void receive_operate(const lcm_recv_buf_t *buffer, const char *channel, void *user) {
    bus *b = user;
    limphome_operate_t message;
    b->counts.received++;
    if (message_decode_operate(buffer->data, buffer->data_size, &message) != MESSAGE_GOOD) {
        b->counts.operate_malformed++;
    } else if (b->listener.operate(b->listener.user, &message) && may_record(&b->operates)) {
        recording_add(b->recording, channel, buffer->data, (int)buffer->data_size);
    }
}

/* The plant's status is kept in the log beside ours. */
static void receive_status(const lcm_recv_buf_t *buffer, const char *channel, void *user) {
    bus *b = user;
    limphome_status_t status;
    const int size = limphome_status_t_decode(buffer->data, 0, (int)buffer->data_size, &status);
    if (size == (int)buffer->data_size && status.process == LIMPHOME_STATUS_T_PLANT) {
        if (may_record(&b->statuses)) {
            recording_add(b->recording, channel, buffer->data, size);
        }
        b->listener.status(b->listener.user, &status);
    }
}

static bool join_bus(bus *b, const char *url, char error[ERROR_LENGTH]) {
    return udpm_open(&b->lcm, url, error) && udpm_subscribe(&b->lcm, LIMPHOME_CHANNEL_STATE, receive_state, b) &&
           udpm_subscribe(&b->lcm, LIMPHOME_CHANNEL_STATUS, receive_status, b) &&
           udpm_subscribe(&b->lcm, LIMPHOME_CHANNEL_OPERATE, receive_operate, b);
}

bool bus_draw(int64_t *number, char error[ERROR_LENGTH]) {
    do {
        if (getrandom(number, sizeof *number, 0) != (ssize_t)sizeof *number && errno != EINTR) {
            return fail_with(error, "no random numbers from the system: %s", strerror(errno));
        }
    } while (*number == 0);
    return true;
}

bool bus_open(bus *b, const char *url, bus_listener listener, recording *log, char error[ERROR_LENGTH]) {
    memset(b, 0, sizeof *b); /* not by a literal, which would lie on the stack */
    b->listener = listener;
    b->recording = log;
    return bus_draw(&b->sender, error) && join_bus(b, url, error);
}

void bus_close(bus *b) {
    udpm_close(&b->lcm);
}

bool bus_wait(bus *b, double timeout) {
    const double begin = bus_now();
    int ready = udpm_wait(&b->lcm, (int)ceil(timeout * 1000));
    b->wait_time += bus_now() - begin;
    for (int handled = 0; ready > 0 && handled < MOST_MESSAGES; handled++) {
        if (!udpm_handle(&b->lcm)) {
            return false;
        }
        ready = udpm_wait(&b->lcm, 0);
    }
    b->counts.overruns += ready > 0;
    return ready >= 0;
}

/* Encodes a message of any of our types into `bytes` and names its size; then `send` puts it on the bus. */
#define ENCODE(type, message, bytes) limphome_##type##_encode(bytes, 0, (int)sizeof bytes, message)

static void send(bus *b, const char *channel, unsigned char *bytes, int size, bool recorded) {
    if (size > 0) {
        udpm_publish(&b->lcm, channel, bytes, size);
    }
    if (size > 0 && recorded) {
        recording_add(b->recording, channel, bytes, size);
    }
}

void bus_record_state(bus *b, const limphome_robot_state_t *state) {
    unsigned char bytes[LARGEST_MESSAGE];
    recording_add(b->recording, LIMPHOME_CHANNEL_STATE, bytes, ENCODE(robot_state_t, state, bytes));
}

void bus_send_command(bus *b, const limphome_velocity_command_t *command, bool repeats) {
    unsigned char bytes[LARGEST_MESSAGE];
    b->counts.resent += repeats;
    send(b, LIMPHOME_CHANNEL_COMMAND, bytes, ENCODE(velocity_command_t, command, bytes), !repeats);
}

void bus_send_reset(bus *b, const limphome_reset_request_t *request, bool repeats) {
    unsigned char bytes[LARGEST_MESSAGE];
    b->counts.resent += repeats;
    send(b, LIMPHOME_CHANNEL_RESET, bytes, ENCODE(reset_request_t, request, bytes), !repeats);
}

void bus_send_decision(bus *b, const limphome_decision_t *decision) {
    unsigned char bytes[LARGEST_MESSAGE];
    send(b, LIMPHOME_CHANNEL_DECISION, bytes, ENCODE(decision_t, decision, bytes), true);
}

void bus_send_episode(bus *b, const limphome_episode_t *episode) {
    unsigned char bytes[LARGEST_MESSAGE];
    send(b, LIMPHOME_CHANNEL_EPISODE, bytes, ENCODE(episode_t, episode, bytes), true);
}

void bus_send_policy(bus *b, const learned *l) {
    unsigned char bytes[LEARNED_LARGEST];
    send(b, learned_channel(l), bytes, learned_encode_policy(l, bytes, sizeof bytes), true);
}

void bus_send_status(bus *b, const limphome_status_t *status) {
    unsigned char bytes[LARGEST_MESSAGE];
    send(b, LIMPHOME_CHANNEL_STATUS, bytes, ENCODE(status_t, status, bytes), true);
}
