/* luaopen_celspan: the module table, filled by the file of each noun. */
#include "bind/openers.h"

#include <lauxlib.h>
#include <stdlib.h>
#include <string.h>

#include "bind/caller.h"
#include "bind/difference.h"
#include "bind/drawing.h"
#include "bind/files.h"
#include "bind/frames.h"
#include "bind/host.h"
#include "bind/painting.h"
#include "bind/parts.h"
#include "bind/random.h"
#include "bind/relight.h"
#include "bind/stack.h"
#include "bind/suggest.h"
#include "bind/tracing.h"
#include "bind/track.h"
#include "celspan/lua.h"

#define MOST_NAMES 128

/* core.find(name): where a file is and, if it is not there, where else it was looked for. */
static int find(lua_State *L) {
  const char *tried;
  cs_files_find(L, luaL_checkstring(L, 1), &tried);
  return 2;
}

/* core.nearest(word, names): the name that was probably meant, or nil. */
static int nearest(lua_State *L) {
  const char *word = luaL_checkstring(L, 1);
  luaL_checktype(L, 2, LUA_TTABLE);
  const char *names[MOST_NAMES] = {0};
  size_t count = lua_rawlen(L, 2) < MOST_NAMES ? lua_rawlen(L, 2) : MOST_NAMES;
  for (size_t i = 0; i < count; i++) {
    if (lua_rawgeti(L, 2, (lua_Integer)i + 1) != LUA_TSTRING)
      return luaL_error(L, "nearest: name %d is not a string", (int)i + 1);
    names[i] = lua_tostring(L, -1); /* the table keeps it alive */
    lua_pop(L, 1);
  }
  lua_pushstring(L, cs_suggest_name(word, names, count));
  return 1;
}

/* core.refuse(message): raises it at the line of the nearest caller that is not celspan's own. */
static int refuse(lua_State *L) { return cs_caller_error(L, "%s", luaL_checkstring(L, 1)); }

int luaopen_celspan_core(lua_State *L) {
  static const luaL_Reg functions[] = {{"find", find},
                                       {"nearest", nearest},
                                       {"refuse", refuse},
                                       {"difference", cs_difference_of},
                                       {"painting", cs_painting_read},
                                       {"parts", cs_parts_list},
                                       {"folder", cs_painting_folder},
                                       {"within", cs_painting_within},
                                       {"trace", cs_tracing_make},
                                       {"tracker", cs_track_tracker},
                                       {"follow", cs_track_follow},
                                       {"rewind", cs_track_rewind},
                                       {"inverse", cs_track_inverse},
                                       {"frames", cs_frames_list},
                                       {"frame_name", cs_frames_name},
                                       {"picture_size", cs_relight_size},
                                       {"light_estimate", cs_relight_estimate},
                                       {"light_shape", cs_relight_shape},
                                       {"relight_picture", cs_relight_picture},
                                       {"relight_exposures", cs_relight_exposures},
                                       {"relight_grounds", cs_relight_grounds},
                                       {"stack", cs_stack_make},
                                       {"stack_lights", cs_stack_lights},
                                       {"stack_light", cs_stack_light},
                                       {"relight_write", cs_relight_write},
                                       {"relight_read", cs_relight_read},
                                       {NULL, NULL}};
  cs_host_open(L, NULL);
  luaL_newlib(L, functions);
  cs_drawing_open(L);
  return 1;
}

static int compare(const void *a, const void *b) {
  return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* celspan.circl: reading a name that the module does not have. */
static int fail_unknown(lua_State *L) {
  if (lua_type(L, 2) != LUA_TSTRING)
    return 0;
  const char *names[MOST_NAMES], *name = lua_tostring(L, 2);
  size_t count = 0;
  lua_pushnil(L);
  for (; count < MOST_NAMES && lua_next(L, 1); lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING)
      names[count++] = lua_tostring(L, -2); /* the module keeps it alive */
  qsort(names, count, sizeof *names, compare);
  const char *nearest = cs_suggest_name(name, names, count);
  if (nearest)
    return cs_caller_error(L, "celspan has no '%s'; did you mean '%s'?", name, nearest);
  return cs_caller_error(L, "celspan has no '%s'", name);
}

static void set_reading(lua_State *L) {
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, fail_unknown);
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
}

int luaopen_celspan(lua_State *L) {
  static void (*const openers[])(lua_State *) = {
      cs_open_paint,   cs_open_texture,  cs_open_object, cs_open_primitive,
      cs_open_stroke,  cs_open_scanline, cs_open_text,   cs_open_rostrum,
      cs_open_boolean, cs_open_cel, /* operators: of objects and rostrums */
      cs_open_film,    cs_open_render,   cs_open_pixels, cs_open_spans};
  luaL_checkversion(L);
  cs_host_open(L, NULL);
  lua_createtable(L, 0, 32);
  lua_pushfstring(L, "celspan %s", celspan_version());
  lua_setfield(L, -2, "_VERSION");
  lua_pushcfunction(L, cs_random_make);
  lua_setfield(L, -2, "random");
  for (size_t i = 0; i < sizeof openers / sizeof *openers; i++)
    openers[i](L);
  cs_open_embedded(L);
  set_reading(L);
  return 1;
}
