#include "plant/bus.h"

#include <stdexcept>
#include <utility>

namespace limphome {

Bus::Bus(const std::string &url) {
    char error[ERROR_LENGTH] = "";
    if (!udpm_open(&bus_, url.c_str(), error)) {
        throw std::runtime_error(error);
    }
}

Bus::~Bus() {
    udpm_close(&bus_);
}

void Bus::add(const std::string &channel, Handler handler) {
    handlers_.push_back(std::move(handler));
    const auto call = [](const lcm_recv_buf_t *buffer, const char *, void *user) {
        (*static_cast<Handler *>(user))({buffer->data, buffer->data_size, buffer->recv_utime});
    };
    if (!udpm_subscribe(&bus_, channel.c_str(), call, &handlers_.back())) {
        throw std::runtime_error(channel + ": no further subscription fits the bus");
    }
}

}  // namespace limphome
