/* URLs: what LCM understands of the two kinds is understood, all else is refused with a text that names it. */
#include "url.h"

#include <arpa/inet.h>
#include <string.h>

#include "suite.h"

static void assert_is(const char *text, const char *group, int port, int ttl, int receive_buffer) {
    udpm_url url;
    char error[ERROR_LENGTH] = "";
    ck_assert_msg(udpm_url_parse(text, &url, error), "%s: %s", text, error);
    ck_assert(!url.queue);
    ck_assert_str_eq(inet_ntoa(url.group.sin_addr), group);
    ck_assert_int_eq(ntohs(url.group.sin_port), port);
    ck_assert_int_eq(url.ttl, ttl);
    ck_assert_int_eq(url.receive_buffer, receive_buffer);
}

START_TEST(test_good) {
    assert_is("udpm://", "239.255.76.67", 7667, 0, 0);
    assert_is("udpm://?ttl=1", "239.255.76.67", 7667, 1, 0);
    assert_is("udpm://:7", "239.255.76.67", 7, 0, 0);
    assert_is("udpm://224.0.0.1", "224.0.0.1", 7667, 0, 0);
    assert_is("udpm://239.1.2.3:65535?recv_buf_size=2097152&ttl=255", "239.1.2.3", 65535, 255, 2097152);
    udpm_url url;
    char error[ERROR_LENGTH] = "";
    ck_assert(udpm_url_parse("udpm://?receiver=7&sender=8", &url, error));
    ck_assert_int_eq(url.receiver, 7);
    ck_assert_int_eq(url.sender, 8);
    ck_assert(udpm_url_parse("memq://", &url, error));
    ck_assert(url.queue);
}
END_TEST

static const struct {
    const char *text, *named;
} BAD[] = {
    {"nowhere://", "udpm://"},
    {"memq://x", "memq://"},
    {"udpm:/239.255.76.67", "udpm://"},
    {"tcpq://127.0.0.1:7700", "udpm://"},
    {"udpm://10.0.0.1:7667", "10.0.0.1"}, /* no group */
    {"udpm://239.255.76:7667", "239.255.76"},
    {"udpm://name:7667", "name"},
    {"udpm://239.255.76.67:0", "port 0"},
    {"udpm://239.255.76.67:65536", "port 65536"},
    {"udpm://239.255.76.67:-1", "port -1"},
    {"udpm://239.255.76.67:7x", "port 7x"},
    {"udpm://239.255.76.67:", "port"},
    {"udpm://?ttl=256", "ttl=256"},
    {"udpm://?ttl=", "ttl="},
    {"udpm://?ttl= 1", "ttl= 1"},
    {"udpm://?ttl", "NAME=VALUE"},
    {"udpm://?recv_buf_size=99999999999999999999", "recv_buf_size="},
    {"udpm://?receiver=-1", "receiver=-1"},
    {"udpm://?colour=red", "colour"},
};

START_TEST(test_bad) {
    udpm_url url;
    char error[ERROR_LENGTH] = "";
    ck_assert(!udpm_url_parse(BAD[_i].text, &url, error));
    ck_assert_msg(strstr(error, BAD[_i].named) != NULL, "%s: %s", BAD[_i].text, error);
}
END_TEST

START_TEST(test_too_long) {
    char text[1000] = "udpm://239.255.76.67:7667?ttl=1";
    memset(text + strlen(text), '0', sizeof text - 1 - strlen(text));
    text[sizeof text - 1] = '\0';
    udpm_url url;
    char error[ERROR_LENGTH] = "";
    ck_assert(!udpm_url_parse(text, &url, error));
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("url");
    tcase_add_test(cases, test_good);
    tcase_add_loop_test(cases, test_bad, 0, sizeof BAD / sizeof BAD[0]);
    tcase_add_test(cases, test_too_long);
    return run_suite("url", cases);
}
