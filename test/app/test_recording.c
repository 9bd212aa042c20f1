/* The recording: wherever it was torn, it is cut to whole events of whole episodes. */
#include <lcm/eventlog.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "learned.h"
#include "limphome_channels.h"
#include "limphome_episode_t.h"
#include "recording.h"
#include "recording_event.h"
#include "recording_thin.h"
#include "suite.h"

enum { EPISODES = 3, EVENTS = 2 * EPISODES };

static char folder[64];
static char path[96];
static char error[ERROR_LENGTH]; /* of the newest failure */

static void make_folder(void) {
    error[0] = '\0';
    snprintf(folder, sizeof folder, "/tmp/limphome_recording_XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/messages.lcmlog", folder);
}

static void remove_folder(void) {
    unlink(path);
    ck_assert_int_eq(rmdir(folder), 0);
}

static int64_t file_size(void) {
    struct stat found;
    ck_assert_int_eq(stat(path, &found), 0);
    return (int64_t)found.st_size;
}

/* Each episode is a few bytes of some other channel and the message that it has ended. */
static void add_episode(recording *r, int32_t number) {
    unsigned char bytes[1024] = "a state";
    recording_add(r, LIMPHOME_CHANNEL_STATE, bytes, 7);
    const limphome_episode_t episode = {.episode = number};
    recording_add(r, LIMPHOME_CHANNEL_EPISODE, bytes, limphome_episode_t_encode(bytes, 0, sizeof bytes, &episode));
}

/* Writes a recording of whole episodes; ends[n] is where episode n ends. */
static void write_recording(int64_t ends[EPISODES + 1]) {
    recording r;
    ck_assert(recording_create(&r, path, error));
    ends[0] = 0;
    for (int32_t i = 1; i <= EPISODES; i++) {
        add_episode(&r, i);
        ends[i] = recording_end(&r).bytes;
    }
    ck_assert(recording_close(&r, error));
    ck_assert_int_eq(file_size(), ends[EPISODES]);
}

/* As a program that knows LCM alone reads it. */
static int count_events(void) {
    lcm_eventlog_t *log = lcm_eventlog_create(path, "r");
    int events = 0;
    for (lcm_eventlog_event_t *e; (e = lcm_eventlog_read_next_event(log)) != NULL; events++) {
        ck_assert_int_eq(e->eventnum, events);
        lcm_eventlog_free_event(e);
    }
    lcm_eventlog_destroy(log);
    return events;
}

static void add_policy(recording *r, int32_t episode) {
    static unsigned char bytes[LEARNED_LARGEST];
    learned l;
    memset(&l, 0, sizeof l);
    l.kind = LH_Q_LEARNING;
    limphome_policy_t *policy = &l.as.q_learning.policy;
    policy->episode = episode;
    policy->num_actuators = 5;
    policy->num_controlled = 4;
    policy->num_units = 50;
    policy->num_inputs = 10;
    recording_add(r, LIMPHOME_CHANNEL_POLICY, bytes, learned_encode_policy(&l, bytes, sizeof bytes));
}

/* It tells of what it has learned by the newest finished episode a second time when it is interrupted in the next. */
START_TEST(an_interrupted_episode_does_not_belong_to_the_one_before) {
    recording r;
    ck_assert(recording_create(&r, path, error));
    add_episode(&r, 1);
    add_policy(&r, 1);
    const recording_place after = recording_end(&r);
    unsigned char state[] = "a state";
    recording_add(&r, LIMPHOME_CHANNEL_STATE, state, 7);
    add_policy(&r, 1);
    ck_assert(recording_close(&r, error));
    recording_place end;
    ck_assert(recording_find(path, 1, &end, error));
    ck_assert_int_eq(end.bytes, after.bytes);
    ck_assert_int_eq(end.events, after.events);
}
END_TEST

START_TEST(an_episode_is_found_where_the_file_is_whole_up_to_its_end) {
    int64_t ends[EPISODES + 1];
    write_recording(ends);
    for (int64_t length = ends[EPISODES]; length >= 0; length--) {
        ck_assert_int_eq(truncate(path, (off_t)length), 0);
        for (int32_t i = 1; i <= EPISODES; i++) {
            recording_place end = {-1, -1};
            error[0] = '\0';
            ck_assert(recording_find(path, i, &end, error) == (length >= ends[i]));
            if (length >= ends[i]) {
                ck_assert_int_eq(end.bytes, ends[i]);
                ck_assert_int_eq(end.events, (int64_t)2 * i);
            } else {
                ck_assert_ptr_nonnull(strstr(error, "is whole up to byte"));
            }
        }
    }
}
END_TEST

/* Nothing behind a byte that is wrong is trusted, whole though it looks. */
START_TEST(an_event_that_is_damaged_ends_it) {
    int64_t ends[EPISODES + 1];
    write_recording(ends);
    FILE *file = fopen(path, "r+");
    ck_assert_int_eq(fseek(file, (long)ends[1], SEEK_SET), 0);
    fputc(0, file); /* of the sync word of the second episode's first event */
    fclose(file);
    recording_place end;
    ck_assert(recording_find(path, 1, &end, error));
    ck_assert(!recording_find(path, 2, &end, error));
    ck_assert(!recording_find(path, EPISODES, &end, error));
}
END_TEST

START_TEST(going_on_leaves_no_trace_of_the_tear) {
    int64_t ends[EPISODES + 1];
    write_recording(ends);
    ck_assert_int_eq(truncate(path, (off_t)ends[2] + 50), 0);
    recording_place end;
    ck_assert(recording_find(path, 2, &end, error));
    recording r;
    ck_assert(recording_go_on(&r, path, end, error));
    add_episode(&r, 3);
    ck_assert(recording_close(&r, error));
    ck_assert_int_eq(file_size(), ends[EPISODES]);
    ck_assert_int_eq(count_events(), EVENTS);
}
END_TEST

START_TEST(a_running_one_is_cut_back) {
    recording r;
    ck_assert(recording_create(&r, path, error));
    add_episode(&r, 1);
    const recording_place place = recording_end(&r);
    add_episode(&r, 2);
    add_episode(&r, 3);
    ck_assert(recording_cut(&r, place, error));
    ck_assert_int_eq(recording_end(&r).bytes, place.bytes);
    add_episode(&r, 2);
    ck_assert(recording_close(&r, error));
    ck_assert_int_eq(file_size(), (int64_t)2 * place.bytes);
    ck_assert_int_eq(count_events(), 4);
}
END_TEST

/* Many episodes; each is 7 bytes of a state and its end. */
START_TEST(a_long_one_is_thinned) {
    enum { LIMIT = 20000, MANY = 1000 };
    recording r;
    bool thinned;
    int times = 0;
    ck_assert(recording_create(&r, path, error));
    for (int32_t i = 1; i <= MANY; i++) {
        add_episode(&r, i);
        const int64_t before = recording_end(&r).bytes;
        ck_assert_msg(recording_thin(&r, LIMIT, &thinned, error), "%s", error);
        ck_assert_int_eq(recording_end(&r).events, (int64_t)2 * i);
        ck_assert(thinned == (recording_end(&r).bytes < before));
        times += thinned;
    }
    ck_assert_int_gt(times, 2);
    ck_assert(recording_close(&r, error));
    recording_place end;
    for (int32_t i = 1; i <= MANY; i += 37) { /* all can be gone on from */
        ck_assert(recording_find(path, i, &end, error));
        ck_assert_int_eq(end.events, (int64_t)2 * i);
    }
    int states[3] = {0};
    FILE *file = fopen(path, "rb");
    for (recording_event e; recording_event_read(file, &e);) {
        if (strcmp(e.channel, LIMPHOME_CHANNEL_STATE) == 0) {
            states[e.number < 10 ? 0 : e.number < 2 * MANY - 10 ? 1 : 2]++;
        }
    }
    fclose(file);
    ck_assert_int_eq(states[0], 5); /* the first ten events and the last ten are all there */
    ck_assert_int_eq(states[2], 5);
    ck_assert_int_lt(states[1], MANY / 2);
}
END_TEST

/* Adds a state that the plant sent when its clock told `utime`. */
static void add_state_at(recording *r, int64_t utime) {
    unsigned char state[] = "a state";
    recording_at(r, utime);
    recording_add(r, LIMPHOME_CHANNEL_STATE, state, 7);
}

static void expect_times(const int64_t *expected, int count) {
    FILE *file = fopen(path, "rb");
    recording_event e;
    for (int i = 0; i < count; i++) {
        ck_assert(recording_event_read(file, &e));
        ck_assert_int_eq(e.time, expected[i]);
    }
    ck_assert(!recording_event_read(file, &e));
    fclose(file);
}

/* A clock that goes on is followed, one that begins anew or lies goes on from there; what comes before the plant is
 * heard, and between two states, is of the time before. */
START_TEST(log_time_is_plant_time) {
    static const int64_t hour = 3600000000;
    recording r;
    ck_assert(recording_create(&r, path, error));
    unsigned char status[] = "a status";
    recording_add(&r, LIMPHOME_CHANNEL_STATUS, status, 8);
    add_state_at(&r, hour);
    add_state_at(&r, hour + 500000);
    recording_add(&r, LIMPHOME_CHANNEL_STATUS, status, 8);
    add_state_at(&r, hour + 500000);
    add_state_at(&r, 0); /* the next session */
    add_state_at(&r, 500000);
    add_state_at(&r, INT64_MIN);
    add_state_at(&r, 100);
    add_state_at(&r, INT64_MAX);
    add_state_at(&r, 0);
    add_state_at(&r, 200);
    ck_assert(recording_close(&r, error));
    expect_times(
        (int64_t[]){0, 0, 500000, 500000, 500000, 500000, 1000000, 1000000, 1000100, INT64_MAX, INT64_MAX, INT64_MAX},
        12);
}
END_TEST

START_TEST(log_time_goes_on_where_the_file_does) {
    recording r;
    ck_assert(recording_create(&r, path, error));
    add_state_at(&r, 0);
    add_state_at(&r, 500000);
    add_episode(&r, 1);
    const recording_place place = recording_end(&r);
    add_state_at(&r, 1000000);
    ck_assert(recording_cut(&r, place, error)); /* and the plant begins anew */
    add_state_at(&r, 700000);
    add_episode(&r, 2);
    add_state_at(&r, 1000000);
    ck_assert(recording_close(&r, error));
    recording_place end;
    ck_assert(recording_find(path, 2, &end, error));
    ck_assert_int_eq(end.time, 500000);
    ck_assert(recording_go_on(&r, path, end, error));
    add_state_at(&r, 90000000);
    add_state_at(&r, 90500000);
    ck_assert(recording_close(&r, error));
    expect_times((int64_t[]){0, 500000, 500000, 500000, 500000, 500000, 500000, 500000, 1000000}, 9);
}
END_TEST

START_TEST(a_full_disk_is_told) {
    recording r;
    ck_assert(recording_create(&r, "/dev/full", error));
    for (int32_t i = 1; i < 1000; i++) {
        add_episode(&r, i);
    }
    ck_assert(!recording_good(&r, error));
    ck_assert_str_eq(error, "/dev/full: No space left on device");
    ck_assert(!recording_close(&r, error));
    fclose(fopen(path, "w"));
}
END_TEST

START_TEST(nothing_is_recorded_without_a_file) {
    recording r = {.log = NULL};
    add_episode(&r, 1);
    ck_assert(recording_cut(&r, recording_end(&r), error) && recording_flush(&r, error) && recording_close(&r, error));
    fclose(fopen(path, "w"));
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("recording");
    tcase_add_checked_fixture(cases, make_folder, remove_folder);
    tcase_add_test(cases, an_episode_is_found_where_the_file_is_whole_up_to_its_end);
    tcase_add_test(cases, an_interrupted_episode_does_not_belong_to_the_one_before);
    tcase_add_test(cases, an_event_that_is_damaged_ends_it);
    tcase_add_test(cases, going_on_leaves_no_trace_of_the_tear);
    tcase_add_test(cases, a_running_one_is_cut_back);
    tcase_add_test(cases, a_long_one_is_thinned);
    tcase_add_test(cases, log_time_is_plant_time);
    tcase_add_test(cases, log_time_goes_on_where_the_file_does);
    tcase_add_test(cases, a_full_disk_is_told);
    tcase_add_test(cases, nothing_is_recorded_without_a_file);
    return run_suite("recording", cases);
}
