#include "bind/painting.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/open.h"
#include "bind/holder.h"
#include "bind/host.h"
#include "bind/pixel_string.h"

#define MOST_FILES 100000

/* ---------------------------------------------------------------- paintings */

static int release(lua_State *L) {
  celspan_painting **painting = lua_touserdata(L, 1);
  celspan_painting_unref(*painting);
  *painting = NULL;
  return 0;
}

/* Pushes a place for a painting that is released whatever happens. */
static celspan_painting **push_holder(lua_State *L) {
  return cs_holder_push(L, "celspan.painting", sizeof(celspan_painting *), release);
}

static void set_number(lua_State *L, const char *name, double number) {
  lua_pushnumber(L, number);
  lua_setfield(L, -2, name);
}

static void set_integer(lua_State *L, const char *name, lua_Integer number) {
  lua_pushinteger(L, number);
  lua_setfield(L, -2, name);
}

static void set_text(lua_State *L, const char *name, const char *text) {
  lua_pushstring(L, text);
  lua_setfield(L, -2, name);
}

static void set_boolean(lua_State *L, const char *name, bool is_so) {
  lua_pushboolean(L, is_so);
  lua_setfield(L, -2, name);
}

static void push_layer(lua_State *L, const celspan_painting_layer *layer, size_t count) {
  lua_createtable(L, 0, 13);
  set_text(L, "name", layer->name);
  set_text(L, "blend", layer->blend);
  set_text(L, "colour", layer->colour);
  set_boolean(L, "group", layer->is_group);
  set_boolean(L, "visible", layer->is_visible);
  set_number(L, "opacity", layer->opacity);
  set_integer(L, "x", layer->x);
  set_integer(L, "y", layer->y);
  set_integer(L, "width", layer->width);
  set_integer(L, "height", layer->height);
  if (layer->parent < count)
    set_integer(L, "parent", (lua_Integer)layer->parent + 1);
  if (layer->surface) {
    cs_pixel_string_push_surface(L, layer->surface);
    lua_setfield(L, -2, "pixels");
  }
}

static void push_layers(lua_State *L, const celspan_painting *painting) {
  size_t count = celspan_painting_layer_count(painting);
  celspan_painting_layer layer;
  lua_createtable(L, (int)count, 0);
  for (size_t i = 0; celspan_painting_layer_at(painting, i, &layer); i++) {
    push_layer(L, &layer, count);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

static void push_notes(lua_State *L, const celspan_painting *painting) {
  size_t layer, count = celspan_painting_layer_count(painting);
  const char *text;
  lua_newtable(L);
  for (size_t i = 0; (text = celspan_painting_note_at(painting, i, &layer)); i++) {
    lua_createtable(L, 0, 2);
    set_text(L, "what", text);
    if (layer < count)
      set_integer(L, "layer", (lua_Integer)layer + 1);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

int cs_painting_read(lua_State *L) {
  const char *path = luaL_checkstring(L, 1);
  cs_host_admit(L, path);
  celspan_context *context = cs_host_context(L);
  celspan_painting **painting = push_holder(L);
  int32_t width, height;
  celspan_status status = celspan_painting_read(context, path, painting);
  if (status != CELSPAN_OK)
    return cs_host_fail(L, status);
  celspan_painting_size(*painting, &width, &height);
  lua_createtable(L, 0, 4);
  set_integer(L, "width", width);
  set_integer(L, "height", height);
  push_layers(L, *painting);
  lua_setfield(L, -2, "layers");
  push_notes(L, *painting);
  lua_setfield(L, -2, "notes");
  return 1;
}

/* ---------------------------------------------------------------- folders */

static int close_folder(lua_State *L) {
  DIR **folder = lua_touserdata(L, 1);
  if (*folder)
    closedir(*folder);
  *folder = NULL;
  return 0;
}

/* Pushes a place for an open folder that is closed whatever happens. */
static DIR **push_folder_holder(lua_State *L) {
  return cs_holder_push(L, "celspan.folder", sizeof(DIR *), close_folder);
}

/* For an errno. */
static int fail_folder(lua_State *L, const char *path, const char *what) {
  lua_pushnil(L);
  lua_pushfstring(L, "%s: %s: %s", path, what, strerror(errno));
  return 2;
}

int cs_painting_folder(lua_State *L) {
  const char *path = luaL_checkstring(L, 1);
  cs_host_admit(L, path);
  DIR **folder = push_folder_holder(L);
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

int cs_painting_within(lua_State *L) {
  const char *folder = luaL_checkstring(L, 1);
  const char *path = lua_pushfstring(L, "%s/%s", folder, luaL_checkstring(L, 2));
  char *real_folder = realpath(folder, NULL), *real_path = realpath(path, NULL);
  bool is_within = real_folder && real_path && lies_in(real_folder, real_path);
  free(real_folder);
  free(real_path);
  if (!is_within)
    lua_pushnil(L);
  return 1;
}
