/* Filters whose pixels depend on those around them, as rules (model/scene/nearby.h):
 * feConvolveMatrix, feDiffuseLighting and feSpecularLighting; and functions of alpha.
 *
 * Source: Filter Effects Module Level 1, 9.7, 9.9, 9.12 to 9.15 and 9.20. `kernelUnitLength` has no
 * effect, as in browsers: a pixel is a unit of the element.
 */
#pragma once

#include "inside/scene.h"
#include "readers/svg/document/style.h"
#include "readers/svg/filters/filter_colours.h"

/* The units of a filter's numbers. */
typedef struct cs_svg_filter_units {
  bool is_in_shares;      /* lengths are shares of the element's box, else user units */
  const celspan_box *box; /* the box of the element */
} cs_svg_filter_units;

/* Both fill in the step of an element of these kinds, whose box and space are known. *reason: as in
 * filter_colours.h. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_weights_read(const cs_svg_reading *reading,
                                                   const cs_svg_node *node, cs_svg_step *step,
                                                   const char **reason);
CELSPAN_CHECKED celspan_status cs_svg_lighting_read(const cs_svg_reading *reading,
                                                    const cs_svg_node *node,
                                                    const cs_svg_style *style,
                                                    const cs_svg_filter_units *units,
                                                    cs_svg_step *step, const char **reason);
