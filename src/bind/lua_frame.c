#include "bind/lua_frame.h"

#include <lauxlib.h>
#include <string.h>

#include "bind/caller.h"
#include "bind/random.h"
#include "bind/userdata.h"

const cs_kind cs_kind_frame = {.name = "celspan.frame", .own_size = sizeof(uint64_t)};

static const cs_field fields[] = {
    {"number", NULL}, {"index", NULL}, {"time", NULL},   {"middle", NULL},   {"count", NULL},
    {"fps", NULL},    {"width", NULL}, {"height", NULL}, {"progress", NULL}, {0}};
static const cs_noun noun = {.name = "frame", .kind = &cs_kind_frame, .fields = fields};

/* ---------------------------------------------------------------- random numbers */

/* Of the film's title and size, and the frame's number. */
static uint64_t seed_of(const cs_film_info *film, int64_t number) {
  const char *title = film->title ? film->title : "";
  uint64_t seed = cs_random_bytes(cs_random_begin, title, strlen(title));
  seed = cs_random_integer(seed, (uint64_t)film->width);
  seed = cs_random_integer(seed, (uint64_t)film->height);
  return cs_random_integer(seed, (uint64_t)number);
}

/* f:random(label [, m [, n]]) */
static int random_number(lua_State *L) {
  const cs_userdata *frame = cs_userdata_self(L, &cs_kind_frame, "random");
  return cs_random_push(L, *(const uint64_t *)cs_userdata_own(frame), 2);
}

/* ---------------------------------------------------------------- holding */

/* Whether the value is a whole number; 2.0 is one too. */
static bool is_whole(lua_State *L, int index, lua_Integer *out) {
  int good = 0;
  if (lua_type(L, index) == LUA_TNUMBER)
    *out = lua_tointegerx(L, index, &good);
  return good;
}

/* f:on(n): the index of the first of n frames that share a drawing. */
static int on(lua_State *L) {
  cs_userdata_self(L, &cs_kind_frame, "on");
  lua_Integer step = 0;
  if (!is_whole(L, 2, &step) || step < 1)
    return cs_caller_error(L, "on: takes a whole number of frames, 1 or more, f:on(2), got %s",
                           lua_type(L, 2) == LUA_TNUMBER ? luaL_tolstring(L, 2, NULL)
                                                         : cs_userdata_type(L, 2));
  lua_getiuservalue(L, 1, 1);
  lua_getfield(L, -1, "index");
  lua_Integer index = lua_tointeger(L, -1);
  lua_pushinteger(L, index - index % step);
  return 1;
}

/* ---------------------------------------------------------------- making */

static void set_integer(lua_State *L, const char *name, int64_t number) {
  lua_pushinteger(L, number);
  lua_setfield(L, -2, name);
}

static void set_number(lua_State *L, const char *name, double number) {
  lua_pushnumber(L, number);
  lua_setfield(L, -2, name);
}

void cs_lua_frame_push(lua_State *L, const cs_film_info *film, int64_t number) {
  int64_t index = number - film->first;
  cs_userdata *value = cs_userdata_push(L, &noun);
  *(uint64_t *)cs_userdata_own(value) = seed_of(film, number);
  lua_createtable(L, 0, 9);
  set_integer(L, "number", number);
  set_integer(L, "index", index);
  set_integer(L, "count", film->count);
  set_integer(L, "width", film->width);
  set_integer(L, "height", film->height);
  set_number(L, "fps", film->frames_second);
  set_number(L, "time", (double)index / film->frames_second);
  set_number(L, "middle", ((double)index + 0.5) / film->frames_second);
  set_number(L, "progress", film->count > 1 ? (double)index / (double)(film->count - 1) : 0);
  lua_setiuservalue(L, -2, 1);
}

void cs_lua_frame_register(lua_State *L) {
  static const luaL_Reg methods[] = {{"on", on}, {"random", random_number}, {NULL, NULL}};
  cs_userdata_register(L, &cs_kind_frame, methods);
}
