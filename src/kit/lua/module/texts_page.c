/* A celspan of web pages: the folders of modules that are not built in are files of the page. */
#include "lua/bind/caller.h"
#include "lua/bind/require.h"
#include "lua/module/texts.h"

/* The path is the name that the chunk would have if it were built in. The page notes that it was
 * looked for. */
static void load_file(lua_State *L, const char *folder, const char *file) {
  const char *path = lua_pushfstring(L, "celspan/%s%s", folder, file);
  int outcome = luaL_loadfilex(L, path, "t");
  if (outcome == LUA_ERRFILE)
    cs_caller_error(L,
                    "this celspan has no %s: it is that of web pages, and more.json has what else "
                    "it can have",
                    path);
  if (outcome != LUA_OK)
    lua_error(L);
  cs_require_push_globals(L);
  lua_setupvalue(L, -2, 1);
}

void cs_texts_load(lua_State *L, const char *folder, const char *file) {
  if (cs_built_in_find(cs_module_texts, file))
    cs_built_in_load(L, cs_module_texts, folder, file);
#ifdef CS_IS_WHOLE
  else if (cs_built_in_find(cs_whole_texts, file))
    cs_built_in_load(L, cs_whole_texts, folder, file);
#endif
  else
    load_file(L, folder, file);
}
