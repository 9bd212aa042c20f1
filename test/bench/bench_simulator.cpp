// Times the simulated world while it drives, and prints time steps per second of processor time and how many times
// faster than the world itself that is. Usage: bench_simulator ROBOT
#include <cstdio>
#include <ctime>
#include <exception>

#include "world.h"

namespace {

double processor_time() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Drags itself along: the healthy crawler drives, the arm joints sweep to and fro, never far enough to tumble.
void drive(limphome::World &world, int periods) {
    world.reset();
    for (int i = 0; i < periods; i++) {
        const double sign = i % 4 < 2 ? 1 : -1;
        const double velocity[limphome::max_actuators] = {0.3, 0.3, 0.1 * sign, 0.1 * sign, -0.1 * sign};
        world.command(velocity);
        world.advance();
    }
}

}  // namespace

int main(int argc, char **argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: bench_simulator ROBOT\n");
        return 2;
    }
    try {
        limphome::World world(limphome::read_robot(argv[1]), settings_default());
        drive(world, 10);  // warms up
        const double start = processor_time();
        drive(world, 60);
        const double seconds = processor_time() - start;
        if (world.diverged()) {
            std::fprintf(stderr, "the world diverged\n");
            return 1;
        }
        std::printf("%.6g %.6g\n", world.time() / world.time_step() / seconds, world.time() / seconds);
        return 0;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
