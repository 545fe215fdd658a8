/* Filters: from elements of the file and functions of CSS to recipes for the element that names
 * them.
 *
 * A list of filters with anything that recipes cannot do is left out as a whole; the note names the
 * line of the filter. Source: Filter Effects Module Level 1.
 */
#pragma once

#include "readers/svg/document/reading.h"
#include "readers/svg/document/recipe.h"
#include "readers/svg/words/filter_list.h"

/* The filters of an element at `place`, whose style has some. *out: new; NULL: the element is drawn
 * without filters. Errors: NO_MEMORY, LIMIT, INPUT. */
CELSPAN_CHECKED celspan_status cs_svg_filter_make(cs_svg_reading *reading, const cs_svg_node *node,
                                                  const cs_svg_place *place, cs_svg_recipe **out);

/* Gives a recipe the region and the step of a function of the property `filter` for an element at
 * `place`: the same steps as for the elements of a filter, in the codes of sRGB. Errors: NO_MEMORY.
 */
CELSPAN_CHECKED celspan_status cs_svg_filter_function_make(const cs_svg_reading *reading,
                                                           const cs_svg_filter_call *call,
                                                           const cs_svg_place *place,
                                                           cs_svg_recipe *recipe);
