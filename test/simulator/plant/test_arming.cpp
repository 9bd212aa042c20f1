// Who may arm a plant, for how long, and what ends it; no bus is needed.
#include "plant/arming.h"

#include <gtest/gtest.h>

namespace limphome {
namespace {

constexpr double timeout = 3;
constexpr int64_t one = 1;
constexpr int64_t other = 2;

arm_request_t request(int8_t action, int64_t challenge, int64_t sender = one) {
    arm_request_t message{};
    message.action = action;
    message.challenge = challenge;
    message.sender = sender;
    return message;
}

// Armed at time 0 by `one`.
Arming armed() {
    Arming arming(true, timeout);
    EXPECT_EQ(arming.hear(request(arm_request_t::ARM, arming.challenge()), true, 0), Arming::Verdict::taken);
    EXPECT_TRUE(arming.armed());
    return arming;
}

TEST(Arming, BeginsWithout) {
    Arming arming(true, timeout);
    EXPECT_FALSE(arming.armed());
    EXPECT_EQ(arming.reason(), status_t::NOT_YET_ARMED);
    EXPECT_NE(arming.challenge(), 0);
}

TEST(Arming, IsNotNeededInLockstep) {
    Arming arming(false, timeout);
    arming.disarm(status_t::CONTROLLER_SILENT, 0);
    arming.pass(1e9);
    arming.hear(request(arm_request_t::DISARM, 0), true, 0);
    EXPECT_TRUE(arming.armed());
    EXPECT_EQ(arming.reason(), status_t::NONE);
}

TEST(Arming, AChallengeServesOnce) {
    Arming arming(true, timeout);
    const int64_t challenge = arming.challenge();
    EXPECT_EQ(arming.hear(request(arm_request_t::ARM, challenge + 1), true, 0), Arming::Verdict::challenge_failed);
    EXPECT_FALSE(arming.armed());
    EXPECT_EQ(arming.hear(request(arm_request_t::ARM, challenge), true, 0), Arming::Verdict::taken);
    EXPECT_NE(arming.challenge(), challenge);
    arming.disarm(status_t::BY_OPERATOR, 1);
    EXPECT_EQ(arming.hear(request(arm_request_t::ARM, challenge), true, 1), Arming::Verdict::challenge_failed);
    EXPECT_FALSE(arming.armed());
}

TEST(Arming, AChallengeOfBeforeItWasDisarmedDoesNotServe) {
    Arming arming = armed();
    const int64_t challenge = arming.challenge();
    arming.disarm(status_t::MACHINE_FAILED, 1);
    EXPECT_EQ(arming.hear(request(arm_request_t::ARM, challenge), true, 1), Arming::Verdict::challenge_failed);
}

TEST(Arming, AChallengeThatNobodyAnswersIsDrawnAnew) {
    Arming arming(true, timeout);
    arming.pass(0);
    const int64_t challenge = arming.challenge();
    arming.pass(timeout);
    EXPECT_EQ(arming.challenge(), challenge);
    arming.pass(timeout + 0.1);
    EXPECT_NE(arming.challenge(), challenge);
}

TEST(Arming, KeepKeepsAndDoesNotArm) {
    Arming arming(true, timeout);
    EXPECT_EQ(arming.hear(request(arm_request_t::KEEP, arming.challenge()), true, 0), Arming::Verdict::other_sender);
    EXPECT_FALSE(arming.armed());
    arming = armed();
    for (int second = 1; second < 100; second++) {
        arming.pass(second);
        EXPECT_EQ(arming.hear(request(arm_request_t::KEEP, arming.challenge()), true, second), Arming::Verdict::taken);
        EXPECT_TRUE(arming.armed());
    }
}

TEST(Arming, SilenceOfTheOperatorDisarms) {
    Arming arming = armed();
    arming.pass(timeout);
    EXPECT_TRUE(arming.armed());
    arming.hear(request(arm_request_t::KEEP, arming.challenge(), other), true, timeout);
    arming.pass(timeout + 0.1);
    EXPECT_FALSE(arming.armed());
    EXPECT_EQ(arming.reason(), status_t::OPERATOR_SILENT);
    EXPECT_EQ(arming.disarmed_at(), timeout + 0.1);
}

TEST(Arming, APauseOfThePlantIsNoSilence) {
    Arming arming = armed();
    arming.excuse(60);
    arming.pass(60 + timeout);
    EXPECT_TRUE(arming.armed());
}

TEST(Arming, AnybodyMayDisarmWithoutAChallenge) {
    Arming arming = armed();
    EXPECT_EQ(arming.hear(request(arm_request_t::DISARM, 0, other), true, 1), Arming::Verdict::taken);
    EXPECT_FALSE(arming.armed());
    EXPECT_EQ(arming.reason(), status_t::BY_OPERATOR);
}

TEST(Arming, TheFirstReasonStands) {
    Arming arming = armed();
    arming.disarm(status_t::MACHINE_FAILED, 1);
    arming.disarm(status_t::CONTROLLER_SILENT, 2);
    EXPECT_EQ(arming.reason(), status_t::MACHINE_FAILED);
    EXPECT_EQ(arming.disarmed_at(), 1);
}

TEST(Arming, NobodyArmsAPlantWithoutAController) {
    Arming arming(true, timeout);
    EXPECT_EQ(arming.hear(request(arm_request_t::ARM, arming.challenge()), false, 0), Arming::Verdict::taken);
    EXPECT_FALSE(arming.armed());
    EXPECT_EQ(arming.reason(), status_t::CONTROLLER_SILENT);
}

TEST(Arming, KnowsItsActions) {
    Arming arming = armed();
    EXPECT_EQ(arming.hear(request(3, arming.challenge()), true, 0), Arming::Verdict::malformed);
    EXPECT_EQ(arming.hear(request(-1, arming.challenge()), true, 0), Arming::Verdict::malformed);
    EXPECT_TRUE(arming.armed());
}

}  // namespace
}  // namespace limphome
