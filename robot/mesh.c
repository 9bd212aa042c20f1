#include "mesh.h"

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/scene.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "mesh_path.h"

enum { MOST_BYTES = 128 << 20, MOST_NODES_DEEP = 64 };

/* Of a flat mesh [m]. */
#define LEAST_THICKNESS 1e-4

struct bounds {
    double low[3], high[3]; /* as long as nothing is in them, low is above high */
};

static void include_vertex(struct bounds *b, const struct aiMatrix4x4 *m, const struct aiVector3D *v) {
    const double p[3] = {(double)(m->a1 * v->x + m->a2 * v->y + m->a3 * v->z + m->a4),
                         (double)(m->b1 * v->x + m->b2 * v->y + m->b3 * v->z + m->b4),
                         (double)(m->c1 * v->x + m->c2 * v->y + m->c3 * v->z + m->c4)};
    for (int i = 0; i < 3; i++) {
        b->low[i] = fmin(b->low[i], p[i]);
        b->high[i] = fmax(b->high[i], p[i]);
    }
}

static void include_node(struct bounds *b, const struct aiScene *scene, const struct aiNode *node,
                         struct aiMatrix4x4 above, int depth) {
    aiMultiplyMatrix4(&above, &node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; i++) {
        const struct aiMesh *mesh = scene->mMeshes[node->mMeshes[i]];
        for (unsigned k = 0; k < mesh->mNumVertices; k++) {
            include_vertex(b, &above, &mesh->mVertices[k]);
        }
    }
    for (unsigned i = 0; i < node->mNumChildren && depth < MOST_NODES_DEEP; i++) {
        include_node(b, scene, node->mChildren[i], above, depth + 1);
    }
}

static FILE *stream_of(struct aiFile *file) {
    return (FILE *)file->UserData;
}

static size_t read_file(struct aiFile *file, char *to, size_t size, size_t count) {
    return fread(to, size, count, stream_of(file));
}

static size_t write_nothing(struct aiFile *file, const char *from, size_t size, size_t count) {
    (void)file, (void)from, (void)size, (void)count;
    return 0;
}

static size_t tell_file(struct aiFile *file) {
    return (size_t)ftell(stream_of(file));
}

static size_t size_file(struct aiFile *file) {
    struct stat found;
    return fstat(fileno(stream_of(file)), &found) == 0 ? (size_t)found.st_size : 0;
}

static aiReturn seek_file(struct aiFile *file, size_t offset, enum aiOrigin origin) {
    static const int from[] = {SEEK_SET, SEEK_CUR, SEEK_END}; /* aiOrigin_SET, _CUR, _END */
    return fseek(stream_of(file), (long)offset, from[origin]) == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
}

static void flush_nothing(struct aiFile *file) {
    (void)file;
}

/* Nothing but the mesh itself is opened: what it names besides, such as materials, may lie anywhere, or be a pipe. */
static struct aiFile *open_file(struct aiFileIO *io, const char *path, const char *mode) {
    (void)mode;
    FILE *stream = strcmp(path, io->UserData) == 0 ? fopen(path, "rb") : NULL;
    if (stream == NULL) {
        return NULL;
    }
    struct aiFile *file = malloc(sizeof *file);
    if (file == NULL) {
        fclose(stream);
        return NULL;
    }
    *file = (struct aiFile){.ReadProc = read_file,
                            .WriteProc = write_nothing,
                            .TellProc = tell_file,
                            .FileSizeProc = size_file,
                            .SeekProc = seek_file,
                            .FlushProc = flush_nothing,
                            .UserData = (char *)stream};
    return file;
}

static void close_file(struct aiFileIO *io, struct aiFile *file) {
    (void)io;
    fclose(stream_of(file));
    free(file);
}

/* Bounds of all vertices of a file. A COLLADA file's unit counts, its up axis does not: so ROS takes them. */
static bool find_bounds(char *path, struct bounds *b) {
    struct aiPropertyStore *properties = aiCreatePropertyStore();
    if (properties == NULL) {
        return false;
    }
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
    struct aiFileIO io = {.OpenProc = open_file, .CloseProc = close_file, .UserData = path};
    const struct aiScene *scene = aiImportFileExWithProperties(path, 0, &io, properties);
    aiReleasePropertyStore(properties);
    *b = (struct bounds){{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    if (scene == NULL || scene->mRootNode == NULL) {
        aiReleaseImport(scene);
        return false;
    }
    struct aiMatrix4x4 identity;
    aiIdentityMatrix4(&identity);
    include_node(b, scene, scene->mRootNode, identity, 0);
    aiReleaseImport(scene);
    return true;
}

static bool is_known_kind(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot != NULL &&
           (strcasecmp(dot, ".stl") == 0 || strcasecmp(dot, ".obj") == 0 || strcasecmp(dot, ".dae") == 0);
}

static void make_box(const struct bounds *b, vector scale, struct file_shape *shape) {
    double middle[3], half[3];
    for (int i = 0; i < 3; i++) {
        const double factor = vector_component(scale, i);
        middle[i] = factor * (b->low[i] + b->high[i]) / 2;
        half[i] = fmax(fabs(factor) * (b->high[i] - b->low[i]), LEAST_THICKNESS) / 2;
    }
    const frame offset = {vector_of(middle), matrix_identity()};
    shape->kind = ROBOT_BOX;
    shape->from_mesh = true;
    shape->pose = frame_multiply(&shape->pose, &offset);
    shape->half_size = vector_of(half);
}

/* The file of a mesh, or NULL with a fault. */
static char *find_file(struct reading *r, const struct xml_element *at) {
    const char *name = read_name(r, at, "filename");
    if (name[0] == '\0') {
        return NULL;
    }
    if (!is_known_kind(name)) {
        fault(r, at, "filename", "is of an unknown kind; known are .stl, .obj and .dae");
        return NULL;
    }
    char *path = mesh_path(r, name);
    struct stat found;
    if (path == NULL) {
        fault(r, at, "filename",
              "cannot be found; --packages DIR tells where package:// lies, else it is looked for in the "
              "folders above the robot file");
    } else if (stat(path, &found) == 0 && found.st_size > MOST_BYTES) {
        fault(r, at, "filename", "is larger than 128 MiB");
        return NULL;
    }
    return path;
}

bool mesh_read(struct reading *r, const struct xml_element *at, struct file_shape *shape) {
    vector scale = {1, 1, 1};
    read_vector(r, at, "scale", false, 1e6, &scale);
    char *path = find_file(r, at);
    if (path == NULL) {
        return false;
    }
    struct bounds b;
    if (!find_bounds(path, &b) || !(b.low[0] <= b.high[0])) {
        fault(r, at, "filename", "%.200s cannot be read as a mesh, or has no vertices", path);
        return false;
    }
    note_mesh(r, path, mesh_copy(r, xml_attribute(at, "filename")));
    make_box(&b, scale, shape);
    const vector size = vector_scale(shape->half_size, 2);
    if (!(vector_norm(size) <= MOST_METRES) || !(vector_norm(shape->pose.origin) <= 2 * MOST_METRES)) {
        fault(r, at, "filename",
              "would be %.4g x %.4g x %.4g m; must be at most %g m: a mesh in millimetres needs "
              "scale=\"0.001 0.001 0.001\"",
              size.x, size.y, size.z, MOST_METRES);
        return false;
    }
    remark(r, at, "filename", "taken as the box round it, %.3g x %.3g x %.3g m", size.x, size.y, size.z);
    return true;
}
