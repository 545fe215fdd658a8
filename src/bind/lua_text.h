/* Whether a file can be a script at all, by its first bytes.
 *
 * INVARIANT: only files that can be read twice are looked into; pipes and files that are missing
 * may be scripts, which Lua finds out.
 */
#ifndef CS_BIND_LUA_TEXT_H
#define CS_BIND_LUA_TEXT_H

#include <stdbool.h>

/* false: the file holds binary data, or is a picture whose format is text. Compiled Lua is for Lua
 * to refuse. */
bool cs_lua_text_accepts(const char *path);

#endif
