// A CAN bus with frames of up to 8 bytes and identifiers of 11 bits.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

struct Frame {
    uint16_t id;
    uint8_t size;  // bytes used, 0 to 8
    uint8_t data[8];
};

class CanBus {
   public:
    virtual ~CanBus() = default;

    // Puts a frame on the bus; one for which there is no room is dropped, as all of ours are soon followed by newer
    // ones. Throws std::system_error where the bus is gone.
    virtual void send(const Frame &frame) = 0;
    // The next frame that has come; false: there is none now. Throws like send().
    virtual bool receive(Frame &frame) = 0;
};

// `channel` is a network interface of Linux (SocketCAN), such as can0 or vcan0, or the path of a serial line to an
// adapter that speaks SLCAN, such as /dev/ttyACM0, which is then set to 500 kbit/s. Throws std::system_error.
std::unique_ptr<CanBus> open_can(const std::string &channel);

// One of network interface type on an open socket, which it closes.
std::unique_ptr<CanBus> socket_can(int socket);
