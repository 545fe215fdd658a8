/* Which values of attributes and properties are read: a test by the table of names.h. */
#pragma once

#include "readers/svg/names.h"

/* Whether a value contains a part that is only known later: var(). */
bool cs_svg_has_variable(const char *value);
/* is_style: the value is of a style sheet or of an attribute `style`. Numbers that no value may be
 * (cs_svg_is_unfit) and values with variables are not judged here: true. */
bool cs_svg_value_is_read(cs_svg_name name, const char *value, bool is_style);
