/* Compiling: a rostrum and a frame size become a shot, the flat form that scans read.
 *
 *   rostrum --walk, rear to front--> leaves, groups, trees, back lights (compose/stack.h)
 *                                  + chains of boundaries in frame pixels (geometry/boundary.h)
 *
 * The shot borrows textures, pictures and procedures of the rostrum, which must outlive it.
 */
#ifndef CS_RENDER_COMPILE_H
#define CS_RENDER_COMPILE_H

#include "row/row.h"

/* What of a film is looked at: its size in units, the frame's in pixels, and the rows that will be
 * asked for. Outlines wholly above or below those are left out, which changes no bit of them. */
typedef struct cs_view {
  double film_width, film_height;
  int32_t width, height;
  int32_t first_row, end_row;
} cs_view;

/* workers: threads at most. Errors: NO_MEMORY; LIMIT; BAD_ARGUMENT for a singular viewport or
 * camera, for a rotated scan-line primitive and for what is not built in, naming the cel. */
CELSPAN_CHECKED celspan_status cs_compile(celspan_context *context, const celspan_rostrum *rostrum,
                                          const cs_view *view, const cs_antialias *antialias,
                                          int workers, cs_plan *out);
/* One cel alone, without opacity, onto a raster of its own: `matrix` takes its units there. Lit
 * from the front alone, or (is_through) from behind alone, by white light. kernel: taken over;
 * NULL: the mean over each pixel. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_compile_cel(celspan_context *context, const celspan_cel *cel,
                                              size_t cel_index, const celspan_matrix *matrix,
                                              int32_t width, int32_t height, bool is_through,
                                              cs_kernel *kernel, cs_plan *out);
void cs_compile_free(cs_plan *plan, cs_memory *memory);

#endif
