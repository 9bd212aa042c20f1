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

/* Which programs take an option. */
enum {
    PLANT = 1 << COMMAND_LINE_SIMULATOR,
    CONTROLLER = 1 << COMMAND_LINE_CONTROLLER,
    PAIR = 1 << COMMAND_LINE_PAIR,
    ALL = PLANT | CONTROLLER | PAIR
};

static const struct program_option {
    struct option option;
    int programs;
} known_options[] = {
    {{"config", required_argument, NULL, CONFIG}, ALL},
    {{"set", required_argument, NULL, SET}, ALL},
    {{"robot", required_argument, NULL, ROBOT}, ALL},
    {{"packages", required_argument, NULL, PACKAGES}, ALL},
    {{"lcm-url", required_argument, NULL, LCM_URL}, PLANT | CONTROLLER},
    {{"check", no_argument, NULL, CHECK}, ALL},
    {{"help", no_argument, NULL, HELP}, ALL},
    {{"help-settings", no_argument, NULL, HELP_SETTINGS}, ALL},
    {{"print-settings", no_argument, NULL, PRINT_SETTINGS}, ALL},
    {{"version", no_argument, NULL, VERSION}, ALL},
    {{"out", required_argument, NULL, OUT}, CONTROLLER | PAIR},
    {{"resume", no_argument, NULL, RESUME}, CONTROLLER | PAIR},
    {{"evaluate", required_argument, NULL, EVALUATE}, CONTROLLER | PAIR},
    {{"list-meshes", no_argument, NULL, LIST_MESHES}, CONTROLLER},
};
enum { KNOWN_OPTIONS = sizeof known_options / sizeof known_options[0] };

static const char shared_help[] =
    "  --config FILE            settings of the experiment (INI); without it, the paper's\n"
    "  --set section.key=value  one setting, over those of the file; may be repeated\n"
    "  --robot FILE             the robot (URDF); default crawler.urdf\n"
    "  --packages DIR[:DIR]     where package:// of the robot's meshes is looked for; then in the folders above FILE\n"
    "  --check                  read all that is given, tell what is wrong with it, and exit; nothing is written\n"
    "  --print-settings         print all settings as resolved, as an INI file, and exit\n"
    "  --help-settings          print every setting with range, default and meaning, and exit\n"
    "  --version                print the version and exit\n"
    "  --help                   print this and exit\n";

static const char bus_help[] =
    "  --lcm-url URL            bus to talk on; default $LCM_DEFAULT_URL, else udpm://239.255.76.67:7667?ttl=0\n";

static const char files_help[] =
    "A FILE named without a folder is looked for in the working directory, then in ../share/limphome/config, seen "
    "from\n"
    "the program's folder. The default robot is looked for there first, then in config/ of the working directory.\n";

static const char run_help[] =
    "  --out DIR                write the run folder: episodes.csv, policy.lcm, checkpoint/, messages.lcmlog\n"
    "  --resume                 go on from the newest good checkpoint in DIR; with --check, tell which\n"
    "  --evaluate POLICY        drive with a learned policy, without learning, [learning] episodes more\n";

static const char meshes_help[] =
    "  --list-meshes            print the files that the robot file needs besides, a line each: where a copy is found\n"
    "                           first, seen from its folder, a tab, and the path; and exit\n";

static const char *program_name(command_line_program program) {
    switch (program) {
        case COMMAND_LINE_CONTROLLER:
            return "limphome-controller";
        case COMMAND_LINE_PAIR:
            return "limphome-pair";
        case COMMAND_LINE_SIMULATOR:
        default:
            return "limphome-simulator";
    }
}

static const char *purpose(command_line_program program) {
    switch (program) {
        case COMMAND_LINE_CONTROLLER:
            return "learns to move a robot with a failed crawler, or moves it with what was learned";
        case COMMAND_LINE_PAIR:
            return "limphome-controller and limphome-simulator in one process: the same run in less time, which nobody "
                   "can watch";
        case COMMAND_LINE_SIMULATOR:
        default:
            return "simulates the robot behind the messages a real one would speak";
    }
}

static void print_help(command_line_program program) {
    const char *name = program_name(program);
    printf("%s: %s\n\nusage: %s [options]\n\n%s%s%s%s\n%sSIGINT, SIGTERM and SIGHUP end it cleanly.\n", name,
           purpose(program), name, shared_help, program == COMMAND_LINE_PAIR ? "" : bus_help,
           program == COMMAND_LINE_SIMULATOR ? "" : run_help, program == COMMAND_LINE_CONTROLLER ? meshes_help : "",
           files_help);
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

/* Those that it takes, and an end. */
static void options_of(command_line_program program, struct option options[KNOWN_OPTIONS + 1]) {
    int count = 0;
    for (int i = 0; i < KNOWN_OPTIONS; i++) {
        if (known_options[i].programs & 1 << program) {
            options[count++] = known_options[i].option;
        }
    }
    options[count] = (struct option){0};
}

command_line_result command_line_parse(int argc, char **argv, command_line_program program, command_line *line) {
    struct option options[KNOWN_OPTIONS + 1];
    options_of(program, options);
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
