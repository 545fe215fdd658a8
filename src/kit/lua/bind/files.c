#include "lua/bind/files.h"

#include <lauxlib.h>
#include <string.h>
#include <unistd.h>

#include "inside/context.h"
#include "lua/bind/caller.h"
#include "lua/bind/host.h"

const char *cs_files_name(lua_State *L, int index) {
  size_t size;
  const char *name = luaL_checklstring(L, index, &size);
  if (strlen(name) != size)
    cs_caller_error(L, "the name of a file must not hold a zero byte, got '%s\\0...'", name);
  return name;
}

/* Replaces the folder on top of the stack by the file in it. */
static const char *push_in_folder(lua_State *L, const char *name) {
  const char *folder = lua_tostring(L, -1);
  lua_pushfstring(L, "%s%s%s", folder, folder[0] && strcmp(folder, "/") != 0 ? "/" : "", name);
  lua_remove(L, -2);
  return lua_tostring(L, -1);
}

static bool exists(const char *path) { return access(path, F_OK) == 0; }

const char *cs_files_find_from(lua_State *L, const char *folder, const char *name,
                               const char **tried) {
  bool is_relative = name[0] != '/';
  const char *near = NULL;
  if (is_relative && folder) {
    lua_pushstring(L, folder);
    near = push_in_folder(L, name);
  }
  const char *beside = is_relative && cs_host_push_folder(L) ? push_in_folder(L, name) : NULL;
  if (!near && !beside)
    near = lua_pushstring(L, name);
  if (near)
    cs_host_admit(L, near);
  bool is_near = near && (!beside || strcmp(near, beside) == 0 || exists(near));
  if (!is_near)
    cs_host_admit(L, beside);
  bool is_found = is_near || !near || exists(beside);
  const char *path = is_near || !is_found ? near : beside;
  const char *other = is_found ? NULL : beside;
  if (other)
    cs_tried_note(cs_host_context(L), path, other);
  lua_pushstring(L, path);
  lua_pushstring(L, other);
  for (int i = !!near + !!beside; i > 0; i--)
    lua_remove(L, -3);
  if (tried)
    *tried = lua_tostring(L, -1);
  return lua_tostring(L, -2);
}

const char *cs_files_find(lua_State *L, const char *name, const char **tried) {
  bool has_folder = cs_caller_push_folder(L);
  const char *path = cs_files_find_from(L, has_folder ? lua_tostring(L, -1) : NULL, name, tried);
  if (has_folder)
    lua_remove(L, -3);
  return path;
}

bool cs_files_is_font(const char *path) {
  static const char *const endings[] = {".ttf", ".otf", ".ttc", ".otc"};
  const char *dot = strrchr(path, '.');
  bool found = false;
  for (size_t i = 0; dot && i < sizeof endings / sizeof *endings; i++)
    found |= strcmp(dot, endings[i]) == 0;
  return found;
}
