/* Where the files are that scripts name.
 *
 *   shot.lua                   picture "bg.png"     -> bg.png
 *   characters/hand.lua        picture "palm.png"   -> characters/palm.png, else palm.png
 *
 * A relative name is looked for beside the Lua file of the nearest caller that is not celspan's
 * own, then beside the script, where there is one. Finding a file opens nothing.
 */
#pragma once

#include <lua.h>
#include <stdbool.h>

/* The name of a file at an index. Raises if it is no text, or has a zero byte, where C would cut
 * it: another file would be read. */
const char *cs_files_name(lua_State *L, int index);
/* Pushes the path of the file; and after it the other place that was searched, if the file is in
 * neither place, otherwise nil. *tried: this text or NULL. folder: of a Lua file, where the search
 * begins; NULL: there is none. Raises if a sandbox does not allow the script to read there. */
const char *cs_files_find_from(lua_State *L, const char *folder, const char *name,
                               const char **tried);
/* The same, beside the nearest caller's file. */
const char *cs_files_find(lua_State *L, const char *name, const char **tried);
/* native.file_text(path, most) -> the text of a file of at most that many bytes | nil, message */
int cs_file_text(lua_State *L);
/* Whether a name ends as those of fonts. */
bool cs_files_is_font(const char *path);
