/* Viewports: where a nested svg element or a symbol is shown, and the units of its contents.
 *
 *     x, y +-----------------+      the viewport, in the units at the element's place in the file;
 *          |  +-----------+  |      the view box is fitted into it, and has the units of its
 *          |  | view box  |  | h    contents
 *          |  +-----------+  |
 *          +-----------------+
 *                   w
 */
#pragma once

#include "readers/svg/document/reading.h"

/* Finds the viewport of `node`, and moves *place so that the point (refX, refY) of a symbol lies
 * where its corner would be. sizes: the element whose width and height replace those of the node;
 * NULL: none. If *out has no size, nothing is shown. Errors: INPUT for unfit numbers. */
CELSPAN_CHECKED celspan_status cs_svg_viewport_find(cs_svg_reading *reading,
                                                    const cs_svg_node *node,
                                                    const cs_svg_node *sizes, cs_svg_place *place,
                                                    celspan_box *out);
/* Moves *place into the viewport, to the units of its contents. */
void cs_svg_viewport_enter(const cs_svg_node *node, const celspan_box *viewport,
                           cs_svg_place *place);
/* Moves *place into a viewport at (0, 0) of this size that shows a view box. Returns the shown
 * part. view_box, aspect: values of their attributes; NULL: not given. */
celspan_box cs_svg_viewport_fit(const char *view_box, const char *aspect, double width,
                                double height, cs_svg_place *place);
