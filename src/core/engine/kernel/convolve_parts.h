/* The data of a filtered row that its two halves share: scatter.c fills it from the retained edges
 * under the kernel, filter.c sums it along the row. One edge, which divides the kernels of the
 * columns 2, 3 and 4:
 *
 *     column        0   1   2   3   4   5   6   7
 *     touched       x       x   x   x   x              something changes here; always in column 0
 *     values                v   v   v                  added at this column only
 *     changes                           d              added to the running sum, from here on
 *     shifts                s   s   s   s              weights of programs change, from here on
 *     passed                            p              signed kernels: the kernel has passed the
 *                                                      edge
 *
 * Under an even shape an upright edge may be a ramp instead: one change of the sum and of its slope
 * at each end (slopes).
 *
 * Invariant: lists by column are only valid for columns that are touched; each begins with 0, which
 * is the empty list, and is linked by index + 1.
 */
#pragma once

#include "engine/kernel/kernel.h"
#include "engine/kernel/retained.h"
#include "engine/paint/painter.h"
#include "engine/span/row.h"

#include <math.h>

#define CS_CONVOLVE_SUB_ROWS 16

/* A program that is visible under the kernel, and the share of the kernel that it fills. */
typedef struct cs_convolve_term {
  cs_program program; /* the program of a cell of a retained row */
  double weight;      /* for the column that is being made */
} cs_convolve_term;

/* ---- what changes from a column on: lists by column, linked by index + 1 */
/* The weight of a term changes. */
typedef struct cs_convolve_shift {
  uint32_t next, term;
  double weight;
} cs_convolve_shift;

/* A passed event: from this column on the whole kernel is right of an edge. */
typedef struct cs_convolve_passed {
  uint32_t next, row;
  int sub_row, sub_row_end; /* heights of the row, [sub_row, sub_row_end) */
  cs_v4d step;              /* the change of colour */
  int varies;               /* +1: a layer that varies begins here; -1: such a layer ends */
} cs_convolve_passed;

/* The colour that is visible at one height, left of the kernel. */
typedef struct cs_convolve_sub_row {
  cs_v4d colour;
  int varies; /* not 0: a layer that varies is visible, or the height lies
                 outside the kernel; then it has no range */
} cs_convolve_sub_row;

/* Colours, channel by channel. */
typedef struct cs_convolve_range {
  cs_v4 least, most;
} cs_convolve_range;

typedef struct cs_convolve {
  const cs_kernel *kernel;
  int32_t width;
  CS_ARRAY(cs_v4d, changes); /* by column: the change of the sum of flat colours */
  /* even shapes, by column: by how much the change differs from the change of the column before */
  CS_ARRAY(cs_v4d, slopes);
  CS_ARRAY(cs_v4, values);           /* by column: what is added at this column only */
  CS_ARRAY(float, sums);             /* separable kernels: scratch */
  CS_ARRAY(uint64_t, touched);       /* one bit for each column: something changes there */
  CS_ARRAY(uint32_t, shifts_at);     /* lists by column; 0: empty */
  CS_ARRAY(uint32_t, passed_at);     /* the same */
  CS_ARRAY(cs_convolve_range, near); /* signed kernels: the range of the colours near a column */
  CS_ARRAY(cs_convolve_term, terms);
  CS_ARRAY(double, weights); /* of the terms, in the columns that are mixed at a time */
  CS_ARRAY(cs_convolve_shift, shifts);
  CS_ARRAY(cs_convolve_passed, passed);
  CS_ARRAY(cs_convolve_sub_row, sub_rows); /* CS_CONVOLVE_SUB_ROWS a row */
  CS_ARRAY(cs_convolve_range, ranges);     /* the ranges of the sub-rows of each row */
  size_t term_count, shift_count, passed_count;
} cs_convolve;

static inline size_t cs_convolve_words(int32_t width) { return (size_t)width / 64 + 1; }

static inline cs_convolve_range cs_convolve_both(cs_convolve_range a, cs_convolve_range b) {
  return (cs_convolve_range){cs_v4_min(a.least, b.least), cs_v4_max(a.most, b.most)};
}

static inline void cs_convolve_widen(cs_convolve_range *range, cs_v4 colour) {
  *range = cs_convolve_both(*range, (cs_convolve_range){colour, colour});
}

static inline cs_convolve_range cs_convolve_nothing(void) {
  return (cs_convolve_range){cs_v4_all(INFINITY), cs_v4_all(-INFINITY)};
}

/* Fills changes, values, slopes, shifts and passed events from the retained edges of `count` rows.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_scatter_rows(cs_convolve *convolve, cs_painter *painter,
                                               const cs_retained_row *const *retained_rows,
                                               size_t count, int32_t y);
