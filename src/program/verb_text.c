#include "program/verb_text.h"

#include <string.h>

#include "lua/bind/require.h"

const cs_verb_text *cs_verb_text_find(const char *name) {
  const cs_verb_text *text = cs_verb_texts;
  while (strcmp(text->name, name) != 0)
    text++;
  return text;
}

void cs_verb_text_load(lua_State *L, const char *name) {
  const cs_verb_text *text = cs_verb_text_find(name);
  lua_pushfstring(L, "@celspan/%s", name);
  if (luaL_loadbufferx(L, text->bytes, text->size, lua_tostring(L, -1), "t") != LUA_OK)
    lua_error(L);
  lua_remove(L, -2);
  cs_require_push_globals(L); /* these give access to celspan's private modules */
  lua_setupvalue(L, -2, 1);
}
