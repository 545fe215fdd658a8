/* The triangles of a mesh as objects. */
#pragma once

#include "model/warp/mesh.h"

/* *out: the union of all triangles, new, each with the texture where the map takes it. texture:
 * placed by a matrix in the units around the object; box: where a picture without a box lies, in
 * its own units. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_CHECKED celspan_status cs_warp_pieces(celspan_context *context, const cs_warp_mesh *mesh,
                                              celspan_texture *texture, const celspan_box *box,
                                              const celspan_matrix *matrix, celspan_object **out);
