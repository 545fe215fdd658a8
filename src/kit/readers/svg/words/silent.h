/* Names that may be in a document and change nothing in the drawing.
 *
 * Invariant: no name of names.h is in this list, which is sorted as strcmp sorts texts.
 */
#pragma once

#include <stdbool.h>

/* Whether an attribute or a property that names.h does not list has no effect on the drawing, with
 * any value or with this value. */
bool cs_svg_name_is_silent(const char *text, const char *value);
