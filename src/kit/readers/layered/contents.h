/* The contents of a painting: its layers and groups, and notes on contents that cannot be shown.
 *
 *   sky        layer   0   parent 3    layers are in the order of painting, rearmost first; a group
 *   hills      layer   1   parent 3    comes after its layers, so the parent of a layer is greater
 *   clouds     group   2   ...         than the layer itself
 *   backdrop   group   3   none
 *
 * INVARIANT: parents are greater than their layers, at most CS_CONTENTS_DEPTH groups lie in one
 * another, no layer has more than CS_CONTENTS_PIXELS pixels, and all layers together have at most
 * CS_CONTENTS_PIXELS_ALL, also if they show the same file. While a painting is read a layer
 * owns its source; the layers of a painting that is complete have surfaces instead. The keys of a
 * layer ascend in their frames, those of its drawings and those of its opacity each by themselves.
 */
#pragma once

#include "celspan/layers.h"
#include "readers/layered/rows.h"

#define CS_CONTENTS_LAYERS 65536
#define CS_CONTENTS_KEYS 1000000
#define CS_CONTENTS_DEPTH 100
#define CS_CONTENTS_SIDE 1048576
#define CS_CONTENTS_PIXELS ((int64_t)1 << 28)
#define CS_CONTENTS_PIXELS_ALL ((int64_t)1 << 33)
/* the greatest distance of a layer's corner from the painting's */
#define CS_CONTENTS_FARTHEST ((int64_t)1 << 30)
#define CS_CONTENTS_NONE SIZE_MAX
#define CS_CONTENTS_TEXT 256 /* bytes of a name or note, with their NUL */
#define CS_PROFILES_MOST 32  /* different colour profiles of a painting */

typedef struct cs_contents_layer {
  char name[CS_CONTENTS_TEXT]; /* valid UTF-8 without control characters; may be "" */
  char blend[32];
  size_t parent; /* CS_CONTENTS_NONE: in no group */
  bool is_group, is_visible;
  /* the layer is visible only where the nearest layer below it that is not clipped is present */
  bool is_clipped;
  bool is_within; /* the layer is visible only where layers below it, in its group, are present */
  int depth;      /* groups it lies in; set when the painting is complete */
  double opacity; /* 0..1 */
  int32_t x, y, width, height;
  const char *colour;     /* static: the meaning of its codes, as in celspan_picture_desc */
  cs_rows_source *source; /* owned; NULL: no pixels; for a group: its mask, in alpha */
  /* the painting's: converts its codes; NULL: they are not converted */
  struct cs_profile_table *table;
  celspan_surface *surface; /* a reference */
} cs_contents_layer;

typedef struct cs_contents_key {
  celspan_painting_key fields; /* complete when the painting is */
  /* while a Krita document is read: where the pixels of the drawing are, and its offset */
  const struct cs_zip_member *member;
  int32_t x, y;
} cs_contents_key;

typedef struct cs_contents_remark {
  size_t layer; /* CS_CONTENTS_NONE: the whole painting */
  /* the note is about the pixels of the layer alone; it does not matter if layers are composed */
  bool is_own;
  char text[CS_CONTENTS_TEXT];
} cs_contents_remark;

struct celspan_painting {
  atomic_size_t references;
  cs_memory *memory;
  int32_t width, height;
  CS_ARRAY(cs_contents_layer, layers);
  CS_ARRAY(cs_contents_remark, notes);
  CS_ARRAY(cs_contents_key, keys);
  size_t count, note_count, key_count;
  double rate; /* frames a second; 0: nothing moves */
  int32_t from, to;
  struct cs_profile_table *tables[CS_PROFILES_MOST]; /* references; kept until surfaces are made */
  size_t table_count;
};

/* An empty painting. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_contents_create(celspan_context *context, celspan_painting **out);
/* Appends a layer: visible, opaque, normal, without pixels and in no group. Its address is valid
 * until the next layer is added. name: size bytes, repaired and cut to a valid name. Errors: LIMIT,
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_contents_add(celspan_context *context, const cs_input *input,
                                               celspan_painting *painting, const char *name,
                                               size_t size, cs_contents_layer **out);
/* Appends a key of the layer added last, with an opacity of 1. Its address is valid until the next
 * one is added. Errors: LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_contents_add_key(celspan_context *context, const cs_input *input,
                                                   celspan_painting *painting,
                                                   cs_contents_key **out);
/* The layer added last. */
static inline size_t cs_contents_last(const celspan_painting *painting) {
  return painting->count - 1;
}
/* Appends a note on a layer, or on the whole painting (CS_CONTENTS_NONE), about something that
 * looks different from the program that made the painting. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_contents_note(celspan_context *context,
                                                celspan_painting *painting, size_t layer,
                                                const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* A note on the layer that was added last; it does not matter to callers that draw layers with all
 * their flags. */
CELSPAN_CHECKED celspan_status cs_contents_note_own(celspan_context *context,
                                                    celspan_painting *painting,
                                                    const char *sentence);
/* Errors: LIMIT for groups that are nested too deeply, and for too many pixels in all; INPUT for
 * layers in a layer that is not a group. */
CELSPAN_CHECKED celspan_status cs_contents_check_whole(celspan_context *context,
                                                       const cs_input *input,
                                                       celspan_painting *painting);
/* Reverses a list in which the foremost layer is first, and groups are before their layers. */
void cs_contents_reverse(celspan_painting *painting);
/* Errors: LIMIT for pictures beyond the limits above, INPUT for pictures without pixels. what: the
 * picture, for the message. */
CELSPAN_CHECKED celspan_status cs_contents_check_size(celspan_context *context,
                                                      const cs_input *input, const char *what,
                                                      int64_t width, int64_t height);
/* Checks that a corner is within the limit. Errors: LIMIT. */
CELSPAN_CHECKED celspan_status cs_contents_check_corner(celspan_context *context,
                                                        const cs_input *input, const char *what,
                                                        int64_t x, int64_t y);
/* Sets the place and the source, which the layer owns from now on. */
void cs_contents_set_pixels(cs_contents_layer *layer, int32_t x, int32_t y, cs_rows_source *source);
