#include "world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "randomisation.h"
#include "scene.h"
#include "sensors.h"

namespace limphome {

World::World(const RobotModel &model, const settings &configuration)
    : model_(model),
      settings_(configuration),
      ground_(configuration),
      failures_(planned_failures(configuration, model)),
      steps_per_period_(
          static_cast<int>(std::lround(configuration.episode.decision_period_s / configuration.simulator.time_step_s))),
      sensor_errors_(configuration) {
    reset();
    if (diverged_) {
        throw std::runtime_error("robot " + model.name + ": the simulation diverges before the robot moves");
    }
}

World::~World() = default;

std::unique_ptr<Scene> World::make_scene(int64_t episode) const {
    RobotModel model = model_;
    settings configuration = settings_;
    randomise(model, configuration, episode);
    return std::make_unique<Scene>(model, configuration, ground_, failures_);
}

void World::reset(int64_t episode) {
    scene_ = make_scene(episode);
    steps_ = 0;
    diverged_ = !plausible();
    robot_state_t exact{};
    read_sensors(*this, exact);
    sensor_errors_.begin(episode, exact);
}

void World::sense(robot_state_t &state) {
    read_sensors(*this, state);
    sensor_errors_.apply(state);
}

void World::command(const double velocity[max_actuators]) {
    for (std::size_t a = 0; a < scene_->drives.size(); a++) {
        scene_->drives[a].command(velocity[a] / scene_->robot.travel_per_radian(static_cast<int>(a)));
    }
}

void World::advance() {
    for (int i = 0; i < steps_per_period_; i++) {
        step();
    }
}

// What fails from the start has failed when the scene was made.
void World::fail_when_due() {
    for (const Failure &failure : failures_) {
        if (failure.time > 0 && steps_ == std::max(1L, std::lround(failure.time / time_step()))) {
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
        read_sensors(*this, exact);
        sensor_errors_.record(exact);
    }
}

double World::time() const {
    return static_cast<double>(steps_) * time_step();
}

// False for what is infinite, not a number, or absurd, which will soon be one or the other.
bool World::plausible() const {
    constexpr double fastest = 1e3;   // [m/s, rad/s]
    constexpr double farthest = 1e6;  // [m]
    const btMultiBody &multibody = robot().multibody();
    double speed = 0;
    for (int dof = 0; dof < 6 + multibody.getNumDofs(); dof++) {
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
