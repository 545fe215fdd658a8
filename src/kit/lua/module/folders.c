/* Folders, and the files of a pattern such as walk.####.png. */
#include <errno.h>
#include <lauxlib.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "inside/files.h"
#include "inside/films.h"
#include "lua/bind/host.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"

#define MOST_FILES 100000

/* ---------------------------------------------------------------- folders */

static int close_folder(lua_State *L) {
  DIR **folder = lua_touserdata(L, 1);
  if (*folder)
    closedir(*folder);
  *folder = NULL;
  return 0;
}

/* Returns the failure for an errno. */
static int fail_folder(lua_State *L, const char *path, const char *what) {
  lua_pushnil(L);
  lua_pushfstring(L, "%s: %s: %s", path, what, strerror(errno));
  return 2;
}

int cs_folders_names(lua_State *L) {
  const char *path = luaL_checkstring(L, 1);
  cs_host_admit(L, path);
  DIR **folder = cs_userdata_push_holder(L, "celspan.folder", sizeof *folder, close_folder);
  *folder = opendir(path);
  if (!*folder)
    return fail_folder(L, path, "cannot be opened");
  lua_newtable(L);
  lua_Integer count = 0;
  for (struct dirent *entry; (entry = cs_open_entry(*folder));) {
    if (entry->d_name[0] == '.')
      continue;
    if (count == MOST_FILES) {
      lua_pushnil(L);
      lua_pushfstring(L, "%s: has more than %d files, which is the limit", path, MOST_FILES);
      return 2;
    }
    lua_pushstring(L, entry->d_name);
    lua_rawseti(L, -2, ++count);
  }
  return errno ? fail_folder(L, path, "cannot be read") : 1;
}

/* Whether a resolved path lies in a resolved folder. */
static bool lies_in(const char *folder, const char *path) {
  size_t size = strlen(folder);
  while (size > 0 && folder[size - 1] == '/')
    size--;
  return strncmp(folder, path, size) == 0 && path[size] == '/';
}

int cs_folders_within(lua_State *L) {
  size_t size;
  const char *folder = luaL_checkstring(L, 1), *name = luaL_checklstring(L, 2, &size);
  const char *path = lua_pushfstring(L, "%s/%s", folder, name);
  char *real_folder = realpath(folder, NULL), *real_path = realpath(path, NULL);
  bool is_within = real_folder && real_path && strlen(name) == size && /* no zero byte */
                   lies_in(real_folder, real_path);
  free(real_folder);
  free(real_path);
  if (!is_within)
    lua_pushnil(L);
  return 1;
}

/* ---------------------------------------------------------------- patterns */

static void push_numbers(lua_State *L, const cs_sequence *sequence) {
  lua_createtable(L, sequence->count < INT_MAX ? (int)sequence->count : 0, 0);
  for (size_t i = 0; i < sequence->count; i++) {
    lua_pushinteger(L, sequence->frames[i]);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

CS_HOLDER_FINISH(release, cs_sequence_finish)

int cs_folders_frames(lua_State *L) {
  const char *pattern = luaL_checkstring(L, 1), *list = luaL_optstring(L, 2, NULL);
  celspan_context *context = cs_host_context(L);
  cs_sequence *sequence = cs_userdata_push_holder(L, "celspan.sequence", sizeof *sequence, release);
  CS_HOST_TRY(L, list ? cs_sequence_parse(context, list, NULL, sequence)
                      : cs_sequence_list(context, pattern, sequence));
  push_numbers(L, sequence);
  return 1;
}

int cs_folders_frame_name(lua_State *L) {
  char name[4096];
  celspan_context *context = cs_host_context(L);
  CS_HOST_TRY(L, cs_sequence_name(context, luaL_checkstring(L, 1), luaL_checkinteger(L, 2), name,
                                  sizeof name));
  lua_pushstring(L, name);
  return 1;
}
