/* LCM's messages over UDP multicast, as far as the two programs need them: a message is one datagram, and what is not
 * exactly that is dropped. liblcm is not used for it, because what it does with a message in several datagrams can be
 * made to write anywhere by one forged datagram, up to its newest release. There are no such messages here, no thread
 * and no heap, and the kernel drops what was not subscribed to before it wakes anybody. docs/security.md tells more.
 *
 * Other programs that speak LCM are understood and understand this; what liblcm calls udpm://GROUP:PORT and memq:// is
 * the same here. */
#ifndef LIMPHOME_UDPM_H
#define LIMPHOME_UDPM_H

#include <fail.h>
#include <lcm/lcm.h> /* lcm_recv_buf_t; nothing of it is linked */
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    UDPM_SUBSCRIPTIONS = 8,
    UDPM_CHANNEL_LENGTH = 63,   /* bytes, without the final 0 */
    UDPM_DATAGRAM_SIZE = 65507, /* bytes; as much as UDP over IPv4 carries */
};

/* Called for each message of a channel. `buffer` holds its data, size and when it was taken in [us since 1970], only as
 * long as the call lasts; `channel` is the name subscribed to. */
typedef void udpm_handler(const lcm_recv_buf_t *buffer, const char *channel, void *user);

/* Owns its sockets from udpm_open to udpm_close. */
typedef struct udpm {
    int receiver;
    int sender;
    struct udpm *other; /* who alone hears what is sent here, within this process; NULL: the network does */
    void (*other_works)(void *user); /* lets it */
    void *other_user;
    bool spoken_to;    /* by the other, since we have waited */
    bool filtered;     /* the kernel does so for the receiver */
    uint32_t next_seq; /* of datagrams sent; LCM counts them so */
    int num_subscriptions;
    struct udpm_subscription {
        char channel[UDPM_CHANNEL_LENGTH + 1];
        udpm_handler *handler;
        void *user;
    } subscriptions[UDPM_SUBSCRIPTIONS];
    unsigned char datagram[UDPM_DATAGRAM_SIZE]; /* the one that is handled */
} udpm;

/* Joins the bus at `url`: udpm://GROUP:PORT[?ttl=N&recv_buf_size=BYTES], or memq://, a queue of its own that nobody
 * else hears. NULL or "" stands for the environment's LCM_DEFAULT_URL, and without one for
 * udpm://239.255.76.67:7667?ttl=0. With receiver=DESCRIPTOR&sender=DESCRIPTOR it joins by datagram sockets that were
 * made elsewhere, such as in a network namespace that this process is not in, and owns them from then on. False, with
 * the reason in `error` and nothing left open, on failure. */
bool udpm_open(udpm *bus, const char *url, char error[ERROR_LENGTH]);

void udpm_close(udpm *bus);

/* Makes of two queues (memq://), with a subscription or without, one bus within this thread, on which the two hear each
 * other: what one publishes has been handled by the other when udpm_publish returns, and nothing is queued.
 * So a handler must not publish. Where `waiting` waits, `work` is called with `user`, once, for the other to do
 * something that can be waited for. Both must stay where they are until either is closed. */
void udpm_join(udpm *waiting, udpm *other, void (*work)(void *user), void *user);

/* Has `handler` called from udpm_handle for each message on `channel`. False if the name is too long, or for one
 * subscription too many. */
bool udpm_subscribe(udpm *bus, const char *channel, udpm_handler *handler, void *user);

/* Descriptor that is readable when there is something to handle. */
int udpm_fileno(const udpm *bus);

/* Waits at most so long for something to handle. 1: it is there; 0: it is not, or has been handled, as on a bus within
 * a thread; -1: the bus is broken, and errno tells why. */
int udpm_wait(udpm *bus, int milliseconds);

/* Takes in one datagram, if there is one, without waiting. False if the bus is broken. */
bool udpm_handle(udpm *bus);

/* Sends `size` bytes. False if they do not fit one datagram or the system does not take them; never waits. */
bool udpm_publish(udpm *bus, const char *channel, const void *data, int size);

#ifdef __cplusplus
}
#endif
#endif
