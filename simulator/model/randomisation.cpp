#include "model/randomisation.h"

#include <algorithm>
#include <cmath>

#include "model/random_stream.h"

namespace limphome {

void randomise(RobotModel &model, settings &configuration, int64_t episode) {
    RandomStream stream(configuration.learning.seed, Purpose::randomisation, episode);
    const auto factor = [&stream](double half_width) { return 1 + half_width * stream.uniform(-1, 1); };
    const auto &ranges = configuration.randomisation;
    configuration.simulator.friction_crawler *= factor(ranges.friction);
    configuration.simulator.friction_arm *= factor(ranges.friction);
    for (Body &body : model.bodies) {
        const double share = factor(ranges.mass);
        body.mass *= share;
        body.inertia *= share;
    }
    for (Actuator &actuator : model.actuators) {
        actuator.effort *= factor(ranges.torque);
    }
}

Start draw_start(RobotModel &model, const settings &configuration, int64_t episode) {
    RandomStream stream(configuration.learning.seed, Purpose::start, episode);
    const auto &ranges = configuration.randomisation;
    const auto within = [&stream](double half_width) { return half_width * stream.uniform(-1, 1); };
    Start start{};
    start.x = within(ranges.position_m);
    start.y = within(ranges.position_m);
    start.heading = 0.5 * M_PI + within(ranges.heading_rad);
    for (std::size_t a = model.crawlers.size(); a < model.actuators.size(); a++) {
        Actuator &joint = model.actuators[a];
        joint.home = std::clamp(joint.home + within(ranges.joint_rad), joint.lower, joint.upper);
    }
    return start;
}

}  // namespace limphome
