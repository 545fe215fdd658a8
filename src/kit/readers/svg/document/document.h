/* An SVG file as a tree of elements, with the rules of its style sheets.
 *
 * Invariants: the tree is at most CS_SVG_DEPTH deep and has at most CS_SVG_ELEMENTS elements;
 * elements of other namespaces are left out, and so are characters outside of text; everything
 * lives in the document's arena.
 */
#pragma once

#include "inside/cache.h"
#include "inside/hash.h"
#include "readers/svg/words/css.h"
#include "readers/svg/words/names.h"
#include "readers/svg/words/values.h"

#define CS_SVG_DEPTH 128
#define CS_SVG_ELEMENTS 1000000

typedef struct cs_svg_attribute {
  cs_svg_name name;
  bool has_variable; /* the value refers to variables */
  const char *value;
} cs_svg_attribute;

typedef struct cs_svg_node {
  cs_svg_element element;
  const char *tag;       /* the name of the element, without a namespace */
  const char *text;      /* the text of CHARACTERS: UTF-8, as in the file; otherwise NULL */
  uint32_t line, number; /* number: counts elements, from 1 in the order of the file */
  struct cs_svg_node *parent, *first, *last, *next; /* NULL: none; first, last: children */
  const cs_svg_attribute *attributes;
  size_t attribute_count;
  cs_css_declarations style;    /* the style of its attribute `style` */
  cs_css_declarations moved;    /* what animations give to its properties; all zero: nothing */
  const celspan_matrix *motion; /* what animateMotion adds, after its transform; NULL: none */
  struct cs_svg_own_box *box;   /* around its contents at its place; NULL: not yet asked for */
} cs_svg_node;

typedef struct cs_svg_document {
  cs_arena arena;
  cs_svg_node *root; /* an svg element */
  size_t element_count;
  cs_svg_node **named; /* the nodes with an id; the first node of each id is in `ids` */
  size_t named_count, named_capacity;
  cs_hash_table ids; /* their values are indices into `named` */
  cs_css_sheet sheet;
  uint32_t sheet_line;    /* the line where the first style element begins; 0: there is none */
  bool has_geometry;      /* a style gives places or sizes */
  bool has_motion;        /* a style names animations */
  size_t animation_count; /* elements that animate */
  cs_hash key;            /* the same for equal texts, if anything of it moves */
  cs_svg_unread unread;
  cs_svg_variables variables; /* made while styles are read */
  cs_svg_measure page;        /* the outermost element's size; zero until it is read (build.c) */
} cs_svg_document;

/* name: of the file, for messages. *out must be finished even after a failure. Errors: INPUT with
 * the line for a file that is not XML or not SVG, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_document_read(celspan_context *context, const char *name,
                                                    const char *bytes, size_t size,
                                                    cs_svg_document *out);
void cs_svg_document_finish(cs_svg_document *document, celspan_context *context);

/* The element whose id consists of these bytes, or NULL. */
const cs_svg_node *cs_svg_document_find(const cs_svg_document *document, const char *id,
                                        size_t size);
/* The value of an attribute, or NULL. */
const char *cs_svg_node_value(const cs_svg_node *node, cs_svg_name name);
/* Whether the value is this word. */
bool cs_svg_node_says(const cs_svg_node *node, cs_svg_name name, const char *word);
