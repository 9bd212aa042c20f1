#include "udpm.h"

#include <arpa/inet.h>
#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "filter.h"
#include "url.h"

enum { HEARING_TRIES = 10, HEARING_MS = 100 };

static const char DEFAULT_URL[] = "udpm://239.255.76.67:7667?ttl=0";
static const char SELF_TEST[] = "LCM_SELF_TEST"; /* LCM's name for it */

static bool set(int socket, int level, int option, const void *value, socklen_t size) {
    return setsockopt(socket, level, option, value, size) == 0;
}

/* Only what comes by the interface on which the group was joined, the one it is routed to, and to the group's own
 * address: nothing that somebody sends to this machine from elsewhere. */
static bool join(int receiver, const udpm_url *url) {
    const int yes = 1, no = 0;
    const struct ip_mreqn membership = {.imr_multiaddr = url->group.sin_addr};
    return set(receiver, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) &&
           set(receiver, IPPROTO_IP, IP_MULTICAST_ALL, &no, sizeof no) &&
           (url->receive_buffer == 0 ||
            set(receiver, SOL_SOCKET, SO_RCVBUF, &url->receive_buffer, sizeof url->receive_buffer)) &&
           bind(receiver, (const struct sockaddr *)&url->group, sizeof url->group) == 0 &&
           set(receiver, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership);
}

/* The one that is there already, or a new one. */
static int datagram_socket(int given) {
    return given > 0 ? given : socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
}

static bool open_group(udpm *bus, const udpm_url *url, char error[ERROR_LENGTH]) {
    bus->sender = datagram_socket(url->sender);
    bus->receiver = datagram_socket(url->receiver);
    if (bus->sender < 0 || bus->receiver < 0) {
        return fail_with(error, "no socket: %s", strerror(errno));
    }
    bus->filtered = true;
    udpm_filter(bus); /* before the first datagram can come */
    return (set(bus->sender, IPPROTO_IP, IP_MULTICAST_TTL, &url->ttl, sizeof url->ttl) &&
            connect(bus->sender, (const struct sockaddr *)&url->group, sizeof url->group) == 0 &&
            join(bus->receiver, url)) ||
           fail_with(error,
                     "%s; is the multicast group routed to an interface? (ip route add 239.255.76.67/32 dev lo src "
                     "127.0.0.1)",
                     strerror(errno));
}

static bool open_queue(udpm *bus, char error[ERROR_LENGTH]) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        return fail_with(error, "no queue: %s", strerror(errno));
    }
    bus->receiver = ends[0];
    bus->sender = ends[1];
    return true;
}

static void note(const lcm_recv_buf_t *buffer, const char *channel, void *user) {
    (void)buffer;
    (void)channel;
    *(bool *)user = true;
}

/* Whether what is sent arrives: a firewall says nothing. */
static bool hears_itself(udpm *bus, char error[ERROR_LENGTH]) {
    bool heard = false;
    udpm_subscribe(bus, SELF_TEST, note, &heard);
    for (int i = 0; i < HEARING_TRIES && !heard; i++) {
        struct pollfd waiting = {.fd = bus->receiver, .events = POLLIN};
        udpm_publish(bus, SELF_TEST, "", 1);
        while (!heard && poll(&waiting, 1, HEARING_MS) > 0 && udpm_handle(bus)) {
        }
    }
    bus->num_subscriptions = 0;
    return heard || fail_with(error, "what is sent does not arrive; is a firewall in the way?");
}

bool udpm_open(udpm *bus, const char *url, char error[ERROR_LENGTH]) {
    memset(bus, 0, sizeof *bus);
    bus->receiver = bus->sender = -1;
    if (url == NULL || *url == '\0') {
        url = getenv("LCM_DEFAULT_URL");
    }
    if (url == NULL || *url == '\0') {
        url = DEFAULT_URL;
    }
    char reason[ERROR_LENGTH] = "";
    udpm_url parsed;
    if (udpm_url_parse(url, &parsed, reason) &&
        (parsed.queue ? open_queue(bus, reason) : open_group(bus, &parsed, reason)) && hears_itself(bus, reason)) {
        return true;
    }
    udpm_close(bus);
    return fail_with(error, "%.200s: cannot join the bus: %.280s", url, reason);
}

void udpm_join(udpm *waiting, udpm *other, void (*work)(void *user), void *user) {
    waiting->other = other;
    waiting->other_works = work;
    waiting->other_user = user;
    other->other = waiting;
}

void udpm_close(udpm *bus) {
    if (bus->other != NULL) {
        bus->other->other = NULL;
    }
    if (bus->receiver >= 0) {
        close(bus->receiver);
    }
    if (bus->sender >= 0) {
        close(bus->sender);
    }
}

bool udpm_subscribe(udpm *bus, const char *channel, udpm_handler *handler, void *user) {
    if (bus->num_subscriptions == UDPM_SUBSCRIPTIONS || strlen(channel) > UDPM_CHANNEL_LENGTH) {
        return false;
    }
    struct udpm_subscription *subscription = &bus->subscriptions[bus->num_subscriptions++];
    snprintf(subscription->channel, sizeof subscription->channel, "%s", channel);
    subscription->handler = handler;
    subscription->user = user;
    if (bus->filtered) {
        udpm_filter(bus);
    }
    return true;
}

int udpm_fileno(const udpm *bus) {
    return bus->receiver;
}

/* Hands a message to whoever subscribed to its channel; whether anybody has. */
static bool hand_over(udpm *bus, const char *channel, void *data, size_t size) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    const lcm_recv_buf_t buffer = {
        .data = data,
        .data_size = (uint32_t)size,
        .recv_utime = (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000,
    };
    bool heard = false;
    for (int i = 0; i < bus->num_subscriptions; i++) {
        const struct udpm_subscription *subscription = &bus->subscriptions[i];
        if (strcmp(subscription->channel, channel) == 0) {
            subscription->handler(&buffer, subscription->channel, subscription->user);
            heard = true;
        }
    }
    return heard;
}

/* Takes a datagram for a message, if it is one. */
static void deliver(udpm *bus, size_t size) {
    if (size < UDPM_HEADER_SIZE || memcmp(bus->datagram, UDPM_MAGIC, UDPM_MAGIC_SIZE) != 0) {
        return;
    }
    const char *name = (const char *)bus->datagram + UDPM_HEADER_SIZE;
    const size_t left = size - UDPM_HEADER_SIZE;
    const size_t length = strnlen(name, left);
    if (length == left) {
        return; /* the name has no end */
    }
    hand_over(bus, name, bus->datagram + UDPM_HEADER_SIZE + length + 1, left - length - 1);
}

/* The other has spoken before, or by now. */
static int wait_for_other(udpm *bus, int milliseconds) {
    if (bus->other_works != NULL) {
        bus->other_works(bus->other_user);
    } else if (!bus->spoken_to) {
        poll(NULL, 0, milliseconds);
    }
    bus->spoken_to = false;
    return 0;
}

int udpm_wait(udpm *bus, int milliseconds) {
    if (bus->other != NULL) {
        return wait_for_other(bus, milliseconds);
    }
    struct pollfd waiting = {.fd = bus->receiver, .events = POLLIN};
    const int count = poll(&waiting, 1, milliseconds);
    return count < 0 && errno == EINTR ? 0 : count;
}

bool udpm_handle(udpm *bus) {
    const ssize_t size = recv(bus->receiver, bus->datagram, sizeof bus->datagram, MSG_DONTWAIT);
    if (size < 0) {
        return errno == EAGAIN || errno == EINTR;
    }
    deliver(bus, (size_t)size);
    return true;
}

static bool publish_to_other(udpm *other, const char *channel, const void *data, int size) {
    if (size < 0 || (size_t)size > sizeof other->datagram) {
        return false;
    }
    memcpy(other->datagram, data, (size_t)size);
    other->spoken_to = hand_over(other, channel, other->datagram, (size_t)size) || other->spoken_to;
    return true;
}

bool udpm_publish(udpm *bus, const char *channel, const void *data, int size) {
    if (bus->other != NULL) {
        return publish_to_other(bus->other, channel, data, size);
    }
    unsigned char datagram[UDPM_DATAGRAM_SIZE];
    const size_t begin = UDPM_HEADER_SIZE + strlen(channel) + 1;
    if (begin > UDPM_HEADER_SIZE + UDPM_CHANNEL_LENGTH + 1 || begin + (size_t)size > sizeof datagram) {
        return false;
    }
    const uint32_t seq = htonl(bus->next_seq++);
    memcpy(datagram, UDPM_MAGIC, UDPM_MAGIC_SIZE);
    memcpy(datagram + UDPM_MAGIC_SIZE, &seq, sizeof seq);
    memcpy(datagram + UDPM_HEADER_SIZE, channel, begin - UDPM_HEADER_SIZE);
    memcpy(datagram + begin, data, (size_t)size);
    const size_t whole = begin + (size_t)size;
    return send(bus->sender, datagram, whole, MSG_DONTWAIT | MSG_NOSIGNAL) == (ssize_t)whole;
}
