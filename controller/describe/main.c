/* limphome-describe: reads a robot file as the controller and the simulator do, and tells what it understood. Exit 0:
 * the file is good; 2: it is refused, or the command line is not understood; 1: what was told did not reach stdout. */
#include <getopt.h>
#include <stdbool.h>
#include <stdio.h>

#include "config_path.h"
#include "convert_robot.h"
#include "facts.h"
#include "print.h"
#include "process.h"
#include "robot_file.h"

enum { DONE = 0, WENT_WRONG = 1, BAD_INPUT = 2 };

static const char help[] =
    "usage: limphome-describe [--json] [--packages DIR[:DIR]] FILE\n"
    "\n"
    "Reads a robot file (URDF with <limphome>) as limphome-controller and limphome-simulator do, and tells what it\n"
    "understood: masses, crawlers, arm and reach, how it stands, what makes it tumble. docs/robot.md explains the "
    "format.\n"
    "\n"
    "  --json                  all of it as JSON; of a file that is refused, what is wrong with it\n"
    "  --packages DIR[:DIR]    where package:// of the robot's meshes is looked for; then in the folders above FILE\n"
    "  --help, --version\n"
    "\n"
    "Exit 0: good; 2: refused; 1: what was told did not reach stdout.\n";

typedef struct options {
    bool json;
    const char *packages;
    const char *file;
} options;

/* True: go on; false: exit with *code. */
static bool parse(int argc, char **argv, options *o, int *code) {
    static const struct option known[] = {{"json", no_argument, NULL, 'j'},
                                          {"packages", required_argument, NULL, 'p'},
                                          {"help", no_argument, NULL, 'h'},
                                          {"version", no_argument, NULL, 'v'},
                                          {NULL, 0, NULL, 0}};
    *code = DONE;
    for (int c = 0; (c = getopt_long(argc, argv, "", known, NULL)) != -1;) {
        switch (c) {
            case 'j':
                o->json = true;
                break;
            case 'p':
                o->packages = optarg;
                break;
            case 'h':
                fputs(help, stdout);
                return false;
            case 'v':
                puts("limphome-describe " LIMPHOME_VERSION);
                return false;
            default:
                *code = BAD_INPUT;
                return false;
        }
    }
    if (optind != argc - 1) {
        fprintf(stderr, "give one robot file; --help tells more\n");
        *code = BAD_INPUT;
        return false;
    }
    o->file = argv[optind];
    return true;
}

static void put_lines(char *const *lines, int count) {
    for (int i = 0; i < count; i++) {
        fprintf(stderr, "%s\n", lines[i]);
    }
}

/* What was understood of a robot that was read. False, with the reason on stderr, if the library has no room for it. */
static bool describe(const options *o, const robot_description *description, const robot_report *report) {
    lh_robot robot;
    char error[ERROR_LENGTH] = "";
    if (!convert_robot(description, &robot, error)) {
        fprintf(stderr, "%s\n", error);
        return false;
    }
    robot_facts facts;
    facts_find(description, &robot, &facts);
    if (o->json) {
        print_json(stdout, o->file, report, description, &facts);
    } else {
        print_text(stdout, description, &facts);
    }
    return true;
}

int main(int argc, char **argv) {
    options o = {.json = false};
    int code = DONE;
    process_prepare_streams();
    if (!parse(argc, argv, &o, &code)) {
        return code;
    }
    char found[CONFIG_PATH_LENGTH];
    robot_description description;
    robot_report report;
    bool good = robot_file_read(config_path_find(o.file, found), o.packages, &description, &report);
    if (!o.json) {
        put_lines(report.faults, report.num_faults);
        put_lines(report.notices, report.num_notices);
    } else if (!good) {
        print_json(stdout, o.file, &report, NULL, NULL);
    }
    good = good && describe(&o, &description, &report);
    robot_report_free(&report);
    if (fflush(stdout) != 0) {
        perror("stdout");
        return WENT_WRONG;
    }
    return good ? DONE : BAD_INPUT;
}
