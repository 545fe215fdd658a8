#include "cli/document.h"

#include <stdio.h>
#include <string.h>

#include "cli/lines.h"

cs_exit cs_document_make(lua_State *L, int arguments) {
  lua_call(L, arguments, 2);
  if (!lua_isnil(L, -2)) {
    lua_pop(L, 1);
    return CS_EXIT_OK;
  }
  cs_report_error("%s", lua_tostring(L, -1));
  lua_pop(L, 2);
  return CS_EXIT_INPUT;
}

static cs_exit print(lua_State *L, const char *subject) {
  lua_getfield(L, -1, "text");
  lua_pushvalue(L, -2);
  lua_call(L, 1, 2);
  size_t size;
  const char *text = lua_tolstring(L, -2, &size);
  if (text)
    fwrite(text, 1, size, stdout); /* failures are found when standard output is closed */
  else
    cs_report_error("%s: %s", subject, lua_tostring(L, -1));
  lua_pop(L, 2);
  return text ? CS_EXIT_OK : CS_EXIT_LIMIT;
}

cs_exit cs_document_put(lua_State *L, const char *output, const char *subject) {
  if (!output || strcmp(output, "-") == 0)
    return print(L, subject);
  (void)cs_lines_make_folders_for(output); /* where it fails, so does writing */
  lua_getfield(L, -1, "write");
  lua_pushvalue(L, -2);
  lua_pushstring(L, output);
  lua_call(L, 2, 2);
  bool is_written = lua_toboolean(L, -2) != 0;
  if (!is_written)
    cs_report_error("%s", lua_tostring(L, -1));
  lua_pop(L, 2);
  return is_written ? CS_EXIT_OK : CS_EXIT_OUTPUT;
}
