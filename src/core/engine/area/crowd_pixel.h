/* A pixel of a crowd (crowd.h): its partial layers, each with its lines, among the layers that
 * cover all of it.
 *
 *     camera   between[0]   partial 0   between[1]   partial 1   between[2]   rear
 *              whole layers              whole layers             whole layers
 *
 * Invariant: the light of whole layers depends on the set at the left side of the pixel alone.
 */
#pragma once

#include "engine/area/crowd_solver.h"

#define CS_CROWD_HIDDEN 0x1p-12f /* what lies behind this much light is not visible */

/* The layers that cover whole pixels, the nearest first, as far as they are known: those that can
 * be reached. */
typedef struct cs_crowd_whole {
  CS_ARRAY(uint32_t, layers);
  size_t count;
  bool is_all;
} cs_crowd_whole;

typedef struct cs_crowd_pixel {
  const cs_composer *composer;
  cs_crowd_solver solver;
  cs_crowd_whole whole;
  /* light of the whole layers between partial ones; one more than these */
  CS_ARRAY(cs_v4, between);
  size_t place;         /* of the walk through the whole layers */
  cs_v4 light, through; /* of whole layers since the last partial one; and all of them */
  bool is_hidden;
  celspan_status failure; /* the first failure; kept until the interval ends */
} cs_crowd_pixel;

void cs_crowd_pixel_finish(cs_crowd_pixel *pixel, cs_memory *memory);
/* Forgets the whole layers: the composer has moved. */
void cs_crowd_pixel_forget(cs_crowd_pixel *pixel);
/* The presence of a layer at the place of the composer has changed. */
void cs_crowd_pixel_change(cs_crowd_pixel *pixel, uint32_t layer);
/* Begins a pixel with at most this number of segments and steps. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_crowd_pixel_begin(cs_crowd_pixel *pixel, size_t most);
/* Adds a layer, the nearest first; its lines are those from `first` on, of which `sides` are its
 * left side from top to foot, including those of winding 0. Returns 1 or 0 where the layer covers
 * the whole pixel or none of it, else -1. */
int cs_crowd_pixel_add(cs_crowd_pixel *pixel, uint32_t layer, size_t first, size_t sides);
/* The mean colour of the pixel. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_crowd_pixel_colour(cs_crowd_pixel *pixel, cs_v4 *out);
