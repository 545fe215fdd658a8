/* The areas between the lines of a drawing.
 *
 *   coverage --half of a pixel--> ink --thinning--> ends of lines --closings.c--> walls
 *     --what hangs together by sides--> labels --nearest.h--> each wall is its nearest area's
 *
 *      1 1 # 2 2         #: a wall, of ink or of a closing; its pixels, too, have the label of the
 *      1 1 # 2 2         area that is nearest to them, so that areas meet in the middle of lines
 *      1 1 # # #
 *
 * INVARIANT: label 0 is the outside, which all pixels of the rim have; all pixels of an area that
 * are no walls hang together by their sides. Everything is a function of the coverage and the gap.
 */
#pragma once

#include "inside/context.h"

#define CS_AREAS_SIDE 4096 /* pixels of a side at most */

typedef enum cs_wall { CS_WALL_NONE, CS_WALL_INK, CS_WALL_CLOSING } cs_wall;

typedef struct cs_area_box {
  int32_t x0, y0, x1, y1; /* of all pixels with its label, the ends excluded */
} cs_area_box;

typedef struct cs_ink_areas {
  celspan_context *context;
  int32_t width, height;
  double thin; /* the share of the ink's middles that is thinner than three pixels */
  CS_ARRAY(unsigned char, coverage);
  CS_ARRAY(unsigned char, walls);
  CS_ARRAY(uint32_t, labels);
  CS_ARRAY(cs_area_box, boxes);
  size_t count; /* some labels may have no pixels */
} cs_ink_areas;

static inline size_t cs_ink_areas_size(const cs_ink_areas *areas) {
  return (size_t)areas->width * (size_t)areas->height;
}

/* coverage: 0..255 for each pixel, row by row, 0 along the border; it is copied. gap: the pixels of
 * the widest opening that is closed. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_ink_areas_create(celspan_context *context,
                                                   const unsigned char *coverage, int32_t width,
                                                   int32_t height, double gap, cs_ink_areas **out);
void cs_ink_areas_destroy(cs_ink_areas *areas); /* NULL is ignored */

/* Closes openings: sets walls, and `thin`. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_ink_areas_close(cs_ink_areas *areas, double gap);

/* For each label: its pixels; the sums of x, y, x * x, x * y and y * y of their middles; the middle
 * of its longest part of a row that has no walls, x and y, and the length of that. */
#define CS_AREA_NUMBERS 9
void cs_ink_areas_measure(const cs_ink_areas *areas, double (*out)[CS_AREA_NUMBERS]);

typedef struct cs_ink_leak {
  int32_t x, y;
  double width; /* pixels; HUGE_VAL: there is no ink on the way */
} cs_ink_leak;

/* The narrowest place on the widest way from one pixel to another of the same area, or from a pixel
 * of the outside to the rim if both are the same. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_ink_areas_leak(const cs_ink_areas *areas, uint32_t from,
                                                 uint32_t to, cs_ink_leak *out);
