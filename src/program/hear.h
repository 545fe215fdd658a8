/* Sounds for scripts: how loud a file is, for lua/celspan/read/sound.lua. */
#pragma once

#include <lua.h>

/* Gives the scripts of a state, which has a context, sounds to read (CS_CORE_HEAR). Raises. */
void cs_hear_give(lua_State *L);
