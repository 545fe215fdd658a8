/* Compiling: a rostrum and a frame size become a plan, the flat form that rows are made from.
 *
 *  camera                                     layer 3   a primitive of the front cel
 *    |     cel 2  ====  objects, trees        layer 2   a primitive of the front cel
 *    |     cel 1  ====  one object            back light, shining on everything above it
 *    v     cel 0  ====  defocused             layer 1   a primitive of cel 1
 *  rear light                                 layer 0   the whole of cel 0 (engine/defocus/layer.h)
 *
 *   rostrum --walk from the rear to the front--> layers, groups, trees, back lights, in order
 *                                                (engine/compose/stack.h)
 *                                              + chains of boundaries in frame pixels
 *                                                (model/geometry/boundary.h)
 *
 * The plan borrows textures, pictures and procedures of the rostrum, which must outlive it.
 *
 * A defocused cel is compiled by this compiler too, alone and onto a raster of its own: it is given
 * to engine/defocus/layer.h as a callback. A cel that is compiled alone is compiled without its
 * blur.
 */
#pragma once

#include "engine/row/plan.h"
#include "model/scene/scene.h"

#define CS_COMPILE_DASHES 4096 /* the most that are compiled together if none share a pixel */

/* The view of a film: its size in units, the frame's size in pixels, and the rows and columns that
 * will be asked for. Outlines wholly above or below those rows are left out, and strokes wholly
 * left or right of those columns, which changes no bit of what is asked for. */
typedef struct cs_view {
  double film_width, film_height;
  int32_t width, height;
  int32_t first_row, end_row, first_column, end_column;
  size_t most_dashes;       /* in view; with more, the plan is crowded (engine/row/plan.h) */
  float span_error;         /* see engine/compose/stack.h */
  celspan_space space;      /* the space of the rows */
  celspan_space film_space; /* for a rostrum without one; AROUND: the space of the rows */
  /* For planes: what places are multiples of, in pixels, across and down. Curves are kept
   * (model/geometry/boundary.h), and objects lie at multiples of it, so that their curves are the
   * same wherever the objects have been moved. 0: curves are not kept, and objects lie anywhere. */
  celspan_point unit;
  const size_t *cel_numbers; /* the numbers of the cels in messages; NULL: from 1 */
  size_t pieces, points;     /* about how many the outlines of a drawing have; 0: not known */
} cs_view;

/* workers: threads at most. Errors: NO_MEMORY; LIMIT; BAD_ARGUMENT for a singular viewport or
 * camera and for a rotated scan-line primitive, naming the cel. */
CELSPAN_CHECKED celspan_status cs_compile(celspan_context *context, const celspan_rostrum *rostrum,
                                          const cs_view *view, const cs_antialias *antialias,
                                          int workers, cs_plan *out);
/* The drawing of a cel alone, without its transform, its opacity, and its blur, in white light,
 * onto a raster, of which `view` has the size in pixels, the rows and columns that are asked for,
 * the space and the most dashes. number: of the cel, for messages. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_compile_drawing(celspan_context *context, const celspan_cel *cel,
                                                  size_t number, const celspan_matrix *matrix,
                                                  const cs_view *view, cs_plan *out);
void cs_compile_free(cs_plan *plan, cs_memory *memory);
