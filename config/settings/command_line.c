#include "command_line.h"

#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <string.h>

#include "config_path.h"
#include "process.h"

enum { MAX_ASSIGNMENTS = 64 };

enum option_code {
    CONFIG = 256,
    SET,
    ROBOT,
    PACKAGES,
    LCM_URL,
    OUT,
    EVALUATE,
    LIST_MESHES,
    RESUME,
    CHECK,
    HELP,
    HELP_SETTINGS,
    PRINT_SETTINGS,
    VERSION
};

/* Options of the controller alone come last, so that the simulator's list is the same one cut short. */
static const struct option controller_options[] = {
    {"config", required_argument, NULL, CONFIG},
    {"set", required_argument, NULL, SET},
    {"robot", required_argument, NULL, ROBOT},
    {"packages", required_argument, NULL, PACKAGES},
    {"lcm-url", required_argument, NULL, LCM_URL},
    {"check", no_argument, NULL, CHECK},
    {"help", no_argument, NULL, HELP},
    {"help-settings", no_argument, NULL, HELP_SETTINGS},
    {"print-settings", no_argument, NULL, PRINT_SETTINGS},
    {"version", no_argument, NULL, VERSION},
    {"out", required_argument, NULL, OUT},
    {"resume", no_argument, NULL, RESUME},
    {"evaluate", required_argument, NULL, EVALUATE},
    {"list-meshes", no_argument, NULL, LIST_MESHES},
    {NULL, 0, NULL, 0},
};
enum { SHARED_OPTIONS = 10 };

static const char shared_help[] =
    "  --config FILE            settings of the experiment (INI); without it, the paper's\n"
    "  --set section.key=value  one setting, over those of the file; may be repeated\n"
    "  --robot FILE             the robot (URDF); default crawler.urdf\n"
    "  --packages DIR[:DIR]     where package:// of the robot's meshes is looked for; then in the folders above FILE\n"
    "  --lcm-url URL            bus to talk on; default $LCM_DEFAULT_URL, else udpm://239.255.76.67:7667?ttl=0\n"
    "  --check                  read all that is given, tell what is wrong with it, and exit; nothing is written\n"
    "  --print-settings         print all settings as resolved, as an INI file, and exit\n"
    "  --help-settings          print every setting with range, default and meaning, and exit\n"
    "  --version                print the version and exit\n"
    "  --help                   print this and exit\n";

static const char files_help[] =
    "A FILE named without a folder is looked for in the working directory, then in ../share/limphome/config, seen "
    "from\n"
    "the program's folder. The default robot is looked for there first, then in config/ of the working directory.\n";

static const char controller_help[] =
    "  --out DIR                write the run folder: episodes.csv, policy.lcm, checkpoint/, messages.lcmlog\n"
    "  --resume                 go on from the newest good checkpoint in DIR; with --check, tell which\n"
    "  --evaluate POLICY        drive with a learned policy, without learning, [learning] episodes more\n"
    "  --list-meshes            print the files that the robot file needs besides, a line each: where a copy is found\n"
    "                           first, seen from its folder, a tab, and the path; and exit\n";

static const char *program_name(command_line_program program) {
    return program == COMMAND_LINE_CONTROLLER ? "limphome-controller" : "limphome-simulator";
}

static void print_help(command_line_program program) {
    const bool controller = program == COMMAND_LINE_CONTROLLER;
    printf("%s: %s\n\nusage: %s [options]\n\n%s%s\n%sSIGINT, SIGTERM and SIGHUP end it cleanly.\n",
           program_name(program),
           controller ? "learns to move a robot with a failed crawler, or moves it with what was learned"
                      : "simulates the robot behind the messages a real one would speak",
           program_name(program), shared_help, controller ? controller_help : "", files_help);
}

/* What was asked for has been printed; BAD, having said so, where it did not get there. */
static command_line_result end_of_print(void) {
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fprintf(stderr, "cannot be printed: %s\n", strerror(errno));
        return COMMAND_LINE_BAD;
    }
    return COMMAND_LINE_DONE;
}

/* Applies the file and the assignments, in this order wherever they stood; says what is wrong on stderr. */
static command_line_result resolve(settings *s, const char *config, char *const *assignments, int count) {
    char error[ERROR_LENGTH] = "";
    char own[CONFIG_PATH_LENGTH];
    *s = settings_default();
    bool good = config == NULL || settings_read(s, config_path_find(config, own), error);
    for (int i = 0; i < count && good; i++) {
        good = settings_set(s, assignments[i], error);
    }
    good = good && settings_check(s, error);
    if (!good) {
        fprintf(stderr, "%s\n", error);
    }
    return good ? COMMAND_LINE_RUN : COMMAND_LINE_BAD;
}

/* Whether the options fit together; says what is wrong on stderr. */
static command_line_result check(const command_line *line) {
    if (line->resume && line->out == NULL) {
        fprintf(stderr, "--resume: needs --out, the run folder to go on with\n");
        return COMMAND_LINE_BAD;
    }
    if (line->resume && line->evaluate != NULL) {
        fprintf(stderr, "--resume and --evaluate do not go together\n");
        return COMMAND_LINE_BAD;
    }
    return COMMAND_LINE_RUN;
}

/* Finds the robot and reads the settings that the options name. */
static command_line_result settle(command_line *line, const char *config, const char *robot, char *const *assignments,
                                  int count) {
    line->robot = robot == NULL ? config_path_robot(line->own_robot) : config_path_find(robot, line->own_robot);
    const command_line_result resolved = resolve(&line->settings, config, assignments, count);
    return resolved == COMMAND_LINE_RUN ? check(line) : resolved;
}

/* An option that is kept as it stands; false if it is none. */
static bool take(command_line *line, int code) {
    switch (code) {
        case PACKAGES:
            line->packages = optarg;
            return true;
        case LCM_URL:
            line->lcm_url = optarg;
            return true;
        case OUT:
            line->out = optarg;
            return true;
        case EVALUATE:
            line->evaluate = optarg;
            return true;
        case LIST_MESHES:
            line->list_meshes = true;
            return true;
        case RESUME:
            line->resume = true;
            return true;
        case CHECK:
            line->check = true;
            return true;
        default:
            return false;
    }
}

command_line_result command_line_parse(int argc, char **argv, command_line_program program, command_line *line) {
    struct option options[sizeof controller_options / sizeof controller_options[0]];
    memcpy(options, controller_options, sizeof options);
    if (program == COMMAND_LINE_SIMULATOR) {
        memset(&options[SHARED_OPTIONS], 0, sizeof options[0]);
    }
    memset(line, 0, sizeof *line);
    process_prepare_streams();
    const char *config = NULL, *robot = NULL;
    char *assignments[MAX_ASSIGNMENTS];
    int count = 0;
    bool print_settings = false;

    for (int code; (code = getopt_long(argc, argv, "", options, NULL)) != -1;) {
        switch (code) {
            case CONFIG:
                config = optarg;
                break;
            case SET:
                if (count == MAX_ASSIGNMENTS) {
                    fprintf(stderr, "--set: at most %d of them\n", MAX_ASSIGNMENTS);
                    return COMMAND_LINE_BAD;
                }
                assignments[count++] = optarg;
                break;
            case ROBOT:
                robot = optarg;
                break;
            case PRINT_SETTINGS:
                print_settings = true;
                break;
            case HELP:
                print_help(program);
                return end_of_print();
            case HELP_SETTINGS:
                settings_describe(stdout);
                return end_of_print();
            case VERSION:
                printf("%s %s\n", program_name(program), LIMPHOME_VERSION);
                return end_of_print();
            default:
                if (!take(line, code)) { /* getopt_long has said what is wrong */
                    fprintf(stderr, "try %s --help\n", program_name(program));
                    return COMMAND_LINE_BAD;
                }
        }
    }
    if (optind < argc) {
        fprintf(stderr, "%s: not an option; try %s --help\n", argv[optind], program_name(program));
        return COMMAND_LINE_BAD;
    }
    const command_line_result settled = settle(line, config, robot, assignments, count);
    if (settled == COMMAND_LINE_RUN && print_settings) {
        settings_write(&line->settings, stdout);
        return end_of_print();
    }
    return settled;
}
