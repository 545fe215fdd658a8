/* The inputs that feMorphology can take: they have one colour, so that their greatest and least
 * pixels are shapes.
 *
 *     the element or its silhouette --> feOffset, feMorphology --> the same paint
 */
#pragma once

#include "readers/svg/reading.h"
#include "readers/svg/recipe.h"

/* The paint of an input of the next step of a recipe for an element at `place`; false: it may have
 * several. The silhouette of an element with several colours is taken to be opaque. */
bool cs_svg_filter_one_paint(const cs_svg_reading *reading, const cs_svg_node *element,
                             const cs_svg_place *place, const cs_svg_recipe *recipe, size_t number,
                             celspan_paint *out);
