/* The borders of a swath, found and added to its pixels: loops for every set of instructions.
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

/* The swath whose sums are made. */
typedef struct cs_map_adding {
  celspan_context *context;
  cs_map_sums *sums;
  cs_map_rows *rows;
  int32_t row;            /* the first of the swath */
  celspan_status *status; /* set to NO_MEMORY if there is no memory for parts */
} cs_map_adding;

/* Finds the borders that cross the swath, with their places. Errors: NO_MEMORY. */
CS_WIDE_DECLARE(CELSPAN_CHECKED celspan_status, cs_map_find_lives, (const cs_map_adding *adding));
/* Adds the parts of the lives in the swath, and finds where each begins in the swath below. */
CS_WIDE_DECLARE(void, cs_map_add, (const cs_map_adding *adding));

/* The difference of the cells' colours from the left to the right of a border. */
static inline void cs_map_find_step(const cs_v4 *colours, const cs_map_border *f,
                                    cs_map_live *live) {
  cs_v4_store(live->step, (colours[f->right] - colours[f->left]) * (1.0f / CS_MAP_HEIGHT));
}
