#include <string.h>

#include "elements.h"
#include "mesh.h"

static void read_box(struct reading *r, const struct xml_element *at, struct file_shape *shape) {
    vector size = {0, 0, 0};
    if (read_vector(r, at, "size", true, MOST_METRES, &size) && !(size.x > 0 && size.y > 0 && size.z > 0)) {
        fault(r, at, "size", "must be three lengths above 0");
    }
    shape->kind = ROBOT_BOX;
    shape->half_size = vector_scale(size, 0.5);
}

static void read_sphere(struct reading *r, const struct xml_element *at, struct file_shape *shape) {
    double radius = 0;
    read_positive(r, at, "radius", true, MOST_METRES, &radius);
    shape->kind = ROBOT_SPHERE;
    shape->half_size = (vector){radius, radius, radius};
}

static void read_cylinder(struct reading *r, const struct xml_element *at, struct file_shape *shape) {
    double radius = 0, length = 0;
    read_positive(r, at, "radius", true, MOST_METRES, &radius);
    read_positive(r, at, "length", true, MOST_METRES, &length);
    shape->kind = ROBOT_CYLINDER;
    shape->half_size = (vector){radius, radius, length / 2};
}

/* The one child of <geometry>, or NULL with a fault. */
static const struct xml_element *read_geometry(struct reading *r, const struct xml_element *at) {
    const struct xml_element *geometry = read_child(r, at, "geometry");
    if (geometry == NULL) {
        fault(r, at, NULL, "needs <geometry>");
        return NULL;
    }
    const struct xml_element *shape = geometry->first;
    if (shape == NULL) {
        fault(r, geometry, NULL, "is empty; must hold one of <box>, <sphere>, <cylinder>, <mesh>");
    } else if (shape->next != NULL) {
        fault(r, shape->next, NULL, "is a second shape, the first is in line %lu; <geometry> holds one", shape->line);
    }
    return shape;
}

/* False if it is no shape to keep. */
static bool read_shape(struct reading *r, const struct xml_element *at, struct file_shape *shape) {
    shape->at = at;
    shape->pose = read_origin(r, at);
    const struct xml_element *geometry = read_geometry(r, at);
    if (geometry == NULL) {
        return false;
    }
    if (strcmp(geometry->name, "box") == 0) {
        read_box(r, geometry, shape);
    } else if (strcmp(geometry->name, "sphere") == 0) {
        read_sphere(r, geometry, shape);
    } else if (strcmp(geometry->name, "cylinder") == 0) {
        read_cylinder(r, geometry, shape);
    } else if (strcmp(geometry->name, "mesh") == 0) {
        return strcmp(at->name, "collision") == 0 && mesh_read(r, geometry, shape); /* nothing is drawn with it */
    } else {
        fault(r, geometry, NULL, "unknown shape; known are <box>, <sphere>, <cylinder>, <mesh>");
        return false;
    }
    return true;
}

void shapes_read(struct reading *r, struct file_link *link) {
    size_t count = 0;
    for (const struct xml_element *at = link->at->first; at != NULL; at = at->next) {
        count++;
    }
    link->shapes = arena_take(&r->arena, count, sizeof *link->shapes);
    for (const struct xml_element *at = xml_child(link->at, "collision"); at != NULL; at = xml_again(at)) {
        link->num_shapes += read_shape(r, at, &link->shapes[link->num_shapes]);
    }
    link->num_seen = link->num_shapes;
    for (const struct xml_element *at = xml_child(link->at, "visual"); at != NULL; at = xml_again(at)) {
        link->num_seen += read_shape(r, at, &link->shapes[link->num_seen]);
    }
}
