#include "filter.h"

#include <arpa/inet.h>
#include <linux/filter.h>
#include <string.h>
#include <sys/socket.h>

/* A filter sees a datagram from its UDP header on. */
enum { UDP_HEADER_SIZE = 8, BLOCK = 2 * (UDPM_CHANNEL_LENGTH + 1) / 4 + 5 };

static const struct sock_filter ACCEPT = BPF_STMT(BPF_RET | BPF_K, UINT32_MAX);
static const struct sock_filter REJECT = BPF_STMT(BPF_RET | BPF_K, 0);

/* Two instructions: goes on only where the `width` bytes at `offset` are those of `text`, else `skipped` instructions
 * further. What lies beyond the end of the datagram rejects it. */
static int compare(struct sock_filter *code, int offset, const char *text, int width, int skipped) {
    uint32_t value = 0;
    for (int i = 0; i < width; i++) {
        value = value << 8 | (unsigned char)text[i];
    }
    const uint16_t size = width == 4 ? BPF_W : width == 2 ? BPF_H : BPF_B;
    code[0] = (struct sock_filter)BPF_STMT((uint16_t)(BPF_LD | BPF_ABS | size), (uint32_t)offset);
    code[1] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, (uint8_t)skipped);
    return 2;
}

/* Accepts a message on `channel`, whose name ends with a 0; anything else goes on behind. Returns the instructions. */
static int accept_channel(struct sock_filter *code, const char *channel) {
    const int length = (int)strlen(channel) + 1;
    const int pieces = length / 4 + (length & 2) / 2 + (length & 1);
    int n = 0;
    for (int done = 0, width; done < length; done += width) {
        width = length - done >= 4 ? 4 : length - done >= 2 ? 2 : 1;
        n += compare(code + n, UDP_HEADER_SIZE + UDPM_HEADER_SIZE + done, channel + done, width, 2 * pieces - n - 1);
    }
    code[n++] = ACCEPT;
    return n;
}

void udpm_filter(const udpm *bus) {
    struct sock_filter code[3 + UDPM_SUBSCRIPTIONS * BLOCK + 1];
    int n = compare(code, UDP_HEADER_SIZE, UDPM_MAGIC, UDPM_MAGIC_SIZE, 0);
    code[1].jt = 1; /* over the next */
    code[n++] = REJECT;
    for (int i = 0; i < bus->num_subscriptions; i++) {
        n += accept_channel(code + n, bus->subscriptions[i].channel);
    }
    code[n++] = REJECT;
    const struct sock_fprog program = {.len = (unsigned short)n, .filter = code};
    (void)setsockopt(bus->receiver, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program);
}
