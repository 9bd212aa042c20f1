/* Settings: defaults, reading, refusals with their place and range, writing, hash. */
#include <check.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "command_line.h"
#include "settings.h"

#define COUNT(table) (int)(sizeof(table) / sizeof(table)[0])

static char path[] = "/tmp/limphome_settings_XXXXXX";

/* Reads `text` as an INI file over the defaults. */
static bool read_text(settings *s, const char *text, char error[ERROR_LENGTH]) {
    char name[sizeof path];
    memcpy(name, path, sizeof path);
    const int file = mkstemp(name);
    ck_assert_int_ge(file, 0);
    ck_assert_int_eq(write(file, text, strlen(text)), (ssize_t)strlen(text));
    close(file);
    *s = settings_default();
    const bool result = settings_read(s, name, error);
    unlink(name);
    return result;
}

/* `text` must be refused, with each of the words in the error, and nothing taken over. */
static void check_refused(const char *text, const char *const *words) {
    char error[ERROR_LENGTH] = "";
    settings s;
    const settings standard = settings_default();
    ck_assert(!read_text(&s, text, error));
    ck_assert_mem_eq(&s, &standard, sizeof s);
    for (; *words != NULL; words++) {
        ck_assert_msg(strstr(error, *words) != NULL, "error \"%s\" lacks \"%s\"", error, *words);
    }
}

START_TEST(defaults_are_table_2) {
    const settings s = settings_default();
    ck_assert_double_eq(s.learning.learning_rate, 0.1);
    ck_assert_double_eq(s.learning.discount_rate, 0.9);
    ck_assert_double_eq(s.reward.forward, 8);
    ck_assert_double_eq(s.reward.sideways, 2);
    ck_assert_double_eq(s.reward.turn, 10);
    ck_assert_double_eq(s.reward.goal, 10);
    ck_assert_double_eq(s.episode.goal_distance_m, 2);
    ck_assert_double_eq(s.reward.stability, 1);
    ck_assert_double_eq(s.rbf.rate_weight, 0.1);
    ck_assert_double_eq(s.rbf.rate_width, 0.01);
    ck_assert_double_eq(s.rbf.rate_centre, 0.1);
    ck_assert_int_eq(s.rbf.units, 50);
    ck_assert_int_eq(s.learning.episodes, 2500);
}
END_TEST

START_TEST(paper_ini_is_the_default) {
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    const settings standard = settings_default();
    ck_assert_msg(settings_read(&s, CONFIG_DIR "/paper.ini", error), "%s", error);
    s.episode.tumble_tilt_rad = standard.episode.tumble_tilt_rad; /* printed with fewer digits */
    ck_assert_mem_eq(&s, &standard, sizeof s);
}
END_TEST

START_TEST(reads_comments_spaces_and_choices) {
    settings s;
    char error[ERROR_LENGTH] = "";
    ck_assert_msg(read_text(&s,
                            "; a comment\n[learning]\n  \nseed=7\nlearning_rate = 1e-2 ; inline\n\n[failure]\n"
                            "actuator = right_crawler\nmode = free\n[second_failure]\nactuator = joint_3",
                            error),
                  "%s", error);
    ck_assert_int_eq(s.learning.seed, 7);
    ck_assert_double_eq(s.learning.learning_rate, 0.01);
    ck_assert_int_eq(s.failure.actuator, SETTINGS_FAILED_RIGHT);
    ck_assert_int_eq(s.failure.mode, SETTINGS_FREE);
    ck_assert_int_eq(s.second_failure.actuator, SETTINGS_FAILED_JOINT + 2);
}
END_TEST

/* Files that mean seed 7 and 3 episodes, however they are laid out. */
static const char *const layouts[] = {
    "[learning]\nseed = 7\nepisodes = 3\n",
    "[learning]\r\nseed = 7\r\nepisodes = 3\r\n",
    "[learning]\rseed = 7\repisodes = 3\r",
    "[learning]\n\tseed = 7\n\tepisodes = 3\n",
    "  [learning] ; what follows\n    seed = 7\n        episodes = 3",
    "\xEF\xBB\xBF[learning]  # a byte order mark before it\nseed: 7\n  episodes = 3\n",
};

START_TEST(reads_every_layout) {
    settings s;
    char error[ERROR_LENGTH] = "";
    ck_assert_msg(read_text(&s, layouts[_i], error), "%s", error);
    ck_assert_int_eq(s.learning.seed, 7);
    ck_assert_int_eq(s.learning.episodes, 3);
}
END_TEST

START_TEST(refuses_a_byte_that_is_no_text) {
    char name[sizeof path];
    memcpy(name, path, sizeof path);
    static const char utf16[] = "[\0l\0e\0a\0";
    const int file = mkstemp(name);
    ck_assert_int_eq(write(file, utf16, sizeof utf16), (ssize_t)sizeof utf16);
    close(file);
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    ck_assert(!settings_read(&s, name, error));
    ck_assert_ptr_nonnull(strstr(error, ":1: a byte of value 0"));
    unlink(name);
}
END_TEST

static const struct {
    const char *text;
    const char *words[6]; /* ends with NULL */
} refusals[] = {
    {"[learning]\nseed = abc\n", {":2:", "[learning] seed = abc", "whole number from 0 to 2147483647"}},
    {"[learning]\nseed = 1.5\n", {":2:", "seed", "whole number"}},
    {"[learning]\nseed = -1\n", {":2:", "seed = -1", "from 0"}},
    {"[learning]\nseed = 99999999999999999999\n", {":2:", "seed", "from 0"}},
    {"\n\n[learning]\nlearning_rate = 1.01\n", {":4:", "learning_rate = 1.01", "a number from 0 to 1"}},
    {"[learning]\nlearning_rate = nan\n", {":2:", "learning_rate = nan", "a number from 0 to 1"}},
    {"[learning]\nlearning_rate = 0.1x\n", {":2:", "0.1x"}},
    {"[learning]\nlearning_rate =\n", {":2:", "learning_rate"}},
    {"[learning]\nlearn_rate = 0.1\n", {":2:", "learn_rate", "unknown key", "keys of [learning]:", "learning_rate"}},
    {"[lerning]\nseed = 1\n", {":2:", "[lerning]", "sections:", "learning"}},
    {"seed = 1\n", {":1:", "seed", "sections:"}},
    {"[failure]\nmode = broken\n", {":2:", "mode = broken", "one of: locked free weak slipping"}},
    {"[failure]\nmode = lock\n", {":2:", "mode = lock"}},
    {"[learning]\nseed = 1\nepisodes = 3\nseed = 2\n", {":4:", "seed", "already set at line 2"}},
    {"[learning]\nwhat is this\n", {":2:", "key = value"}},
    {"[learning\nseed = 1\n", {":1:"}},
    {"; one\n[learning] seed = 7\n", {":2:", "[section] must stand on a line of its own"}},
    {"\xEF\xBB\xBF[learning]seed = 7\n", {":1:", "[section] must stand on a line of its own"}},
    {"[learning]\rseed = 7\r\repisodes = 0\r", {":4:", "episodes = 0"}},
    {"[task]\npath = straight\n",
     {":2:", "[task] path = straight", "path is rolling, ahead, to X Y", "waypoints FILE"}},
    {"[task]\npath = ahead 3\n", {":2:", "path = ahead 3"}},
    {"[task]\npath = to\n", {":2:", "path = to"}},
    {"[task]\npath = to 3\n", {":2:", "path = to 3"}},
    {"[task]\npath = to 3-4\n", {":2:", "path = to 3-4"}},
    {"[task]\npath = to 3 -4 5\n", {":2:", "path = to 3 -4 5"}},
    {"[task]\npath = to 3 -4,\n", {":2:", "path = to 3 -4,"}},
    {"[task]\npath = to 3 1000.1\n", {":2:", "path = to 3 1000.1", "from -1000 to 1000"}},
    {"[task]\npath = to nan 1\n", {":2:", "path = to nan 1"}},
    {"[task]\npath = to 1 1,2 2,3 3,4 4,5 5,6 6,7 7,8 8,9 9\n", {":2:", "up to 8 waypoints"}},
    {"[task]\npath = waypoints\n", {":2:", "path = waypoints"}},
    {"\n[task]\npath = waypoints /nowhere/way.txt\n", {":3:", "[task] path", "/nowhere/way.txt: cannot be opened"}},
    {"[task]\npath = waypoints /\n", {":2:", "/: cannot be read"}},
};

START_TEST(refuses_with_place_and_range) {
    check_refused(refusals[_i].text, refusals[_i].words);
}
END_TEST

START_TEST(refuses_a_line_that_is_too_long) {
    char text[1200] = "[learning]\nseed = ";
    memset(text + strlen(text), '1', 1000);
    const char *const words[] = {":2:", "line too long", NULL};
    check_refused(text, words);
}
END_TEST

START_TEST(refuses_a_missing_file) {
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    ck_assert(!settings_read(&s, "/nowhere/at_all.ini", error));
    ck_assert_ptr_nonnull(strstr(error, "/nowhere/at_all.ini"));
    ck_assert(!settings_read(&s, "/", error));
}
END_TEST

START_TEST(set_takes_one_assignment) {
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    ck_assert(settings_set(&s, "simulator.pace=real_time", error));
    ck_assert_int_eq(s.simulator.pace, SETTINGS_REAL_TIME);
    static const char *const bad[] = {"",   "seed=1", "learning.seed",  "learning.seed=", "learning.seed=x",
                                      ".=", "a.b=c",  "learning=seed.1"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const settings before = s;
        ck_assert_msg(!settings_set(&s, bad[i], error), "%s was accepted", bad[i]);
        ck_assert_ptr_nonnull(strstr(error, "--set"));
        ck_assert_mem_eq(&s, &before, sizeof s);
    }
}
END_TEST

/* Two settings that are allowed each for itself, but not together; the text names both with their values. */
static const struct {
    const char *first, *second;
    const char *text;
} relations[] = {
    {"rbf.initial_width=0.5", "rbf.width_floor=0.75",
     "[rbf] initial_width = 0.5: must be at least [rbf] width_floor = 0.75"},
    {"rbf.initial_weight=20", "rbf.weight_limit=10",
     "[rbf] initial_weight = 20: must be in magnitude at most [rbf] weight_limit = 10"},
    {"rbf.initial_weight=-20", "rbf.weight_limit=10", "[rbf] initial_weight = -20: must be in magnitude"},
    {"safety.crawler_speed=0.2", "action.crawler_speed=0.25",
     "[safety] crawler_speed = 0.2: must be at least [action] crawler_speed = 0.25"},
    {"simulator.pace=real_time", "episode.decision_period_s=0.1",
     "[safety] crawler_acceleration = 2: nothing would ever move: must be at least 3, to come to [action] "
     "crawler_speed "
     "= 0.3 in [episode] decision_period_s = 0.1"},
    {"safety.monitor=on", "safety.joint_acceleration=0.5",
     "[safety] joint_acceleration = 0.5: nothing would ever move"},
    {"action.joint_speed=0.75", "safety.joint_speed=0.5",
     "[safety] joint_speed = 0.5: must be at least [action] joint_speed = 0.75"},
    {"episode.decision_period_s=0.5", "simulator.time_step_s=0.003",
     "[episode] decision_period_s = 0.5: must be a whole number of [simulator] time_step_s = 0.003"},
    {"episode.decision_period_s=0.01", "simulator.time_step_s=0.02", "[episode] decision_period_s = 0.01: must be"},
    {"sensors.attitude_delay_s=0.1001", "simulator.time_step_s=0.005",
     "[sensors] attitude_delay_s = 0.1001: must be a whole number of [simulator] time_step_s = 0.005"},
    {"sensors.position_delay_s=0.003", "simulator.time_step_s=0.005",
     "[sensors] position_delay_s = 0.003: must be a whole number of [simulator] time_step_s = 0.005"},
    {"sensors.joint_delay_s=1e-9", "simulator.time_step_s=0.005",
     "[sensors] joint_delay_s = 1e-09: must be a whole number of [simulator] time_step_s = 0.005"},
    {"sensors.torque_delay_s=4.9999", "simulator.time_step_s=0.005",
     "[sensors] torque_delay_s = 4.9999: must be a whole number of [simulator] time_step_s = 0.005"},
    {"failure.actuator=joint_2", "second_failure.actuator=joint_2",
     "[second_failure] actuator = joint_2: must be another than [failure] actuator = joint_2"},
    {"failure.actuator=joint_1", "failure.mode=slipping",
     "[failure] mode = slipping: is for crawlers only, not for [failure] actuator = joint_1"},
    {"second_failure.actuator=joint_6", "second_failure.mode=slipping",
     "[second_failure] mode = slipping: is for crawlers only, not for [second_failure] actuator = joint_6"},
};

START_TEST(check_names_both_of_two_that_do_not_go_together) {
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    ck_assert(settings_set(&s, relations[_i].first, error));
    ck_assert(settings_set(&s, relations[_i].second, error));
    ck_assert(!settings_check(&s, error));
    ck_assert_msg(strstr(error, relations[_i].text) == error, "error \"%s\" is not \"%s\"", error, relations[_i].text);
}
END_TEST

/* Next to what is refused. */
static const struct {
    const char *first, *second;
} agreements[] = {
    {"rbf.initial_width=0.5", "rbf.width_floor=0.5"},
    {"rbf.initial_weight=-10", "rbf.weight_limit=10"},
    {"safety.crawler_speed=0.25", "action.crawler_speed=0.25"},
    {"safety.joint_speed=2", "action.joint_speed=2"},
    {"safety.monitor=off", "safety.joint_acceleration=0.5"},
    {"episode.decision_period_s=0.02", "simulator.time_step_s=0.02"},
    {"episode.decision_period_s=0.3", "simulator.time_step_s=0.003"},
    {"sensors.joint_delay_s=0.1", "simulator.time_step_s=0.005"},
    {"failure.actuator=none", "second_failure.actuator=none"},
    {"failure.actuator=left_crawler", "second_failure.actuator=right_crawler"},
    {"failure.actuator=right_crawler", "failure.mode=slipping"},
    {"second_failure.actuator=none", "second_failure.mode=slipping"},
};

START_TEST(check_accepts_what_goes_together) {
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    ck_assert(settings_set(&s, agreements[_i].first, error));
    ck_assert(settings_set(&s, agreements[_i].second, error));
    ck_assert_msg(settings_check(&s, error), "%s", error);
}
END_TEST

/* Settings that were made by a program, not read. */
static void check_out_of_range(const settings *s, const char *text) {
    char error[ERROR_LENGTH] = "";
    ck_assert(!settings_check(s, error));
    ck_assert_str_eq(error, text);
}

START_TEST(check_wants_every_value_in_its_range) {
    settings s = settings_default();
    s.episode.step_limit = 0;
    check_out_of_range(&s, "[episode] step_limit = 0: not allowed; step_limit is a whole number from 1 to 100000");
    s = settings_default();
    s.failure.mode = SETTINGS_SLIPPING + 1;
    check_out_of_range(&s, "[failure] mode = ?: not allowed; mode is one of: locked free weak slipping");
    s = settings_default();
    s.reward.goal = NAN;
    check_out_of_range(&s, "[reward] goal = nan: not allowed; goal is a number from 0 to 1000");
    s = settings_default();
    s.task.path.kind = SETTINGS_WAYPOINTS;
    check_out_of_range(&s,
                       "[task] path = ?: not allowed; path is rolling, ahead, to X Y[, X Y ...] (up to 8 waypoints, "
                       "coordinates from -1000 to 1000 [m]) or waypoints FILE");
}
END_TEST

START_TEST(what_is_written_reads_back_the_same) {
    settings s = settings_default();
    s.learning.learning_rate = 1.0 / 3;
    s.simulator.time_step_s = 0.1 / 24;
    s.failure.mode = SETTINGS_WEAK;
    char text[8192] = "";
    FILE *out = fmemopen(text, sizeof text, "w");
    settings_write(&s, out);
    fclose(out);
    settings read;
    char error[ERROR_LENGTH] = "";
    ck_assert_msg(read_text(&read, text, error), "%s", error);
    ck_assert_mem_eq(&read, &s, sizeof s);
}
END_TEST

/* A path as text, and as it is printed. */
static const struct {
    const char *text, *printed;
} paths[] = {
    {"rolling", "rolling"},
    {"ahead", "ahead"},
    {"to 3 -4", "to 3 -4"},
    {"to  0.5\t5 ,5 5e0", "to 0.5 5, 5 5"},
    {"to -0.0001 1.23456", "to 0 1.235"},
    /* the longest there is */
    {"to -999.999 -999.999,-999.999 -999.999,-999.999 -999.999,-999.999 -999.999,-999.999 -999.999,-999.999 -999.999,"
     "-999.999 -999.999,-999.999 -999.999",
     "to -999.999 -999.999, -999.999 -999.999, -999.999 -999.999, -999.999 -999.999, -999.999 -999.999, "
     "-999.999 -999.999, -999.999 -999.999, -999.999 -999.999"},
};

START_TEST(a_path_is_printed_as_it_is_read) {
    char assignment[256];
    char error[ERROR_LENGTH] = "";
    settings s = settings_default();
    snprintf(assignment, sizeof assignment, "task.path=%s", paths[_i].text);
    ck_assert_msg(settings_set(&s, assignment, error), "%s", error);
    ck_assert_msg(settings_check(&s, error), "%s", error);
    char text[8192] = "";
    char expected[256];
    FILE *out = fmemopen(text, sizeof text, "w");
    settings_write(&s, out);
    fclose(out);
    snprintf(expected, sizeof expected, "\npath = %s\n", paths[_i].printed);
    ck_assert_ptr_nonnull(strstr(text, expected));
    settings read;
    ck_assert_msg(read_text(&read, text, error), "%s", error);
    ck_assert_mem_eq(&read, &s, sizeof s);
}
END_TEST

/* Takes a file of waypoints with this text as the path. */
static bool set_waypoints(settings *s, const char *text, char error[ERROR_LENGTH]) {
    char name[sizeof path];
    memcpy(name, path, sizeof path);
    const int file = mkstemp(name);
    ck_assert_int_ge(file, 0);
    ck_assert_int_eq(write(file, text, strlen(text)), (ssize_t)strlen(text));
    close(file);
    char assignment[256];
    snprintf(assignment, sizeof assignment, "task.path=waypoints %s", name);
    const bool result = settings_set(s, assignment, error);
    unlink(name);
    return result;
}

START_TEST(waypoints_are_read_from_a_file) {
    settings from_file = settings_default();
    settings given = from_file;
    char error[ERROR_LENGTH] = "";
    ck_assert_msg(set_waypoints(&from_file, "; an L\n0 5 # ahead\r\n\n  5\t5", error), "%s", error);
    ck_assert(settings_set(&given, "task.path=to 0 5, 5 5", error));
    ck_assert_mem_eq(&from_file, &given, sizeof given);
}
END_TEST

static const struct {
    const char *text;
    const char *words[4]; /* ends with NULL */
} bad_waypoints[] = {
    {"0 5\n5\n", {":2: 5: not allowed", "X Y, two numbers from -1000 to 1000 [m]"}},
    {"0 5 3\n", {":1: 0 5 3: not allowed"}},
    {"# none\n", {"holds no waypoint"}},
    {"", {"holds no waypoint"}},
    {"1 1\n2 2\n3 3\n4 4\n5 5\n6 6\n7 7\n8 8\n\n9 9\n", {":10: too many; at most 8 waypoints"}},
    {"\n0                                                                                                   "
     "                                                                   5\n",
     {":2: line too long"}},
    {"0 5\r5 5\r", {":1: line too long, or no text that ends in \\n"}},
};

START_TEST(bad_waypoints_are_refused_with_their_place) {
    settings s = settings_default();
    const settings standard = s;
    char error[ERROR_LENGTH] = "";
    ck_assert(!set_waypoints(&s, bad_waypoints[_i].text, error));
    ck_assert_mem_eq(&s, &standard, sizeof s);
    ck_assert_ptr_eq(strstr(error, "--set task.path=waypoints /tmp/limphome_settings_"), error);
    for (const char *const *word = bad_waypoints[_i].words; *word != NULL; word++) {
        ck_assert_msg(strstr(error, *word) != NULL, "error \"%s\" lacks \"%s\"", error, *word);
    }
}
END_TEST

START_TEST(hash_tells_what_decides) {
    const settings s = settings_default();
    settings other = s;
    other.learning.episodes = 10;
    other.simulator.pace = SETTINGS_REAL_TIME;
    other.link.resend_s = 0.1;
    ck_assert_uint_eq(settings_hash(&s), settings_hash(&other));
    other.rbf.rate_width = 0.02;
    ck_assert_uint_ne(settings_hash(&s), settings_hash(&other));
    other = s;
    other.failure.mode = SETTINGS_FREE;
    ck_assert_uint_ne(settings_hash(&s), settings_hash(&other));
    other = s;
    other.task.path.kind = SETTINGS_AHEAD;
    ck_assert_uint_ne(settings_hash(&s), settings_hash(&other));
}
END_TEST

static void check_hash(const settings *s, uint64_t expected) {
    ck_assert_msg(settings_hash(s) == expected, "0x%016" PRIx64 ", expected 0x%016" PRIx64, settings_hash(s), expected);
}

/* A checkpoint is gone on with only where the hash is that of its settings. A new key that decides what is learned
 * changes these on purpose. */
START_TEST(hash_is_that_of_earlier_checkpoints) {
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    check_hash(&s, 0x6f2eff7f6e26a064);
    ck_assert_msg(settings_read(&s, CONFIG_DIR "/paper.ini", error), "%s", error);
    check_hash(&s, 0x22aee0356271c613);
}
END_TEST

START_TEST(command_line_takes_the_file_first_then_assignments) {
    char name[sizeof path];
    memcpy(name, path, sizeof path);
    const int file = mkstemp(name);
    dprintf(file, "[learning]\nseed = 5\nepisodes = 6\n");
    close(file);
    char *arguments[] = {"limphome-controller", "--set", "learning.seed=9", "--config", name, "--out", "x", NULL};
    command_line line;
    ck_assert_int_eq(command_line_parse(7, arguments, COMMAND_LINE_CONTROLLER, &line), COMMAND_LINE_RUN);
    ck_assert_int_eq(line.settings.learning.seed, 9);
    ck_assert_int_eq(line.settings.learning.episodes, 6);
    ck_assert_str_eq(line.out, "x");
    unlink(name);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("settings");
    TCase *all = tcase_create("settings");
    tcase_add_test(all, defaults_are_table_2);
    tcase_add_test(all, paper_ini_is_the_default);
    tcase_add_test(all, reads_comments_spaces_and_choices);
    tcase_add_loop_test(all, reads_every_layout, 0, COUNT(layouts));
    tcase_add_test(all, refuses_a_byte_that_is_no_text);
    tcase_add_loop_test(all, refuses_with_place_and_range, 0, COUNT(refusals));
    tcase_add_test(all, refuses_a_line_that_is_too_long);
    tcase_add_test(all, refuses_a_missing_file);
    tcase_add_test(all, set_takes_one_assignment);
    tcase_add_loop_test(all, check_names_both_of_two_that_do_not_go_together, 0, COUNT(relations));
    tcase_add_loop_test(all, check_accepts_what_goes_together, 0, COUNT(agreements));
    tcase_add_test(all, check_wants_every_value_in_its_range);
    tcase_add_test(all, what_is_written_reads_back_the_same);
    tcase_add_loop_test(all, a_path_is_printed_as_it_is_read, 0, COUNT(paths));
    tcase_add_test(all, waypoints_are_read_from_a_file);
    tcase_add_loop_test(all, bad_waypoints_are_refused_with_their_place, 0, COUNT(bad_waypoints));
    tcase_add_test(all, hash_tells_what_decides);
    tcase_add_test(all, hash_is_that_of_earlier_checkpoints);
    tcase_add_test(all, command_line_takes_the_file_first_then_assignments);
    suite_add_tcase(suite, all);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed != 0;
}
