/* The plan of a frame: a rostrum compiled for a frame of some size. It is made by render/compile.c
 * and never changed afterwards, so any number of workers read it at once. */
#ifndef CS_ROW_PLAN_H
#define CS_ROW_PLAN_H

#include "compose/stack.h"
#include "kernel/kernel.h"
#include "sweep/cull.h"

typedef struct cs_plan {
  cs_stack stack;
  cs_boundary_set boundaries;
  cs_cull cull;
  int32_t width, height; /* pixels */
  int32_t margin;        /* pixels beyond the frame, on all sides, that rows may need */
  celspan_antialias_mode antialias;
  cs_kernel *kernel; /* owned; NULL: rows are not filtered */
} cs_plan;

#endif
