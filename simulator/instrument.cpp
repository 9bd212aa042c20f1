// limphome-instrument: the machine of limphome-simulator under the hands of a script, which tells it on stdin what to
// do and measures on stdout, one line of JSON each. There is no link, and no time but the machine's.
//
//   reset EPISODE      the machine's verbs, as in machine.h
//   command RATE...    belt speeds [m/s], then joint rates [rad/s]; those left out are 0
//   advance SECONDS
//   sense              readings, {"utime": ...}
//   truth              {"centre_of_mass": ...}; contacts as in ground_truth_t, "with" -2: the ground
//   gravity X Y Z      what only a world has: from now on [m/s^2]; one that is not vertical stands for a slope
//   lift HEIGHT        puts the robot that much higher [m]
//   ground X Y SPACING COLUMNS ROWS   {"height": [m], "friction": share left} of nodes from (X, Y) on, row after row
//   measure            {"time": since the reset [s], "cpu_s": processor time of all commands and advances so far [s],
//                      "kinetic_energy": [J]}
//
// Takes the options of limphome-simulator. Exit 1: the machine diverged; 2: bad input.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bullet/world.h"
#include "command_line.h"
#include "model/robot_model.h"
#include "robot_file.h"

namespace limphome {
namespace {

double cpu_time() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Name and values of an array of JSON; what follows is up to the caller.
void print(const char *name, const double *values, int count) {
    std::printf("\"%s\": [", name);
    for (int i = 0; i < count; i++) {
        std::printf("%s%.17g", i == 0 ? "" : ", ", values[i]);
    }
    std::printf("]");
}

// Nodes along one edge of the ground that is told.
bool on_grid(double nodes) {
    constexpr double most_nodes = 1000;
    return nodes >= 1 && nodes <= most_nodes;
}

// As messages count them.
bool is_episode(double number) {
    return number >= 0 && number <= std::numeric_limits<int32_t>::max();
}

class Instrument {
   public:
    explicit Instrument(const RobotModel &model, const settings &configuration) : world_(model, configuration) {}

    // One line of input. Throws std::invalid_argument if it is not understood.
    void obey(const std::string &line);

   private:
    bool act(const std::string &verb, const std::vector<double> &numbers);
    void command(const std::vector<double> &rates);
    void advance(double seconds);
    void lift(double height);
    void sense();
    void truth() const;
    void ground(double x, double y, double spacing, int columns, int rows) const;
    void measure() const;

    World world_;
    double cpu_s_ = 0;
};

void Instrument::obey(const std::string &line) {
    std::istringstream words(line);
    std::string verb;
    words >> verb;
    std::vector<double> numbers;
    for (double number = 0; words >> number;) {
        numbers.push_back(number);
    }
    if (!words.eof()) {
        throw std::invalid_argument("not a number in: " + line);
    }
    if (!act(verb, numbers)) {
        throw std::invalid_argument("not understood: " + line);
    }
    std::fflush(stdout);
}

bool Instrument::act(const std::string &verb, const std::vector<double> &numbers) {
    const std::size_t count = numbers.size();
    if (verb == "reset" && count == 1 && is_episode(numbers[0])) {
        world_.reset(static_cast<int64_t>(numbers[0]));
    } else if (verb == "command" && count <= max_actuators) {
        command(numbers);
    } else if (verb == "advance" && count == 1) {
        advance(numbers[0]);
    } else if (verb == "gravity" && count == 3) {
        world_.set_gravity({numbers[0], numbers[1], numbers[2]});
    } else if (verb == "lift" && count == 1) {
        lift(numbers[0]);
    } else if (verb == "sense" && count == 0) {
        sense();
    } else if (verb == "truth" && count == 0) {
        truth();
    } else if (verb == "ground" && count == 5 && on_grid(numbers[3]) && on_grid(numbers[4])) {
        ground(numbers[0], numbers[1], numbers[2], static_cast<int>(numbers[3]), static_cast<int>(numbers[4]));
    } else if (verb == "measure" && count == 0) {
        measure();
    } else {
        return false;
    }
    return true;
}

void Instrument::command(const std::vector<double> &rates) {
    double velocity[max_actuators] = {};
    std::copy(rates.begin(), rates.end(), velocity);
    const double begin = cpu_time();
    world_.command(velocity);
    cpu_s_ += cpu_time() - begin;
}

void Instrument::advance(double seconds) {
    const double begin = cpu_time();
    world_.advance(seconds);
    cpu_s_ += cpu_time() - begin;
    if (world_.diverged()) {
        throw std::runtime_error("the machine diverged at " + std::to_string(world_.time()) + " s");
    }
}

void Instrument::lift(double height) {
    Eigen::Isometry3d pose = world_.robot().pose();
    pose.translation().z() += height;
    world_.robot().set_pose(pose);
}

void Instrument::sense() {
    robot_state_t state{};
    world_.sense(state);
    std::printf("{\"utime\": %lld, ", static_cast<long long>(state.utime));
    print("position", state.position, 3);
    std::printf(", ");
    print("orientation", state.orientation, 4);
    std::printf(", ");
    print("actuator_position", state.actuator_position, state.num_actuators);
    std::printf(", ");
    print("actuator_velocity", state.actuator_velocity, state.num_actuators);
    std::printf(", ");
    print("actuator_effort", state.actuator_effort, state.num_actuators);
    std::printf("}\n");
}

void Instrument::truth() const {
    ground_truth_t truth{};
    world_.truth(truth);
    std::printf("{");
    print("centre_of_mass", truth.centre_of_mass, 3);
    std::printf(", ");
    print("velocity", truth.velocity, 3);
    std::printf(", \"contacts\": [");
    for (int i = 0; i < truth.num_contacts; i++) {
        std::printf("%s{\"part\": %d, \"with\": %d, ", i == 0 ? "" : ", ", truth.contact_part[i],
                    truth.contact_with[i]);
        print("point", truth.contact_point[i], 3);
        std::printf(", ");
        print("force", truth.contact_force[i], 3);
        std::printf("}");
    }
    std::printf("]}\n");
}

void Instrument::ground(double x, double y, double spacing, int columns, int rows) const {
    std::vector<double> height, friction;
    for (int row = 0; row < rows; row++) {
        for (int column = 0; column < columns; column++) {
            const double across = x + column * spacing, along = y + row * spacing;
            height.push_back(world_.ground().height(across, along));
            friction.push_back(world_.ground().friction({across, along, height.back()}));
        }
    }
    std::printf("{");
    print("height", height.data(), columns * rows);
    std::printf(", ");
    print("friction", friction.data(), columns * rows);
    std::printf("}\n");
}

void Instrument::measure() const {
    std::printf("{\"time\": %.17g, \"cpu_s\": %.9g, \"kinetic_energy\": %.17g}\n", world_.time(), cpu_s_,
                world_.robot().kinetic_energy());
}

}  // namespace
}  // namespace limphome

int main(int argc, char **argv) {
    enum { done = 0, went_wrong = 1, bad_input = 2 };
    command_line line;
    const command_line_result result = command_line_parse(argc, argv, COMMAND_LINE_SIMULATOR, &line);
    if (result != COMMAND_LINE_RUN) {
        return result == COMMAND_LINE_DONE ? done : bad_input;
    }
    robot_description robot;
    if (!robot_file_load(line.robot, line.packages, &robot)) {
        return bad_input;
    }
    std::optional<limphome::Instrument> instrument;
    try {
        instrument.emplace(limphome::make_model(robot), line.settings);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return bad_input;
    }
    try {
        std::string text;
        while (std::getline(std::cin, text)) {
            instrument->obey(text);
        }
        return done;
    } catch (const std::invalid_argument &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return bad_input;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return went_wrong;
    }
}
