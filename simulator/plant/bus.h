// The bus in C++ (udpm.h), with the calls that lcm::LCM has for it.
#pragma once

#include <udpm.h>

#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <list>
#include <string>

namespace limphome {

class Bus {
   public:
    // Joins the bus at `url`, empty for LCM's default; throws std::runtime_error if it cannot.
    explicit Bus(const std::string &url);
    ~Bus();
    Bus(const Bus &) = delete;
    Bus &operator=(const Bus &) = delete;

    // Has a member of `object` called from handle() for what comes on `channel`: with the bytes, or with a message that
    // could be decoded. Throws std::runtime_error where a bus cannot have one more subscription.
    template <typename Object>
    void subscribe(const std::string &channel, void (Object::*member)(const lcm::ReceiveBuffer *, const std::string &),
                   Object *object) {
        add(channel, [=](const lcm::ReceiveBuffer &buffer) { (object->*member)(&buffer, channel); });
    }
    template <typename Object, typename Message>
    void subscribe(const std::string &channel,
                   void (Object::*member)(const lcm::ReceiveBuffer *, const std::string &, const Message *),
                   Object *object) {
        add(channel, [=](const lcm::ReceiveBuffer &buffer) {
            Message message;
            if (message.decode(buffer.data, 0, static_cast<int>(buffer.data_size)) >= 0) {
                (object->*member)(&buffer, channel, &message);
            }
        });
    }

    // False if the message cannot be sent now.
    template <typename Message>
    bool publish(const std::string &channel, const Message *message) {
        const int size = message->getEncodedSize();
        return size <= UDPM_DATAGRAM_SIZE && message->encode(bytes_, 0, size) == size &&
               udpm_publish(&bus_, channel.c_str(), bytes_, size);
    }

    // Descriptor that is readable when there is something to handle.
    int getFileno() const { return udpm_fileno(&bus_); }
    // Waits at most so long for something to handle: udpm_wait.
    int wait(int milliseconds) { return udpm_wait(&bus_, milliseconds); }
    // Takes in one datagram, if there is one; 0, or else the bus is broken.
    int handle() { return udpm_handle(&bus_) ? 0 : -1; }
    // The same in C.
    udpm *in_c() { return &bus_; }

   private:
    using Handler = std::function<void(const lcm::ReceiveBuffer &)>;
    void add(const std::string &channel, Handler handler);

    udpm bus_;
    std::list<Handler> handlers_;              // udpm has their addresses
    unsigned char bytes_[UDPM_DATAGRAM_SIZE];  // of the message that is sent
};

}  // namespace limphome
