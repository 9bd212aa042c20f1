#include "can_bus.h"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <pty.h>
#include <sys/socket.h>
#include <unistd.h>

#include <system_error>

namespace {

// What SocketCAN's sockets carry are can_frames, whole; so does a pair of sockets of this kind.
struct SocketCanTest : testing::Test {
    int ends[2];
    std::unique_ptr<CanBus> bus;
    void SetUp() override {
        ASSERT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, ends), 0);
        bus = socket_can(ends[0]);
    }
    void TearDown() override { close(ends[1]); }
};

TEST_F(SocketCanTest, SendsAFrameOfTheKernel) {
    bus->send(Frame{0x203, 2, {0x34, 0x12}});
    can_frame out{};
    ASSERT_EQ(read(ends[1], &out, sizeof out), static_cast<ssize_t>(sizeof out));
    EXPECT_EQ(out.can_id, 0x203U);
    EXPECT_EQ(out.can_dlc, 2);
    EXPECT_EQ(out.data[0], 0x34);
    EXPECT_EQ(out.data[1], 0x12);
}

TEST_F(SocketCanTest, TakesFramesInTheirOrderAndThenThereIsNone) {
    for (const unsigned id : {0x181U, 0x701U}) {
        can_frame in{};
        in.can_id = id;
        in.can_dlc = 8;
        in.data[7] = 9;
        ASSERT_EQ(write(ends[1], &in, sizeof in), static_cast<ssize_t>(sizeof in));
    }
    Frame frame{};
    ASSERT_TRUE(bus->receive(frame));
    EXPECT_EQ(frame.id, 0x181);
    EXPECT_EQ(frame.size, 8);
    EXPECT_EQ(frame.data[7], 9);
    ASSERT_TRUE(bus->receive(frame));
    EXPECT_EQ(frame.id, 0x701);
    EXPECT_FALSE(bus->receive(frame));
}

TEST_F(SocketCanTest, DropsWhatThereIsNoRoomFor) {
    for (int i = 0; i < 100000; i++) {
        bus->send(Frame{0x201, 0, {}});
    }
}

// The far end of a serial line, as an adapter has it.
struct SerialTest : testing::Test {
    int adapter, line;
    std::unique_ptr<CanBus> bus;
    void SetUp() override {
        char name[128];
        ASSERT_EQ(openpty(&adapter, &line, name, nullptr, nullptr), 0);
        bus = open_can(name);
        EXPECT_EQ(heard(), "C\rS6\rO\r");
    }
    void TearDown() override {
        close(adapter);
        close(line);
    }
    std::string heard() const {
        char bytes[256];
        return std::string(bytes, static_cast<size_t>(read(adapter, bytes, sizeof bytes)));
    }
    void say(const std::string &text) const {
        ASSERT_EQ(write(adapter, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    }
};

TEST_F(SerialTest, SendsAFrameAsText) {
    bus->send(Frame{0x205, 2, {0xFE, 0x01}});
    EXPECT_EQ(heard(), "t2052FE01\r");
    bus->send(Frame{0x001, 0, {}});
    EXPECT_EQ(heard(), "t0010\r");
}

TEST_F(SerialTest, TakesAFrameThatComesInPieces) {
    Frame frame{};
    say("t18");
    EXPECT_FALSE(bus->receive(frame));
    say("28010203040506fF08");
    EXPECT_FALSE(bus->receive(frame));
    say("\rt7011");
    ASSERT_TRUE(bus->receive(frame));
    EXPECT_EQ(frame.id, 0x182);
    EXPECT_EQ(frame.size, 8);
    EXPECT_EQ(frame.data[0], 1);
    EXPECT_EQ(frame.data[6], 0xFF);
    EXPECT_FALSE(bus->receive(frame));
}

TEST_F(SerialTest, PassesOverWhatIsNoFrame) {
    say("\r\a\rz\rt\rt18\rt1xx0\rt1811\rt1819112233445566778899\rt1811G1\rT000001811AA\rt1812AABB\r");
    Frame frame{};
    ASSERT_TRUE(bus->receive(frame));
    EXPECT_EQ(frame.id, 0x181);
    EXPECT_EQ(frame.size, 2);
    EXPECT_EQ(frame.data[1], 0xBB);
    EXPECT_FALSE(bus->receive(frame));
}

TEST_F(SerialTest, KeepsNoLineWithoutEnd) {
    Frame frame{};
    for (int i = 0; i < 1000; i++) {
        say(std::string(100, 't'));
        EXPECT_FALSE(bus->receive(frame));
    }
    say("\rt1810\r");
    EXPECT_TRUE(bus->receive(frame));
}

TEST_F(SerialTest, ThrowsWhereTheAdapterIsGone) {
    close(adapter);
    Frame frame{};
    EXPECT_THROW(bus->receive(frame), std::system_error);
    EXPECT_THROW(bus->send(Frame{0x201, 0, {}}), std::system_error);
    ASSERT_EQ(openpty(&adapter, &line, nullptr, nullptr, nullptr), 0);  // for the end of the test
}

TEST(CanBus, SaysWhatCannotBeOpened) {
    EXPECT_THROW(open_can("/no/such/line"), std::system_error);
    EXPECT_THROW(open_can("/dev/null"), std::system_error);    // no serial line
    EXPECT_THROW(open_can("no_such_can"), std::system_error);  // with CAN in the kernel, or without
}

}  // namespace
