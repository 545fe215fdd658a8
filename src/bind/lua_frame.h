/* The `f` that frame functions are given. */
#ifndef CS_BIND_LUA_FRAME_H
#define CS_BIND_LUA_FRAME_H

#include <lua.h>

#include "film/film.h"

/* Registers the kind. */
void cs_lua_frame_register(lua_State *L);
/* Pushes the f of a frame. */
void cs_lua_frame_push(lua_State *L, const cs_film_info *film, int64_t number);

#endif
