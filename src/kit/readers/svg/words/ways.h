/* Lines measured by their length, along which letters and whole elements are placed. */
#pragma once

#include "inside/geometry.h"

/* All zero is a line of no length. */
typedef struct cs_svg_way {
  cs_outline outline;
  double *lengths; /* for each piece: the length of all pieces before it */
  double length;   /* the length of all */
} cs_svg_way;

/* Measures way->outline. *way must be finished, also after a failure. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_way_measure(celspan_context *context, cs_svg_way *way);
void cs_svg_way_finish(cs_svg_way *way, cs_memory *memory);

/* The point at a distance 0 .. length from the beginning of the line, and the direction of the line
 * there in degrees. The line has a length. */
celspan_point cs_svg_way_at(const cs_svg_way *way, double distance, double *degrees);
