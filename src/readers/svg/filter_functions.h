/* The functions of the property `filter` as steps of recipes: the same steps as for the elements of
 * a filter, in the codes of sRGB.
 */
#pragma once

#include "readers/svg/filter_list.h"
#include "readers/svg/reading.h"
#include "readers/svg/recipe.h"

/* Gives a recipe the region and the step of a function for an element at `place`. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_filter_function_make(const cs_svg_reading *reading,
                                                           const cs_svg_filter_call *call,
                                                           const cs_svg_place *place,
                                                           cs_svg_recipe *recipe);
