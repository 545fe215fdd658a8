/* The contours of one primitive, as path operators read and write them.
 *
 *   a shape     *-----*        every contour is closed; new contours are closed by a line
 *                \   /
 *                 `*'
 *   a stroke    *-----*  *     what is drawn of its centre line, without dashes; `closed` says
 *                       /      which contours return to their beginning
 *                 *----'
 */
#pragma once

#include "model/geometry/bezier.h"
#include "model/stroke/stroke.h"

typedef struct cs_lines {
  cs_outline outline;
  cs_outline_closed closed; /* the closed lines of a stroke */
  bool is_filled;
} cs_lines;

void cs_lines_init(cs_lines *lines, bool is_filled);
void cs_lines_finish(cs_lines *lines, cs_memory *memory);
/* The drawn parts of a stroke. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_lines_of_stroke(celspan_context *context, const cs_stroke *stroke,
                                                  cs_lines *out);

/* A contour that is read: the pieces [begin, end). */
typedef struct cs_lines_contour {
  size_t begin, end;
  bool is_closed;
} cs_lines_contour;
/* closed_at: how many closed contours come before; it is counted on. */
cs_lines_contour cs_lines_contour_at(const cs_lines *lines, size_t contour, size_t *closed_at);

/* Writing a contour: its beginning, its pieces, its end. All: Errors NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_lines_begin(celspan_context *context, cs_lines *lines,
                                              cs_hpoint at);
/* A piece after its first point, where the contour ends. */
CELSPAN_CHECKED celspan_status cs_lines_add(celspan_context *context, cs_lines *lines,
                                            const cs_bezier *piece);
CELSPAN_CHECKED celspan_status cs_lines_end(celspan_context *context, cs_lines *lines,
                                            bool is_closed);

/* Piece `i`, whole. */
void cs_lines_load(const cs_lines *lines, size_t i, cs_bezier *out);
