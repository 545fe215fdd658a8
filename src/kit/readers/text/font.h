/* Fonts: read once, kept in the context, shared by its threads.
 *
 *   file, variations --cache--> font --module--> outline of a glyph, made once
 *
 * The outlines are in font units with y down, ready to be placed. A file that changed is another
 * font.
 *
 * INVARIANT: a font does not change while it is kept, except for the outlines that are added to it.
 */
#pragma once

#include "celspan/text.h"
#include "inside/cache.h"
#include "inside/geometry.h"
#include "readers/type/letters.h"

typedef struct cs_font {
  cs_cache_entry entry;
  const cs_type_functions *type;
  cs_type_font *font;
  cs_type_font_info info;
  uint8_t *bytes;
  size_t size;
  pthread_mutex_t lock; /* protects the members below */
  cs_outline **glyphs;  /* by their numbers; NULL: not made yet */
  size_t points;        /* the points of all outlines that were made */
} cs_font;

/* How a glyph is placed: font units times scale, then moved. */
typedef struct cs_font_place {
  double x, y, scale;
} cs_font_place;

/* The font of desc->fonts[index], pinned until it is released. noun: for messages. Errors: see
 * celspan_object_create_text. */
CELSPAN_CHECKED celspan_status cs_font_acquire(celspan_context *context,
                                               const celspan_text_desc *desc, size_t index,
                                               cs_font **out);
/* NULL is ignored. */
void cs_font_release(celspan_context *context, cs_font *font);

/* Appends the outline of a glyph. Errors: NO_MEMORY, LIMIT; INPUT if the numbers of the outline are
 * invalid. Any thread. */
CELSPAN_CHECKED celspan_status cs_font_append(celspan_context *context, cs_font *font,
                                              uint32_t glyph, cs_font_place place,
                                              cs_outline *outline);
