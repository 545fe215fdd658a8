/* The sounds that are heard in a film, as one flat list, for hosts and for the program's mix.
 *
 *   film --lua/celspan/film/soundtrack.lua--> a flat list in Lua --> cs_mix_sound[]
 */
#pragma once

#include <lua.h>

#include "plugins/sound/mix.h"

typedef struct cs_heard {
  const cs_mix_sound *sounds;
  size_t count;
} cs_heard;

/* Pushes the sounds of the film or rostrum at index as one value, as celspan_lua_sounds of
 * celspan/lua.h does; *out points into it. */
CELSPAN_CHECKED celspan_status cs_heard_push(lua_State *L, int index, cs_heard *out);
