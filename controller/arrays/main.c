/* limphome-arrays: a learned policy, and the robot and the settings that it is for, as C: what the library on a
 * microcontroller takes as it is. Exit 0: both files are written; 1: they could not be; 2: bad input. */
#include <getopt.h>
#include <stdio.h>
#include <string.h>

#include "convert.h"
#include "convert_robot.h"
#include "learned.h"
#include "process.h"
#include "robot_file.h"
#include "run_folder.h"
#include "settings.h"
#include "structs.h"

enum { DONE = 0, WENT_WRONG = 1, BAD_INPUT = 2 };

static const char help[] =
    "usage: limphome-arrays --config FILE --robot FILE [--packages DIR[:DIR]] --policy FILE --out DIR\n"
    "\n"
    "Writes a learned policy as C for the library on a microcontroller: DIR/robot.h has limphome_robot and\n"
    "limphome_shapes, DIR/policy.h limphome_config, limphome_controlled, limphome_learned and limphome_episode. They\n"
    "are what lh_controller_init, lh_controller_keep_apart and lh_controller_restore take (docs/embedded.md).\n"
    "\n"
    "  --config FILE           settings by which it was learned (INI)\n"
    "  --robot FILE            the robot (URDF)\n"
    "  --packages DIR[:DIR]    where package:// of the robot's meshes is looked for\n"
    "  --policy FILE           policy.lcm of a run\n"
    "  --out DIR               an existing folder\n"
    "  --help, --version\n";

typedef struct options {
    const char *config, *robot, *packages, *policy, *out;
} options;

/* All that is written. */
typedef struct exported {
    lh_robot robot;
    lh_shapes shapes;
    lh_config config;
    lh_controlled controlled;
    lh_learned learned;
    int32_t episode; /* that the policy goes on with */
} exported;

/* True: go on; false: exit with *code. */
static bool parse(int argc, char **argv, options *o, int *code) {
    static const struct option known[] = {
        {"config", required_argument, NULL, 'c'},   {"robot", required_argument, NULL, 'r'},
        {"packages", required_argument, NULL, 'p'}, {"policy", required_argument, NULL, 'l'},
        {"out", required_argument, NULL, 'o'},      {"help", no_argument, NULL, 'h'},
        {"version", no_argument, NULL, 'v'},        {NULL, 0, NULL, 0}};
    *code = DONE;
    for (int c = 0; (c = getopt_long(argc, argv, "", known, NULL)) != -1;) {
        switch (c) {
            case 'c':
                o->config = optarg;
                break;
            case 'r':
                o->robot = optarg;
                break;
            case 'p':
                o->packages = optarg;
                break;
            case 'l':
                o->policy = optarg;
                break;
            case 'o':
                o->out = optarg;
                break;
            case 'h':
                fputs(help, stdout);
                return false;
            case 'v':
                puts("limphome-arrays " LIMPHOME_VERSION);
                return false;
            default:
                *code = BAD_INPUT;
                return false;
        }
    }
    if (optind != argc || o->config == NULL || o->robot == NULL || o->policy == NULL || o->out == NULL) {
        fprintf(stderr, "give --config, --robot, --policy and --out; --help tells more\n");
        *code = BAD_INPUT;
        return false;
    }
    return true;
}

/* The settings for a machine that only drives: nothing is learned, the monitor watches, and of the planner's values,
 * which are restored, nothing is computed first. */
static lh_config driving_config(const settings *s) {
    lh_config config = convert_config(s);
    config.learner.learn = false;
    config.learner.greedy = true;
    config.learner.planner.sweeps = 0;
    config.monitor.active = true;
    return config;
}

/* What a controller that is set up so takes up of the policy; it must take it. */
static bool take_up(exported *e, const learned *policy, char error[ERROR_LENGTH]) {
    static lh_controller controller; /* too large for a comfortable stack frame */
    lh_error bad = lh_controller_init(&controller, &e->config, &e->robot, &e->controlled);
    if (bad == LH_OK) {
        bad = lh_controller_keep_apart(&controller, &e->shapes);
    }
    if (bad != LH_OK) {
        return fail_with(error, "robot, settings and policy do not go together: %s", lh_error_text(bad));
    }
    if (!learned_restore(policy, &controller, &e->learned)) {
        return fail_with(error, "the policy is for other actuators, speeds, ranges, periods or mechanics");
    }
    e->episode = learned_episode(policy) + 1;
    bad = lh_controller_restore(&controller, &e->learned, e->episode);
    return bad == LH_OK || fail_with(error, "the policy cannot be taken up: %s", lh_error_text(bad));
}

static bool read_inputs(const options *o, exported *e, char error[ERROR_LENGTH]) {
    static robot_description robot;
    static learned policy;
    settings s = settings_default();
    if (!settings_read(&s, o->config, error) || !settings_check(&s, error)) {
        return false;
    }
    if (!robot_file_load(o->robot, o->packages, &robot)) {
        return fail_with(error, "%.200s: no robot that can be used", o->robot);
    }
    if (!convert_robot(&robot, &e->robot, error) || !run_folder_read_policy(o->policy, &policy, error)) {
        return false;
    }
    if (convert_shapes(&robot, &e->shapes) > 0) {
        return fail_with(error, "robot %s: has more shapes that may meet than there is room for (LH_MAX_SHAPES)",
                         robot.name);
    }
    e->config = driving_config(&s);
    e->controlled = learned_controlled(&policy);
    return take_up(e, &policy, error);
}

/* A file of that name, with a comment at its head. False, with the reason on stderr, if it cannot be written. */
static bool write_header(const options *o, const char *name, const exported *e,
                         void (*write)(initialiser *i, const exported *e)) {
    char path[FILES_PATH_LENGTH];
    const int length = snprintf(path, sizeof path, "%s/%s", o->out, name);
    FILE *file = length < (int)sizeof path ? fopen(path, "w") : NULL;
    if (file == NULL) {
        perror(o->out);
        return false;
    }
    fprintf(file, "/* Written by limphome-arrays " LIMPHOME_VERSION
                  ". For one source file to include: all is static. */\n"
                  "#pragma once\n"
                  "\n"
                  "#include <limphome/controller.h>\n");
    write(&(initialiser){.file = file}, e);
    const bool good = ferror(file) == 0;
    if (fclose(file) != 0 || !good) {
        perror(path);
        return false;
    }
    return true;
}

static void write_robot(initialiser *i, const exported *e) {
    structs_robot(i, "limphome_robot", &e->robot);
    fprintf(i->file, "\n/* What the monitor keeps apart. */");
    structs_shapes(i, "limphome_shapes", &e->shapes, e->robot.num_links);
}

static void write_policy(initialiser *i, const exported *e) {
    fprintf(i->file, "\n/* Drives without learning, greedily; the monitor is on. */");
    structs_config(i, "limphome_config", &e->config);
    structs_controlled(i, "limphome_controlled", &e->controlled);
    fprintf(i->file, "\n/* The first that it drives: it has learned from those before. */\n");
    fprintf(i->file, "static const int32_t limphome_episode = %ld;\n", (long)e->episode);
    structs_learned(i, "limphome_learned", &e->learned);
}

int main(int argc, char **argv) {
    static exported e;
    options o = {.config = NULL};
    int code = DONE;
    process_prepare_streams();
    if (!parse(argc, argv, &o, &code)) {
        return code;
    }
    char error[ERROR_LENGTH] = "";
    if (!read_inputs(&o, &e, error)) {
        fprintf(stderr, "%s\n", error);
        return BAD_INPUT;
    }
    const bool good = write_header(&o, "robot.h", &e, write_robot) && write_header(&o, "policy.h", &e, write_policy);
    return good ? DONE : WENT_WRONG;
}
