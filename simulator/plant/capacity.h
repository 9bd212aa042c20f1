// How much fits into the messages, told once, by the wire contract.
#pragma once

#include <limphome/ground_truth_t.hpp>
#include <limphome/robot_state_t.hpp>
#include <type_traits>

namespace limphome {

constexpr int max_actuators = std::extent_v<decltype(robot_state_t::actuator_position)>;
constexpr int max_contacts = std::extent_v<decltype(ground_truth_t::contact_part)>;

}  // namespace limphome
