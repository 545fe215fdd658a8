/* Softening: a cel, compiled alone onto a grid, filtered into bands of nodes.
 *
 *   cel --two shots: lit from the front (S), lit from behind (T)--> rows of spans on the grid
 *       --the kernel over their boundaries (traces.c), or a Gaussian over their cells--> bands
 *
 * The grid's pitch follows the radius, from one pixel up, so the work falls as the radius grows; a
 * Gaussian of some cells is applied to the cells, its variance lessened by theirs. Where it is but
 * a few cells wide, means would show where in its cell an edge lies (an error of 0.02/sigma^2);
 * tents do not (below 0.001 from sigma 1.5 on).
 *
 * Stretches in which the rows are one colour are not summed.
 */
#ifndef CS_FILTER_SOFTEN_H
#define CS_FILTER_SOFTEN_H

#include "filter/scan.h"
#include "filter/soft_bands.h"
#include "filter/soft_slices.h"

typedef struct cs_soften {
  cs_soft soft;         /* first: what composing sees */
  cs_softness softness; /* in cells */
  bool is_summed;       /* a Gaussian over cells; else through the shots' kernel */
  bool has_tents; /* is_summed: the cells are not means, but seen through tents two cells wide */
  int32_t reach_x, reach_y; /* is_summed: cells, and the shots' frames are wider by as many */
  float *weights[2];        /* is_summed: by distance, reach_x + 1 and reach_y + 1 of them */
  bool is_sliced;           /* an even kernel over cells */
  cs_soft_slices slices;    /* is_sliced */
  cs_shot shots[2];         /* one a plane; made by render/compile.c */
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
