/* Functions that hosts call for values on their stack (celspan/lua.h). */
#pragma once

#include <lua.h>

#include "celspan/film.h"
#include "inside/films.h"

/* Calls function(value at index, user as light userdata) in protected mode. On success `results`
 * values are left on the stack; otherwise the sentence is in the context. Errors: BAD_ARGUMENT if
 * the function raises an error, and in a state without celspan; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_visit(lua_State *L, int index, lua_CFunction function, void *user,
                                        int results);
/* The film or rostrum at index as a film, which is pushed. Errors: the same. */
CELSPAN_CHECKED celspan_status cs_visit_film(lua_State *L, int index, cs_film_info *out);
