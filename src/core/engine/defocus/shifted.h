/* From the grid of a cel that is averaged over pixels to the grid of a frame, along a shift
 * (model/scene/shift.h).
 *
 *     o    o    o    o     o  nodes of the cel's grid: its pixels, as far as they can be read
 *     o    o    o    o     x  the place of a tap: the mix of the four nodes around it
 *     o    o  x o    o
 *     o    o    o    o     a node of the frame's grid: one tap where it is displaced, else the mean
 *                          of taps, of about one for each pixel of the way
 *
 * A tap is a matrix from pixels of the frame to nodes of the cel's grid. What displaces is a grid
 * of the same pixels. The taps of a line are the same for all pixels (shifted_line.h), except in
 * perspective.
 *
 * Invariant: where the nodes around a tap are equal, it has their bits.
 */
#pragma once

#include "engine/defocus/shifted_line.h"
#include "model/geometry/boundary.h"
#include "model/scene/shift.h"

typedef struct cs_shifted {
  const cs_shift *shift; /* a reference */
  celspan_space space;   /* the space of the nodes */
  bool is_affine;
  celspan_matrix to_units, to_nodes; /* pixels of the frame to the cel's units, and on to nodes */
  cs_defocused_range columns, rows;  /* pixels of the frame that may not be clear */
  const cs_defocused *from, *by;     /* by: where the cel is displaced by something, else NULL */
  int32_t from_at[2], by_at[2];      /* the nodes under the frame's first pixel */
  bool is_line;                      /* `line` has the taps; else: */
  cs_shifted_line line;
  celspan_matrix *taps;
  size_t tap_count;
} cs_shifted;

/* The rows of nodes of a frame. */
typedef struct cs_shifted_rows {
  const cs_shifted *map;
  const cs_defocused *to;
  celspan_context *context;
  cs_isa isa;
  cs_shifted_source from, by;
  cs_shifted_line_rows line; /* the line of a line */
  double *places[2];         /* among the nodes, of each column of a row, by axis */
} cs_shifted_rows;

#define CS_SHIFTED_SIDE (1 << 24) /* pixels of a side that are read, at most */

/* LIMIT: this many pixels would be read. */
CELSPAN_CHECKED celspan_status cs_shifted_refuse(celspan_context *context, double width,
                                                 double height);
/* Copies what is known of a shift: its taps over the pixels of `map`, whose other fields are given.
 * Must be finished after a failure too. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_shifted_init(celspan_context *context, cs_shift *shift,
                                               cs_shifted *map);
void cs_shifted_finish(cs_shifted *map, cs_memory *memory);
/* Must be finished after a failure too. Errors: NO_MEMORY; LIMIT where too much would be read. */
CELSPAN_CHECKED celspan_status cs_shifted_begin(const cs_shifted *map, const cs_defocused *to,
                                                celspan_context *context, cs_shifted_rows *out);
void cs_shifted_end(cs_shifted_rows *rows);
/* Row y of one plane of the frame's nodes; plane 0 of a row comes first. Errors: those of the bands
 * that are read. */
CELSPAN_CHECKED celspan_status cs_shifted_row(cs_shifted_rows *rows, int plane, int32_t y,
                                              float (*nodes)[4]);

/* ---- shifted_wide.c */

/* The nodes of one plane of a grid. */
typedef struct cs_shifted_nodes {
  const float *const *rows; /* the rows of plane 0 */
  size_t offset;            /* floats from these to the rows of the plane */
  int32_t columns, count;   /* columns and rows */
} cs_shifted_nodes;

/* How a channel moves points along an axis, in the cel's units. clear: where the alpha is 0;
 * space: to which the channel is converted. */
typedef struct cs_shifted_moving {
  celspan_channel channel;
  bool is_converted;
  celspan_space space;
  double scale, clear;
} cs_shifted_moving;

/* How far `count` points move that have these nodes. */
CS_WIDE_DECLARE(void, cs_shifted_moves,
                (const cs_shifted_moving *moving, const float (*nodes)[4], int32_t count,
                 double *out));
/* Adds moves, in the cel's units, to the places of neighbouring columns, which begin at `start` and
 * are `step` nodes apart. units: how many nodes a unit along each axis is, by axis of the nodes. */
CS_WIDE_DECLARE(void, cs_shifted_move,
                (const double start[2], const double step[2], const double units[2][2],
                 int32_t count, double *x, double *y));
/* Clamps places to the nodes from 0 to `last`; range: of their y. */
CS_WIDE_DECLARE(void, cs_shifted_settle,
                (const double last[2], int32_t count, double *x, double *y, double range[2]));
/* The nodes at settled places of a grid, mixed; adds: to the sums in `out`. */
CS_WIDE_DECLARE(void, cs_shifted_read,
                (const cs_shifted_nodes *nodes, const double *x, const double *y, int32_t count,
                 bool adds, float *out));
