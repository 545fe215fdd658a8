/* Onion skin: the film of --onion, which verbs/onion.lua makes. */
#pragma once

#include <lauxlib.h>

/* film, before, after, width, height, name or nil -> a film that shows each frame with the drawings
 * of the frames before and after it. width, height: pixels of the skins. name: only cels of this
 * name are shown. Raises. */
int cs_onion_film(lua_State *L);
