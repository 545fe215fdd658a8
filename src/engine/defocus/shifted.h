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
 * of the same pixels.
 *
 * Invariant: where the nodes around a tap are equal, it has their bits.
 */
#pragma once

#include "base/wide.h"
#include "engine/sample/defocused.h"
#include "model/geometry/boundary.h"
#include "model/scene/shift.h"

typedef struct cs_shifted {
  const cs_shift *shift; /* a reference */
  celspan_space space;   /* of the nodes */
  bool is_affine;
  celspan_matrix to_units, to_nodes; /* pixels of the frame to the cel's units, and on to nodes */
  cs_defocused_range columns, rows;  /* pixels of the frame that may not be clear */
  const cs_defocused *from, *by;     /* by: where the cel is displaced by something, else NULL */
  int32_t by_at[2];                  /* the node of `by` under the frame's first pixel */
  celspan_matrix *taps;
  size_t tap_count;
} cs_shifted;

/* The nodes of a grid, all bands that have been read. */
typedef struct cs_shifted_source {
  const cs_defocused *grid;
  cs_defocus_band **bands; /* acquired; NULL: not yet */
  size_t band_count;
} cs_shifted_source;

/* The rows of nodes of a frame. */
typedef struct cs_shifted_rows {
  const cs_shifted *map;
  const cs_defocused *to;
  celspan_context *context;
  cs_isa isa;
  cs_shifted_source from, by;
  double (*places)[2]; /* among the nodes, of each column of a row that is displaced */
  float *channels;     /* scratch: of each column, two channels, and the alpha */
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
/* Row y of one plane of the frame's nodes, and the groups that are even, as in defocused.h; plane 0
 * of a row comes first. Errors: those of the bands that are read. */
CELSPAN_CHECKED celspan_status cs_shifted_row(cs_shifted_rows *rows, int plane, int32_t y,
                                              float (*nodes)[4], bool *even);

/* ---- shifted_wide.c */

/* Adds a tap that is `count` nodes of two rows, mixed by the shares of the next column and of the
 * lower row. */
CS_WIDE_DECLARE(void, cs_shifted_add,
                (const float *upper, const float *lower, const float shares[2], int32_t count,
                 float *sums));
