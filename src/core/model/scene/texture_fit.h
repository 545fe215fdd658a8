/* Gradients without points, which fit what they paint.
 *
 *   given    in a box from (0, 0) to (1, 1)        fitted    in the box of the primitive
 *             .-------.                                       .-------------.
 *             |\ \ \ \|  1                                    | \   \   \   |  1
 *             | \ \ \ |                                       |   \   \   \ |
 *          0  '-------'                                    0  '-------------'
 *
 * The line of 1/2 towards a corner goes through the two corners beside it.
 *
 * Invariant: no primitive has a texture with a fit. That of a light keeps it, because the size of
 * the film is not known: its units are those of the box from (0, 0) to (1, 1).
 */
#pragma once

#include "model/scene/texture.h"

/* Where *texture has a fit, replaces it by one that fits the box, and releases it. In a box without
 * a size it is its first colour. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_texture_fit(celspan_context *context, celspan_texture **texture,
                                              const celspan_box *box);
/* The matrix from the units of the texture of a light to those of the film. */
celspan_matrix cs_texture_fit_light(const celspan_texture *texture, const celspan_matrix *matrix,
                                    double width, double height);
