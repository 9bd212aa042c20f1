// The link by itself, with messages put on its own bus (memq://, which stays in this process).
#include "plant/link.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <thread>

#include "limphome_channels.h"

namespace limphome {
namespace {

constexpr int num_actuators = 5;
constexpr int64_t owner = 7;
constexpr int64_t stranger = 8;

settings paced(int64_t pace) {
    settings s = settings_default();
    s.simulator.pace = pace;
    s.link.sender_timeout_s = 0.1;
    s.link.command_timeout_s = 0.05;
    return s;
}

void pass(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

// A link and what is said to it.
struct Conversation {
    explicit Conversation(int64_t pace = SETTINGS_LOCKSTEP) : link("memq://", paced(pace), num_actuators) {
        link.send_state({});
    }

    void command(int64_t sender, int64_t seq, double velocity = 0.1) {
        velocity_command_t message{};
        message.session = link.session();
        message.seq = seq;
        message.sender = sender;
        message.num_actuators = num_actuators;
        message.velocity[1] = velocity;
        message.velocity[2] = -velocity;
        link.bus().publish(LIMPHOME_CHANNEL_COMMAND, &message);
        link.wait(0);
    }
    void ask(int64_t sender, int64_t nonce = 1) {
        reset_request_t message{};
        message.session = link.session();
        message.sender = sender;
        message.nonce = nonce;
        link.bus().publish(LIMPHOME_CHANNEL_RESET, &message);
        link.wait(0);
    }
    // Begins a session of `sender` and sends its first state.
    void begin(int64_t sender) {
        ask(sender);
        const auto request = link.take_reset();
        ASSERT_TRUE(request);
        link.begin_session(request);
        link.send_state({});
    }
    void arm(int64_t challenge) {
        arm_request_t message{};
        message.sender = 1;
        message.action = arm_request_t::ARM;
        message.challenge = challenge;
        link.bus().publish(LIMPHOME_CHANNEL_ARM, &message);
        link.wait(0);
    }

    Link link;
};

TEST(Link, ASessionThatNobodyAskedForObeysNobody) {
    Conversation talk;
    talk.command(owner, 0);
    EXPECT_FALSE(talk.link.take_command());
    EXPECT_EQ(talk.link.counts().rejected_sender, 1);
    EXPECT_FALSE(talk.link.owned());
}

TEST(Link, ASessionObeysItsOwnerAlone) {
    Conversation talk;
    talk.begin(owner);
    talk.command(stranger, 0);
    EXPECT_FALSE(talk.link.take_command());
    talk.command(owner, 0);
    EXPECT_TRUE(talk.link.take_command());
}

TEST(Link, AnotherIsGrantedASessionOnceTheOwnerIsSilent) {
    Conversation talk;
    talk.begin(owner);
    talk.ask(stranger);
    EXPECT_FALSE(talk.link.reset_requested());
    EXPECT_EQ(talk.link.counts().rejected_sender, 1);
    pass(0.15);
    talk.ask(stranger);
    talk.ask(owner);
    const auto request = talk.link.take_reset();
    ASSERT_TRUE(request);
    EXPECT_EQ(request->sender, stranger);
}

// After a fault the session is nobody's, but who owned the last one comes first.
TEST(Link, AFaultDoesNotHandThePlantOver) {
    Conversation talk;
    talk.begin(owner);
    talk.link.begin_session(std::nullopt);
    talk.link.send_state({});
    talk.ask(stranger);
    EXPECT_FALSE(talk.link.reset_requested());
    talk.ask(owner);
    EXPECT_TRUE(talk.link.reset_requested());
}

TEST(Link, ALateRequestBeginsNothing) {
    Conversation talk;
    reset_request_t late{};
    late.session = talk.link.session();
    late.sender = owner;
    late.nonce = 1;
    talk.begin(owner);
    talk.link.bus().publish(LIMPHOME_CHANNEL_RESET, &late);
    talk.link.wait(0);
    EXPECT_FALSE(talk.link.reset_requested());
    EXPECT_EQ(talk.link.counts().rejected_session, 1);
}

TEST(Link, ASpeedIsLimitedToThatOfAction) {
    Conversation talk;
    talk.begin(owner);
    talk.command(owner, 0, std::numeric_limits<double>::max());
    const auto taken = talk.link.take_command();
    ASSERT_TRUE(taken);
    EXPECT_FLOAT_EQ(static_cast<float>(taken->command.velocity[1]), 0.3F);
    EXPECT_FLOAT_EQ(static_cast<float>(taken->command.velocity[2]), -0.3F);
    EXPECT_EQ(talk.link.counts().limited, 1);
    talk.link.send_state({});
    talk.command(owner, 1, static_cast<double>(0.3F));  // as a controller in single precision has it
    EXPECT_EQ(talk.link.take_command()->command.velocity[1], static_cast<double>(0.3F));
    EXPECT_EQ(talk.link.counts().limited, 1);
}

TEST(Link, ACommandNumberThatWasNeverSentIsRefused) {
    Conversation talk;
    talk.begin(owner);
    for (const int64_t seq :
         {int64_t{1}, int64_t{-1}, std::numeric_limits<int64_t>::max(), std::numeric_limits<int64_t>::min()}) {
        talk.command(owner, seq);
    }
    EXPECT_FALSE(talk.link.take_command());
    EXPECT_EQ(talk.link.counts().rejected_session, 4);
}

TEST(Link, InRealTimeACommandIsAsOldAsTheStateItAnswers) {
    Conversation talk(SETTINGS_REAL_TIME);
    talk.begin(owner);
    talk.arm(talk.link.arming().challenge());
    ASSERT_TRUE(talk.link.arming().armed());
    talk.link.send_state({});
    pass(0.03);
    talk.command(owner, 1);
    const auto taken = talk.link.take_command();
    ASSERT_TRUE(taken);
    EXPECT_NEAR(monotonic_now() - taken->born, 0.03, 0.02);
    talk.link.send_state({});
    pass(0.06);
    talk.command(owner, 2);
    EXPECT_FALSE(talk.link.take_command());
    EXPECT_EQ(talk.link.counts().late, 1);
}

TEST(Link, InRealTimeAnOlderCommandDoesNotTakeThePlaceOfANewerOne) {
    Conversation talk(SETTINGS_REAL_TIME);
    talk.begin(owner);
    talk.arm(talk.link.arming().challenge());
    talk.link.send_state({});
    talk.link.send_state({});
    talk.command(owner, 2, 0.2);
    talk.command(owner, 1, 0.1);
    const auto taken = talk.link.take_command();
    ASSERT_TRUE(taken);
    EXPECT_EQ(taken->command.seq, 2);
    EXPECT_EQ(talk.link.counts().duplicates, 1);
}

// It was decided upon when nothing was to move.
TEST(Link, ACommandThatAnswersAStateBeforeArmingIsASignOfLifeOnly) {
    Conversation talk(SETTINGS_REAL_TIME);
    talk.begin(owner);
    talk.arm(talk.link.arming().challenge());
    ASSERT_TRUE(talk.link.arming().armed());
    talk.command(owner, 0);
    EXPECT_FALSE(talk.link.take_command());
}

TEST(Link, TheSilenceOfTheOwnerDisarms) {
    Conversation talk(SETTINGS_REAL_TIME);
    talk.begin(owner);
    talk.arm(talk.link.arming().challenge());
    talk.link.pass();
    EXPECT_TRUE(talk.link.arming().armed());
    pass(0.15);
    talk.link.pass();
    EXPECT_FALSE(talk.link.arming().armed());
    EXPECT_EQ(talk.link.arming().reason(), status_t::CONTROLLER_SILENT);
}

TEST(Link, AFloodLeavesTimeForOtherThings) {
    Conversation talk;
    for (int i = 0; i < 250; i++) {
        reset_request_t message{};
        talk.link.bus().publish(LIMPHOME_CHANNEL_RESET, &message);
    }
    const int64_t before = talk.link.counts().received;
    talk.link.wait(0);
    EXPECT_LE(talk.link.counts().received - before, 200);
    EXPECT_EQ(talk.link.counts().overruns, 1);
    for (int i = 0; i < 10; i++) {
        talk.link.wait(0);
    }
    EXPECT_EQ(talk.link.counts().received - before, 250);
}

}  // namespace
}  // namespace limphome
