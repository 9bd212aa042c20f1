/* Every write cut: a run whose process dies at any byte of any file is gone on with, and ends as one that never died.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "limphome_channels.h"
#include "run_folder.h"
#include "suite.h"

enum { SETTINGS = 1234, EPISODES = 6, CHECKPOINT_EVERY = 2 };

static char error[ERROR_LENGTH]; /* of the newest failure */

static learned learned_after(int32_t after) {
    learned l;
    memset(&l, 0, sizeof l);
    l.kind = LH_Q_LEARNING;
    limphome_checkpoint_t *c = &l.as.q_learning;
    c->settings_hash = SETTINGS;
    c->episode = c->policy.episode = after;
    c->policy.num_actuators = c->policy.num_controlled = 1;
    c->policy.num_units = 1;
    c->policy.num_inputs = 4;
    c->policy.weight[0] = (float)after;
    return l;
}

/* An episode as limphome-controller leaves it. */
static bool finish_episode(run_folder *folder, int32_t number) {
    static unsigned char bytes[LEARNED_LARGEST];
    const limphome_episode_t e = {.episode = number, .outcome = LIMPHOME_EPISODE_T_GOAL, .steps = 3};
    recording_add(&folder->recording, LIMPHOME_CHANNEL_STATE, bytes, 1000);
    recording_add(&folder->recording, LIMPHOME_CHANNEL_EPISODE, bytes,
                  limphome_episode_t_encode(bytes, 0, sizeof bytes, &e));
    if (!run_folder_episode(folder, &e, error)) {
        return false;
    }
    if (number % CHECKPOINT_EVERY != 0) {
        return true;
    }
    const learned l = learned_after(number);
    recording_add(&folder->recording, learned_channel(&l), bytes, learned_encode_policy(&l, bytes, sizeof bytes));
    return run_folder_checkpoint(folder, &l, error) && recording_good(&folder->recording, error);
}

/* Episodes first to last and the end; exit code 0 if all was written. */
static bool finish_run(run_folder *folder, int32_t first) {
    for (int32_t i = first; i <= EPISODES; i++) {
        if (!finish_episode(folder, i)) {
            return false;
        }
    }
    const learned l = learned_after(EPISODES);
    return run_folder_policy(folder, &l, error) && run_folder_close(folder, error);
}

/* What a run has begun with nothing, in a process that no file may let write beyond `most` bytes: the write that would
 * is cut there, and the next one kills it. */
static bool run_with_limit(const char *path, rlim_t most) {
    const pid_t child = fork();
    if (child == 0) {
        const struct rlimit limit = {most, most}, none = {0, 0};
        run_folder folder;
        setrlimit(RLIMIT_CORE, &none);
        setrlimit(RLIMIT_FSIZE, &limit);
        _exit(run_folder_create(&folder, path, error) && finish_run(&folder, 1) ? 0 : 1);
    }
    int status = -1;
    ck_assert_int_eq(waitpid(child, &status, 0), child);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

static bool go_on(const char *path) {
    run_folder folder = {.lock = -1};
    run_folder_place place;
    learned l;
    error[0] = '\0';
    if (!run_folder_find(path, SETTINGS, CHECKPOINT_EVERY, &place, &l, error) ||
        !run_folder_resume(&folder, path, &place, error)) {
        return false;
    }
    ck_assert(place.episodes == 0 || learned_episode(&l) == place.episodes);
    return finish_run(&folder, place.episodes + 1);
}

static off_t size_of(const char *folder, const char *name) {
    char path[128];
    struct stat found;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return stat(path, &found) == 0 ? found.st_size : -1;
}

/* Apart from the times in the recording. */
static void expect_alike(const char *actual, const char *expected) {
    char command[512];
    snprintf(command, sizeof command,
             "cd %s && cmp -s episodes.csv %s/episodes.csv && cmp -s policy.lcm %s/policy.lcm && "
             "diff -rq checkpoint %s/checkpoint >/dev/null",
             actual, expected, expected, expected);
    ck_assert_int_eq(system(command), 0);
    ck_assert_int_eq(size_of(actual, "messages.lcmlog"), size_of(expected, "messages.lcmlog"));
}

/* The steps are prime, so that cuts come in all places of a record. */
START_TEST(a_run_cut_at_any_byte_is_gone_on_with) {
    char base[] = "/tmp/limphome_cut_XXXXXX";
    char whole[64], cut[64], command[128];
    ck_assert_ptr_nonnull(mkdtemp(base));
    snprintf(whole, sizeof whole, "%s/whole", base);
    snprintf(cut, sizeof cut, "%s/cut", base);
    ck_assert(run_with_limit(whole, RLIM_INFINITY));
    const rlim_t longest = (rlim_t)size_of(whole, "messages.lcmlog");
    int cuts = 0;
    for (rlim_t most = 1; most < longest; most += most < 1000 ? 37 : 251, cuts++) {
        ck_assert(!run_with_limit(cut, most));
        ck_assert_msg(go_on(cut), "after %d bytes: %s", (int)most, error);
        expect_alike(cut, whole);
        snprintf(command, sizeof command, "rm -r '%s'", cut);
        ck_assert_int_eq(system(command), 0);
    }
    printf("%d cuts\n", cuts);
    snprintf(command, sizeof command, "rm -r '%s'", base);
    ck_assert_int_eq(system(command), 0);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("write_cut");
    tcase_set_timeout(cases, 120);
    tcase_add_test(cases, a_run_cut_at_any_byte_is_gone_on_with);
    return run_suite("write_cut", cases);
}
