/* Meshes of every kind, wherever they lie: a slab of 0.4 x 0.2 x 0.1 m from one corner, three corners of which say as
 * much. */
#include <sys/stat.h>

#include "edited.h"

static const char stl[] =
    "solid slab\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0.4 0 0.1\nvertex 0 0.2 0\nendloop\nendfacet\n"
    "endsolid slab\n";

static const char obj[] = "v 0 0 0\nv 0.4 0 0.1\nv 0 0.2 0\nf 1 2 3\n";

/* In centimetres, and with y up, which ROS passes over. */
static const char dae[] =
    "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><asset>"
    "<unit name=\"cm\" meter=\"0.01\"/><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id=\"g\"><mesh>"
    "<source id=\"p\"><float_array id=\"pa\" count=\"9\">0 0 0 40 0 10 0 20 0</float_array><technique_common><accessor "
    "source=\"#pa\" count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" "
    "type=\"float\"/><param "
    "name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
    "source=\"#p\"/></vertices><triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 "
    "2</p>"
    "</triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id=\"s\"><node id=\"n\">"
    "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene "
    "url=\"#s\"/></scene></COLLADA>\n";

static struct {
    char folder[64], robot[128];
    robot_description description;
    robot_report report;
    bool good;
} m;

static void write_file(const char *name, const char *text) {
    char path[256];
    snprintf(path, sizeof path, "%s/%s", m.folder, name);
    for (char *slash = strchr(path + strlen(m.folder) + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        mkdir(path, 0700);
        *slash = '/';
    }
    FILE *file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    fputs(text, file);
    fclose(file);
}

static void setup(void) {
    memset(&m, 0, sizeof m);
    strcpy(m.folder, "/tmp/limphome_mesh_XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(m.folder));
}

static void teardown(void) {
    char command[100];
    robot_report_free(&m.report);
    snprintf(command, sizeof command, "rm -r %s", m.folder);
    ck_assert_int_eq(system(command), 0);
}

/* The crawler in src/bot/urdf with the elbow's ball made a mesh. */
static void read_with(const char *element, const char *mesh, const char *packages) {
    static struct edited e;
    char geometry[300];
    edited_begin(&e);
    snprintf(geometry, sizeof geometry, "<%s><origin xyz='1 0 0'/><geometry><mesh %s/></geometry></%s><!--", element,
             mesh, element);
    edited_replace(&e, "<collision name=\"elbow\">", geometry);
    edited_replace(&e, "<sphere radius=\"0.08\"/></geometry></collision>", "-->");
    write_file("src/bot/urdf/robot.urdf", e.text);
    snprintf(m.robot, sizeof m.robot, "%s/src/bot/urdf/robot.urdf", m.folder);
    m.good = robot_file_read(m.robot, packages, &m.description, &m.report);
}

static void expect_slab(void) {
    ck_assert_msg(m.good, "%s", m.good ? "" : m.report.faults[0]);
    const robot_shape *slab = &m.description.shapes[4];
    static const double half[3] = {0.2, 0.1, 0.05};
    ck_assert_str_eq(slab->name, "boom");
    ck_assert_int_eq(slab->kind, ROBOT_BOX);
    for (int i = 0; i < 3; i++) {
        ck_assert_double_eq_tol(slab->half_size[i], half[i], 1e-7);
        ck_assert_double_eq_tol(slab->pose.position[i], half[i] + (i == 0), 1e-7);
    }
    ck_assert_int_eq(m.report.num_meshes, 1);
    ck_assert_int_eq(strncmp(m.report.meshes[0].copy, "robot_meshes/", strlen("robot_meshes/")), 0);
    ck_assert(edited_says(m.report.notices, m.report.num_notices, "taken as the box round it, 0.4 x 0.2 x 0.1 m"));
}

static const struct {
    const char *file, *text, *mesh;
} kinds[] = {
    {"src/bot/meshes/slab.stl", stl, "filename='package://bot/meshes/slab.stl'"},
    {"src/bot/meshes/slab.STL", stl, "filename='package://bot/meshes/slab.STL'"},
    {"src/bot/meshes/slab.obj", obj, "filename='package://bot/meshes/slab.obj'"},
    {"src/bot/meshes/slab.dae", dae, "filename='package://bot/meshes/slab.dae'"},
    {"src/other/meshes/slab.obj", obj, "filename='package://other/meshes/slab.obj'"},
    {"src/bot/meshes/slab.obj", obj, "filename='model://another_name/meshes/slab.obj'"},
    {"src/bot/urdf/slab.obj", obj, "filename='slab.obj'"},
    {"src/bot/meshes/slab.obj", obj, "filename='../meshes/slab.obj'"},
    {"src/bot/meshes/slab.obj", obj, "filename='file://../meshes/slab.obj'"},
    {"src/bot/meshes/slab.obj", "v 0 0 0\nv 400 0 100\nv 0 200 0\nf 1 2 3\n",
     "filename='../meshes/slab.obj' scale='0.001 0.001 0.001'"},
    {"src/bot/meshes/slab.obj", obj, "filename='file:///home/somebody/ws/src/bot/meshes/slab.obj'"},
    {"src/bot/meshes/slab.obj", obj, "filename='/opt/ros/share/bot/meshes/slab.obj'"},
    {"src/bot/urdf/robot_meshes/package_3a_2f_2fgone_2fa_2fslab.obj", obj, "filename='package://gone/a/slab.obj'"},
};

START_TEST(a_mesh_is_the_box_round_it) {
    write_file(kinds[_i].file, kinds[_i].text);
    read_with("collision", kinds[_i].mesh, NULL);
    expect_slab();
}
END_TEST

START_TEST(packages_are_looked_for_where_the_caller_says) {
    char packages[200], mesh[200];
    write_file("elsewhere/far/meshes/slab.obj", obj);
    snprintf(packages, sizeof packages, "/nowhere:%s/elsewhere", m.folder);
    read_with("collision", "filename='package://far/meshes/slab.obj'", packages);
    expect_slab();
    char path[200];
    snprintf(path, sizeof path, "%s/elsewhere/far/meshes/slab.obj", m.folder);
    ck_assert_str_eq(m.report.meshes[0].path, path);
    robot_report_free(&m.report);
    snprintf(mesh, sizeof mesh, "filename='file://%s'", path); /* wherever it is */
    read_with("collision", mesh, NULL);
    expect_slab();
}
END_TEST

static const struct {
    const char *mesh, *words;
} refusals[] = {
    {"filename='package://bot/meshes/none.obj'", "<mesh filename=\"package://bot/meshes/none.obj\">: cannot be found"},
    {"filename='slab.step'", "<mesh filename=\"slab.step\">: is of an unknown kind; known are .stl, .obj and .dae"},
    {"filename='slab.obj' scale='1 1'", "<mesh scale=\"1 1\">: must be 3 numbers"},
    {"filename='slab.obj' scale='1000 1000 1000'", "would be 400 x 200 x 100 m; must be at most 100 m"},
    {"filename='empty.obj'", "cannot be read as a mesh, or has no vertices"},
    {"", "<mesh>: needs filename"},
};

START_TEST(bad_meshes_are_refused) {
    write_file("src/bot/urdf/slab.obj", obj);
    write_file("src/bot/urdf/empty.obj", "");
    read_with("collision", refusals[_i].mesh, NULL);
    ck_assert(!m.good);
    ck_assert_msg(edited_says(m.report.faults, m.report.num_faults, refusals[_i].words), "%s", m.report.faults[0]);
}
END_TEST

/* Nothing is drawn with it. */
START_TEST(meshes_that_are_only_seen_need_not_be_there) {
    read_with("visual", "filename='package://bot/meshes/none.step'", NULL);
    ck_assert(m.good);
    ck_assert_int_eq(m.report.num_meshes, 0);
}
END_TEST

/* A material that is a pipe would be waited for without end. */
START_TEST(nothing_is_opened_but_the_mesh) {
    char text[200], pipe[256];
    snprintf(text, sizeof text, "mtllib pipe.mtl\n%s", obj);
    write_file("src/bot/urdf/slab.obj", text);
    snprintf(pipe, sizeof pipe, "%s/src/bot/urdf/pipe.mtl", m.folder);
    ck_assert_int_eq(mkfifo(pipe, 0600), 0);
    read_with("collision", "filename='slab.obj'", NULL);
    expect_slab();
}
END_TEST

START_TEST(no_two_meshes_share_a_copy) {
    write_file("src/bot/urdf/a_b.obj", obj);
    write_file("src/bot/urdf/a/b.obj", obj);
    read_with("collision", "filename='a_b.obj'", NULL);
    expect_slab();
    char *first = strdup(m.report.meshes[0].copy);
    robot_report_free(&m.report);
    read_with("collision", "filename='a/b.obj'", NULL);
    expect_slab();
    ck_assert_str_ne(first, m.report.meshes[0].copy);
    free(first);
}
END_TEST

/* The box round a mesh claims more than there is: what it reaches into need not be in the way. */
START_TEST(meshes_that_overlap_at_home_are_excepted) {
    write_file("src/bot/urdf/counterweight.obj",
               "v -1.33 -0.05 -0.46\nv -1.23 0.05 -0.36\nv -1.33 0.05 -0.36\nf 1 2 3\n");
    read_with("collision", "filename='counterweight.obj'", NULL);
    ck_assert_msg(m.good, "%s", m.good ? "" : m.report.faults[0]);
    ck_assert(edited_says(m.report.notices, m.report.num_notices, "with shapes taken from meshes"));
    ck_assert(!m.description.may_meet[0][4]);
    ck_assert(m.description.may_meet[0][5]);
}
END_TEST

int main(void) {
    TCase *cases = tcase_create("mesh");
    tcase_add_checked_fixture(cases, setup, teardown);
    tcase_add_loop_test(cases, a_mesh_is_the_box_round_it, 0, (int)(sizeof kinds / sizeof kinds[0]));
    tcase_add_test(cases, packages_are_looked_for_where_the_caller_says);
    tcase_add_loop_test(cases, bad_meshes_are_refused, 0, (int)(sizeof refusals / sizeof refusals[0]));
    tcase_add_test(cases, nothing_is_opened_but_the_mesh);
    tcase_add_test(cases, no_two_meshes_share_a_copy);
    tcase_add_test(cases, meshes_that_overlap_at_home_are_excepted);
    tcase_add_test(cases, meshes_that_are_only_seen_need_not_be_there);
    return run_suite("mesh", cases);
}
