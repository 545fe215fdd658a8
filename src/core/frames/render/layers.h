/* Layers of a plan: each is a primitive in its place, with what it paints.
 *
 *   primitive, matrix ---> layer: kind, paint or index     engine/compose/layer.h
 *                     ---> shade, image or procedure       by its kind
 *                     ---> boundaries, in frame pixels     model/geometry/boundary.h
 */
#pragma once

#include "frames/render/compiler.h"

/* A clear layer that is present nowhere, of the compiler's group and front light. Errors:
 * NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_layers_append(cs_compiler *c, double fade, celspan_rule rule,
                                                uint32_t *index);
/* Lights a flat paint, faded, by the layer's front light. */
void cs_layers_fill_flat(cs_layer *layer, cs_paint paint, float fade);

/* A texture in its place. */
typedef struct cs_layers_texture {
  const celspan_texture *texture;
  celspan_box bounds;        /* the bounds of the primitive: where a picture without a box lies */
  bool ends_at_bounds;       /* the layer ends there by a boundary, not by the end of the picture */
  celspan_matrix inverse;    /* frame pixels to its units */
  cs_boundary_frame visible; /* pixels: the layer is present nowhere else */
} cs_layers_texture;

/* Fills a layer by its texture. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_layers_fill(cs_compiler *c, cs_layer *layer,
                                              const cs_layers_texture *place);
/* Makes the layer present inside an outline. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_layers_add_outline(cs_compiler *c, const cs_outline *outline,
                                                     const celspan_box *bounds,
                                                     const celspan_matrix *matrix, uint32_t index);
/* A primitive: an outline or a procedure. Errors: NO_MEMORY, LIMIT, BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_layers_add(cs_compiler *c, const cs_primitive_data *data,
                                             double fade, const celspan_matrix *matrix);
