/* The brush of a drawing: one thread's tool to paint the cells that vary.
 *
 *   map: layers, formulas, pictures over the raster --place--> the same over the frame's pixels
 *   program of a cell --painter--> colours under white light --light, grade--> those of the frame
 *
 * In pixels with several cells short streaks are painted ahead and kept, because the varying cells
 * of a pixel are needed in its neighbours, too.
 *
 * Invariant: a colour depends on the drawing, the cell and the pixel alone.
 */
#pragma once

#include "engine/map/sums.h"
#include "engine/paint/painter.h"

#define CS_MAP_STREAK 8 /* pixels */

typedef struct cs_map_streak {
  uint32_t cell;
  int32_t x0, y; /* y: -1: the streak is empty */
  cs_v4 colours[CS_MAP_STREAK];
} cs_map_streak;

/* The brush must not be moved. */
typedef struct cs_map_brush {
  const cs_map_drawing *drawing; /* borrowed; NULL: nothing varies */
  cs_painter painter;
  cs_map_streak streaks[4];
  unsigned oldest;
} cs_map_brush;

/* Puts the stack of the drawing's map into its place: drawing->stack. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_brush_place(celspan_context *context,
                                                  cs_map_drawing *drawing);
/* Frees the stack that cs_map_brush_place has made. */
void cs_map_brush_displace(cs_map_drawing *drawing, cs_memory *memory);

/* Errors: NO_MEMORY; cs_map_brush_finish must be called then, too. */
CELSPAN_CHECKED celspan_status cs_map_brush_init(cs_map_brush *brush, celspan_context *context,
                                                 const cs_map_drawing *drawing);
void cs_map_brush_finish(cs_map_brush *brush);

/* Converts a colour under white light to the colour under the light of the drawing. */
cs_v4 cs_map_brush_light(const cs_map_drawing *drawing, cs_v4 colour);
/* Whether this conversion changes no colour. */
bool cs_map_brush_is_bare(const cs_map_drawing *drawing);

/* The program of a cell that varies. */
cs_program cs_map_brush_program(const cs_map_drawing *drawing, uint32_t cell);
/* The colours of a cell in the pixels [x0, x1) of row y. Errors: those of painting. */
CELSPAN_CHECKED celspan_status cs_map_brush_colours(cs_map_brush *brush, uint32_t cell, int32_t y,
                                                    int32_t x0, int32_t x1, cs_v4 *out);
/* The colour of any cell in a pixel. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_map_brush_colour(cs_map_brush *brush,
                                                   const cs_map_drawing *drawing, uint32_t cell,
                                                   int32_t x, int32_t y, cs_v4 *out);
