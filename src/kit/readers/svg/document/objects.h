/* Objects that are put in the place of others: items, and the steps of filters. An object that is
 * NULL draws nothing. */
#pragma once

#include "inside/context.h"

/* Releases *object and puts `made` in its place, or NULL where `status` is a failure. Returns
 * status. */
celspan_status cs_svg_object_replace(celspan_status status, celspan_object *made,
                                     celspan_object **object);
/* Both functions take over *object; *object is NULL after a failure. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_svg_object_move(celspan_context *context,
                                                  const celspan_matrix *matrix,
                                                  celspan_object **object);
/* radius: along x and along y; one of them is above 0. */
CELSPAN_CHECKED celspan_status cs_svg_object_blur(celspan_context *context,
                                                  const celspan_point *radius,
                                                  celspan_defocus_kernel kernel,
                                                  celspan_object **object);

/* *out: new; NULL: nothing. Errors: NO_MEMORY, LIMIT. */

/* `art` where `by` is present, or where it is not. */
CELSPAN_CHECKED celspan_status cs_svg_object_mask(celspan_context *context, celspan_object *art,
                                                  celspan_object *by, bool inverts,
                                                  celspan_object **out);
CELSPAN_CHECKED celspan_status cs_svg_object_fill(celspan_context *context, const celspan_box *box,
                                                  celspan_texture *texture, celspan_object **out);
CELSPAN_CHECKED celspan_status cs_svg_object_flood(celspan_context *context, const celspan_box *box,
                                                   const celspan_paint *paint,
                                                   celspan_object **out);
/* The shape of an object in one paint. */
CELSPAN_CHECKED celspan_status cs_svg_object_silhouette(celspan_context *context,
                                                        celspan_object *object,
                                                        const celspan_paint *paint,
                                                        celspan_object **out);
