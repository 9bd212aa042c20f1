/* The robot of the paper as it is read, and every refusal with its element. */
#include <stddef.h>

#include "edited.h"

static struct edited e; /* large for a stack frame */

START_TEST(crawler_is_the_papers_robot) {
    robot_description r;
    ck_assert(robot_file_load(CONFIG_DIR "/crawler.urdf", NULL, &r));
    static const char *const names[] = {"left_crawler", "right_crawler", "swing", "boom", "arm"};
    ck_assert_str_eq(r.name, "crawler");
    ck_assert_int_eq(r.num_actuators, 5);
    ck_assert_int_eq(r.num_bodies, 6);
    double mass = 0;
    for (int i = 0; i < 5; i++) {
        ck_assert_str_eq(r.actuators[i].name, names[i]);
    }
    for (int i = 0; i < 6; i++) {
        mass += r.bodies[i].mass;
    }
    ck_assert_double_eq(mass, 945);
    ck_assert_double_eq(r.actuators[1].effort, 1000);
    ck_assert_double_eq(r.actuators[1].speed, 5);
    ck_assert_double_eq(r.actuators[3].lower, -0.6);
    ck_assert_double_eq(r.actuators[4].home, -1.5);
    ck_assert_double_eq(r.bodies[3].inertia[1][1], 40);
    ck_assert_double_eq(r.crawlers[1].centre[1], -0.475);
    ck_assert_double_eq(r.crawlers[0].axis[1], 1);
}
END_TEST

/* Supports are listed in the file, and would be the same if they were not. */
START_TEST(supports_follow_from_the_crawlers) {
    robot_description listed;
    ck_assert(robot_file_load(CONFIG_DIR "/crawler.urdf", NULL, &listed));
    edited_begin(&e);
    static const char *const points[] = {"0.62 0.625", "-0.62 0.625", "-0.62 -0.625", "0.62 -0.625"};
    for (int i = 0; i < 4; i++) {
        char support[64];
        snprintf(support, sizeof support, "<support link=\"base\" xyz=\"%s 0\"/>", points[i]);
        edited_replace(&e, support, "");
    }
    edited_read(&e);
    edited_expect_good(&e);
    ck_assert_int_eq(e.robot.num_supports, listed.num_supports);
    for (int i = 0; i < listed.num_supports; i++) {
        ck_assert_int_eq(e.robot.supports[i].body, listed.supports[i].body);
        for (int k = 0; k < 3; k++) {
            ck_assert_double_eq_tol(e.robot.supports[i].point[k], listed.supports[i].point[k], 1e-15);
        }
    }
    edited_end(&e);
}
END_TEST

/* All that touches but what is joined, and the sprockets. */
START_TEST(bodies_may_meet_unless_they_are_joined) {
    robot_description r;
    ck_assert(robot_file_load(CONFIG_DIR "/crawler.urdf", NULL, &r));
    for (int a = 0; a < r.num_bodies; a++) {
        for (int b = 0; b < r.num_bodies; b++) {
            const bool apart = (a == 0 && b > 3) || (b == 0 && a > 3) || (a == 3 && b == 5) || (a == 5 && b == 3);
            ck_assert_int_eq(r.may_meet[a][b], apart);
        }
    }
}
END_TEST

static const struct {
    const char *from, *to, *words;
} refusals[] = {
    {"</robot>", "", "not XML: "},
    {"<limphome>", "<other>", "not XML: mismatched tag"},
    {"<robot name=\"crawler\">", "<!DOCTYPE r [<!ENTITY a \"b\">]><robot>", "<!ENTITY>: entities are refused"},
    {"<mass value=\"498\"/>", "<mass value=\"-1\"/>",
     ":14: <link name=\"base\"> <mass value=\"-1\">: must be 0 or more"},
    {"<mass value=\"498\"/>", "<mass value=\"nan\"/>", "<mass value=\"nan\">: must be 1 number"},
    {"<mass value=\"498\"/>", "<mass value=\"1e999\"/>", "<mass value=\"1e999\">: must be 1 number"},
    {"<mass value=\"498\"/>", "<mass value=\"0x10\"/>", "<mass value=\"0x10\">: must be 1 number"},
    {"<mass value=\"498\"/>", "<mass/>", "<mass>: needs value"},
    {"<mass value=\"498\"/>", "", "<link name=\"base\"> <inertial>: needs <mass>"},
    {"<mass value=\"498\"/>", "<mass value=\"498\"/><mass value=\"1\"/>",
     "<mass value=\"1\">: is given twice, first in line 14"},
    {"<mass value=\"60\"/>", "<mass value=\"0\"/>", "<link name=\"boom\">: has no mass"},
    {"<origin xyz=\"0 0 0.30\"/>", "<origin xyz=\"0,0 0,30\"/>", "<origin xyz=\"0,0 0,30\">: must be 3 numbers"},
    {"<origin xyz=\"0 0 0.50\"/>", "<origin xyz=\"0 0 inf\"/>",
     "<joint name=\"swing\"> <origin xyz=\"0 0 inf\">: must be 3 numbers"},
    {"<origin xyz=\"0 0 0.50\"/>", "<origin xyz=\"0 0 0.50\"/><origin/>",
     "<joint name=\"swing\"> <origin>: is given twice"},
    {"ixx=\"30\"", "ixx=\"\"", "<inertia ixx=\"\">: must be 1 number"},
    {"<box size=\"1.0 0.80 0.86\"/></geometry></collision>", "<box size=\"1 0.8\"/></geometry></collision>",
     "<link name=\"upper_body\"> <box size=\"1 0.8\">: must be 3 numbers"},
    {"<box size=\"1.0 0.80 0.86\"/></geometry></visual>", "<box size=\"1,0\"/></geometry></visual>",
     "<box size=\"1,0\">: must be 3 numbers"},
    {"<sphere radius=\"0.08\"/>", "<sphere radius=\"-0.08\"/>", "<sphere radius=\"-0.08\">: must be above 0"},
    {"<sphere radius=\"0.08\"/>", "<ball radius=\"0.08\"/>", "<ball radius=\"0.08\">: unknown shape"},
    {"<sphere radius=\"0.08\"/>", "", "<geometry>: is empty"},
    {"<sphere radius=\"0.08\"/>", "<sphere radius=\"1\"/><sphere radius=\"1\"/>", "is a second shape"},
    {"<geometry><sphere radius=\"0.08\"/></geometry>", "",
     "<link name=\"boom\"> <collision name=\"elbow\">: needs <geometry>"},
    {"<crawler joint=\"left_crawler\"", "<crawler joint=\"lost\"", "<crawler joint=\"lost\">: there is no such joint"},
    {"<crawler joint=\"left_crawler\"", "<crawler", "<crawler xyz=\"0 0.475 0.18\">: needs joint"},
    {"<crawler joint=\"left_crawler\"", "<crawler joint=\"\"", "<crawler joint=\"\">: must not be empty"},
    {"width=\"0.30\" radius=\"0.18\"/>", "width=\"0.30\"/>", "<crawler joint=\"left_crawler\">: needs radius"},
    {"width=\"0.30\"", "width=\"-0.30\"", "<crawler width=\"-0.30\">: must be above 0"},
    {"width=\"0.30\"", "width=\"1.7\"", "they overlap"},
    {"length=\"1.6\"", "length=\"0.2\"", "<crawler length=\"0.2\">: must be at least twice the radius of 0.18 m"},
    {"length=\"1.6\"", "lenght=\"1.6\"", "<crawler lenght=\"1.6\">: unknown attribute"},
    {"xyz=\"0 0.475 0.18\" l", "xyz=\"0 -0.9 0.18\" l", "the left one must come first"},
    {"xyz=\"0 0.475 0.18\" l", "xyz=\"0 0.475 0.30\" l", "the left crawler stands 0.12 m higher than the right"},
    {"xyz=\"0 0.475 0.18\" l", "xyz=\"0.2 0.475 0.18\" l", "degrees past the other crawler"},
    {"<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1 0.1\"/>", "5.71 degrees past the other crawler"},
    {"<crawler joint=\"right_crawler\" xyz=\"0 -0.475 0.18\" length=\"1.6\" width=\"0.30\" radius=\"0.18\"/>", "",
     "<limphome>: has 1 <crawler>; must have two"},
    {"<arm joint=\"boom\"", "<arm joint=\"bom\"", "<arm joint=\"bom\">: there is no such joint"},
    {"<arm joint=\"boom\"", "<arm joint=\"swing\"", "<arm joint=\"swing\">: is an actuator already"},
    {"<arm joint=\"boom\"", "<leg joint=\"boom\"", "<leg joint=\"boom\">: unknown inside <limphome>"},
    {"home=\"0.6\"", "home=\"1.6\"", "<arm home=\"1.6\">: must lie within the limits of joint boom, -0.6 to 1.2 rad"},
    {"home=\"0.6\"", "", "<arm joint=\"boom\">: needs home"},
    {"<tip link=\"arm\"", "<tip link=\"hand\"", "<tip link=\"hand\">: there is no such link"},
    {"<tip link=\"arm\" xyz=\"0.8 0 0\"", "<tip link=\"arm\" xyz=\"0.8 0 0 0\"", "must be 3 numbers"},
    {"<tip link=\"arm\" xyz=\"0.8 0 0\" radius=\"0.08\"/>", "", "has no <tip>"},
    {"radius=\"0.08\"/>\n    <support", "radius=\"round\"/>\n    <support", "<tip radius=\"round\">: must be 1 number"},
    {"lower=\"-0.6\" upper=\"1.2\"", "lower=\"1.6\" upper=\"1.2\"",
     "<joint name=\"boom\"> <limit upper=\"1.2\">: lower 1.6 must be below upper 1.2"},
    {"effort=\"6000\"", "effort=\"0\"",
     "<joint name=\"boom\"> <limit effort=\"0\">: needs <limit> with effort above 0"},
    {"effort=\"6000\"", "", "<joint name=\"boom\"> <limit>: needs <limit> with effort above 0"},
    {"<limit effort=\"1000\" velocity=\"5\"/>", "",
     "<joint name=\"left_crawler\">: needs <limit> with velocity above 0"},
    {"<joint name=\"boom\" type=\"revolute\">", "<joint name=\"boom\" type=\"prismatic\">",
     "<joint type=\"prismatic\">: the joint of an <arm> must be revolute or continuous"},
    {"type=\"continuous\"", "type=\"revolute\"", "the joint of a crawler's sprocket must be continuous"},
    {"type=\"continuous\"", "type=\"round\"", "<joint type=\"round\">: needs type"},
    {"type=\"continuous\"", "", "<joint name=\"left_crawler\">: needs type"},
    {"<parent link=\"boom\"/>", "<parent link=\"arm\"/>", "<joint name=\"arm\">: link arm would hang on itself"},
    {"<parent link=\"boom\"/>", "<parent link=\"nowhere\"/>", "<parent link=\"nowhere\">: there is no such link"},
    {"<parent link=\"boom\"/>", "", "<joint name=\"arm\">: needs <parent"},
    {"<parent link=\"upper_body\"/>", "<parent link=\"arm\"/>", "closes a loop: boom on arm on boom; links"},
    {"<child link=\"arm\"/>", "<child link=\"upper_body\"/>", "link upper_body hangs on joint swing already (line 48)"},
    {"<link name=\"left_sprocket\">", "<link name=\"spare\"/><link name=\"left_sprocket\">",
     "<link name=\"spare\">: hangs on no joint, nor does link base (line 11)"},
    {"<link name=\"left_sprocket\">", "<link name=\"right_sprocket\">",
     "is given twice, first in line 22; names must differ"},
    {"<link name=\"base\">", "<link>", "<link>: needs name"},
    {"<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 0\"/>", "<joint name=\"swing\"> <axis xyz=\"0 0 0\">: has no direction"},
    {"<robot name", "<model name", "not XML"},
    {"lower=\"-0.6\" upper=\"1.2\"", "lower=\"-35\" upper=\"70\"",
     "<limit upper=\"70\">: lower -35 and upper 70 look like degrees; must be in radians: -0.6109 and 1.222"},
    {"lower=\"-0.6\" upper=\"1.2\"", "lower=\"-7.5\" upper=\"1.2\"",
     "<limit lower=\"-7.5\">: lower -7.5 and upper 1.2 must lie"},
    {"<origin xyz=\"0 0 0.50\"/>", "<origin xyz=\"0 0 0.50\" rpy=\"0 0 90\"/>",
     "<origin rpy=\"0 0 90\">: is more than once round"},
    {"<origin xyz=\"0 0 0.50\"/>", "<origin xyz=\"0 0 500\"/>",
     "<origin xyz=\"0 0 500\">: must be numbers of at most 100"},
    {"<mass value=\"498\"/>", "<mass value=\"5e6\"/>", "<mass value=\"5e6\">: must be 0 or more and at most 1e+06"},
    {"ixx=\"30\"", "ixx=\"-30\"",
     "<link name=\"upper_body\"> <inertia ixx=\"-30\">: has the principal moments -30, 40, 40"},
    {"ixx=\"30\"", "ixx=\"300\"", "principal moments 40, 40, 300 kg m^2, which no body has"},
    {"ixx=\"30\" iyy=\"40\" izz=\"40\"", "ixx=\"3e4\" iyy=\"4e4\" izz=\"4e4\"",
     "is that of a mass 10.7 m from its centre"},
    {"ixx=\"30\" iyy=\"40\" izz=\"40\"", "ixx=\"3e-3\" iyy=\"4e-3\" izz=\"4e-3\"",
     "is that of a mass within 0.00338 m of its centre, but the link reaches"},
    {"<mass value=\"350\"/>", "<mass value=\"350000\"/>", "<mass value=\"350000\">: would be"},
    {"ixx=\"30\" iyy=\"40\" izz=\"40\"", "ixx=\"0\" iyy=\"0\" izz=\"0\"",
     "<link name=\"upper_body\">: has, with what is fixed"},
    {"<inertia ixx=\"30\" iyy=\"40\" izz=\"40\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>", "", "<inertial>: needs <inertia>"},
    {"<support link=\"base\" xyz=\"0.62 0.625 0\"/>\n    <support link=\"base\" xyz=\"-0.62 0.625 0\"/>\n    <support "
     "link=\"base\" xyz=\"-0.62 -0.625 0\"/>",
     "", "has 1 <tip> and 1 <support>; must have three in all"},
    {"<joint name=\"boom\" type=\"revolute\">", "<joint name=\"boom\" type=\"revolute\"><mimic joint=\"swing\"/>",
     "<mimic joint=\"swing\">: an <arm> joint that follows another"},
    {"<link name=\"base\">", "<xacro:if value=\"1\"/><link name=\"base\">", "<xacro:if>: is xacro, not URDF"},
};

START_TEST(bad_robots_are_refused_with_the_element) {
    edited_begin(&e);
    edited_replace(&e, refusals[_i].from, refusals[_i].to);
    edited_read(&e);
    edited_expect_fault(&e, refusals[_i].words);
    edited_end(&e);
}
END_TEST

START_TEST(all_faults_are_told_in_the_order_of_the_file) {
    edited_begin(&e);
    edited_replace(&e, "home=\"0.6\"", "home=\"1.6\"");
    edited_replace(&e, "<mass value=\"350\"/>", "<mass value=\"heavy\"/>");
    edited_replace(&e, "<mass value=\"498\"/>", "<mass value=\"-1\"/>");
    edited_read(&e);
    ck_assert_int_eq(e.report.num_faults, 3);
    ck_assert_ptr_nonnull(strstr(e.report.faults[0], "value=\"-1\""));
    ck_assert_ptr_nonnull(strstr(e.report.faults[1], "value=\"heavy\""));
    ck_assert_ptr_nonnull(strstr(e.report.faults[2], "home=\"1.6\""));
    edited_end(&e);
}
END_TEST

START_TEST(no_extension_is_refused) {
    edited_begin(&e);
    strcpy(e.text, "<robot name=\"r\"><link name=\"base\"/></robot>");
    edited_read(&e);
    edited_expect_fault(&e, ":1: <robot name=\"r\">: needs <limphome>");
    edited_end(&e);
    strcpy(e.text, "<model/>");
    edited_read(&e);
    edited_expect_fault(&e, "<model>: is no robot file");
    edited_end(&e);
    strcpy(e.text, "");
    edited_read(&e);
    edited_expect_fault(&e, "not XML: no element found");
    edited_end(&e);
}
END_TEST

START_TEST(what_cannot_be_opened_or_read_is_told) {
    robot_description robot;
    robot_report report;
    ck_assert(!robot_file_read("/tmp/limphome_no_such.urdf", NULL, &robot, &report));
    ck_assert_str_eq(report.faults[0], "/tmp/limphome_no_such.urdf: cannot be opened: No such file or directory");
    robot_report_free(&report);
    ck_assert(!robot_file_read("/tmp", NULL, &robot, &report));
    ck_assert_str_eq(report.faults[0], "/tmp: cannot be read: Is a directory");
    robot_report_free(&report);
}
END_TEST

/* What a file may ask of the reader is bounded. */
START_TEST(deep_xml_is_refused) {
    edited_begin(&e);
    size_t length = (size_t)snprintf(e.text, sizeof e.text, "<robot>");
    for (int i = 0; i < 70; i++) {
        length += (size_t)snprintf(e.text + length, sizeof e.text - length, "<a>");
    }
    edited_read(&e);
    edited_expect_fault(&e, "more than 64 deep");
    edited_end(&e);
}
END_TEST

/* Extensions of others, such as <transmission>, hold elements called joint and link: they are none of ours. */
/* Read in pieces, a tag of 8 MB takes minutes; a test case may take 4 s. */
START_TEST(a_large_tag_is_read_at_once) {
    enum { LENGTH = 8000000 };
    char path[] = "/tmp/limphome_large_XXXXXX", *name = malloc(LENGTH);
    ck_assert_ptr_nonnull(name);
    memset(name, 'x', LENGTH);
    const int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    FILE *file = fdopen(fd, "w");
    ck_assert_ptr_nonnull(file);
    fprintf(file, "<robot name=\"%.*s\"/>", LENGTH, name);
    fclose(file);
    robot_report report;
    ck_assert(!robot_file_read(path, NULL, &e.robot, &report));
    ck_assert_ptr_nonnull(strstr(report.faults[0], "has no <link>"));
    robot_report_free(&report);
    unlink(path);
    free(name);
}
END_TEST

START_TEST(remarks_hold_nothing_that_a_terminal_obeys) {
    edited_begin(&e);
    edited_replace(&e, "<arm joint=\"arm\"",
                   "<arm joint=\"a\x7f\xc2\x9b"
                   "31m\xc3\xa9\"");
    edited_read(&e);
    ck_assert(!e.good);
    ck_assert_ptr_nonnull(strstr(e.report.faults[0], "\"a   31m\xc3\xa9\""));
    edited_end(&e);
}
END_TEST

/* Whose 63rd byte is the first half of a letter. */
START_TEST(long_names_are_cut_between_letters) {
    char name[100] = "ab", text[200];
    for (size_t length = 2; length < 80; length += 2) {
        snprintf(name + length, sizeof name - length, "\xc3\xa9");
    }
    snprintf(text, sizeof text, "<robot name=\"\x7f%s\"", name + 1);
    edited_begin(&e);
    edited_replace(&e, "<robot name=\"crawler\"", text);
    edited_read(&e);
    edited_expect_good(&e);
    memset(name + 62, 0, 2);
    name[0] = ' ';
    name[62] = ' ';
    ck_assert_str_eq(e.robot.name, name);
    edited_end(&e);
}
END_TEST

START_TEST(extensions_of_others_are_passed_over) {
    robot_description plain;
    ck_assert(robot_file_load(CONFIG_DIR "/crawler.urdf", NULL, &plain));
    edited_begin(&e);
    edited_replace(
        &e, "<robot name=\"crawler\">",
        "<!DOCTYPE robot><robot name=\"crawler\" xmlns:sensor=\"http://there\"><sensor:camera><link/></sensor:camera>");
    edited_replace(&e, "<limphome>",
                   "<transmission><joint name=\"x\"/><link/></transmission><gazebo><limphome/></gazebo><limphome>");
    edited_read(&e);
    edited_expect_good(&e);
    e.robot.hash = plain.hash;
    ck_assert_mem_eq(&e.robot, &plain, sizeof plain);
    edited_end(&e);
}
END_TEST

START_TEST(fixed_links_become_one_body) {
    edited_begin(&e);
    edited_replace(
        &e, "<limphome>",
        "<link name='box'><inertial><mass value='100'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
        "iyz='0'/></inertial></link><joint name='bolts' type='fixed'><parent link='base'/><child link='box'/>"
        "<origin\txyz=' 0\n0  1.3 '/><axis xyz='0 0 0'/></joint><limphome>");
    edited_read(&e);
    edited_expect_good(&e);
    const robot_body *base = &e.robot.bodies[0];
    ck_assert_int_eq(e.robot.num_bodies, 6);
    ck_assert_double_eq_tol(base->mass, 598, 1e-9);
    ck_assert_double_eq_tol(base->centre[2], (498 * 0.3 + 100 * 1.3) / 598, 1e-12);
    /* reduced mass times distance squared is what two bodies add about their common centre */
    ck_assert_double_eq_tol(base->inertia[0][0], 75 + 1 + 498.0 * 100 / 598 * 1.0, 1e-9);
    ck_assert_double_eq_tol(base->inertia[2][2], 165 + 1, 1e-9);
    edited_end(&e);
}
END_TEST

START_TEST(there_are_as_many_arm_joints_as_the_file_gives) {
    edited_begin(&e);
    edited_replace(&e, "<arm joint=\"arm\" home=\"-1.5\"/>", "");
    edited_replace(&e, "<joint name=\"arm\" type=\"revolute\">", "<joint name=\"arm\" type=\"fixed\">");
    edited_read(&e);
    edited_expect_good(&e);
    ck_assert_int_eq(e.robot.num_actuators, 4);
    ck_assert_int_eq(e.robot.num_bodies, 5);
    ck_assert_int_eq(e.robot.supports[0].body, 4); /* the tip, now on the boom */
    ck_assert_double_eq_tol(e.robot.supports[0].point[0], 1.9, 1e-12);
    edited_end(&e);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("robot_file");
    tcase_add_test(cases, crawler_is_the_papers_robot);
    tcase_add_test(cases, supports_follow_from_the_crawlers);
    tcase_add_test(cases, bodies_may_meet_unless_they_are_joined);
    tcase_add_loop_test(cases, bad_robots_are_refused_with_the_element, 0, (int)(sizeof refusals / sizeof refusals[0]));
    tcase_add_test(cases, all_faults_are_told_in_the_order_of_the_file);
    tcase_add_test(cases, no_extension_is_refused);
    tcase_add_test(cases, what_cannot_be_opened_or_read_is_told);
    tcase_add_test(cases, deep_xml_is_refused);
    tcase_add_test(cases, a_large_tag_is_read_at_once);
    tcase_add_test(cases, remarks_hold_nothing_that_a_terminal_obeys);
    tcase_add_test(cases, long_names_are_cut_between_letters);
    tcase_add_test(cases, extensions_of_others_are_passed_over);
    tcase_add_test(cases, fixed_links_become_one_body);
    tcase_add_test(cases, there_are_as_many_arm_joints_as_the_file_gives);
    return run_suite("robot_file", cases);
}
