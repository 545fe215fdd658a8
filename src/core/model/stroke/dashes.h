/* Dashes: the parts of a line that are drawn in turn. They are not stored: a part is found from its
 * number whenever it is needed, so that a million dashes cost no more memory than one.
 *
 *    lengths     |--------|....|--|....|--------|....|--|....|--------|....   drawn, left out
 *    pattern     |<----------------->|<----------------->|
 *    contour         |-------------------------------------->       it begins after the offset
 *    parts           =====      ==      ========      ==            numbered along the line
 *
 * A part lies at lengths of the line, which a ruler turns into parameters of its pieces.
 */
#pragma once

#include "model/stroke/curve.h"

/* ---------------------------------------------------------------- ruler */

/* A line, measured. It remembers the marks of one piece, so every thread needs one of its own. */
typedef struct cs_ruler {
  const cs_outline *line;
  const double *ends; /* for each piece: the length of the line up to its end */
  double pattern;     /* the length of the dashes; 0: there are none */
  size_t marked;      /* the piece to which the marks belong, or SIZE_MAX */
  double marks[CS_CURVE_MARKS + 1];
} cs_ruler;

void cs_ruler_init(cs_ruler *ruler, const cs_outline *line, const double *ends, double pattern);
/* The length of the line up to a piece. */
static inline double cs_ruler_begin(const cs_ruler *ruler, size_t piece) {
  return piece > 0 ? ruler->ends[piece - 1] : 0;
}
/* The part of a contour from one length of the line to another. */
cs_stroke_part cs_ruler_part(cs_ruler *ruler, size_t contour, double from, double to);

/* ---------------------------------------------------------------- making */

/* Sets the pattern. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_dashes_set(celspan_context *context, cs_dashes *dashes,
                                             const celspan_stroke_desc *desc);
/* The part of a run that is not divided. */
cs_stroke_part cs_dashes_whole(const cs_outline *line, const cs_dashes_run *run);
/* Appends a run of a number of parts. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_dashes_append(celspan_context *context, cs_stroke *stroke,
                                                cs_dashes_run run, size_t parts);
/* Divides a contour between two lengths of the line into dashes. is_round: the contour is closed
 * and drawn as a whole, so its last dash may continue in its first. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_dashes_add(celspan_context *context, cs_stroke *stroke,
                                             size_t contour, double from, double to, bool is_round);

/* ---------------------------------------------------------------- reading */

/* Reads the parts of a stroke, in any order. */
typedef struct cs_parts {
  const cs_stroke *stroke;
  cs_ruler ruler;
  size_t run; /* the run of the part that was read last */
} cs_parts;

void cs_parts_init(cs_parts *parts, const cs_stroke *stroke);
/* Part `index`, which is less than stroke->part_count. */
cs_stroke_part cs_parts_get(cs_parts *parts, size_t index);
