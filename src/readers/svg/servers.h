/* Gradients and patterns: from an element of the file to a texture for one shape.
 *
 *      gradient's own units --gradientTransform--> --objectBoundingBox--> user units of the shape
 *
 * The texture stays in the gradient's own units, where a circle is a circle; so the shape is
 * brought there and taken back as an object. SVG interpolates colours as they are coded and with
 * straight alpha; stops are added until what lies between two of them differs from that by less
 * than 1/255.
 */
#pragma once

#include "readers/svg/painted.h"

#define CS_SVG_STOPS 4096 /* of one texture */

/* The paint of a shape by its property fill or stroke. Errors: NO_MEMORY, LIMIT, INPUT. */
CELSPAN_CHECKED celspan_status cs_svg_server_find(cs_svg_reading *reading,
                                                  const cs_svg_paint *paint,
                                                  const cs_svg_style *style,
                                                  const cs_svg_painted *shape, cs_svg_server *out);
