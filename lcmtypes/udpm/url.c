#include "url.h"

#include <arpa/inet.h>
#include <limits.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char PREFIX[] = "udpm://";

/* A whole number of digits alone, up to `largest`. */
static bool parse_number(const char *text, long largest, int *number) {
    char *end = NULL;
    const long value = strtol(text, &end, 10);
    const bool good = text[0] >= '0' && text[0] <= '9' && *end == '\0' && value <= largest;
    if (good) {
        *number = (int)value;
    }
    return good;
}

/* GROUP:PORT; each may be left out, as in LCM. */
static bool parse_group(char *text, struct sockaddr_in *group, char error[ERROR_LENGTH]) {
    char *colon = strchr(text, ':');
    int port = ntohs(group->sin_port);
    if (colon != NULL) {
        *colon = '\0';
        if (!parse_number(colon + 1, UINT16_MAX, &port) || port == 0) {
            return fail_with(error, "port %.64s: must be 1 to 65535", colon + 1);
        }
    }
    group->sin_port = htons((uint16_t)port);
    if (*text != '\0' &&
        (inet_pton(AF_INET, text, &group->sin_addr) != 1 || !IN_MULTICAST(ntohl(group->sin_addr.s_addr)))) {
        return fail_with(error, "%.64s: not an IPv4 multicast address, such as 239.255.76.67", text);
    }
    return true;
}

/* What may stand behind the question mark. */
static const struct {
    const char *name;
    long largest;
    size_t field; /* an int of udpm_url */
} OPTIONS[] = {
    {"ttl", UINT8_MAX, offsetof(udpm_url, ttl)},
    {"recv_buf_size", INT_MAX, offsetof(udpm_url, receive_buffer)},
    {"receiver", INT_MAX, offsetof(udpm_url, receiver)},
    {"sender", INT_MAX, offsetof(udpm_url, sender)},
};
enum { NUM_OPTIONS = sizeof OPTIONS / sizeof OPTIONS[0] };

static bool parse_option(const char *name, const char *value, udpm_url *url, char error[ERROR_LENGTH]) {
    for (int i = 0; i < NUM_OPTIONS; i++) {
        if (strcmp(name, OPTIONS[i].name) == 0) {
            int *field = (int *)(void *)((char *)url + OPTIONS[i].field);
            return parse_number(value, OPTIONS[i].largest, field) ||
                   fail_with(error, "%s=%.64s: must be 0 to %ld", name, value, OPTIONS[i].largest);
        }
    }
    return fail_with(error, "%.64s: options are ttl, recv_buf_size, receiver and sender", name);
}

/* NAME=VALUE&NAME=VALUE... in any order. */
static bool parse_options(char *text, udpm_url *url, char error[ERROR_LENGTH]) {
    char *rest = NULL;
    for (char *option = strtok_r(text, "&", &rest); option != NULL; option = strtok_r(NULL, "&", &rest)) {
        char *value = strchr(option, '=');
        if (value == NULL) {
            return fail_with(error, "%.64s: an option is NAME=VALUE", option);
        }
        *value++ = '\0';
        if (!parse_option(option, value, url, error)) {
            return false;
        }
    }
    return true;
}

bool udpm_url_parse(const char *text, udpm_url *url, char error[ERROR_LENGTH]) {
    memset(url, 0, sizeof *url);
    url->queue = strcmp(text, "memq://") == 0;
    if (url->queue) {
        return true;
    }
    char copy[256];
    if (strncmp(text, PREFIX, sizeof PREFIX - 1) != 0 || strlen(text) >= sizeof copy) {
        return fail_with(error, "a URL is udpm://GROUP:PORT[?ttl=N&recv_buf_size=BYTES] or memq://");
    }
    snprintf(copy, sizeof copy, "%s", text + sizeof PREFIX - 1);
    url->group = (struct sockaddr_in){
        .sin_family = AF_INET, .sin_port = htons(7667), .sin_addr.s_addr = inet_addr("239.255.76.67")};
    char *options = strchr(copy, '?');
    if (options != NULL) {
        *options++ = '\0';
    }
    return parse_group(copy, &url->group, error) && (options == NULL || parse_options(options, url, error));
}
