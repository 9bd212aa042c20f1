/* An XML file as a tree of elements with their lines. What other programs need of XML only is passed over: text,
 * comments, processing instructions, elements of other namespaces with all they hold, a DOCTYPE. Entities, which could
 * make a small file a large one, are refused; so is what is too large or too deep. */
#ifndef LIMPHOME_ROBOT_XML_H
#define LIMPHOME_ROBOT_XML_H

#include <stdint.h>

#include "reading.h"

enum {
    XML_MOST_BYTES = 16 << 20, /* of a file */
    XML_MOST_ELEMENTS = 100000,
    XML_MOST_DEPTH = 64
};

struct xml_element {
    const char *name;
    unsigned long line;
    const char **attributes; /* name, value, name, value, ..., NULL */
    struct xml_element *parent, *first, *last, *next;
};

/* The root element, or NULL with a fault; `hash` receives FNV-1a of the file's bytes. */
struct xml_element *xml_read(struct reading *r, uint64_t *hash);

/* Value of an attribute, or NULL. */
const char *xml_attribute(const struct xml_element *element, const char *name);

/* Whether a name is in a list that NULL ends. */
bool xml_is_one_of(const char *name, const char *const *list);

/* First child of that name, or NULL; and the next one of the same name after a child. */
const struct xml_element *xml_child(const struct xml_element *element, const char *name);
const struct xml_element *xml_again(const struct xml_element *child);

#endif
