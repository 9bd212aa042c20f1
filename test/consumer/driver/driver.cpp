// A driver as small as can be: driver URL EXPERIMENT. The robot does at once what it is told, and all is over after its
// third state.
#include <plant/link.h>
#include <plant/loop.h>
#include <plant/machine.h>
#include <settings.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>

namespace {

volatile std::sig_atomic_t stop = 0;
constexpr int crawlers_and_joints = 5;

class MyRobot final : public limphome::Machine {
   public:
    int num_actuators() const override { return crawlers_and_joints; }
    void reset(int64_t /*episode*/) override {}
    void command(const double velocity[limphome::max_actuators]) override {
        std::copy(velocity, velocity + crawlers_and_joints, velocity_);
    }
    void sense(limphome::robot_state_t &state) override {
        state.utime = static_cast<int64_t>(limphome::monotonic_now() * 1e6);
        state.num_actuators = crawlers_and_joints;
        state.orientation[0] = 1;
        std::copy(velocity_, velocity_ + crawlers_and_joints, state.actuator_velocity);
        stop = ++states_ == 3;
    }
    limphome::Health health(int /*actuator*/) const override { return limphome::Health::obeys; }

   private:
    double velocity_[crawlers_and_joints] = {};
    int states_ = 0;
};

}  // namespace

int main(int argc, char **argv) {
    settings s = settings_default();
    char error[ERROR_LENGTH] = "usage: driver URL EXPERIMENT";
    bool good = argc == 3 && settings_read(&s, argv[2], error);
    for (const char *setting : {"simulator.pace=real_time", "episode.decision_period_s=0.02",
                                "safety.crawler_acceleration=15", "safety.joint_acceleration=15"}) {
        good = good && settings_set(&s, setting, error);
    }
    if (!good || !settings_check(&s, error)) {
        std::fprintf(stderr, "%s\n", error);
        return 2;
    }
    try {
        MyRobot robot;
        limphome::Link link(argv[1], s, robot.num_actuators());
        const bool sound = limphome::Loop(robot, link, s).run(&stop);
        std::printf("%lld states\n", static_cast<long long>(link.seq()) + 1);
        return sound ? 0 : 1;
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return 1;
    }
}
