/* Adding the borders of a swath to its pixels: loops for every set of instructions.
 *
 *      border, from row to row            a row, from column to column
 *      +---------\-----------+            +-----------+-----------+-----------+
 *      |          \          |            |           |       ..--|-----------|
 *      +-----------\---------+            |  ...---"""|""" area   |   area    |  height
 *      |            \        |            +-----------+-----------+-----------+
 *
 * Places are integers, so that a line may be cut anywhere without a change to what is added: its x
 * at a row depends on the line alone, and the heights in the columns of a row add up to the height
 * of the line there. Lines are cut at rows one by one, and at columns eight at a time, since few of
 * these pieces reach a third column.
 *
 * Invariant: the bits are the same whichever instructions add them.
 */
#pragma once

#include "engine/map/swath.h"

/* From points to places: (origin + point) * scale + shift. Each array has x first, then y. */
typedef struct cs_map_placing {
  double origin[4], scale[4], shift[4];
} cs_map_placing;

/* Puts points into their places; `out` must have room for one more than there are. */
CS_WIDE_DECLARE(void, cs_map_put_places,
                (const cs_map_placing *placing, const cs_map_point *points, size_t count,
                 cs_map_point *out));

/* The swath whose sums are made; the lives of its drawing have been found. */
typedef struct cs_map_adding {
  celspan_context *context;
  cs_map_sums *sums;
  cs_map_rows *rows;
  int32_t row;            /* the first of the swath */
  celspan_status *status; /* set to NO_MEMORY if there is no memory for parts */
} cs_map_adding;

/* Adds the parts of the lives in the swath, and finds where each begins in the swath below. */
CS_WIDE_DECLARE(void, cs_map_add, (const cs_map_adding *adding));
