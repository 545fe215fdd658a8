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
#ifndef CS_FILTER_SOFTEN_H
#define CS_FILTER_SOFTEN_H

#include "filter/scan.h"
#include "filter/soft_bands.h"
#include "filter/soft_edges.h"
#include "filter/soft_slices.h"
#include "filter/soft_sums.h"

typedef enum cs_soften_way {
  CS_SOFTEN_KERNEL, /* the shots' own */
  CS_SOFTEN_EDGES,
  CS_SOFTEN_SUMS,
  CS_SOFTEN_SLICES
} cs_soften_way;

typedef struct cs_soften {
  cs_soft soft;         /* first: what composing sees */
  cs_softness softness; /* in cells */
  cs_soften_way way;
  cs_soft_edges edges;
  cs_soft_sums sums;
  cs_soft_slices slices;
  cs_shot shots[2]; /* one a plane; made by render/compile.c */
  cs_hash key;
} cs_soften;

/* The grid for a softness in pixels over a frame: everything but planes, shots and key. varies: the
 * cel holds layers that vary between their boundaries.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_soften_create(celspan_context *context,
                                                const cs_softness *softness, bool varies,
                                                int32_t width, int32_t height, cs_soften **out);
/* Frame pixels to the pixels of the shots, and their size. */
void cs_soften_raster(const cs_soften *soften, int32_t *width, int32_t *height);
celspan_matrix cs_soften_matrix(const cs_soften *soften);
/* The kernel of the shots; NULL: means. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_soften_kernel(celspan_context *context, const cs_soften *soften,
                                                cs_kernel **out);
/* Frees everything but the shots. */
void cs_soften_free(cs_soften *soften, cs_memory *memory);

#endif
