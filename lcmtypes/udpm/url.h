/* URLs of LCM, of which two kinds are known. */
#ifndef LIMPHOME_UDPM_URL_H
#define LIMPHOME_UDPM_URL_H

#include <fail.h>
#include <netinet/in.h>
#include <stdbool.h>

typedef struct udpm_url {
    bool queue;               /* memq://; the rest is of udpm:// */
    struct sockaddr_in group; /* multicast address and port */
    int ttl;                  /* routers it passes, and 1; 0: it stays on this machine */
    int receive_buffer;       /* [bytes]; 0: the system's default */
    int receiver;             /* a datagram socket that is there already; 0: one is made */
    int sender;               /* likewise */
} udpm_url;

/* False, with the reason in `error`, for anything else. */
bool udpm_url_parse(const char *text, udpm_url *url, char error[ERROR_LENGTH]);

#endif
