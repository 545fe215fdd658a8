/* Names of values, and the lines of scripts where they were made.
 *
 * While a constructor runs, the context knows the line of the script that called it: of the
 * innermost function that is not one of celspan's own. A method such as :rotate needs no line,
 * because the core keeps that of the value it changes; :with takes it over here.
 */
#pragma once

#include "lua/bind/userdata.h"

/* Sets the line that the context gives to the values made from now on: that of the caller. */
void cs_named_begin(lua_State *L, celspan_context *context);
/* The same, with the line where `value` was made. */
void cs_named_begin_as(celspan_context *context, const cs_userdata *value);
void cs_named_end(celspan_context *context);

/* Gives `value`, new and not shared yet, the name of `from`, if it has one. */
void cs_named_copy(lua_State *L, const cs_userdata *from, cs_userdata *value);
/* v:named("hand") */
int cs_named_method(lua_State *L);
