#include "world.h"

#include <cmath>

#include "scene.h"

namespace limphome {

World::World(const RobotModel &model, const settings &configuration)
    : model_(model),
      settings_(configuration),
      steps_per_period_(
          static_cast<int>(std::lround(configuration.episode.decision_period_s / configuration.simulator.time_step_s))),
      scene_(std::make_unique<Scene>(model_, settings_)) {}

World::~World() = default;

void World::reset() {
    scene_ = std::make_unique<Scene>(model_, settings_);
    steps_ = 0;
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

void World::step() {
    scene_->step();
    steps_++;
    for (const Drive &drive : scene_->drives) {
        saturated_ += drive.saturated() ? 1 : 0;
    }
}

double World::time() const {
    return static_cast<double>(steps_) * time_step();
}

bool World::finite() const {
    const btMultiBody &multibody = robot().multibody();
    double sum = multibody.getBasePos().length2() + multibody.getWorldToBaseRot().length2();
    for (int dof = 0; dof < 6 + multibody.getNumDofs(); dof++) {
        sum += std::abs(multibody.getVelocityVector()[dof]);
    }
    for (int joint = 0; joint < multibody.getNumLinks(); joint++) {
        sum += std::abs(multibody.getJointPos(joint));
    }
    return std::isfinite(sum);
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
