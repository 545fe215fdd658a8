/* Which elements are shown at their place in the file. */
#pragma once

#include "readers/svg/document/document.h"

/* false: the element draws nothing by itself, or is for other readers. sizes: the `use` that shows
 * it, without which a symbol is not shown; NULL: none. */
bool cs_svg_is_shown(const cs_svg_node *node, const cs_svg_node *sizes);
/* The child that a `switch` shows; NULL: none. */
const cs_svg_node *cs_svg_shown_choice(const cs_svg_node *node);
