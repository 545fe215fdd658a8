/* Values in the colours of another palette: flat paints, stops and corners of gradients that have
 * exactly one colour of a table, and paintings (painting.h).
 *
 *   value --> objects --> textures --> paints
 *                             \-----> paintings, each once
 *
 * What cuts and is not painted stays: the later operands of a difference, the shape of a clip, what
 * a matte is matted by. So do lights, grain, gels, and paintings with a medium.
 *
 * INVARIANT: a value in which no colour changes is the same value, with one more reference.
 */
#pragma once

#include "inside/hash.h"
#include "inside/scene.h"
#include "tools/recolour/painting.h"

/* A colour that is in no table. */
typedef struct cs_strange {
  uint32_t rgb;              /* 0xrrggbb */
  int64_t count;             /* paints and pixels */
  int32_t x, y;              /* the first place: a pixel of a painting; -1: a paint */
  char place[CS_ERROR_SIZE]; /* the value that has it, such as " 'hat' (shot.lua:4)" */
} cs_strange;

enum { CS_STRANGE_MOST = 256 }; /* further colours are not listed */

typedef struct cs_recolour {
  celspan_context *context; /* for the calls */
  cs_swatches swatches;
  bool is_strict;      /* strange colours are listed */
  bool only_known;     /* as in paintings */
  cs_strange *strange; /* room for CS_STRANGE_MOST, if it is strict */
  size_t strange_count;
  int64_t work; /* pixels that were looked at */
  /* recoloured paintings, NULL where one stays; by their hashes */
  cs_picture **pictures;
  size_t picture_count, picture_capacity;
  cs_hash_table indices;
  const celspan_object *object; /* that is being looked at; NULL: none */
} cs_recolour;

/* recolour: the table is set, all else may be zero. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_recolour_begin(cs_recolour *recolour);
void cs_recolour_finish(cs_recolour *recolour);

/* *out: a reference. Errors: those of pictures; NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_recolour_texture(cs_recolour *recolour, celspan_texture *texture,
                                                   celspan_texture **out);
CELSPAN_CHECKED celspan_status cs_recolour_object(cs_recolour *recolour, celspan_object *object,
                                                  celspan_object **out);
CELSPAN_CHECKED celspan_status cs_recolour_rostrum(cs_recolour *recolour, celspan_rostrum *rostrum,
                                                   celspan_rostrum **out);
