#include "bullet/scene.h"

#include <cmath>

#include "bullet/convert.h"

namespace limphome {
namespace {

constexpr double static_deflection = 1e-3;  // of the ground under the robot's weight on its crawlers [m]
constexpr double settling_time = 0.5;       // [s]
constexpr double longest_settling = 10;     // on uneven ground [s]
constexpr double watched = 0.1;             // for so long, until it stays where it is [s]
constexpr double at_rest = 1e-4;            // at the mean over that time [m/s, rad/s]

// Critically damped at the deflection above, so that the robot does not bounce.
GroundStiffness ground_stiffness(const RobotModel &model) {
    const double points = 4.0 * static_cast<double>(model.crawlers.size());
    const double stiffness = model.mass() * standard_gravity / static_deflection / points;
    return {stiffness, stiffness * 2 * std::sqrt(static_deflection / standard_gravity)};
}

std::vector<Drive> make_drives(const RobotModel &model, const settings &s) {
    std::vector<Drive> drives;
    const PidGains gains{s.drive.proportional, s.drive.integral, s.drive.derivative};
    for (const Actuator &actuator : model.actuators) {
        drives.emplace_back(actuator, gains, s.simulator.time_step_s);
    }
    return drives;
}

}  // namespace

Scene::Scene(const RobotModel &model, const settings &s, const Ground &ground, const std::vector<Failure> &failures,
             const Start &start)
    : robot(model, {s.simulator.friction_crawler, s.simulator.friction_arm, s.simulator.friction_body}),
      drives(make_drives(model, s)),
      ground_(ground),
      start_(start),
      dynamics_(robot, ground, Solver(static_cast<int>(s.simulator.solver_iterations), ground_stiffness(model))),
      time_step_(s.simulator.time_step_s) {
    for (const Failure &failure : failures) {
        if (failure.from_the_start()) {
            fail(failure);
        }
    }
    place();
    settle();
}

void Scene::fail(const Failure &failure) {
    drives[static_cast<std::size_t>(failure.actuator)].fail(failure.condition, failure.left);
    if (failure.condition == DriveCondition::slipping) {
        robot.scale_friction(failure.actuator, failure.left);
    }
}

void Scene::set_gravity(const Eigen::Vector3d &gravity) {
    dynamics_.gravity = gravity;
}

// The point above the start that lies `height` above the incline, across it [m].
Eigen::Vector3d Scene::at_start(double height) const {
    const Eigen::Vector3d up = ground_.incline();
    return {start_.x, start_.y, (height - up.x() * start_.x - up.y() * start_.y) / up.z()};
}

// Along the incline, as low as may be without being inside uneven ground.
void Scene::place() {
    const Eigen::Vector3d up = ground_.incline();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), up) *
                    Eigen::AngleAxisd(start_.heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.translation() = at_start(ground_.highest());
    pose.translation().z() -= static_deflection;
    robot.set_pose(pose);
}

// Where the ground carries the robot [m].
Eigen::Vector3d Scene::centre_of_pressure() const {
    Eigen::Vector3d moment(0, 0, 0);
    double load = 0;
    for (const Contact &contact : dynamics_.contacts) {
        moment += contact.impulse[0] * contact.point;
        load += contact.impulse[0];
    }
    return load > 0 ? Eigen::Vector3d(moment / load) : robot.pose().translation();
}

// Keeps a robot that sinks in from sliding or turning away. What slides is told by where it is carried: the frame of
// the body moves along the ground as it tilts, too, and without that friction would brake the tilting for seconds.
void Scene::hold_in_place() {
    const Eigen::Vector3d up = ground_.incline();
    btMultiBody &body = robot.multibody();
    const Eigen::Vector3d turning = to_eigen(body.getBaseOmega()), velocity = to_eigen(body.getBaseVel());
    const Eigen::Vector3d arm = centre_of_pressure() - to_eigen(body.getBasePos());
    const Eigen::Vector3d tilting = turning - up.dot(turning) * up;
    const Eigen::Vector3d sliding = velocity + tilting.cross(arm);
    body.setBaseOmega(to_bullet(tilting));
    body.setBaseVel(to_bullet(velocity - (sliding - up.dot(sliding) * up)));

    Eigen::Isometry3d pose = robot.pose();
    pose.translation() = at_start(pose.translation().dot(up));
    const double turned = std::atan2(pose(1, 0), pose(0, 0)) - start_.heading;
    pose.linear() = Eigen::AngleAxisd(-turned, up) * pose.linear();
    robot.set_pose(pose);
}

// Lets the robot sink in for so long [s]. On uneven ground it rocks over bumps, which hardly anything damps: it is
// stopped where it is fastest, as it passes its equilibrium there.
void Scene::sink_in(double duration) {
    double energy = 0, time = 0;
    while (time < duration) {
        time += time_step_;
        for (Contact &contact : dynamics_.contacts) {
            contact.impulse.tail<2>().setZero();  // locks no friction in between the points of contact
        }
        step();
        if (ground_.level()) {
            continue;
        }
        hold_in_place();
        const double before = energy;
        energy = robot.kinetic_energy();
        if (energy < before) {
            robot.multibody().clearVelocities();
            energy = 0;
        }
    }
}

// Lets the robot come to its equilibrium, then puts it where it is to start, at rest.
void Scene::settle() {
    sink_in(ground_.level() ? settling_time : settling_time - watched);
    for (double time = settling_time; !ground_.level() && time < longest_settling; time += watched) {
        const Eigen::Isometry3d before = robot.pose();
        sink_in(watched);
        if ((robot.pose().matrix() - before.matrix()).norm() < at_rest * watched) {
            break;
        }
    }
    robot.multibody().clearVelocities();
    const Eigen::Isometry3d pose = robot.pose();
    const double turned = std::atan2(pose(1, 0), pose(0, 0)) - start_.heading;
    const Eigen::Isometry3d back = Eigen::Translation3d(start_.x, start_.y, 0) *
                                   Eigen::AngleAxisd(-turned, Eigen::Vector3d::UnitZ()) *
                                   Eigen::Translation3d(-pose.translation().x(), -pose.translation().y(), 0);
    robot.set_pose(back * pose);
    for (Contact &contact : dynamics_.contacts) {
        contact.point = back * contact.point;
        contact.frame = back.linear() * contact.frame;
    }
    for (std::size_t a = 0; a < drives.size(); a++) {
        robot.multibody().setJointPos(static_cast<int>(a), robot.model().actuators[a].home);
        drives[a].clear_integral();
    }
}

void Scene::step() {
    const btMultiBody &multibody = robot.multibody();
    for (std::size_t a = 0; a < drives.size(); a++) {
        const int joint = static_cast<int>(a);
        dynamics_.joints[a] = drives[a].begin_step(multibody.getJointPos(joint), multibody.getJointVel(joint));
    }
    dynamics_.step(time_step_);
    for (std::size_t a = 0; a < drives.size(); a++) {
        drives[a].end_step(dynamics_.joints[a], multibody.getJointVel(static_cast<int>(a)));
    }
}

}  // namespace limphome
