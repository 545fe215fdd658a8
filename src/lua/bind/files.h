/* Where the files are that scripts name.
 *
 *   shot.lua                   picture "bg.png"     -> bg.png
 *   characters/hand.lua        picture "palm.png"   -> characters/palm.png, else palm.png
 *
 * A relative name is looked for beside the Lua file of the nearest caller that is not celspan's
 * own, then beside the script, where there is one. Nothing is opened here.
 */
#pragma once

#include <lua.h>

/* Pushes where the file is and, after it, where else it was looked for if it is in neither place;
 * else nil. *tried: that or NULL. folder: of a Lua file, where it is looked for first; NULL: of
 * none. Raises where a sandbox does not let the script read there. */
const char *cs_files_find_from(lua_State *L, const char *folder, const char *name,
                               const char **tried);
/* The same, beside the nearest caller's file. */
const char *cs_files_find(lua_State *L, const char *name, const char **tried);
