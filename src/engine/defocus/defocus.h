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
 *       --one of four ways--> bands of nodes
 *
 * Between the nodes the blurred cel is linear (engine/sample/defocused.h reads it). The pitch grows
 * with the radius, from one pixel up, so the work falls as the radius grows.
 *
 * Flat art is blurred by its boundaries: through a kernel (kernel/), or under a wide Gaussian line
 * by line (lines.h). Where pictures and gradients vary between the boundaries, samples on a finer
 * grid are summed: sums.h for a Gaussian, slices.h for even kernels.
 */
#pragma once

#include "engine/defocus/bands.h"
#include "engine/defocus/edges.h"
#include "engine/defocus/slices.h"
#include "engine/defocus/sums.h"
#include "engine/row/row.h"

typedef enum cs_defocus_way {
  CS_DEFOCUS_KERNEL, /* the rows of the plans are blurred by their kernel */
  CS_DEFOCUS_EDGES,
  CS_DEFOCUS_SUMS,
  CS_DEFOCUS_SLICES
} cs_defocus_way;

typedef struct cs_defocus {
  cs_defocused grid; /* what composing reads */
  cs_blur blur;      /* in nodes' widths */
  cs_defocus_way way;
  cs_defocus_edges edges;
  cs_defocus_sums sums;
  cs_defocus_slices slices;
  cs_plan plans[2]; /* one a plane; made by engine/defocus/layer.c */
  cs_hash key;
} cs_defocus;

/* The grid for a blur in pixels over a frame: everything except planes, plans and key. varies: the
 * cel has layers that vary between their boundaries. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_create(celspan_context *context, const cs_blur *blur,
                                                 bool varies, int32_t width, int32_t height,
                                                 cs_defocus **out);
/* The size of the plans, and the matrix from pixels of the frame to theirs. */
void cs_defocus_raster(const cs_defocus *defocus, int32_t *width, int32_t *height);
celspan_matrix cs_defocus_matrix(const cs_defocus *defocus);
/* The kernel of the plans; NULL: the mean over each pixel. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_kernel(celspan_context *context,
                                                 const cs_defocus *defocus, cs_kernel **out);
/* Frees everything except the plans. */
void cs_defocus_free(cs_defocus *defocus, cs_memory *memory);
