/* Programs in which a linear or radial gradient alone varies: all that is done to its paint - light,
 * fades, what lies before and behind it - is affine, so what they show is a mix of what they show at
 * two stops. The stops are folded once, and a pixel costs a look along them and a mix.
 *
 * Invariant: a pixel's colour depends on the program and the place alone. One store a composer; its
 * palettes hold for as long as the stack does.
 */
#ifndef CS_COMPOSE_PALETTE_H
#define CS_COMPOSE_PALETTE_H

#include "base/number.h"
#include "compose/composer.h"
#include "compose/shade.h"

/* From one stop to the next. */
typedef struct cs_palette_part {
  cs_v4 colour, step; /* premultiplied RGBA: at its beginning, and to its end */
  double at, scale;   /* its beginning, and 1 / its length; before the first stop and after the
                         last 0, as is the step */
} cs_palette_part;

typedef struct cs_palette {
  const cs_shade *shade;
  const cs_palette_part *parts; /* one before each stop, one after the last, one behind the
                                   horizon */
  cs_set_hash name;             /* of the program's leaves */
} cs_palette;

typedef struct cs_palettes cs_palettes;

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_palettes_create(celspan_context *context, cs_palettes **out);
void cs_palettes_destroy(cs_palettes *palettes, cs_memory *memory); /* NULL is nothing */

/* *out: the palette of a program, valid until the next is asked for; NULL where it has none. */
CELSPAN_CHECKED celspan_status cs_palette_find(cs_composer *composer, const cs_program *program,
                                               const cs_palette **out);

/* Which part holds what lies at `at` along the stops. */
static inline size_t cs_palette_part_at(const cs_palette *palette, double at) {
  const celspan_texture *texture = palette->shade->texture;
  size_t part = 0;
  while (part < texture->stop_count && texture->stops[part].at <= at)
    part++;
  return part;
}

/* The colour of a part at `at`, held to its ends. */
static inline cs_v4 cs_palette_mix(const cs_palette_part *part, double at) {
  double share = cs_number_most(cs_number_least((at - part->at) * part->scale, 1), 0);
  return part->colour + part->step * (float)share;
}

/* The colour at a point of the frame. */
static inline cs_v4 cs_palette_colour(const cs_palette *palette, double x, double y) {
  double at = cs_shade_at(palette->shade, x, y);
  if (at != at)
    return palette->parts[palette->shade->texture->stop_count + 1].colour;
  return cs_palette_mix(&palette->parts[cs_palette_part_at(palette, at)], at);
}

#endif
