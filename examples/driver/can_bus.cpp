#include "can_bus.h"

#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <system_error>

namespace {

[[noreturn]] void fail(const std::string &what) {
    throw std::system_error(errno, std::generic_category(), what);
}

// For now nothing can be read or written.
bool is_busy() {
    return errno == EAGAIN || errno == EINTR || errno == ENOBUFS;
}

// Closes what it holds.
class Descriptor {
   public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(number_); }
    Descriptor(const Descriptor &) = delete;
    Descriptor &operator=(const Descriptor &) = delete;
    int operator*() const { return number_; }

   private:
    int number_;
};

class SocketCan final : public CanBus {
   public:
    explicit SocketCan(int socket) : socket_(socket) {}

    void send(const Frame &frame) override {
        can_frame out{};
        out.can_id = frame.id;
        out.can_dlc = frame.size;
        std::copy(frame.data, frame.data + frame.size, out.data);
        if (write(*socket_, &out, sizeof out) < 0 && !is_busy()) {
            fail("CAN");
        }
    }

    bool receive(Frame &frame) override {
        can_frame in{};
        const ssize_t size = recv(*socket_, &in, sizeof in, MSG_DONTWAIT);
        if (size < 0 && !is_busy()) {
            fail("CAN");
        }
        if (size != static_cast<ssize_t>(sizeof in)) {
            return false;
        }
        frame = Frame{static_cast<uint16_t>(in.can_id & CAN_SFF_MASK), std::min<uint8_t>(in.can_dlc, 8), {}};
        std::copy(in.data, in.data + frame.size, frame.data);
        return true;
    }

   private:
    Descriptor socket_;
};

std::unique_ptr<CanBus> open_interface(const std::string &name) {
    const int number = socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
    if (number < 0) {
        fail("CAN is not in this kernel (modprobe can can_raw)");
    }
    auto bus = socket_can(number);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(if_nametoindex(name.c_str()));
    if (address.can_ifindex == 0 || bind(number, reinterpret_cast<sockaddr *>(&address), sizeof address) < 0) {
        fail("no CAN interface " + name + " in this network");
    }
    return bus;
}

// Lawicel's protocol over a serial line: a frame is t, three hexadecimal digits of identifier, one of size, two of each
// byte and a carriage return; O opens the channel, C closes it, S6 sets 500 kbit/s. What an adapter answers is no frame
// and is passed over.
class SerialCan final : public CanBus {
   public:
    explicit SerialCan(const std::string &path)
        : line_(open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
        termios settings{};
        if (*line_ < 0 || tcgetattr(*line_, &settings) < 0) {
            fail(path);
        }
        cfmakeraw(&settings);
        cfsetspeed(&settings, B115200);  // USB adapters do not care
        if (tcsetattr(*line_, TCSANOW, &settings) < 0) {
            fail(path);
        }
        tcflush(*line_, TCIOFLUSH);
        put("C\rS6\rO\r");
    }
    ~SerialCan() override { (void)!write(*line_, "C\r", 2); }

    void send(const Frame &frame) override {
        char text[32];
        int length = std::snprintf(text, sizeof text, "t%03X%X", frame.id & 0x7FFU, frame.size & 0xFU);
        for (int i = 0; i < frame.size; i++) {
            length += std::snprintf(text + length, sizeof text - static_cast<size_t>(length), "%02X", frame.data[i]);
        }
        put(std::string(text, static_cast<size_t>(length)) + "\r");
    }

    bool receive(Frame &frame) override {
        for (;;) {
            const size_t end = heard_.find('\r');
            if (end != std::string::npos) {
                const std::string text = heard_.substr(0, end);
                heard_.erase(0, end + 1);
                if (parse(text, frame)) {
                    return true;
                }
            } else if (!listen()) {
                return false;
            }
        }
    }

   private:
    // Whole, or not at all: half a frame would spoil the one after.
    void put(const std::string &text) {
        const ssize_t written = write(*line_, text.data(), text.size());
        if (written < 0 && !is_busy()) {
            fail("CAN adapter");
        }
        if (written > 0 && written < static_cast<ssize_t>(text.size())) {
            (void)!write(*line_, "\r", 1);
        }
    }

    bool listen() {
        char bytes[4096];
        const ssize_t size = read(*line_, bytes, sizeof bytes);
        if (size == 0) {  // where nothing has come it is busy
            errno = EIO;
            fail("CAN adapter");
        }
        if (size < 0 && !is_busy()) {
            fail("CAN adapter");
        }
        heard_.append(bytes, static_cast<size_t>(std::max<ssize_t>(size, 0)));
        if (heard_.size() > 2 * sizeof bytes) {  // a line without end is no adapter's
            heard_.clear();
        }
        return size > 0;
    }

    static bool hexadecimal(const std::string &text, size_t at, size_t digits, unsigned &value) {
        const char *begin = text.data() + at;
        return std::from_chars(begin, begin + digits, value, 16).ptr == begin + digits;
    }

    static bool parse(const std::string &text, Frame &frame) {
        unsigned id = 0;
        unsigned size = 0;
        if (text.size() < 5 || text[0] != 't' || !hexadecimal(text, 1, 3, id) || !hexadecimal(text, 4, 1, size) ||
            size > 8 || text.size() < 5 + 2 * size) {
            return false;
        }
        frame = Frame{static_cast<uint16_t>(id), static_cast<uint8_t>(size), {}};
        for (size_t i = 0; i < size; i++) {
            unsigned byte = 0;
            if (!hexadecimal(text, 5 + 2 * i, 2, byte)) {
                return false;
            }
            frame.data[i] = static_cast<uint8_t>(byte);
        }
        return true;
    }

    Descriptor line_;
    std::string heard_;  // after the last whole frame
};

}  // namespace

std::unique_ptr<CanBus> socket_can(int socket) {
    return std::make_unique<SocketCan>(socket);
}

std::unique_ptr<CanBus> open_can(const std::string &channel) {
    if (channel.find('/') != std::string::npos) {
        return std::make_unique<SerialCan>(channel);
    }
    return open_interface(channel);
}
