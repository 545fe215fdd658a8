/* Movies for scripts: the function behind celspan.footage. */
#pragma once

#include <lua.h>

/* Gives the scripts of a state, which has a context, the function that opens movies
 * (CS_NATIVE_MOVIE), for lua/celspan/read/footage.lua. Raises. */
void cs_movies_give(lua_State *L);
/* is_movie(path) -> whether a file has the first bytes of a movie */
int cs_movies_is(lua_State *L);
