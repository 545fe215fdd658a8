/* What the two halves of a filtered row share: scatter.c fills it from the retained edges under the
 * kernel, convolve.c sums it along the row.
 *
 * Invariant: lists by column are only valid for columns that are touched; each begins with 0, which
 * is the empty list, and is linked by index + 1.
 */
#ifndef CS_KERNEL_CONVOLVE_PARTS_H
#define CS_KERNEL_CONVOLVE_PARTS_H

#include "kernel/kernel.h"
#include "kernel/retained.h"
#include "paint/painter.h"
#include "span/row.h"

#include <math.h>

#define CS_CONVOLVE_SUB_ROWS 16

/* A program among those under the kernel. */
typedef struct cs_convolve_term {
  const cs_program *program;
  double weight; /* at the column that is made */
} cs_convolve_term;

/* What changes from a column on; lists by column, linked by index + 1. */
typedef struct cs_convolve_shift { /* of a look's weight */
  uint32_t next, look;
  double weight;
} cs_convolve_shift;

typedef struct cs_convolve_passed { /* the whole kernel is right of a piece now */
  uint32_t next, row;
  int sub_row, slab_end;
  cs_v4d step;
  int varies; /* +1: a layer that varies begins, -1: one ends */
} cs_convolve_passed;

typedef struct cs_convolve_sub_row { /* what is seen at one height, left of the kernel */
  cs_v4d colour;
  int varies;
} cs_convolve_sub_row;

typedef struct cs_convolve_range {
  cs_v4 least, most;
} cs_convolve_range;

typedef struct cs_convolve {
  const cs_kernel *kernel;
  int32_t width;
  double (*changes)[4];              /* by column */
  double (*slopes)[4];               /* even shapes: of the change from column to column */
  cs_v4 *values;                     /* by column: what is seen there alone */
  float *sums;                       /* separable kernels: scratch */
  uint64_t *touched;                 /* columns at which something changes, one bit each */
  uint32_t *shifts_at, *passages_at; /* lists by column; 0: empty */
  cs_convolve_range *near;           /* signed kernels: of the looks near a column */
  cs_convolve_term *looks;
  cs_convolve_shift *shifts;
  cs_convolve_passed *passeds;
  cs_convolve_sub_row *sub_rows; /* CS_CONVOLVE_SUB_ROWS a row */
  size_t look_count, look_capacity;
  size_t shift_count, shift_capacity;
  size_t passage_count, passage_capacity;
  cs_convolve_range *ranges; /* of the slabs of each row */
  size_t slab_capacity, range_capacity;
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

#endif
