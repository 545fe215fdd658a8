/* A film and its frames as Lua of celspan's own sees them: the facts of the film in a table, and a
 * frame as a list of its exposures. */
#pragma once

#include <lua.h>

#include "inside/films.h"

/* Sets the facts of a film in the table on top of the stack: size { w, h }, fps, first, frames,
 * poster, has_poster (whether the film says it), title, space, has_sound, and marks, a list
 * { { name =, frame = }, ... } in the order of the frames. Raises. */
void cs_film_table_put(lua_State *L, const cs_film_info *info);
/* Pushes { { rostrum, weight }, ... }. The state may be another than that which built them. Raises.
 * Returns 1. */
int cs_film_table_push_frame(lua_State *L, const celspan_exposure *exposures, size_t count);
/* Pushes 16 bytes, equal for equal scenes; returns 0 if a procedure draws, otherwise 1. Raises. */
int cs_film_table_push_scene(lua_State *L, const celspan_exposure *exposures, size_t count);
