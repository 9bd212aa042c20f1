// The driver of a robot on a CAN bus: a plant in place of the simulator. Exit 0: stopped by a signal; 1: something went
// wrong on the way; 2: bad input, nothing was started.
#include <plant/link.h>
#include <plant/loop.h>
#include <settings.h>

#include <getopt.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "can_robot.h"

namespace {

volatile std::sig_atomic_t stop = 0;

void on_signal(int number) {
    stop = number;
}

struct Options {
    const char *config = nullptr;
    const char *lcm_url = "";
    const char *channel = nullptr;
    int actuators = 5;
    double silence = 0.1;  // [s]
};

const char usage[] =
    "usage: driver --config FILE [--lcm-url URL] [--actuators N] [--silence S] CHANNEL\n"
    "  --config FILE    the controller's experiment (INI): period, speeds, timeouts\n"
    "  --lcm-url URL    bus of the controller\n"
    "  --actuators N    motors: two crawlers, then the joints; default 5\n"
    "  --silence S      a node that says nothing for so long is lost [s]; default 0.1\n"
    "  --robot FILE     not used: scripts/launch gives it to any driver\n"
    "  CHANNEL          can0, vcan0, or the serial line of an SLCAN adapter such as /dev/ttyACM0\n";

// False if the command line is not understood.
bool parse(int argc, char **argv, Options &o) {
    const option known[] = {
        {"config", required_argument, nullptr, 'c'},  {"lcm-url", required_argument, nullptr, 'u'},
        {"robot", required_argument, nullptr, 'r'},   {"actuators", required_argument, nullptr, 'a'},
        {"silence", required_argument, nullptr, 's'}, {}};
    for (int c = 0; (c = getopt_long(argc, argv, "", known, nullptr)) != -1;) {
        switch (c) {
            case 'c':
                o.config = optarg;
                break;
            case 'u':
                o.lcm_url = optarg;
                break;
            case 'r':
                break;
            case 'a':
                o.actuators = std::atoi(optarg);
                break;
            case 's':
                o.silence = std::atof(optarg);
                break;
            default:
                return false;
        }
    }
    o.channel = optind == argc - 1 ? argv[optind] : nullptr;
    return o.config != nullptr && o.channel != nullptr && o.actuators >= 2 && o.actuators <= limphome::max_actuators &&
           o.silence > 0;
}

}  // namespace

int main(int argc, char **argv) {
    enum { done = 0, went_wrong = 1, bad_input = 2 };
    Options o;
    if (!parse(argc, argv, o)) {
        std::fputs(usage, stderr);
        return bad_input;
    }
    settings s = settings_default();
    char error[ERROR_LENGTH] = "";
    if (!settings_read(&s, o.config, error) || !settings_set(&s, "simulator.pace=real_time", error) ||
        !settings_check(&s, error)) {
        std::fprintf(stderr, "%s\n", error);
        return bad_input;
    }
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        std::signal(number, on_signal);
    }
    try {
        const auto bus = open_can(o.channel);
        CanRobot robot(*bus, o.actuators, o.silence, &stop);
        if (stop != 0) {
            return done;
        }
        limphome::Link link(o.lcm_url, s, robot.num_actuators());
        return limphome::Loop(robot, link, s).run(&stop) ? done : went_wrong;
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return went_wrong;
    }
}
