/* A plane that is being recorded: the arrays of a plane file, which grow.
 *
 *     record.h     chains, borders, cells
 *     programs.h   what cells show that vary
 * pictures.h the pictures of these
 *
 * Invariant: every cell has a program, which is empty where the cell is flat; no two axes and no
 * two programs of a plan are the same.
 */
#pragma once

#include <planefile.h>
#include <stddef.h>

#include "inside/context.h"

#define CS_RECORD_SIDE 16381 /* pixels of the plan's width and height */

/* The steps of a grid, in pixels of the plan. */
static inline celspan_point cs_record_unit(planefile_grid grid) {
  return (celspan_point){(double)CS_RECORD_SIDE / (double)planefile_steps(grid.columns),
                         (double)CS_RECORD_SIDE / (double)planefile_steps(grid.rows)};
}

typedef struct cs_record_picture cs_record_picture; /* the source of its pixels: pictures.c */

typedef struct cs_recording {
  planefile_grid grid; /* the grid of all places */
  CS_ARRAY(planefile_point, points);
  CS_ARRAY(planefile_piece, pieces);
  CS_ARRAY(planefile_chain, chains);
  CS_ARRAY(planefile_border, borders);
  CS_ARRAY(planefile_cell, cells);
  CS_ARRAY(planefile_program, programs); /* the programs of the cells */
  CS_ARRAY(planefile_step, steps);
  CS_ARRAY(planefile_axis, axes);
  CS_ARRAY(planefile_stop, stops);
  CS_ARRAY(planefile_picture, pictures);
  CS_ARRAY(cs_record_picture, sources); /* the sources of the pictures */
  celspan_status status;                /* the status of reading pixels: the first failure */
  size_t point_count, piece_count, chain_count, border_count, cell_count, program_count, step_count;
  size_t axis_count, stop_count, picture_count;
} cs_recording;
