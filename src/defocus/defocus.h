/* Softening: a cel, compiled alone onto a grid, filtered into bands of nodes.
 *
 *   cel --two shots: lit from the front (S), lit from behind (T)--> rows of spans on the grid
 *       --one of four ways--> bands of nodes
 *
 * Flat art goes by its boundaries, through a kernel (traces.c) or, under a wide Gaussian, line by
 * line (soft_edges.h). Where pictures and gradients lie between the boundaries, cells are summed:
 * soft_sums.h for a Gaussian, soft_slices.h for even kernels.
 *
 * The grid's pitch follows the radius, from one pixel up, so the work falls as the radius grows.
 */
#ifndef CS_DEFOCUS_DEFOCUS_H
#define CS_DEFOCUS_DEFOCUS_H

#include "defocus/bands.h"
#include "defocus/edges.h"
#include "defocus/slices.h"
#include "defocus/sums.h"
#include "row/row.h"

typedef enum cs_defocus_way {
  CS_DEFOCUS_KERNEL, /* the shots' own */
  CS_DEFOCUS_EDGES,
  CS_DEFOCUS_SUMS,
  CS_DEFOCUS_SLICES
} cs_defocus_way;

typedef struct cs_defocus {
  cs_defocused grid; /* first: what composing sees */
  cs_blur blur;      /* in cells */
  cs_defocus_way way;
  cs_defocus_edges edges;
  cs_defocus_sums sums;
  cs_defocus_slices slices;
  cs_plan plans[2]; /* one a plane; made by render/compile.c */
  cs_hash key;
} cs_defocus;

/* The grid for a blur in pixels over a frame: everything but planes, shots and key. varies: the
 * cel holds layers that vary between their boundaries.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_create(celspan_context *context, const cs_blur *blur,
                                                 bool varies, int32_t width, int32_t height,
                                                 cs_defocus **out);
/* Frame pixels to the pixels of the shots, and their size. */
void cs_defocus_raster(const cs_defocus *defocus, int32_t *width, int32_t *height);
celspan_matrix cs_defocus_matrix(const cs_defocus *defocus);
/* The kernel of the shots; NULL: means. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_kernel(celspan_context *context,
                                                 const cs_defocus *defocus, cs_kernel **out);
/* Frees everything but the shots. */
void cs_defocus_free(cs_defocus *defocus, cs_memory *memory);

#endif
