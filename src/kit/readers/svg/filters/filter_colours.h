/* Filters of colours, feColorMatrix and feComponentTransfer, as grades.
 *
 *     colour, not premultiplied --> matrix or curves --> clamped to 0..1
 *     alpha ----------------------> times a share, or a function of its own
 *
 * A grade does not change how much light passes. Where alpha is not just multiplied by 0..1, a rule
 * (model/scene/nearby.h) changes each pixel. Alpha that depends on colours, and colours that depend
 * on alpha, are not read.
 */
#pragma once

#include "readers/svg/document/reading.h"
#include "readers/svg/document/recipe.h"

/* Fills in the step of an element of one of the two kinds. *reason: why it cannot be read, for a
 * note; NULL: it was read. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_colour_matrix_read(cs_svg_reading *reading,
                                                         const cs_svg_node *node, cs_svg_step *step,
                                                         const char **reason);
CELSPAN_CHECKED celspan_status cs_svg_transfer_read(cs_svg_reading *reading,
                                                    const cs_svg_node *node, cs_svg_step *step,
                                                    const char **reason);

/* Fills in the product of two inputs of a step; one of them is a flood. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_product_read(const cs_svg_reading *reading,
                                                   const cs_svg_recipe *recipe, cs_svg_step *step,
                                                   const char **reason);

/* Fills in a rotation of all hues. */
void cs_svg_hue_set(celspan_grade_desc *desc, double degrees);
/* The grade of a matrix, clamped to 0..1. *out: new. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_clamped_grade(const cs_svg_reading *reading,
                                                    celspan_grade_desc *desc, celspan_grade **out);

/* The value of an attribute that is one number; `fallback` for any other. */
double cs_svg_filter_number(const cs_svg_node *node, cs_svg_name name, double fallback);
/* The numbers of an attribute, up to `most` of them. Returns their number, or 0 if the attribute
 * contains anything else. */
size_t cs_svg_filter_numbers(const cs_svg_node *node, cs_svg_name name, double *out, size_t most);
