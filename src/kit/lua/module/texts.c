/* A celspan that has all of its Lua modules. */
#include "lua/module/texts.h"

void cs_texts_load(lua_State *L, const char *folder, const char *file) {
  cs_built_in_load(L, cs_module_texts, folder, file);
}
