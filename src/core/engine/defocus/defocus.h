/* Defocus: a cel, compiled alone onto a grid over the frame, blurred into bands of nodes.
 *
 *       pitch_x                     o  a node, in the middle of a grid cell of pitch_x by pitch_y
 *      |<----->|                       pixels; the first ones lie outside the frame
 *      o       o       o       o
 *          +-------------------    frame
 *      o   |   o       o       o   \
 *          |                       |  a band: the node rows that are made and kept together
 *      o   |   o       o       o   /
 *
 *   cel --two plans: lit from the front (S), lit from behind (T)--> rows of spans on the grid
 *       --one of six ways--> bands of nodes
 *
 *   or: the same on the cel's own grid (own_grid.h) --mixed (regrid.h)--> rows of nodes
 *   or: means over pixels on a grid of its own --read along a shift (shifted.h)--> bands of nodes
 *
 * Between the nodes the blurred cel is linear (engine/sample/defocused.h reads it). The pitch grows
 * with the radius, from one pixel up, so the work falls as the radius grows.
 *
 * Flat art is blurred by its boundaries: through a kernel (kernel/), or under a wide Gaussian line
 * by line (swept_lines.h). Where pictures and gradients vary between the boundaries, samples on a
 * finer grid are summed: sample_sums.h for a Gaussian, slices.h for even kernels. A cel that has a
 * rule of its own (model/scene/nearby.h) is sharpened by sample_sums.h, and changed by
 * neighbours.h.
 */
#pragma once

#include "engine/defocus/bands.h"
#include "engine/defocus/edges.h"
#include "engine/defocus/neighbours.h"
#include "engine/defocus/regrid.h"
#include "engine/defocus/sample_sums.h"
#include "engine/defocus/shifted.h"
#include "engine/defocus/slices.h"
#include "engine/row/row.h"

#include <stddef.h>

typedef enum cs_defocus_way {
  CS_DEFOCUS_KERNEL, /* the rows of the plans are blurred by their kernel */
  CS_DEFOCUS_EDGES,
  CS_DEFOCUS_SUMS,
  CS_DEFOCUS_SLICES,
  CS_DEFOCUS_NEIGHBOURS,
  CS_DEFOCUS_MEANS,  /* the rows of the plans are the nodes, on a grid of a cel's own */
  CS_DEFOCUS_OWN,    /* the nodes are mixed from those of the cel's own grid */
  CS_DEFOCUS_SHIFTED /* the nodes are read from it along a shift */
} cs_defocus_way;

#define CS_DEFOCUS_ROWS_LEAST 8 /* a band has at least as many rows of nodes */
/* Samples in the radius of a Gaussian, at least. */
#define CS_DEFOCUS_SAMPLES 4

typedef struct cs_defocus cs_defocus;
struct cs_defocus {
  /* the number of owners: plans, layers that mix their nodes from it, and the list of a frame;
   * all belong to one thread */
  size_t owners;
  cs_defocused grid; /* the grid that composing reads */
  cs_blur blur;      /* in nodes' widths */
  cs_defocus_way way;
  cs_defocus_edges edges;
  cs_defocus_sums sums;
  cs_defocus_slices slices;
  cs_defocus_neighbours neighbours;
  bool is_fine;     /* there are enough samples for each to be the mean over its area */
  bool is_own;      /* the grid of a cel's own, whose bands are nodes */
  cs_defocus *own;  /* the cel's own grid, where it has one, and how the nodes are mixed from it; */
  cs_regrid regrid; /* there are no plans beside it */
  cs_shifted shifted;
  cs_defocus *by;           /* the grid of what displaces the cel; NULL: nothing */
  cs_plan plans[2];         /* one for each plane; made by engine/defocus/layer.c */
  celspan_object *extended; /* the objects of the plans, continued beyond the frame; NULL: the cel's
                               own objects */
  cs_hash key;
};

/* The layer that a grid is part of. */
static inline const cs_defocus *cs_defocus_of(const cs_defocused *grid) {
  return (const cs_defocus *)(const void *)((const char *)grid - offsetof(cs_defocus, grid));
}

/* The radius of a Gaussian or a disc along an axis, or the extent of a box: how far the blur
 * extends. */
double cs_defocus_radius(const cs_blur *blur, int axis);
double cs_defocus_extent(const cs_blur *blur, int axis);
/* The grid for a blur in pixels over a frame: everything except the way, planes, plans and key.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_create(celspan_context *context, const cs_blur *blur,
                                                 int32_t width, int32_t height, cs_defocus **out);
/* Finds the way of a frame's grid that is not mixed from another. varies: the cel has layers that
 * vary between their boundaries. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_find_way(celspan_context *context, cs_defocus *defocus,
                                                   bool varies);
/* The grid of a cel's own (own_grid.h), of one node for each pixel of its part. samples: in the
 * radius of a Gaussian, at least. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_create_own(celspan_context *context, const cs_blur *blur,
                                                     bool varies, const int32_t size[2],
                                                     double samples, cs_defocus **out);
/* From now on the nodes of a frame's grid are mixed from the cel's own grid, which has the planes
 * of the frame's grid and belongs to it. scale, offset: from pixels of the frame, by axis. */
void cs_defocus_use_own(cs_defocus *defocus, cs_defocus *own, const double scale[2],
                        const double offset[2]);
/* From now on the nodes of a frame's grid are read along a shift, which belongs to it, as do the
 * grids that are read. by: NULL where there is nothing there. */
void cs_defocus_use_shift(cs_defocus *defocus, const cs_shifted *shifted, cs_defocus *own,
                          cs_defocus *by);
/* From now on every pixel between these places of the frame is a node of a grid that is mixed
 * so. */
void cs_defocus_use_pixels(cs_defocus *defocus, const int32_t first[2], const int32_t end[2]);
/* Returns how many pixels of the plans a node is wide. *x, *y: how many pixels the plans have
 * beyond the nodes on each side. */
int32_t cs_defocus_beyond(const cs_defocus *defocus, int32_t *x, int32_t *y);
/* The size of the plans, and the matrix from pixels of the frame to theirs. */
void cs_defocus_raster(const cs_defocus *defocus, int32_t *width, int32_t *height);
celspan_matrix cs_defocus_matrix(const cs_defocus *defocus);
/* The kernel of the plans; NULL: the mean over each pixel. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_kernel(celspan_context *context,
                                                 const cs_defocus *defocus, cs_kernel **out);
/* Frees everything except the plans and the cel's own grid. */
void cs_defocus_free(cs_defocus *defocus, cs_memory *memory);
/* Whether the nodes are made from a plan that stays on its thread. */
static inline bool cs_defocus_stays_on_thread(const cs_defocus *defocus) {
  const cs_defocus *own = defocus->own ? defocus->own : defocus;
  return own->plans[0].stays_on_thread || (defocus->by && defocus->by->plans[0].stays_on_thread);
}
