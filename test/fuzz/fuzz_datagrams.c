/* A datagram of any bytes is dropped, or handed on as what lies behind the name of its channel, within its bounds. */
#include <string.h>
#include <sys/socket.h>

#include "input.h"
#include "limphome_channels.h"
#include "udpm.h"

static void touch(const lcm_recv_buf_t *buffer, const char *channel, void *user) {
    static unsigned char copy[UDPM_DATAGRAM_SIZE];
    const udpm *bus = user;
    FUZZ_EXPECT(buffer->data_size <= sizeof copy);
    memcpy(copy, buffer->data, buffer->data_size);
    FUZZ_EXPECT((const unsigned char *)buffer->data - bus->datagram == 8 + (long)strlen(channel) + 1);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static udpm bus;
    if (bus.num_subscriptions == 0) {
        char error[ERROR_LENGTH] = "";
        FUZZ_EXPECT(udpm_open(&bus, "memq://", error));
        FUZZ_EXPECT(udpm_subscribe(&bus, "S", touch, &bus) &&
                    udpm_subscribe(&bus, LIMPHOME_CHANNEL_STATE, touch, &bus));
    }
    if (size > 0) {
        FUZZ_EXPECT(send(bus.sender, data, size, 0) == (ssize_t)size);
    }
    FUZZ_EXPECT(udpm_handle(&bus));
    return 0;
}
