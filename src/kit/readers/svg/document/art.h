/* A drawing that was read: a tree of items, and the scene value that each of them is.
 *
 *        item "arm" ---- item (a path)          object of an item =
 *          |    \                                 its own, or the union of its items' objects,
 *          |     item "hand" --- item ...         filtered, clipped, masked, faded, with a mode
 *          filter, clip, mask, opacity, mode
 *
 * With the items, `with` can replace a part by another object: only the objects above the part are
 * made again. Invariant: an item's object follows from its own object or items, filter, clip, mask,
 * opacity and mode; everything is in the drawing's units.
 */
#pragma once

#include "celspan/svg.h"
#include "inside/cache.h"
#include "inside/hash.h"
#include "readers/svg/document/recipe.h"

/* The facts about an element of the file, also for elements without a name. */
typedef struct cs_svg_facts {
  uint32_t number, line;     /* number: among all elements of the file, from 1 */
  const char *tag, *classes; /* classes: NULL if there are none; both in the arena */
  char fill[8];              /* "#rrggbb" for a shape or text; "": it has no flat colour */
  cs_mark place;             /* the place of its objects: "nell.svg", line 12; without a name */
} cs_svg_facts;

typedef struct cs_svg_item {
  struct cs_svg_item *next, *first, *last; /* first, last: items inside */
  const char *id, *label;                  /* NULL: none; in the arena */
  const cs_svg_facts *facts; /* NULL: the item is only a part of an element's drawing */
  celspan_object *own;       /* NULL for a group, and for an element that draws nothing */
  cs_svg_recipe *filter;     /* NULL: none. A reference */
  bool has_clip;
  celspan_object *clip; /* if NULL although has_clip is set: everything is cut away */
  bool has_mask;
  celspan_object *mask; /* if NULL although has_mask is set: nothing is visible */
  celspan_matte_from masks_by;
  double opacity;
  celspan_blend blend;
  bool isolates;              /* modes inside do not act on its background */
  bool is_moved;              /* `use` shows the item in another place than its place in the file */
  celspan_matrix moved, back; /* from its place in the file to the shown place; the inverse */
  celspan_object *object;     /* NULL: nothing is drawn */
} cs_svg_item;

typedef struct cs_svg_part {
  const char *name;
  bool is_label;          /* the name is a label, and not an id */
  celspan_object *object; /* at its place in the file; owned */
} cs_svg_part;

typedef struct cs_svg_note {
  int32_t line;
  const char *what;
} cs_svg_note;

/* A file that the drawing names and that was there: a picture, or a drawing in it. */
typedef struct cs_svg_named {
  const struct cs_svg_named *next;
  const char *path;
} cs_svg_named;

/* What a drawing that may move was read from, for its other times: the file is opened once. */
typedef struct cs_svg_file {
  const char *name, *bytes;
  size_t size;
  const celspan_svg_font *fonts;
  size_t font_count;
  uint64_t device, number; /* the identity of the file */
  cs_hash key;             /* the key of the file as it was, and of how it is read */
} cs_svg_file;

struct celspan_svg {
  atomic_size_t references;
  cs_memory *memory;
  cs_arena arena;
  /* the drawing of which this is a changed copy, and from which texts are borrowed; NULL: none */
  celspan_svg *origin;
  cs_svg_item *root;
  double width, height;
  double seconds;         /* how long it moves; 0: it does not */
  cs_svg_file *file;      /* in the arena; NULL: at all times it is the same, or has changes */
  celspan_space space;    /* the space of the object and of the parts */
  celspan_object *object; /* never NULL */
  cs_svg_part *parts;
  size_t part_count;
  cs_svg_note *skipped;
  size_t skipped_count;
  const cs_svg_named *named; /* the last one first; a changed copy has none of its own */
};

/* A drawing without items. *out: new. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_art_create(celspan_context *context, celspan_svg **out);
/* A new item inside `parent`, after its other items; NULL: an item without a parent. Errors:
   NO_MEMORY.
 */
CELSPAN_CHECKED celspan_status cs_svg_item_append(celspan_context *context, celspan_svg *art,
                                                  cs_svg_item *parent, cs_svg_item **out);
CELSPAN_CHECKED celspan_status cs_svg_text_copy(celspan_context *context, celspan_svg *art,
                                                const char *text, const char **out);
/* Adds a file that the drawing names. The path is copied. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_name_file(celspan_context *context, celspan_svg *art,
                                                const char *path);
/* Releases the contents of a list of items. */
void cs_svg_item_drop(cs_svg_item *item);
/* Makes the object of an item from its contents, which must be complete. Errors: NO_MEMORY,
 * LIMIT. */
CELSPAN_CHECKED celspan_status cs_svg_item_compose(celspan_context *context, cs_svg_item *item);
/* Makes the object of the whole drawing and the list of parts. Called after all items are
 * composed. */
CELSPAN_CHECKED celspan_status cs_svg_art_complete(celspan_context *context, celspan_svg *art);
