/* The plan: a rostrum compiled for a frame of some size, in the flat form that rows are made from.
 *
 *   rostrum --frames/render/compile.c--> plan --engine/row/row.c, once a worker--> rows of spans
 *
 * Invariant: a plan never changes once it is made, so threads share it. It borrows the textures,
 * pictures and procedures of the rostrum, which must outlive it.
 */
#pragma once

#include "base/hash.h"
#include "engine/compose/stack.h"
#include "engine/kernel/kernel.h"
#include "engine/sweep/cull.h"

struct cs_defocus; /* engine/defocus/defocus.h */

/* What a plan shows: a cel of the film, or a flat back light behind one. */
typedef struct cs_plan_shown {
  cs_hash hash;       /* the hash of the cel and its objects, or of the light */
  size_t first;       /* the number of its first layer */
  double top, bottom; /* the heights that it reaches, in pixels; top > bottom: it reaches none */
} cs_plan_shown;

typedef struct cs_plan {
  cs_stack stack;
  cs_boundary_set boundaries;
  cs_cull cull;
  int32_t width, height; /* pixels */
  int32_t margin;        /* pixels beyond the frame, on all sides, that rows may need */
  celspan_antialias_mode antialias;
  cs_kernel *kernel; /* owned; NULL: rows are not filtered */
  /* The defocused cels: stack.defocused[i] is the grid of defocus[i]. Other plans may own them,
   * too; released by cs_compile_free. */
  CS_ARRAY(struct cs_defocus *, defocus);
  CS_ARRAY(cs_plan_shown, shown); /* from the rear; none in the plan of a drawing */
  size_t defocus_count, shown_count;
  size_t dash_count;    /* in view, of strokes that are not defocused */
  bool stays_on_thread; /* a procedure or a surface in it must be called by the rendering thread */
  bool is_crowded;      /* there were more than allowed: outlines are missing, so it has no rows */
} cs_plan;

/* Frees the contents of a plan, except for its defocused cels. */
void cs_plan_finish(cs_plan *plan, cs_memory *memory);
