// A run in which all that moves is moved and the arm touches and leaves the ground, as text with the bits of each
// state.
#pragma once

#include <cstdio>
#include <string>

#include "laboratory.h"

namespace limphome::laboratory {

inline void append_bits(std::string &text, const double *values, int count) {
    for (int i = 0; i < count; i++) {
        char number[32];
        std::snprintf(number, sizeof number, "%a ", values[i]);
        text += number;
    }
}

inline std::string bits(const World &world) {
    const robot_state_t s = state(world);
    const ground_truth_t t = truth(world);
    std::string text;
    append_bits(text, s.position, 3);
    append_bits(text, s.orientation, 4);
    append_bits(text, s.actuator_position, max_actuators);
    append_bits(text, s.actuator_velocity, max_actuators);
    append_bits(text, s.actuator_effort, max_actuators);
    append_bits(text, t.centre_of_mass, 3);
    append_bits(text, t.contact_force[0], 3 * t.num_contacts);
    append_bits(text, &t.stability_margin, 1);
    return text + "\n";
}

inline std::string trajectory(World &world) {
    std::string text = bits(world);
    const Rates phases[] = {{0, 0.3, 0.3, -0.3, 0}, {0, 0.3, 0.3, -0.3, 0}, {0, -0.3, 0.3, -0.3, 0.3},
                            {0, 0.3, 0, -0.3, 0},   {0, 0.3, 0, 0, 0.3},    {0, 0.3, -0.3, 0.3, 0},
                            {0, 0, 0, 0.3, -0.3}};
    for (const Rates &rates : phases) {
        for (int decision = 0; decision < 3; decision++) {
            world.command(rates.data());
            world.advance(decision_period);
            text += bits(world);
        }
    }
    return text;
}

}  // namespace limphome::laboratory
