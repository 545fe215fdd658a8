/* Which values of attributes and properties are read: a test by the table of names.h. */
#pragma once

#include "readers/svg/words/names.h"

/* Whether a value contains a part that is only known later: var(). */
bool cs_svg_has_variable(const char *value);
/* is_style: the value is from a style sheet or an attribute `style`. Returns true for numbers that
 * no value may be (cs_svg_is_unfit) and for values with variables: they are checked elsewhere. */
bool cs_svg_value_is_read(cs_svg_name name, const char *value, bool is_style);
