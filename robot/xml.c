#include "xml.h"

#include <errno.h>
#include <expat.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

struct parsing {
    struct reading *r;
    XML_Parser parser;
    struct xml_element *root, *open; /* the element under way */
    int depth, elements;
    int passed_over; /* depth below an element of another namespace, it included */
    bool xacro;      /* was told of */
    bool failed;
};

const char *xml_attribute(const struct xml_element *element, const char *name) {
    for (const char **at = element->attributes; at[0] != NULL; at += 2) {
        if (strcmp(at[0], name) == 0) {
            return at[1];
        }
    }
    return NULL;
}

bool xml_is_one_of(const char *name, const char *const *list) {
    while (*list != NULL && strcmp(name, *list) != 0) {
        list++;
    }
    return *list != NULL;
}

static const struct xml_element *first_named(const struct xml_element *at, const char *name) {
    while (at != NULL && strcmp(at->name, name) != 0) {
        at = at->next;
    }
    return at;
}

const struct xml_element *xml_child(const struct xml_element *element, const char *name) {
    return first_named(element->first, name);
}

const struct xml_element *xml_again(const struct xml_element *child) {
    return first_named(child->next, child->name);
}

static void stop(struct parsing *p, const char *why) {
    if (!p->failed) {
        p->failed = true;
        fault_in_line(p->r, XML_GetCurrentLineNumber(p->parser), "%s", why);
        XML_StopParser(p->parser, XML_FALSE);
    }
}

static struct xml_element *add_element(struct parsing *p, const char *name, const char **attributes) {
    struct arena *arena = &p->r->arena;
    struct xml_element *e = arena_take(arena, 1, sizeof *e);
    e->name = arena_copy(arena, name);
    e->line = XML_GetCurrentLineNumber(p->parser);
    size_t count = 0;
    while (attributes[count] != NULL) {
        count++;
    }
    e->attributes = arena_take(arena, count + 1, sizeof *e->attributes);
    for (size_t i = 0; i < count; i++) {
        e->attributes[i] = arena_copy(arena, attributes[i]);
    }
    e->parent = p->open;
    if (p->open == NULL) {
        p->root = e;
    } else if (p->open->last == NULL) {
        p->open->first = p->open->last = e;
    } else {
        p->open->last = p->open->last->next = e;
    }
    return e;
}

static void begin_element(void *user, const char *name, const char **attributes) {
    struct parsing *p = user;
    if (p->failed) {
        return;
    }
    if (++p->depth > XML_MOST_DEPTH) {
        stop(p, "elements lie more than 64 deep; a robot file has a handful");
        return;
    }
    if (++p->elements > XML_MOST_ELEMENTS) {
        stop(p, "more than 100000 elements");
        return;
    }
    if (p->passed_over == 0 && strchr(name, ':') == NULL) {
        p->open = add_element(p, name, attributes);
        return;
    }
    if (strncmp(name, "xacro:", strlen("xacro:")) == 0 && !p->xacro) {
        p->xacro = true;
        fault_in_line(p->r, XML_GetCurrentLineNumber(p->parser),
                      "<%.60s>: is xacro, not URDF; make the robot file of it: xacro FILE >robot.urdf", name);
    }
    p->passed_over++;
}

static void end_element(void *user, const char *name) {
    struct parsing *p = user;
    (void)name;
    p->depth--;
    if (p->passed_over > 0) {
        p->passed_over--;
    } else if (p->open != NULL) {
        p->open = p->open->parent;
    }
}

static void declare_entity(void *user, const char *name, int is_parameter, const char *value, int length,
                           const char *base, const char *system, const char *public, const char *notation) {
    (void)name, (void)is_parameter, (void)value, (void)length, (void)base, (void)system, (void)public, (void)notation;
    stop(user, "<!ENTITY>: entities are refused; write what they stand for");
}

/* All of the file, up to the largest that is taken; its length, or more than that. */
static size_t read_bytes(struct reading *r, FILE *file, char **bytes) {
    size_t room = 0, length = 0, more = 0;
    do {
        if (length == room) {
            room = room == 0 ? 65536 : 2 * room;
            char *larger = arena_take(&r->arena, room, 1);
            if (length > 0) {
                memcpy(larger, *bytes, length);
            }
            *bytes = larger;
        }
        more = fread(*bytes + length, 1, room - length, file);
        length += more;
    } while (more > 0 && length <= XML_MOST_BYTES);
    return length;
}

/* All of the file through the parser, at once: in pieces, a tag of many pieces is begun anew with each. */
static void parse(struct parsing *p, FILE *file, uint64_t *hash) {
    char *bytes = NULL;
    const size_t length = read_bytes(p->r, file, &bytes);
    if (ferror(file)) {
        fault_in_line(p->r, 0, "cannot be read: %s", strerror(errno));
        p->failed = true;
        return;
    }
    if (length > XML_MOST_BYTES) {
        stop(p, "is larger than 16 MiB");
        return;
    }
    *hash = 14695981039346656037u;
    for (size_t i = 0; i < length; i++) {
        *hash = (*hash ^ (unsigned char)bytes[i]) * 1099511628211u;
    }
    if (XML_Parse(p->parser, bytes, (int)length, true) == XML_STATUS_ERROR && !p->failed) {
        p->failed = true;
        fault_in_line(p->r, XML_GetCurrentLineNumber(p->parser), "not XML: %s",
                      XML_ErrorString(XML_GetErrorCode(p->parser)));
    }
}

struct xml_element *xml_read(struct reading *r, uint64_t *hash) {
    FILE *file = fopen(r->path, "rb");
    if (file == NULL) {
        fault_in_line(r, 0, "cannot be opened: %s", strerror(errno));
        return NULL;
    }
    struct parsing p = {.r = r, .parser = XML_ParserCreate(NULL)};
    if (p.parser == NULL) {
        fclose(file);
        fault_in_line(r, 0, "out of memory");
        return NULL;
    }
    XML_SetUserData(p.parser, &p);
    XML_SetElementHandler(p.parser, begin_element, end_element);
    XML_SetEntityDeclHandler(p.parser, declare_entity);
    parse(&p, file, hash);
    XML_ParserFree(p.parser);
    fclose(file);
    if (!p.failed && p.root == NULL) {
        fault_in_line(r, 0, "has no element <robot>");
    }
    return p.failed ? NULL : p.root;
}
