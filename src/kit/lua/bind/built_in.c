#include "lua/bind/built_in.h"

#include <stdbool.h>
#include <string.h>

#include "lua/bind/require.h"

#pragma weak lua_ident /* LuaJIT and interpreters that export functions alone lack it: then NULL */

const cs_built_in *cs_built_in_find(const cs_built_in *files, const char *name) {
  while (files->name && strcmp(files->name, name) != 0)
    files++;
  return files->name ? files : NULL;
}

/* Pushes the function if there is bytecode of the release of Lua that runs, with whose name the
 * file begins (compile.c); false: nothing is pushed. */
static bool load_bytecode(lua_State *L, const cs_built_in *files, const char *name) {
  const cs_built_in *file = cs_built_in_find(files, lua_pushfstring(L, "%sc", name));
  const size_t head = lua_ident ? strlen(lua_ident) + 1 : 0;
  lua_pop(L, 1);
  if (!file || head == 0 || file->size < head || memcmp(file->bytes, lua_ident, head) != 0)
    return false;
  if (luaL_loadbufferx(L, file->bytes + head, file->size - head, name, "b") == LUA_OK)
    return true;
  lua_pop(L, 1); /* it may be of the same release, but with other numbers */
  return false;
}

/* The chunk is named as compile.c names it; by the start of the name the finder of callers
 * recognizes it (caller.c). */
static void load_text(lua_State *L, const cs_built_in *file, const char *folder) {
  const char *chunk = lua_pushfstring(L, "@celspan/%s%s", folder, file->name);
  if (luaL_loadbufferx(L, file->bytes, file->size, chunk, "t") != LUA_OK)
    lua_error(L);
  lua_remove(L, -2);
}

void cs_built_in_load(lua_State *L, const cs_built_in *files, const char *folder,
                      const char *name) {
  if (!load_bytecode(L, files, name))
    load_text(L, cs_built_in_find(files, name), folder);
  cs_require_push_globals(L); /* these give access to celspan's private modules */
  lua_setupvalue(L, -2, 1);
}
