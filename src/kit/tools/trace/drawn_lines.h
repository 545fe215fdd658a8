/* Drawn lines as strokes: where their middle runs, and how wide they are.
 *
 *      #########                 thinned to one pixel, then at each place the width and the middle
 *      ####..####                of what lies across it, by the shares of the mixed pixels too
 *         ########  --> strokes
 *            ####                from end to end or fork to fork; splines through few points, with
 *                                a width at each
 *
 * INVARIANT: the ground, the colour that most of the picture's rim has, is not drawn; every other
 * region is, each part of it once.
 */
#pragma once

#include "celspan/trace.h"
#include "tools/trace/regions.h"
#include "tools/trace/result.h"

/* Adds a stroke for each line, the longest first. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_lines_make(celspan_context *context, const cs_material *material,
                                             const cs_regions *regions, double smooth,
                                             celspan_trace *out);
/* The description that draws such a shape, without a texture. */
celspan_stroke_desc cs_lines_stroke(const cs_shape *shape);
