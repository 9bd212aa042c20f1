#include "model/sensor_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

robot_state_t sense(World &world) {
    robot_state_t s{};
    world.sense(s);
    return s;
}

struct Statistics {
    double mean = 0, deviation = 0;
};

template <typename Value>
Statistics statistics(World &world, int count, Value value) {
    double sum = 0, squares = 0;
    for (int i = 0; i < count; i++) {
        const double x = value(sense(world));
        sum += x;
        squares += x * x;
    }
    const double mean = sum / count;
    return {mean, std::sqrt(squares / count - mean * mean)};
}

double heading_of(const robot_state_t &s) {
    return 2 * std::atan2(s.orientation[3], s.orientation[0]);
}

// As bytes of a message: what lies between the fields of a struct is nobody's.
std::vector<unsigned char> encoded(const robot_state_t &s) {
    std::vector<unsigned char> bytes(static_cast<std::size_t>(s.getEncodedSize()));
    EXPECT_EQ(s.encode(bytes.data(), 0, s.getEncodedSize()), s.getEncodedSize());
    return bytes;
}

TEST(SensorErrors, AreNoneUnlessAskedFor) {
    World world(paper_robot(), left_locked());
    run(world, {0, 0.3, 0.3, -0.3, 0.1}, 2);
    robot_state_t exact = state(world);
    exact.utime = 2000000;
    EXPECT_EQ(encoded(exact), encoded(sense(world)));
}

TEST(SensorErrors, NoiseHasItsDeviation) {
    settings s = left_locked();
    s.sensors.attitude.noise = 0.01;
    s.sensors.position.noise = 0.05;
    s.sensors.joint.noise = 0.02;
    s.sensors.torque.noise = 30;
    World world(paper_robot(), s);
    const robot_state_t exact = state(world);
    constexpr int count = 4000;  // mean within 4 standard errors, deviation within 5 %
    const auto check = [&](double truth, double deviation, auto value) {
        const Statistics found = statistics(world, count, value);
        EXPECT_NEAR(found.mean, truth, 4 * deviation / std::sqrt(count));
        EXPECT_NEAR(found.deviation, deviation, 0.05 * deviation);
    };
    check(exact.position[1], 0.05, [](const robot_state_t &r) { return r.position[1]; });
    check(exact.actuator_position[boom], 0.02, [](const robot_state_t &r) { return r.actuator_position[boom]; });
    check(exact.actuator_effort[boom], 30, [](const robot_state_t &r) { return r.actuator_effort[boom]; });
    check(exact.actuator_effort[right], 30, [](const robot_state_t &r) { return r.actuator_effort[right]; });
    check(heading_of(exact), 0.01, heading_of);
    EXPECT_EQ(sense(world).actuator_position[right], exact.actuator_position[right]);  // no joint of the arm
}

TEST(SensorErrors, BiasStaysForASessionAndIsDrawnForEach) {
    settings s = left_locked();
    s.sensors.position.bias = 0.1;
    World world(paper_robot(), s);
    double sum = 0, largest = 0;
    for (int episode = 1; episode <= 200; episode++) {
        world.reset(episode);
        const double error = sense(world).position[0] - state(world).position[0];
        EXPECT_EQ(sense(world).position[0] - state(world).position[0], error);
        sum += error;
        largest = std::max(largest, std::abs(error));
    }
    EXPECT_LE(largest, 0.1);
    EXPECT_GT(largest, 0.09);
    EXPECT_NEAR(sum / 200, 0, 4 * 0.1 / std::sqrt(3 * 200));
}

TEST(SensorErrors, ReadingsAreMultiplesOfTheQuantum) {
    settings s = left_locked();
    s.sensors.joint.quantum = 0.05;
    s.sensors.torque.quantum = 25;
    s.sensors.attitude.quantum = 0.1;
    World world(paper_robot(), s);
    run(world, {0, 0.3, 0.3, -0.3, 0.1}, 1.3);
    const robot_state_t exact = state(world), read = sense(world);
    for (int a = 2; a < 5; a++) {
        EXPECT_NEAR(std::remainder(read.actuator_position[a], 0.05), 0, 1e-12);
        EXPECT_LE(std::abs(read.actuator_position[a] - exact.actuator_position[a]), 0.025 + 1e-12);
        EXPECT_NEAR(std::remainder(read.actuator_effort[a], 25), 0, 1e-9);
    }
    EXPECT_NEAR(heading_of(read), std::round(heading_of(exact) / 0.1) * 0.1, 1e-9);
}

TEST(SensorErrors, DelayIsExact) {
    settings s = left_locked();
    s.sensors.position.delay_s = 0.1;
    s.sensors.attitude.delay_s = 0.05;
    s.sensors.joint.delay_s = 0.15;
    s.sensors.torque.delay_s = 0.005;
    World world(paper_robot(), s);
    std::vector<robot_state_t> past{state(world)};
    world.command(Rates{0, 0.3, 0.3, -0.3, 0.1}.data());
    const auto ago = [&past](std::size_t steps) { return past[past.size() - 1 - std::min(steps, past.size() - 1)]; };
    for (int i = 0; i < 200; i++) {
        world.step();
        past.push_back(state(world));
        const robot_state_t read = sense(world);
        ASSERT_EQ(read.position[1], ago(20).position[1]);
        ASSERT_EQ(read.orientation[3], ago(10).orientation[3]);
        ASSERT_EQ(read.actuator_position[swing], ago(30).actuator_position[swing]);
        ASSERT_EQ(read.actuator_velocity[right], ago(30).actuator_velocity[right]);
        ASSERT_EQ(read.actuator_effort[right], ago(1).actuator_effort[right]);
    }
    world.reset(0);
    EXPECT_EQ(sense(world).position[1], state(world).position[1]);  // nothing is left of the session before
}

// What is drawn follows from seed and episode, whatever came before.
TEST(SensorErrors, AreTheSameForTheSameEpisode) {
    settings s = left_locked();
    s.sensors.position.noise = s.sensors.position.bias = 0.1;
    World unbroken(paper_robot(), s), resumed(paper_robot(), s);
    for (int episode = 1; episode <= 51; episode += 10) {
        unbroken.reset(episode);
        sense(unbroken);
    }
    resumed.reset(51);
    const double first = sense(resumed).position[0];
    unbroken.reset(51);
    EXPECT_EQ(sense(unbroken).position[0], first);
    EXPECT_NE(sense(unbroken).position[0], first);
    unbroken.reset(52);
    EXPECT_NE(sense(unbroken).position[0], first);
    s.learning.seed = 2;
    World other(paper_robot(), s);
    other.reset(51);
    EXPECT_NE(sense(other).position[0], first);
}

}  // namespace
}  // namespace limphome
