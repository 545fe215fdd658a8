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
  planefile_point *points;
  planefile_piece *pieces;
  planefile_chain *chains;
  planefile_border *borders;
  planefile_cell *cells;
  planefile_program *programs; /* the programs of the cells */
  planefile_step *steps;
  planefile_axis *axes;
  planefile_stop *stops;
  planefile_picture *pictures;
  cs_record_picture *sources; /* the sources of the pictures */
  celspan_status status;      /* the status of reading pixels: the first failure */
  size_t point_count, point_capacity;
  size_t piece_count, piece_capacity;
  size_t chain_count, chain_capacity;
  size_t border_count, border_capacity;
  size_t cell_count, cell_capacity, program_count, program_capacity;
  size_t step_count, step_capacity;
  size_t axis_count, axis_capacity;
  size_t stop_count, stop_capacity;
  size_t picture_count, picture_capacity, source_capacity;
} cs_recording;
