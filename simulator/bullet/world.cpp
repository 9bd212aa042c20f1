#include "bullet/world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bullet/scene.h"
#include "bullet/sensors.h"
#include "bullet/truth.h"
#include "model/randomisation.h"

namespace limphome {

namespace {

void change_ground(settings &configuration, int64_t episode) {
    const auto &change = configuration.change;
    if (change.at_episode > 0 && episode >= change.at_episode) {
        configuration.simulator.friction_crawler *= change.friction;
        configuration.simulator.friction_arm *= change.friction;
    }
}

}  // namespace

World::World(const RobotModel &model, const settings &configuration)
    : model_(model),
      settings_(configuration),
      ground_(configuration),
      failures_(planned_failures(configuration, model)),
      sensor_errors_(configuration) {
    reset(0);
    if (diverged_) {
        throw std::runtime_error("robot " + model.name + ": the simulation diverges before the robot moves");
    }
}

World::~World() = default;

std::unique_ptr<Scene> World::make_scene(int64_t episode) const {
    RobotModel model = model_;
    settings configuration = settings_;
    change_ground(configuration, episode);
    randomise(model, configuration, episode);
    const Start start = draw_start(model, configuration, episode);
    return std::make_unique<Scene>(model, configuration, ground_, failures_, start);
}

void World::reset(int64_t episode) {
    episode_ = episode;
    scene_ = make_scene(episode);
    earlier_steps_ += steps_;
    steps_ = 0;
    steps_due_ = 0;
    diverged_ = !plausible();
    robot_state_t exact{};
    read_sensors(scene_->robot, scene_->drives, exact);
    sensor_errors_.begin(episode, exact);
}

void World::sense(robot_state_t &state) {
    exact(state);
    sensor_errors_.apply(state);
}

bool World::exact(robot_state_t &state) const {
    read_sensors(scene_->robot, scene_->drives, state);
    state.utime = std::llround(time() * 1e6);
    return true;
}

Health World::health(int actuator) const {
    return scene_->drives[static_cast<std::size_t>(actuator)].health();
}

bool World::truth(ground_truth_t &truth) const {
    read_truth(scene_->robot, scene_->contacts(), time_step(), truth);
    return true;
}

void World::command(const double velocity[max_actuators]) {
    for (std::size_t a = 0; a < scene_->drives.size(); a++) {
        scene_->drives[a].command(velocity[a] / scene_->robot.travel_per_radian(static_cast<int>(a)));
    }
}

void World::advance(double seconds) {
    advance_asking(seconds, [](double) { return true; });
}

void World::advance_asking(double seconds, const std::function<bool(double)> &may_step) {
    steps_due_ += seconds / time_step();
    const long steps = std::lround(steps_due_);
    steps_due_ -= static_cast<double>(steps);
    for (long i = 0; i < steps && may_step(time_step()); i++) {
        step();
    }
}

// What fails from the start has failed when the scene was made.
void World::fail_when_due() {
    for (const Failure &failure : failures_) {
        if (!failure.from_the_start() && episode_ >= failure.episode &&
            steps_ == std::max(1L, std::lround(failure.time / time_step()))) {
            scene_->fail(failure);
        }
    }
}

void World::step() {
    if (diverged_) {
        return;
    }
    fail_when_due();
    scene_->step();
    steps_++;
    for (const Drive &drive : scene_->drives) {
        saturated_ += drive.saturated() ? 1 : 0;
    }
    diverged_ = !plausible();
    if (sensor_errors_.delayed()) {
        robot_state_t exact{};
        read_sensors(scene_->robot, scene_->drives, exact);
        sensor_errors_.record(exact);
    }
}

double World::time() const {
    return static_cast<double>(steps_) * time_step();
}

double World::simulated_time() const {
    return static_cast<double>(earlier_steps_ + steps_) * time_step();
}

// False for what is infinite, not a number, or absurd, which will soon be one or the other.
bool World::plausible() const {
    constexpr double fastest = 1e3;   // [m/s, rad/s]
    constexpr double farthest = 1e6;  // [m]
    const btMultiBody &multibody = robot().multibody();
    double speed = 0;
    for (int dof = 0; dof < base_dofs + multibody.getNumDofs(); dof++) {
        speed += std::abs(multibody.getVelocityVector()[dof]);
    }
    double angles = multibody.getWorldToBaseRot().length2();
    for (int joint = 0; joint < multibody.getNumLinks(); joint++) {
        angles += std::abs(multibody.getJointPos(joint));
    }
    return speed < fastest && multibody.getBasePos().length() < farthest && std::isfinite(angles);
}

void World::set_gravity(const Eigen::Vector3d &gravity) {
    scene_->set_gravity(gravity);
}
Robot &World::robot() {
    return scene_->robot;
}
const Robot &World::robot() const {
    return scene_->robot;
}
const std::vector<Drive> &World::drives() const {
    return scene_->drives;
}
const std::vector<Contact> &World::contacts() const {
    return scene_->contacts();
}

}  // namespace limphome
