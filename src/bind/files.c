#include "bind/files.h"

#include <string.h>
#include <unistd.h>

#include "bind/caller.h"
#include "bind/host.h"

/* Replaces the folder on top of the stack by the file in it. */
static const char *push_in_folder(lua_State *L, const char *name) {
  const char *folder = lua_tostring(L, -1);
  lua_pushfstring(L, "%s%s%s", folder, folder[0] && strcmp(folder, "/") != 0 ? "/" : "", name);
  lua_remove(L, -2);
  return lua_tostring(L, -1);
}

static bool exists(const char *path) { return access(path, F_OK) == 0; }

const char *cs_files_find(lua_State *L, const char *name, const char **tried) {
  bool is_relative = name[0] != '/';
  const char *near = is_relative && cs_caller_push_folder(L) ? push_in_folder(L, name) : NULL;
  const char *beside = is_relative && cs_host_push_folder(L) ? push_in_folder(L, name) : NULL;
  if (!near && !beside)
    near = lua_pushstring(L, name);
  bool is_near = near && (!beside || strcmp(near, beside) == 0 || exists(near));
  bool is_found = is_near || !near || exists(beside);
  *tried = is_found ? NULL : beside;
  const char *path = is_near || !is_found ? near : beside;
  lua_pushstring(L, path);
  lua_pushstring(L, *tried);
  for (int i = !!near + !!beside; i > 0; i--)
    lua_remove(L, -3);
  *tried = lua_tostring(L, -1);
  return lua_tostring(L, -2);
}
