/* The run folder: rows, checkpoints, taking up where the newest good checkpoint lies, and what is refused. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "limphome_channels.h"
#include "run_folder.h"
#include "suite.h"

enum { SETTINGS = 1234, RESET_EVERY = 10 }; /* hash of those that the runs were made with */

static char folder_name[64];
static char error[ERROR_LENGTH]; /* of the newest failure */

static void make_name(void) {
    error[0] = '\0';
    snprintf(folder_name, sizeof folder_name, "/tmp/limphome_run_XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(folder_name));
}

static void remove_folder(void) {
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", folder_name);
    ck_assert_int_eq(system(command), 0);
}

static limphome_episode_t episode(int32_t number) {
    return (limphome_episode_t){.episode = number,
                                .outcome = LIMPHOME_EPISODE_T_GOAL,
                                .steps = 10 * number,
                                .duration = 5.0 * number,
                                .reward = 1.5,
                                .reward_motion = 1.5,
                                .temperature = 0.25};
}

static learned learned_after(int32_t after) {
    learned l;
    memset(&l, 0, sizeof l);
    l.kind = LH_Q_LEARNING;
    limphome_checkpoint_t *c = &l.as.q_learning;
    c->settings_hash = SETTINGS;
    c->episode = c->policy.episode = after;
    c->policy.num_actuators = 5;
    c->policy.num_controlled = 4;
    c->policy.num_units = 50;
    c->policy.num_inputs = 10;
    c->policy.weight[3] = 0.5F;
    c->q_learning.random_state[1] = 99;
    return l;
}

static learned planned_after(int32_t after) {
    learned l;
    memset(&l, 0, sizeof l);
    l.kind = LH_PLANNER;
    limphome_planner_checkpoint_t *c = &l.as.planner;
    c->settings_hash = SETTINGS;
    c->episode = c->planner.episode = after;
    c->planner.num_actuators = 5;
    c->planner.num_controlled = 4;
    c->planner.num_actions = 81;
    c->planner.num_nodes = 1200;
    c->planner.node_value[1199][8] = -7;
    return l;
}

/* Compares them as messages: what lies between the fields of a struct is nobody's. */
static void expect_same(const learned *actual, const learned *expected) {
    static unsigned char bytes[2][LEARNED_LARGEST];
    const int size = learned_encode_checkpoint(actual, bytes[0], sizeof bytes[0]);
    ck_assert_int_gt(size, 0);
    ck_assert_int_eq(learned_encode_checkpoint(expected, bytes[1], sizeof bytes[1]), size);
    ck_assert_mem_eq(bytes[0], bytes[1], (size_t)size);
}

static void file_path(char path[256], const char *name) {
    snprintf(path, 256, "%s/%s", folder_name, name);
}

static off_t file_size(const char *path) {
    struct stat found;
    ck_assert_int_eq(stat(path, &found), 0);
    return found.st_size;
}

static int count_lines(const char *name) {
    char path[256];
    file_path(path, name);
    FILE *file = fopen(path, "r");
    ck_assert_ptr_nonnull(file);
    int lines = 0;
    for (int c; (c = fgetc(file)) != EOF;) {
        lines += c == '\n';
    }
    fclose(file);
    return lines;
}

static void record_episode(run_folder *folder, const limphome_episode_t *e) {
    unsigned char bytes[1024];
    const int size = limphome_episode_t_encode(bytes, 0, sizeof bytes, e);
    recording_add(&folder->recording, LIMPHOME_CHANNEL_EPISODE, bytes, size);
}

/* Goes on as limphome-controller --resume does. */
static bool resume(run_folder *folder, const char *path, int64_t settings_hash, run_folder_place *place, learned *l) {
    memset(folder, 0, sizeof *folder);
    folder->lock = -1;
    return run_folder_find(path, settings_hash, RESET_EVERY, place, l, error) &&
           run_folder_resume(folder, path, place, error);
}

/* Of episodes.csv and messages.lcmlog alike. */
static void expect_episodes(int32_t episodes) {
    char path[256];
    recording_place end;
    ck_assert_int_eq(count_lines("episodes.csv"), 1 + episodes);
    file_path(path, "messages.lcmlog");
    ck_assert(recording_find(path, episodes, &end, error));
    ck_assert_int_eq(end.bytes, file_size(path));
}

/* Episodes 1 to `episodes`, with a checkpoint after each tenth. */
static void write_run(int32_t episodes) {
    run_folder folder;
    ck_assert(run_folder_create(&folder, folder_name, error));
    for (int32_t i = 1; i <= episodes; i++) {
        const limphome_episode_t e = episode(i);
        record_episode(&folder, &e);
        ck_assert(run_folder_episode(&folder, &e, error));
        const learned l = learned_after(i);
        ck_assert(i % 10 != 0 || run_folder_checkpoint(&folder, &l, error));
    }
    ck_assert(run_folder_close(&folder, error));
}

START_TEST(a_row_holds_the_summary) {
    write_run(1);
    char path[256];
    char line[512];
    file_path(path, "episodes.csv");
    FILE *file = fopen(path, "r");
    ck_assert_ptr_nonnull(fgets(line, sizeof line, file));
    ck_assert_ptr_nonnull(fgets(line, sizeof line, file));
    ck_assert_str_eq(line, "1,goal,10,5,1.5,1.5,0,0,0,0,0,0.25\n");
    fclose(file);
}
END_TEST

START_TEST(a_folder_with_a_run_is_refused) {
    write_run(1);
    run_folder folder;
    ck_assert(!run_folder_create(&folder, folder_name, error));
    ck_assert_int_eq(count_lines("episodes.csv"), 2);
}
END_TEST

START_TEST(resume_takes_the_newest_checkpoint_and_cuts_what_came_after) {
    write_run(27);
    run_folder folder;
    run_folder_place place;
    learned l;
    const learned expected = learned_after(20);
    ck_assert(resume(&folder, folder_name, SETTINGS, &place, &l));
    ck_assert_int_eq(place.episodes, 20);
    expect_same(&l, &expected);
    expect_episodes(20);
    const limphome_episode_t e = episode(21);
    record_episode(&folder, &e);
    ck_assert(run_folder_episode(&folder, &e, error));
    ck_assert(run_folder_close(&folder, error));
    expect_episodes(21);
}
END_TEST

/* One of two files that a checkpoint of 20 needs is cut short, or the checkpoint itself: the one of 10 is taken. */
START_TEST(resume_steps_back_over_what_is_damaged) {
    static const struct {
        const char *file;
        off_t length;
    } damage[] = {{"checkpoint/episode_000020.lcm", 100},
                  {"checkpoint/episode_000020.lcm", 0},
                  {"episodes.csv", 700},
                  {"messages.lcmlog", 4000}};
    write_run(27);
    run_folder folder;
    run_folder_place place;
    learned l;
    char path[256];
    file_path(path, damage[_i].file);
    ck_assert_int_gt(file_size(path), damage[_i].length);
    ck_assert_int_eq(truncate(path, damage[_i].length), 0);
    ck_assert_msg(resume(&folder, folder_name, SETTINGS, &place, &l), "%s", error);
    ck_assert_int_eq(place.episodes, 10);
    ck_assert_int_eq(learned_episode(&l), 10);
    ck_assert(run_folder_close(&folder, error));
    expect_episodes(10);
}
END_TEST

START_TEST(resume_without_a_good_checkpoint_is_refused_and_loses_nothing) {
    write_run(17);
    run_folder folder;
    run_folder_place place;
    learned l;
    char path[256];
    file_path(path, "checkpoint/episode_000010.lcm");
    ck_assert_int_eq(truncate(path, 100), 0);
    ck_assert(!resume(&folder, folder_name, SETTINGS, &place, &l));
    ck_assert_ptr_nonnull(strstr(error, "no checkpoint that is good"));
    expect_episodes(17);
}
END_TEST

START_TEST(a_stray_file_among_the_checkpoints_is_ignored) {
    static const char *const names[] = {"episode_000099.lcm.new", "episode_99.lcm", "notes.txt", "episode_-00001.lcm"};
    write_run(27);
    char path[256];
    for (int i = 0; i < 4; i++) {
        snprintf(path, sizeof path, "%s/checkpoint/%s", folder_name, names[i]);
        fclose(fopen(path, "w"));
    }
    run_folder_place place;
    learned l;
    ck_assert(run_folder_find(folder_name, SETTINGS, RESET_EVERY, &place, &l, error));
    ck_assert_int_eq(place.episodes, 20);
}
END_TEST

START_TEST(a_run_without_a_recording_is_gone_on_with) {
    write_run(27);
    char path[256];
    file_path(path, "messages.lcmlog");
    ck_assert_int_eq(unlink(path), 0);
    run_folder folder;
    run_folder_place place;
    learned l;
    ck_assert(resume(&folder, folder_name, SETTINGS, &place, &l));
    ck_assert_int_eq(place.episodes, 20);
    ck_assert(run_folder_close(&folder, error));
}
END_TEST

START_TEST(resume_with_other_settings_is_refused_and_loses_nothing) {
    write_run(27);
    run_folder folder;
    run_folder_place place;
    learned l;
    ck_assert(!resume(&folder, folder_name, SETTINGS + 1, &place, &l));
    ck_assert_ptr_nonnull(strstr(error, "other settings"));
    expect_episodes(27);
}
END_TEST

START_TEST(a_run_that_ended_before_its_first_checkpoint_begins_anew) {
    write_run(5);
    run_folder folder;
    run_folder_place place;
    learned l;
    ck_assert(resume(&folder, folder_name, SETTINGS, &place, &l));
    ck_assert_int_eq(place.episodes, 0);
    ck_assert(run_folder_close(&folder, error));
    ck_assert_int_eq(count_lines("episodes.csv"), 1);
    char path[256];
    file_path(path, "messages.lcmlog");
    ck_assert_int_eq(file_size(path), 0);
}
END_TEST

START_TEST(a_run_whose_checkpoints_are_gone_is_left_as_it_is) {
    write_run(2 * RESET_EVERY);
    char path[256];
    for (int32_t i = 1; i <= 2; i++) {
        snprintf(path, sizeof path, "%s/checkpoint/episode_%06d.lcm", folder_name, i * RESET_EVERY);
        ck_assert_int_eq(unlink(path), 0);
    }
    run_folder folder;
    run_folder_place place;
    learned l;
    ck_assert(!resume(&folder, folder_name, SETTINGS, &place, &l));
    ck_assert_ptr_nonnull(strstr(error, "the checkpoints are gone"));
    ck_assert_int_eq(count_lines("episodes.csv"), 1 + 2 * RESET_EVERY);
}
END_TEST

START_TEST(what_is_no_table_is_left_as_it_is) {
    char path[256];
    file_path(path, "episodes.csv");
    FILE *file = fopen(path, "w");
    fputs("two years of work\n", file);
    fclose(file);
    run_folder folder;
    run_folder_place place;
    learned l;
    ck_assert(!resume(&folder, folder_name, SETTINGS, &place, &l));
    ck_assert_ptr_nonnull(strstr(error, "episodes.csv:1: "));
    ck_assert_int_eq(file_size(path), 18);
    ck_assert(!resume(&folder, "/nowhere", SETTINGS, &place, &l));
}
END_TEST

/* The plant has been started anew after three episodes more. */
START_TEST(table_and_recording_are_cut_back_to_a_place) {
    run_folder folder;
    ck_assert(run_folder_create(&folder, folder_name, error));
    run_folder_place place = run_folder_here(&folder, 0);
    for (int32_t i = 1; i <= 5; i++) {
        const limphome_episode_t e = episode(i);
        record_episode(&folder, &e);
        ck_assert(run_folder_episode(&folder, &e, error));
        place = i == 2 ? run_folder_here(&folder, i) : place;
    }
    ck_assert(run_folder_cut(&folder, &place, error));
    const limphome_episode_t e = episode(3);
    record_episode(&folder, &e);
    ck_assert(run_folder_episode(&folder, &e, error));
    ck_assert(run_folder_close(&folder, error));
    expect_episodes(3);
}
END_TEST

/* A lock is a process's, so another one has to ask. */
START_TEST(a_second_controller_is_refused_and_told_who_is_there) {
    run_folder folder, second;
    ck_assert(run_folder_create(&folder, folder_name, error));
    const pid_t child = fork();
    if (child == 0) {
        char expected[64];
        snprintf(expected, sizeof expected, "process %d works in this folder", (int)getppid());
        _exit(!run_folder_create(&second, folder_name, error) && strstr(error, expected) != NULL ? 0 : 1);
    }
    int status = -1;
    ck_assert_int_eq(waitpid(child, &status, 0), child);
    ck_assert_int_eq(status, 0);
    ck_assert(run_folder_close(&folder, error));
}
END_TEST

START_TEST(a_policy_reads_back) {
    const learned written[] = {learned_after(10), planned_after(10)};
    run_folder folder;
    ck_assert(run_folder_create(&folder, folder_name, error));
    char path[256];
    file_path(path, "policy.lcm");
    learned l;
    for (int i = 0; i < 2; i++) {
        ck_assert(run_folder_policy(&folder, &written[i], error));
        ck_assert(run_folder_read_policy(path, &l, error));
        ck_assert_int_eq(l.kind, written[i].kind);
        ck_assert(l.policy_only);
        static unsigned char bytes[2][LEARNED_LARGEST];
        const int size = learned_encode_policy(&written[i], bytes[0], LEARNED_LARGEST);
        ck_assert_int_eq(learned_encode_policy(&l, bytes[1], LEARNED_LARGEST), size);
        ck_assert_mem_eq(bytes[0], bytes[1], (size_t)size);
    }
    ck_assert(run_folder_close(&folder, error));
    file_path(path, "episodes.csv");
    ck_assert(!run_folder_read_policy(path, &l, error));
    ck_assert(!run_folder_read_policy("/nowhere", &l, error));
}
END_TEST

START_TEST(a_planner_is_gone_on_with) {
    run_folder folder;
    ck_assert(run_folder_create(&folder, folder_name, error));
    const limphome_episode_t e = episode(1);
    const learned expected = planned_after(1);
    record_episode(&folder, &e);
    ck_assert(run_folder_episode(&folder, &e, error));
    ck_assert(run_folder_checkpoint(&folder, &expected, error));
    ck_assert(run_folder_close(&folder, error));
    run_folder_place place;
    learned l;
    ck_assert(resume(&folder, folder_name, SETTINGS, &place, &l));
    ck_assert_int_eq(place.episodes, 1);
    ck_assert(run_folder_close(&folder, error));
    expect_same(&l, &expected);
}
END_TEST

START_TEST(no_folder_writes_nothing) {
    run_folder folder;
    const limphome_episode_t e = episode(1);
    const learned l = learned_after(1);
    ck_assert(run_folder_create(&folder, NULL, error));
    ck_assert(run_folder_episode(&folder, &e, error));
    ck_assert(run_folder_checkpoint(&folder, &l, error));
    ck_assert(run_folder_policy(&folder, &l, error));
    ck_assert(run_folder_close(&folder, error));
}
END_TEST

START_TEST(a_place_that_cannot_be_written_is_refused) {
    run_folder folder;
    ck_assert(!run_folder_create(&folder, "/proc/nothing/here", error));
}
END_TEST

START_TEST(the_reason_is_told_however_long_the_path) {
    run_folder folder;
    char path[4 * FILES_PATH_LENGTH];
    memset(path, 'x', sizeof path);
    path[sizeof path - 1] = '\0';
    ck_assert(!run_folder_create(&folder, path, error));
    ck_assert_ptr_nonnull(strstr(error, "too long"));
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("run_folder");
    tcase_add_checked_fixture(cases, make_name, remove_folder);
    tcase_add_test(cases, a_row_holds_the_summary);
    tcase_add_test(cases, a_folder_with_a_run_is_refused);
    tcase_add_test(cases, resume_takes_the_newest_checkpoint_and_cuts_what_came_after);
    tcase_add_loop_test(cases, resume_steps_back_over_what_is_damaged, 0, 4);
    tcase_add_test(cases, resume_without_a_good_checkpoint_is_refused_and_loses_nothing);
    tcase_add_test(cases, a_stray_file_among_the_checkpoints_is_ignored);
    tcase_add_test(cases, a_run_without_a_recording_is_gone_on_with);
    tcase_add_test(cases, resume_with_other_settings_is_refused_and_loses_nothing);
    tcase_add_test(cases, a_run_that_ended_before_its_first_checkpoint_begins_anew);
    tcase_add_test(cases, a_run_whose_checkpoints_are_gone_is_left_as_it_is);
    tcase_add_test(cases, what_is_no_table_is_left_as_it_is);
    tcase_add_test(cases, table_and_recording_are_cut_back_to_a_place);
    tcase_add_test(cases, a_second_controller_is_refused_and_told_who_is_there);
    tcase_add_test(cases, a_policy_reads_back);
    tcase_add_test(cases, a_planner_is_gone_on_with);
    tcase_add_test(cases, no_folder_writes_nothing);
    tcase_add_test(cases, a_place_that_cannot_be_written_is_refused);
    tcase_add_test(cases, the_reason_is_told_however_long_the_path);
    return run_suite("run_folder", cases);
}
