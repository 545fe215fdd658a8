/* The borders under which an area must continue, so that no renderer shows a seam there: those
 * between two opaque fills. The thicker one continues: what is thin is drawn last, and in full.
 */
#pragma once

#include "writers/parcels/parcels.h"

/* A part of a border. */
typedef struct cs_under_line {
  uint32_t rank; /* the rank of its fill */
  bool is_thin;  /* so is its fill there, in front of which are the lines of others */
  bool is_flat;  /* a horizontal line, which no arc has: from..to; else an arc */
  uint32_t arc;
  celspan_point from, to;
} cs_under_line;

typedef struct cs_under {
  uint32_t *order;      /* the numbers of all fills, from the thinnest to the thickest */
  uint32_t *ranks;      /* the ranks of each fill its place among them */
  double *loops;        /* the loops of each loop, how thick its part of the fill is */
  cs_under_line *lines; /* thin ones and others, each by rank */
  size_t line_count, line_capacity;
  size_t fill_count, loop_count;
  double opaque; /* the area of opaque fills, in square units */
} cs_under;

/* Whether a fill is opaque, wherever it is. */
static inline bool cs_under_suits(const cs_fill *fill) {
  return fill->kind != CS_FILL_CLEAR && fill->is_opaque;
}
/* thin: an area that is thinner than this, in units, does not continue if its neighbour is thicker;
 * 0: the order of fills is made, and no lines.
 * out: must be finished in any case. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_under_make(celspan_context *context, const cs_parcels *parcels,
                                             double thin, cs_under *out);
/* Draws a line, which stays open. */
void cs_under_draw(const cs_parcels *parcels, const cs_under_line *line,
                   const cs_parcel_stylus *stylus);
void cs_under_finish(cs_under *under, cs_memory *memory);
