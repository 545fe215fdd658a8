/* The values that --set and --set-from give to the parameters of a script (celspan.parameters).
 *
 *   options --> settings --> registry of the script's state --> lua/celspan/film/parameters.lua
 *                                                                    |
 *   wrong usage, reported <-- the sentence that refuses a setting <--+
 */
#pragma once

#include <lua.h>

#include "base/hash.h"
#include "program/request.h"

typedef struct cs_settings {
  const cs_request *request; /* borrowed */
  const char *path;          /* of --set-from; NULL: it was not given */
  char *json;                /* its text; owned */
  size_t size, capacity;
} cs_settings;

/* Reads the file of --set-from, before the script's rules forbid that. OK, or reported; either way
 * *out may be closed. */
cs_exit cs_settings_open(celspan_context *context, const cs_request *request, cs_settings *out);
void cs_settings_close(celspan_context *context, cs_settings *settings);
/* Of all that the script is given: its arguments, and the values of its parameters. */
cs_hash cs_settings_hash(const cs_settings *settings);
/* Puts them into the registry of a state that has celspan. Raises. */
void cs_settings_give(lua_State *L, const cs_settings *settings);
/* After the script: wrong usage, reported, where a setting was refused; or where no parameters were
 * declared, if the script came to its end, because its own error says more; else OK. Never raises.
 */
cs_exit cs_settings_outcome(lua_State *L, bool has_ended);
