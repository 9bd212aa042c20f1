// limphome-experiment: a World that does what it is told on stdin and reports on stdout, for measurements by scripts.
//
//   gravity X Y Z        from now on [m/s^2]; one that is not vertical stands for a slope
//   lift HEIGHT          puts the robot that much higher [m]
//   run SECONDS RATE...  steady commands: belt speeds [m/s], then joint rates [rad/s]; those left out are 0
//   report               one line of JSON
//
// Takes the options of limphome-simulator. Exit 2: bad input.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "command_line.h"
#include "mass_matrix.h"
#include "robot_model.h"
#include "sensors.h"
#include "truth.h"
#include "world.h"

namespace limphome {
namespace {

double cpu_time() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double kinetic_energy(const btMultiBody &multibody) {
    GeneralVector velocity = GeneralVector::Zero();
    const int dofs = 6 + multibody.getNumDofs();
    velocity.head(dofs) = Eigen::Map<const Eigen::VectorXd>(multibody.getVelocityVector(), dofs);
    return 0.5 * velocity.dot(mass_matrix(multibody) * velocity);
}

class Experiment {
   public:
    explicit Experiment(const command_line &line) : world_(read_robot(line.robot), line.settings) {}

    void obey(const std::string &text);

   private:
    void run(double seconds, const double (&rates)[max_actuators]);
    void report() const;

    World world_;
    double cpu_s_ = 0;  // processor time of all steps so far
};

void Experiment::obey(const std::string &text) {
    std::istringstream words(text);
    std::string verb;
    words >> verb;
    double number[1 + max_actuators] = {};
    int count = 0;
    while (count <= max_actuators && words >> number[count]) {
        count++;
    }
    if (!words.eof()) {
        throw std::runtime_error("not a number in: " + text);
    }
    if (verb == "gravity" && count == 3) {
        world_.set_gravity({number[0], number[1], number[2]});
    } else if (verb == "lift" && count == 1) {
        Eigen::Isometry3d pose = world_.robot().pose();
        pose.translation().z() += number[0];
        world_.robot().set_pose(pose);
    } else if (verb == "run" && count >= 1) {
        double rates[max_actuators] = {};
        std::copy(number + 1, number + 1 + max_actuators, rates);
        run(number[0], rates);
    } else if (verb == "report" && count == 0) {
        report();
    } else {
        throw std::runtime_error("not understood: " + text);
    }
}

void Experiment::run(double seconds, const double (&rates)[max_actuators]) {
    const long steps = std::lround(seconds / world_.time_step());
    const double begin = cpu_time();
    world_.command(rates);
    for (long i = 0; i < steps; i++) {
        world_.step();
    }
    cpu_s_ += cpu_time() - begin;
}

void print(const char *name, const double *values, int count) {
    std::printf(", \"%s\": [", name);
    for (int i = 0; i < count; i++) {
        std::printf("%s%.17g", i == 0 ? "" : ", ", values[i]);
    }
    std::printf("]");
}

void Experiment::report() const {
    robot_state_t state{};
    read_sensors(world_, state);
    ground_truth_t truth{};
    read_truth(world_, truth);
    std::printf("{\"time\": %.17g, \"cpu_s\": %.9g, \"kinetic_energy\": %.17g", world_.time(), cpu_s_,
                kinetic_energy(world_.robot().multibody()));
    print("position", state.position, 3);
    print("orientation", state.orientation, 4);
    print("actuator_position", state.actuator_position, state.num_actuators);
    print("actuator_velocity", state.actuator_velocity, state.num_actuators);
    print("actuator_effort", state.actuator_effort, state.num_actuators);
    print("centre_of_mass", truth.centre_of_mass, 3);
    print("velocity", truth.velocity, 3);
    std::printf(", \"contacts\": [");
    for (int i = 0; i < truth.num_contacts; i++) {
        std::printf("%s{\"part\": %d", i == 0 ? "" : ", ", truth.contact_part[i]);
        print("point", truth.contact_point[i], 3);
        print("force", truth.contact_force[i], 3);
        std::printf("}");
    }
    std::printf("]}\n");
    std::fflush(stdout);
}

}  // namespace
}  // namespace limphome

int main(int argc, char **argv) {
    enum { done = 0, bad_input = 2 };
    command_line line;
    const command_line_result result = command_line_parse(argc, argv, COMMAND_LINE_SIMULATOR, &line);
    if (result != COMMAND_LINE_RUN) {
        return result == COMMAND_LINE_DONE ? done : bad_input;
    }
    try {
        limphome::Experiment experiment(line);
        std::string text;
        while (std::getline(std::cin, text)) {
            experiment.obey(text);
        }
        return done;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return bad_input;
    }
}
