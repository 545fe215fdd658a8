/* The values that a host gives to the parameters of a script, and what the script declares, in the
 * table `settings` that lua/celspan/film/parameters.lua describes.
 *
 *   --set, celspan_lua_set --cs_parameters_give--> settings <--declared-- celspan.parameters
 *                                                     |
 *               the sentence that refuses a value <---+---> celspan_lua_parameter, celspan info
 */
#pragma once

#include <lua.h>

#include "celspan/film.h"

/* () -> the settings of this state */
int cs_parameters_settings(lua_State *L);

/* Gives a value. source: the beginning of messages about it. Raises. */
void cs_parameters_give(lua_State *L, const char *source, const char *name, size_t length,
                        const char *text);
/* Gives the values of a JSON object, which was read from a file. Raises. */
void cs_parameters_give_json(lua_State *L, const char *path, const char *json, size_t size);

/* Called before a script runs: the declarations of an earlier script are forgotten. Raises. */
void cs_parameters_begin(lua_State *L);
/* Called after the script: the values are forgotten. BAD_ARGUMENT, with the sentence in the
 * context, if a value was refused, or if no parameters were declared and the script came to its end
 * (otherwise its own error says more). Errors: also NO_MEMORY. Never raises. */
CELSPAN_CHECKED celspan_status cs_parameters_end(lua_State *L, bool has_ended);
/* Whether a value was refused. Never raises. */
bool cs_parameters_are_refused(lua_State *L);
