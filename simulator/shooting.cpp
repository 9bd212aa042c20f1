// limphome-shooting: what can be reached where the world is known. Drives the simulated machine by random shooting:
// before each decision it tries a hundred sequences of joint actions on the exact world as it stands, in rounds that
// vary the best of the round before, does the first action of the best and plans anew. It learns nothing; learners are
// compared with it.
//
// A process is the copy of a world: each sequence is tried in a child of its own, made by fork(), which tells what it
// came to by a pipe. There are as many at a time as there are processors, and the result does not depend on how many.
//
// Takes the options of limphome-simulator and drives [learning] episodes of the task, with rolling goal lines whatever
// the path. Writes rows as in episodes.csv to stdout; rewards are not computed and told as nan. Exit 1: something
// went wrong on the way; 2: bad input.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "bullet/world.h"
#include "command_line.h"
#include "model/random_stream.h"
#include "model/robot_model.h"
#include "robot_file.h"

namespace limphome {
namespace {

constexpr int horizon = 12;      // decisions looked ahead
constexpr int rounds = 4;        // before each decision
constexpr int sequences = 30;    // of a round
constexpr int drawn = 15;        // of the first round, without regard to the last plan
constexpr int longest_hold = 4;  // decisions for which a drawn action is held

using Action = std::array<double, max_actuators>;  // wanted rates, as in Machine::command
using Sequence = std::array<Action, horizon>;

// What a sequence comes to [m]: the way along the line less what it strays from the line and turns, on average and at
// its end.
constexpr double cost_of_lateral = 1.0;
constexpr double cost_of_turn = 0.5;  // [m/rad]
constexpr double cost_of_fall = 100;

double turned(double from, double to) {
    return std::remainder(to - from, 2 * M_PI);
}

struct Place {
    double x, y, heading;
};

Place place(const World &world) {
    const Eigen::Isometry3d pose = world.robot().pose();
    return {pose.translation().x(), pose.translation().y(), std::atan2(pose.linear()(1, 0), pose.linear()(0, 0))};
}

// Angle between the body's and the world's z axis.
double tilt(const World &world) {
    return std::acos(std::clamp(world.robot().pose().linear()(2, 2), -1.0, 1.0));
}

// Seen from the start of an episode, along its line.
struct Way {
    double along, lateral, turn;
};

Way way(const Place &start, const Place &now) {
    const double dx = now.x - start.x, dy = now.y - start.y;
    const double c = std::cos(start.heading), s = std::sin(start.heading);
    return {c * dx + s * dy, c * dy - s * dx, turned(start.heading, now.heading)};
}

class Shooting {
   public:
    Shooting(const RobotModel &model, const settings &configuration)
        : settings_(configuration), world_(model, configuration), random_(seed(), Purpose::shooting) {
        for (int a = 0; a < world_.num_actuators(); a++) {
            speed_[a] = a < static_cast<int>(model.crawlers.size()) ? settings_.action.crawler_speed
                                                                    : settings_.action.joint_speed;
        }
    }

    // All episodes, a row each.
    void drive();

   private:
    int64_t seed() const { return settings_.learning.seed; }
    void reset(int64_t episode);
    // Drives one episode and returns whether the robot must be put back.
    bool drive_episode(int64_t episode);
    void decide(const Place &start);
    bool act(const Action &action);
    double value(const Sequence &sequence, const Place &start);
    std::vector<double> try_all(const std::vector<Sequence> &tried, const Place &start);

    int draw(int count) { return static_cast<int>(random_.uniform(0, count)); }
    Action draw_action();
    Sequence draw_sequence();
    Sequence vary_plan();

    settings settings_;
    World world_;
    RandomStream random_;
    double speed_[max_actuators] = {};
    Sequence plan_{};  // the best of the last decision, moved on by one
};

void Shooting::drive() {
    std::printf(
        "episode,outcome,steps,duration_s,reward,reward_motion,reward_goal,reward_stability,reward_tumble,"
        "lateral_error_m,heading_change_rad,temperature\n");
    bool put_back = true;
    for (int64_t episode = 1; episode <= settings_.learning.episodes; episode++) {
        if (put_back || (episode - 1) % settings_.episode.reset_every == 0) {
            reset(episode);
        }
        put_back = drive_episode(episode);
    }
}

void Shooting::reset(int64_t episode) {
    world_.reset(episode);
    plan_ = draw_sequence();
}

bool Shooting::drive_episode(int64_t episode) {
    const Place start = place(world_);
    const char *outcome = "timeout";
    int64_t steps = 0;
    while (steps < settings_.episode.step_limit) {
        decide(start);
        steps++;
        const bool stands = act(plan_[0]);
        std::rotate(plan_.begin(), plan_.begin() + 1, plan_.end());
        plan_[horizon - 1] = plan_[horizon - 2];
        if (!stands) {
            outcome = "tumble";
            break;
        }
        if (way(start, place(world_)).along >= settings_.episode.goal_distance_m) {
            outcome = "goal";
            break;
        }
    }
    const Way end = way(start, place(world_));
    std::printf("%lld,%s,%lld,%.9g,nan,nan,nan,nan,nan,%.9g,%.9g,nan\n", static_cast<long long>(episode), outcome,
                static_cast<long long>(steps), static_cast<double>(steps) * settings_.episode.decision_period_s,
                end.lateral, end.turn);
    std::fflush(stdout);
    return outcome[0] != 'g';
}

// Makes plan_ the best of the sequences tried.
void Shooting::decide(const Place &start) {
    double best = -std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds; round++) {
        std::vector<Sequence> tried;
        if (round == 0) {
            tried.push_back(plan_);
            std::generate_n(std::back_inserter(tried), drawn, [this] { return draw_sequence(); });
        }
        while (tried.size() < sequences) {
            tried.push_back(vary_plan());
        }
        const std::vector<double> values = try_all(tried, start);
        const auto most = std::max_element(values.begin(), values.end());
        if (*most > best) {
            best = *most;
            plan_ = tried[static_cast<std::size_t>(most - values.begin())];
        }
    }
}

// One decision; whether the robot still stands after it.
bool Shooting::act(const Action &action) {
    world_.command(action.data());
    world_.advance(settings_.episode.decision_period_s);
    return !world_.diverged() && tilt(world_) <= settings_.episode.tumble_tilt_rad;
}

// Leaves this process's world at the sequence's end.
double Shooting::value(const Sequence &sequence, const Place &start) {
    const double before = way(start, place(world_)).along;
    double strayed = 0;
    Way now{};
    for (const Action &action : sequence) {
        if (!act(action)) {
            return -cost_of_fall;
        }
        now = way(start, place(world_));
        strayed += (cost_of_lateral * std::abs(now.lateral) + cost_of_turn * std::abs(now.turn)) / horizon;
    }
    return now.along - before - strayed - cost_of_lateral * std::abs(now.lateral) - cost_of_turn * std::abs(now.turn);
}

std::vector<double> Shooting::try_all(const std::vector<Sequence> &tried, const Place &start) {
    struct Child {
        pid_t process;
        int pipe;
    };
    std::vector<double> values;
    const std::size_t at_a_time = std::max(1U, std::thread::hardware_concurrency());
    while (values.size() < tried.size()) {
        std::vector<Child> children;
        for (std::size_t i = values.size(); i < std::min(tried.size(), values.size() + at_a_time); i++) {
            int ends[2];
            const pid_t process = pipe(ends) == 0 ? fork() : -1;
            if (process < 0) {
                throw std::runtime_error("a sequence cannot be tried: no process or pipe is left");
            }
            if (process == 0) {
                const double found = value(tried[i], start);
                _exit(write(ends[1], &found, sizeof found) == sizeof found ? 0 : 1);
            }
            close(ends[1]);
            children.push_back({process, ends[0]});
        }
        for (const Child &child : children) {
            double found = 0;
            const bool complete = read(child.pipe, &found, sizeof found) == sizeof found;
            close(child.pipe);
            waitpid(child.process, nullptr, 0);
            if (!complete) {
                throw std::runtime_error("a process that tried a sequence ended early");
            }
            values.push_back(found);
        }
    }
    return values;
}

// Each actuator that obeys backward, still or forward, Table 1.
Action Shooting::draw_action() {
    Action action{};
    for (int a = 0; a < world_.num_actuators(); a++) {
        const int level = draw(3) - 1;
        action[static_cast<std::size_t>(a)] = world_.health(a) == Health::failed ? 0 : level * speed_[a];
    }
    return action;
}

Sequence Shooting::draw_sequence() {
    Sequence sequence{};
    for (int first = 0; first < horizon;) {
        const int end = std::min(horizon, first + 1 + draw(longest_hold));
        std::fill(sequence.begin() + first, sequence.begin() + end, draw_action());
        first = end;
    }
    return sequence;
}

// The best plan so far with another action in one stretch of it.
Sequence Shooting::vary_plan() {
    Sequence sequence = plan_;
    const int first = draw(horizon);
    const int end = std::min(horizon, first + 1 + draw(longest_hold));
    std::fill(sequence.begin() + first, sequence.begin() + end, draw_action());
    return sequence;
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
    std::optional<limphome::Shooting> shooting;
    try {
        shooting.emplace(limphome::make_model(robot), line.settings);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return bad_input;
    }
    try {
        shooting->drive();
        return done;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return went_wrong;
    }
}
