#include "model/randomisation.h"

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

}  // namespace limphome
