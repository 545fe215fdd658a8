/* The field `grade` of groups, cels and rostrums. */
#pragma once

#include "lua/bind/form.h"

/* Makes the grade of a form; NULL: the form has none. Raises. The result is a reference: no error
 * may be raised until it is released. */
celspan_grade *cs_grade_of(const cs_form *form);

#define CS_GRADE_FIELD                                                                             \
  { "grade", CS_OWN("celspan.grade"), .about = "How its colours are changed" }
