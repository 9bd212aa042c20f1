// limphome-simulator: a robot in Bullet as the machine of a plant, behind the messages a real one would speak.
// Exit 0: stopped by a signal; 1: something went wrong on the way; 2: bad input, nothing was started.
#include <csignal>
#include <cstdio>
#include <exception>
#include <optional>

#include "bullet/world.h"
#include "command_line.h"
#include "model/robot_model.h"
#include "plant/link.h"
#include "plant/loop.h"
#include "process.h"
#include "robot_file.h"

namespace {

volatile std::sig_atomic_t stop = 0;

void on_signal(int number) {
    stop = number;
}

}  // namespace

int main(int argc, char **argv) {
    enum { done = 0, went_wrong = 1, bad_input = 2 };
    command_line line;
    const command_line_result result = command_line_parse(argc, argv, COMMAND_LINE_SIMULATOR, &line);
    if (result != COMMAND_LINE_RUN) {
        return result == COMMAND_LINE_DONE ? done : bad_input;
    }
    robot_description robot;
    if (!robot_file_load(line.robot, line.packages, &robot)) {  // which a signal ends, even at a pipe that stays silent
        return bad_input;
    }
    process_end_on_signals(on_signal);

    std::optional<limphome::World> world;
    std::optional<limphome::Link> link;
    try {
        world.emplace(limphome::make_model(robot), line.settings);
        if (line.check) {
            return done;
        }
        link.emplace(line.lcm_url == nullptr ? "" : line.lcm_url, line.settings, world->num_actuators());
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return bad_input;
    }
    try {
        return limphome::Loop(*world, *link, line.settings).run(&stop) ? done : went_wrong;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return went_wrong;
    }
}
