/* The bus: whole messages of channels subscribed to are delivered, all else is dropped, whatever the bytes. */
#include "udpm.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

#include "suite.h"

static udpm bus;
static struct heard {
    int count;
    int size; /* of the newest */
    unsigned char data[UDPM_DATAGRAM_SIZE];
    char channel[UDPM_CHANNEL_LENGTH + 1];
} heard;

static void note(const lcm_recv_buf_t *buffer, const char *channel, void *user) {
    struct heard *h = user;
    h->count++;
    h->size = (int)buffer->data_size;
    memcpy(h->data, buffer->data, buffer->data_size);
    snprintf(h->channel, sizeof h->channel, "%s", channel);
    ck_assert_int_gt(buffer->recv_utime, 0);
}

static void join(void) {
    char error[ERROR_LENGTH] = "";
    memset(&heard, 0, sizeof heard);
    ck_assert_msg(udpm_open(&bus, "memq://", error), "%s", error);
    ck_assert(udpm_subscribe(&bus, "STATE", note, &heard));
}

static void leave(void) {
    udpm_close(&bus);
}

/* Puts bytes on the bus as they are, and has them handled. */
static void receive(const void *bytes, size_t size) {
    ck_assert(send(bus.sender, bytes, size, MSG_DONTWAIT) == (ssize_t)size);
    ck_assert(udpm_handle(&bus));
}

START_TEST(test_a_message_is_delivered_once) {
    ck_assert(udpm_publish(&bus, "STATE", "hello", 5));
    ck_assert(udpm_handle(&bus));
    ck_assert_int_eq(heard.count, 1);
    ck_assert_int_eq(heard.size, 5);
    ck_assert_mem_eq(heard.data, "hello", 5);
    ck_assert_str_eq(heard.channel, "STATE");
    ck_assert(udpm_handle(&bus)); /* nothing there */
    ck_assert_int_eq(heard.count, 1);
}
END_TEST

START_TEST(test_other_channels_are_dropped) {
    static const char *const others[] = {"", "STAT", "STATES", "state", "STATE.*"};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        ck_assert(udpm_publish(&bus, others[i], "hello", 5));
        ck_assert(udpm_handle(&bus));
    }
    ck_assert_int_eq(heard.count, 0);
}
END_TEST

START_TEST(test_each_subscription_hears) {
    struct heard second = {0};
    ck_assert(udpm_subscribe(&bus, "STATE", note, &second));
    ck_assert(udpm_publish(&bus, "STATE", "", 0));
    ck_assert(udpm_handle(&bus));
    ck_assert_int_eq(heard.count, 1);
    ck_assert_int_eq(heard.size, 0);
    ck_assert_int_eq(second.count, 1);
}
END_TEST

/* Cut anywhere, a datagram is no message until its channel has an end; what is left of the data is handed on. */
START_TEST(test_cut_short) {
    static const char whole[] = "LC02\0\0\0\1STATE\0data";
    const int name_ends = 14;
    for (int size = 1; size < (int)sizeof whole; size++) {
        heard.count = 0;
        receive(whole, (size_t)size);
        ck_assert_int_eq(heard.count, size >= name_ends);
        ck_assert(size < name_ends || heard.size == size - name_ends);
    }
}
END_TEST

START_TEST(test_messages_in_parts_are_dropped) {
    static const char part[] = "LC03\0\0\0\1\0\0\3\350\377\377\377\360\0\0\0\2STATE\0data";
    receive(part, sizeof part - 1);
    ck_assert_int_eq(heard.count, 0);
}
END_TEST

START_TEST(test_the_largest) {
    static unsigned char data[UDPM_DATAGRAM_SIZE];
    const int largest = UDPM_DATAGRAM_SIZE - 8 - (int)sizeof "STATE";
    memset(data, 7, sizeof data);
    ck_assert(udpm_publish(&bus, "STATE", data, largest));
    ck_assert(udpm_handle(&bus));
    ck_assert_int_eq(heard.count, 1);
    ck_assert_int_eq(heard.size, largest);
    ck_assert_mem_eq(heard.data, data, (size_t)largest);
    ck_assert(!udpm_publish(&bus, "STATE", data, largest + 1));
    ck_assert(!udpm_publish(&bus, "STATE", data, INT32_MAX));
}
END_TEST

START_TEST(test_long_names) {
    char name[UDPM_CHANNEL_LENGTH + 2];
    memset(name, 'n', sizeof name);
    name[UDPM_CHANNEL_LENGTH + 1] = '\0';
    ck_assert(!udpm_publish(&bus, name, "", 0));
    ck_assert(!udpm_subscribe(&bus, name, note, &heard));
    name[UDPM_CHANNEL_LENGTH] = '\0';
    ck_assert(udpm_subscribe(&bus, name, note, &heard));
    ck_assert(udpm_publish(&bus, name, "", 0));
    ck_assert(udpm_handle(&bus));
    ck_assert_int_eq(heard.count, 1);
    ck_assert_str_eq(heard.channel, name);
}
END_TEST

START_TEST(test_no_more_subscriptions_than_fit) {
    for (int i = 1; i < UDPM_SUBSCRIPTIONS; i++) {
        ck_assert(udpm_subscribe(&bus, "OTHER", note, &heard));
    }
    ck_assert(!udpm_subscribe(&bus, "OTHER", note, &heard));
}
END_TEST

START_TEST(test_a_full_queue_loses_and_does_not_wait) {
    static unsigned char data[60000];
    int sent = 0;
    while (sent < 1000 && udpm_publish(&bus, "STATE", data, sizeof data)) {
        sent++;
    }
    ck_assert_int_lt(sent, 1000);
    while (heard.count < sent) {
        ck_assert(udpm_handle(&bus));
    }
    ck_assert(udpm_publish(&bus, "STATE", data, sizeof data));
}
END_TEST

/* What `bus` waits for: the other answers what it has heard since. */
static struct partner {
    udpm end;
    struct heard heard;
    int answered;
    int worked;
} partner;

static void work(void *user) {
    struct partner *p = user;
    p->worked++;
    if (p->answered < p->heard.count) {
        p->answered = p->heard.count;
        ck_assert(udpm_publish(&p->end, "STATE", p->heard.data, p->heard.size));
    }
}

static void join_partner(void) {
    char error[ERROR_LENGTH] = "";
    memset(&partner, 0, sizeof partner);
    ck_assert_msg(udpm_open(&partner.end, "memq://", error), "%s", error);
    ck_assert(udpm_subscribe(&partner.end, "COMMAND", note, &partner.heard));
    udpm_join(&bus, &partner.end, work, &partner);
}

START_TEST(test_joined_ends_hear_each_other_at_once) {
    join_partner();
    ck_assert(udpm_publish(&bus, "COMMAND", "go", 2));
    ck_assert(udpm_publish(&bus, "STATE", "its own", 7));
    ck_assert_int_eq(partner.heard.count, 1);
    ck_assert_int_eq(partner.worked, 0);
    ck_assert_int_eq(udpm_wait(&partner.end, 1000000), 0); /* not so long: it was spoken to */
    ck_assert_int_eq(udpm_wait(&bus, 1000000), 0);
    ck_assert_int_eq(partner.worked, 1);
    ck_assert_int_eq(heard.count, 1);
    ck_assert_int_eq(heard.size, 2);
    ck_assert_mem_eq(heard.data, "go", 2);
    udpm_close(&partner.end);
}
END_TEST

START_TEST(test_joined_ends_are_parted_by_closing) {
    join_partner();
    udpm_close(&partner.end);
    ck_assert(udpm_publish(&bus, "STATE", "alone", 5));
    ck_assert_int_eq(udpm_wait(&bus, 1000), 1);
    ck_assert(udpm_handle(&bus));
    ck_assert_int_eq(heard.count, 1);
}
END_TEST

START_TEST(test_joined_ends_take_what_a_datagram_carries) {
    static unsigned char data[UDPM_DATAGRAM_SIZE + 1];
    join_partner();
    ck_assert(udpm_publish(&bus, "COMMAND", data, UDPM_DATAGRAM_SIZE));
    ck_assert(!udpm_publish(&bus, "COMMAND", data, UDPM_DATAGRAM_SIZE + 1));
    ck_assert_int_eq(partner.heard.count, 1);
    udpm_close(&partner.end);
}
END_TEST

START_TEST(test_nothing_to_wait_for) {
    ck_assert_int_eq(udpm_wait(&bus, 1), 0);
    ck_assert(udpm_publish(&bus, "STATE", "", 0));
    ck_assert_int_eq(udpm_wait(&bus, 1000), 1);
}
END_TEST

START_TEST(test_bad_urls) {
    static udpm other;
    char error[ERROR_LENGTH] = "";
    ck_assert(!udpm_open(&other, "nowhere://", error));
    ck_assert_ptr_nonnull(strstr(error, "nowhere://: cannot join the bus"));
    setenv("LCM_DEFAULT_URL", "somewhere://", 1);
    error[0] = '\0';
    ck_assert(!udpm_open(&other, NULL, error));
    ck_assert_ptr_nonnull(strstr(error, "somewhere://"));
    setenv("LCM_DEFAULT_URL", "memq://", 1);
    ck_assert(udpm_open(&other, "", error));
    udpm_close(&other);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("udpm");
    tcase_add_checked_fixture(cases, join, leave);
    tcase_add_test(cases, test_a_message_is_delivered_once);
    tcase_add_test(cases, test_other_channels_are_dropped);
    tcase_add_test(cases, test_each_subscription_hears);
    tcase_add_test(cases, test_cut_short);
    tcase_add_test(cases, test_messages_in_parts_are_dropped);
    tcase_add_test(cases, test_the_largest);
    tcase_add_test(cases, test_long_names);
    tcase_add_test(cases, test_no_more_subscriptions_than_fit);
    tcase_add_test(cases, test_a_full_queue_loses_and_does_not_wait);
    tcase_add_test(cases, test_joined_ends_hear_each_other_at_once);
    tcase_add_test(cases, test_joined_ends_are_parted_by_closing);
    tcase_add_test(cases, test_joined_ends_take_what_a_datagram_carries);
    tcase_add_test(cases, test_nothing_to_wait_for);
    tcase_add_test(cases, test_bad_urls);
    return run_suite("udpm", cases);
}
