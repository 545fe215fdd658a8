/* Outlines of the basic shapes and of paths, in the user units of their element; rectangles. */
#pragma once

#include "inside/geometry.h"
#include "readers/svg/document/document.h"
#include "readers/svg/words/values.h"

/* The length in an attribute, in user units; `fallback` if it is missing or does not count. Errors:
 * INPUT for an unfit number. */
CELSPAN_CHECKED celspan_status cs_svg_length_of(celspan_context *context, const cs_svg_node *node,
                                                cs_svg_name name, cs_svg_axis axis,
                                                const cs_svg_measure *measure,
                                                cs_svg_length fallback, double *out);
/* The same for an attribute that is a number in user units, 0 by default. */
CELSPAN_CHECKED celspan_status cs_svg_number_of(celspan_context *context, const cs_svg_node *node,
                                                cs_svg_name name, cs_svg_axis axis,
                                                const cs_svg_measure *measure, double *out);

/* The attribute refX or refY: a length, or a word for a place in the view box that begins at `from`
 * and has the size of `measure`; 0 by default. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_svg_reference_of(celspan_context *context,
                                                   const cs_svg_node *node, cs_svg_axis axis,
                                                   const cs_svg_measure *measure, double from,
                                                   double *out);

/* Whether the element is a path or a basic shape. */
bool cs_svg_is_shape(const cs_svg_node *node);
/* Appends the element's outline, all of whose contours are closed: nothing for a shape without a
 * size. *is_broken: the data have an error, and the outline ends before it. Errors: NO_MEMORY,
 * LIMIT, INPUT for numbers that are unfit. */
CELSPAN_CHECKED celspan_status cs_svg_shape_outline(celspan_context *context,
                                                    const cs_svg_node *node,
                                                    const cs_svg_measure *measure,
                                                    cs_outline *outline, bool *is_broken);

/* An outline as a line. */
typedef struct cs_svg_line {
  cs_outline outline;
  cs_outline_closed closed;
  bool is_broken; /* as above */
} cs_svg_line;

/* The element's line: its subpaths are open if they are open in the file. finish frees it, also
 * after an error. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_svg_line_init(celspan_context *context, const cs_svg_node *node,
                                                const cs_svg_measure *measure, cs_svg_line *line);
void cs_svg_line_finish(cs_svg_line *line, celspan_context *context);
/* Converts an outline to other units by an affine matrix; false if its numbers would be too
 * large. */
bool cs_svg_outline_map(cs_outline *outline, const celspan_matrix *matrix);

/* A rectangle in user units as an object; matrix: from user units to the drawing's. */
CELSPAN_CHECKED celspan_status cs_svg_rectangle(celspan_context *context, const celspan_box *box,
                                                const celspan_matrix *matrix, celspan_object **out);
/* The box around a box under an affine matrix. */
celspan_box cs_svg_box_mapped(const celspan_box *box, const celspan_matrix *matrix);
/* From shares of a box to user units. */
celspan_matrix cs_svg_box_matrix(const celspan_box *box);
