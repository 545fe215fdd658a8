/* The paint of a shape: one colour, or a gradient or a pattern that it refers to (painted.h). */
#pragma once

#include "readers/svg/draw/painted.h"

/* The paint of a shape by its property fill or stroke. Errors: NO_MEMORY, LIMIT, INPUT. */
CELSPAN_CHECKED celspan_status cs_svg_server_find(cs_svg_reading *reading,
                                                  const cs_svg_paint *paint,
                                                  const cs_svg_style *style,
                                                  const cs_svg_painted *shape, cs_svg_server *out);
