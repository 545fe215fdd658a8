/* Rows of pixels as sums of what borders change.
 *
 *      border             pixel p           p + 1
 *                   +-----------/-----+-----------------+    right of a border the colour changes
 *                   |          /######|#################|    by right - left, in the area that is
 *                   |   left  / right |                 |    marked: pixel p gets that times its
 *                   |        /########|#################|    area, and all pixels right of it get
 *                   +-------/---------+-----------------+    that times the border's height
 *
 * Left of the crop a border changes all pixels of its rows.
 *
 * INVARIANT: sums are whole numbers below 2^53, because the borders of a band change each channel
 * by less than 2^36 together, so they do not depend on any order. What is added is a function of
 * the chord, the row and the column alone: a crop has the pixels of the whole.
 */
#pragma once

#include "chords.h"
#include "varied.h"

/* From the left of a border to its right. */
typedef struct pf_step {
  double colour[4];
  uint32_t left, right; /* cells that vary, by their numbers in all bands, or NO_CELL */
} pf_step;
#define PF_NO_CELL UINT32_MAX

/* What is added at a pixel, times PF_HEIGHT: to it, and to all pixels right of it. */
typedef struct pf_slot {
  double area[4], height[4];
} pf_slot;

typedef struct pf_lead {
  double colour[4];
} pf_lead;

typedef struct pf_sums {
  const planefile_plane *plane;
  planefile_view view;
  int64_t left, right;        /* the columns of the crop in the frame */
  int64_t top;                /* the top of the rows being made */
  uint32_t rows;              /* that are made at once, at most */
  size_t words;               /* the words of the bits of a row, some of them beyond it */
  pf_slot *slots;             /* the slots of each row a slot for each column, if anything is, */
  uint64_t *bits;             /* and a bit: something is in it */
  pf_lead leads[PF_ROWS + 2]; /* by what rows differ, left of the crop, from those before them */
  pf_lead lead;               /* of the latest row that was read */
  pf_lead start;         /* the start of every row: cell 0, and borders that are left of all rows */
  planefile_span *spans; /* the spans of the latest row */
  pf_varied varied;      /* where the plane varies */
  bool failed;           /* no memory */
} pf_sums;

/* view: within its frame. False: no memory; sums must be finished whatever happens. */
bool pf_sums_init(pf_sums *sums, const planefile_plane *plane, const planefile_view *view);
void pf_sums_finish(pf_sums *sums);

/* Adds to what every row begins with. */
void pf_sums_add_start(pf_sums *sums, const pf_step *change);
/* Before rows are made. top: the height of the first one. */
void pf_sums_begin(pf_sums *sums, int64_t top);
/* Draws a chord from a height down to a foot that it reaches. */
void pf_sums_draw(pf_sums *sums, const pf_step *change, const pf_chord *chord, int64_t y,
                  int64_t foot);
/* Draws a line left of the crop, from height y to foot of the rows being made. */
void pf_sums_draw_left(pf_sums *sums, const pf_step *change, int64_t y, int64_t foot);
/* The spans of a row of the crop, which is `made` of those that were made; it is forgotten. Rows
 * are read from the top. Returns how many they are. */
size_t pf_sums_read(pf_sums *sums, uint32_t row, uint32_t made);
