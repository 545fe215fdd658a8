/* The field `grade` of groups, cels and rostrums. */
#pragma once

#include "lua/bind/form.h"

/* The grade of a form, made; NULL: it has none. Raises. A reference: nothing may raise until it is
 * dropped. */
celspan_grade *cs_grade_of(const cs_form *form);

#define CS_GRADE_FIELD                                                                             \
  { "grade", CS_OWN("celspan.grade"), .about = "How its colours are changed" }
