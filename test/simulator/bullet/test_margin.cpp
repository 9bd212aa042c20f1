// The stability margin that the controller finds from attitude and joint angles, against the truth of the simulator.
#include <gtest/gtest.h>

extern "C" {
#include "crawler.h"
}

#include "laboratory.h"

namespace limphome {
namespace {

using namespace laboratory;

// As lh_task_observe() has it.
double controllers_margin(const World &world) {
    const lh_robot robot = crawler_robot();
    const robot_state_t now = state(world);
    float angle[LH_MAX_ACTUATORS] = {};
    for (int a = swing; a <= arm; a++) {
        angle[a] = static_cast<float>(now.actuator_position[a]);
    }
    const double *q = now.orientation;
    const lh_quat attitude = {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]),
                              static_cast<float>(q[3])};
    lh_posture posture;
    lh_stance stance;
    lh_kinematics_posture(&robot, lh_quat_normalise(attitude), angle, &posture);
    lh_stance_find(&robot, &posture, &stance);
    return static_cast<double>(lh_stability_margin(stance.points, stance.count, posture.centre_of_mass));
}

struct Case {
    const char *name;
    double swing, boom, arm;  // [rad]
    bool pressed;
};

// Drives the joints there, one after the other, at 0.3 rad/s.
void move_arm(World &world, const Case &posture) {
    const double goal[] = {0, 0, posture.swing, posture.boom, posture.arm};
    for (const int joint : {swing, arm, boom}) {
        const double way = goal[joint] - state(world).actuator_position[joint];
        Rates rates{};
        rates.at(static_cast<std::size_t>(joint)) = way > 0 ? 0.3 : -0.3;
        run(world, rates, std::abs(way) / 0.3);
    }
    run(world, {}, 1);
}

TEST(Margin, OfTheControllerIsThatOfTheSimulatorOnInclines) {
    const Case cases[] = {{"arm ahead", 0, 0.6, -1.5, false},
                          {"arm aside", 1.5, 0.3, -0.8, false},
                          {"arm back", 2.5, 0.8, -1.0, false},
                          {"pressed ahead", 0, -0.2, -0.7, true},
                          {"pressed aside", 1.2, -0.25, -0.7, true}};
    for (const double angle : {0.0, 10.0, 20.0}) {
        for (const Eigen::Vector2d &uphill : {Eigen::Vector2d(1, 0), {-1, 0}, {0, 1}}) {
            settings s = sound();
            s.ground.incline_along_rad = uphill[0] * angle * degree;
            s.ground.incline_across_rad = uphill[1] * angle * degree;
            for (const Case &posture : cases) {
                World world(paper_robot(), s);
                move_arm(world, posture);
                const ground_truth_t t = truth(world);
                bool on_tip = false;
                for (int i = 0; i < t.num_contacts; i++) {
                    on_tip = on_tip || t.contact_part[i] == arm;
                }
                EXPECT_EQ(on_tip, posture.pressed) << posture.name;
                EXPECT_NEAR(controllers_margin(world), t.stability_margin, 0.01)
                    << posture.name << ", " << angle << " degrees, uphill " << uphill.transpose();
            }
        }
    }
}

}  // namespace
}  // namespace limphome
