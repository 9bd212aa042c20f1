/* The URDF reader: the robot of the paper, and every refusal with its element. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "suite.h"
#include "urdf.h"

enum { TEXT = 16384 };

static void read_crawler(urdf_robot *robot) {
    char error[ERROR_LENGTH] = "";
    ck_assert_msg(urdf_read(robot, CONFIG_DIR "/crawler.urdf", error), "%s", error);
}

START_TEST(crawler_has_its_actuators) {
    urdf_robot r;
    read_crawler(&r);
    static const char *const names[] = {"left_crawler", "right_crawler", "swing", "boom", "arm"};
    ck_assert_int_eq(r.robot.num_actuators, 5);
    for (int i = 0; i < 5; i++) {
        ck_assert_str_eq(r.actuator_name[i], names[i]);
        ck_assert_int_eq(r.robot.actuators[i].kind, i < 2 ? LH_CRAWLER : LH_JOINT);
    }
    ck_assert_float_eq(r.robot.actuators[0].effort_limit, 1000);
    ck_assert_float_eq(r.robot.actuators[3].low, -0.6F);
    ck_assert_float_eq(r.robot.actuators[3].high, 1.2F);
}
END_TEST

START_TEST(crawler_has_its_masses_and_supports) {
    urdf_robot r;
    read_crawler(&r);
    float mass = 0;
    for (int i = 0; i < r.robot.num_links; i++) {
        mass += r.robot.links[i].mass;
        ck_assert_int_lt(r.robot.links[i].parent, i);
    }
    ck_assert_float_eq_tol(mass, 945, 1e-3F);
    ck_assert_int_eq(r.robot.num_links, 6);
    ck_assert_int_eq(r.robot.num_supports, 5); /* four ends of crawlers and the tip */
}
END_TEST

/* Writes the crawler's URDF with `from` replaced by `to`, reads it, and gives the result. */
static bool read_changed(const char *from, const char *to, char error[ERROR_LENGTH]) {
    static char text[TEXT], changed[TEXT];
    FILE *file = fopen(CONFIG_DIR "/crawler.urdf", "r");
    ck_assert_ptr_nonnull(file);
    text[fread(text, 1, TEXT - 1, file)] = '\0';
    fclose(file);
    const char *at = strstr(text, from);
    ck_assert_msg(at != NULL, "the URDF no longer holds %s", from);
    snprintf(changed, TEXT, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));

    char name[] = "/tmp/limphome_urdf_XXXXXX";
    const int fd = mkstemp(name);
    ck_assert_int_eq(write(fd, changed, strlen(changed)), (ssize_t)strlen(changed));
    close(fd);
    urdf_robot robot, before;
    memset(&robot, 7, sizeof robot);
    before = robot;
    const bool result = urdf_read(&robot, name, error);
    if (!result) {
        ck_assert_mem_eq(&robot, &before, sizeof robot);
        ck_assert_ptr_nonnull(strstr(error, name));
    }
    unlink(name);
    return result;
}

static const struct {
    const char *from, *to, *word;
} refusals[] = {
    {"</robot>", "", "not XML"},
    {"<limphome>", "<other>", "not XML"},
    {"<mass value=\"498\"/>", "<mass value=\"-1\"/>", "<mass> of link base"},
    {"<mass value=\"498\"/>", "<mass value=\"nan\"/>", "finite"},
    {"<mass value=\"498\"/>", "<mass/>", "<mass>: needs value"},
    {"<crawler joint=\"left_crawler\"", "<crawler joint=\"lost\"", "no joint lost"},
    {"<crawler joint=\"left_crawler\"", "<crawler", "<crawler>: needs joint"},
    {"<arm joint=\"boom\"", "<arm joint=\"bom\"", "no joint bom"},
    {"<arm joint=\"boom\"", "<leg joint=\"boom\"", "<leg>: unknown"},
    {"<tip link=\"arm\"", "<tip link=\"amr\"", "no link amr"},
    {"<tip link=\"arm\" xyz=\"0.8 0 0\"", "<tip link=\"arm\" xyz=\"0.8 0\"", "must be 3 finite numbers"},
    {"<tip link=\"arm\" xyz=\"0.8 0 0\"", "<tip link=\"arm\" xyz=\"0.8 0 0 0\"", "must be 3 finite numbers"},
    {"lower=\"-0.6\" upper=\"1.2\"", "lower=\"1.6\" upper=\"1.2\"", "joint boom: must be revolute with lower below"},
    {"lower=\"-0.6\" upper=\"1.2\"", "upper=\"1.2\"", "<limit>: needs lower"},
    {"effort=\"6000\"", "effort=\"0\"", "joint boom: needs <limit> with effort above 0"},
    {"type=\"revolute\"", "type=\"prismatic\"", "type must be revolute, continuous or fixed"},
    {"<parent link=\"boom\"/>", "<parent link=\"arm\"/>", "link arm: is not joined"},
    {"<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 0\"/>", "<axis> of joint swing"},
};

START_TEST(bad_robots_are_refused_with_the_element) {
    char error[ERROR_LENGTH] = "";
    ck_assert(!read_changed(refusals[_i].from, refusals[_i].to, error));
    ck_assert_msg(strstr(error, refusals[_i].word) != NULL, "error \"%s\" lacks \"%s\"", error, refusals[_i].word);
}
END_TEST

START_TEST(no_extension_is_refused) {
    char error[ERROR_LENGTH] = "";
    char name[] = "/tmp/limphome_urdf_XXXXXX";
    const int fd = mkstemp(name);
    dprintf(fd, "<robot name=\"r\"><link name=\"base\"/></robot>");
    close(fd);
    urdf_robot robot;
    ck_assert(!urdf_read(&robot, name, error));
    ck_assert_ptr_nonnull(strstr(error, "<limphome>: missing"));
    unlink(name);
    error[0] = '\0';
    ck_assert(!urdf_read(&robot, name, error));
    ck_assert_ptr_nonnull(strstr(error, "cannot be opened"));
}
END_TEST

/* Extensions of others, such as <transmission>, hold elements called joint and link: they are none of ours. */
START_TEST(extensions_of_others_are_passed_over) {
    char error[ERROR_LENGTH] = "";
    ck_assert_msg(read_changed("<limphome>",
                               "<transmission><joint name=\"x\"/><link/></transmission><gazebo><limphome/></gazebo>"
                               "<limphome>",
                               error),
                  "%s", error);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("urdf");
    tcase_add_test(cases, crawler_has_its_actuators);
    tcase_add_test(cases, crawler_has_its_masses_and_supports);
    tcase_add_loop_test(cases, bad_robots_are_refused_with_the_element, 0, (int)(sizeof refusals / sizeof refusals[0]));
    tcase_add_test(cases, no_extension_is_refused);
    tcase_add_test(cases, extensions_of_others_are_passed_over);
    return run_suite("urdf", cases);
}
