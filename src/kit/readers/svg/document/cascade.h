/* The value that wins for each property of an element:
 *
 *   attribute  <  rule, by weight and order  <  style="..."  <  animation  <  rules and style with
 *   !important
 *
 * with the values of variables in the place of var().
 */
#pragma once

#include "readers/svg/document/document.h"

typedef struct cs_svg_cascade {
  const char *values[CS_SVG_NAME_COUNT]; /* NULL: no value is given */
  const cs_svg_variable *variables;      /* the variables of the element */
} cs_svg_cascade;

/* inherited: the variables of the element's parent. tests: how many tests of selectors are left;
 * counted down. Errors: NO_MEMORY; LIMIT when these tests are used up, or variables take too much
 * memory. */
CELSPAN_CHECKED celspan_status cs_svg_cascade_collect(celspan_context *context,
                                                      cs_svg_document *document,
                                                      const cs_svg_node *node,
                                                      const cs_svg_variable *inherited,
                                                      uint64_t *tests, cs_svg_cascade *out);

/* Places and sizes that styles give: writes x, y, cx, cy, width, height, r, rx, ry and d into the
 * attributes of the elements that have such a property, so that all other code reads only
 * attributes. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_svg_cascade_geometry(celspan_context *context,
                                                       cs_svg_document *document, uint64_t *tests);
