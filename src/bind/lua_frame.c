#include "bind/lua_frame.h"

#include <lauxlib.h>
#include <string.h>

#include "bind/userdata.h"

const cs_kind cs_kind_frame = {.name = "celspan.frame"};

static const cs_field fields[] = {
    {"number", NULL}, {"index", NULL}, {"time", NULL},   {"middle", NULL},   {"count", NULL},
    {"fps", NULL},    {"width", NULL}, {"height", NULL}, {"progress", NULL}, {0}};
static const cs_noun noun = {.name = "frame", .kind = &cs_kind_frame, .fields = fields};

/* ---------------------------------------------------------------- random numbers
 * FNV-1a over the bytes, SplitMix64's finaliser on top: a pure function of the film's title and
 * size, the frame's number and the label, on every machine. */

#define FNV_BASIS 14695981039346656037u
#define FNV_PRIME 1099511628211u

static uint64_t hash_bytes(uint64_t hash, const char *bytes, size_t size) {
  for (size_t i = 0; i < size; i++)
    hash = (hash ^ (unsigned char)bytes[i]) * FNV_PRIME;
  return hash;
}

static uint64_t hash_integer(uint64_t hash, uint64_t number) {
  for (int i = 0; i < 8; i++)
    hash = (hash ^ (number >> (8 * i) & 255)) * FNV_PRIME;
  return hash;
}

static uint64_t finalise(uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

static uint64_t seed_of(const cs_film_info *film, int64_t number) {
  const char *title = film->title ? film->title : "";
  uint64_t seed = hash_bytes(FNV_BASIS, title, strlen(title));
  seed = hash_integer(seed, (uint64_t)film->width);
  seed = hash_integer(seed, (uint64_t)film->height);
  return hash_integer(seed, (uint64_t)number);
}

/* 0..span-1, each equally likely: the few values that would make some likelier are drawn again. */
static uint64_t below(uint64_t hash, uint64_t span) {
  uint64_t reject = (0 - span) % span; /* 2^64 mod span */
  while (hash < reject)
    hash = finalise(hash);
  return hash % span;
}

/* Whether the value is a whole number; 2.0 is one too. */
static bool is_whole(lua_State *L, int index, lua_Integer *out) {
  int good = 0;
  if (lua_type(L, index) == LUA_TNUMBER)
    *out = lua_tointegerx(L, index, &good);
  return good;
}

static lua_Integer whole(lua_State *L, int index, const char *name) {
  lua_Integer number = 0;
  if (!is_whole(L, index, &number))
    luaL_error(L, "random: %s must be a whole number, got %s", name, cs_userdata_type(L, index));
  return number;
}

/* f:random(label) 0 <= x < 1; f:random(label, m) 1..m; f:random(label, m, n) m..n. */
static int random_number(lua_State *L) {
  const cs_userdata *frame = cs_userdata_self(L, &cs_kind_frame, "random");
  int type = lua_type(L, 2);
  if (type != LUA_TSTRING && type != LUA_TNUMBER)
    return luaL_error(L, "random: the label must be a string or a number, got %s",
                      cs_userdata_type(L, 2));
  size_t size;
  const char *label = luaL_tolstring(L, 2, &size);
  uint64_t hash = finalise(hash_bytes(frame->seed, label, size));
  lua_pop(L, 1);
  if (lua_isnoneornil(L, 3)) {
    lua_pushnumber(L, (lua_Number)(hash >> 11) * 0x1p-53);
    return 1;
  }
  bool has_two = !lua_isnoneornil(L, 4);
  lua_Integer least = has_two ? whole(L, 3, "m") : 1;
  lua_Integer most = has_two ? whole(L, 4, "n") : whole(L, 3, "m");
  if (least > most)
    return luaL_error(L, "random: there is no number from %I to %I", (LUAI_UACINT)least,
                      (LUAI_UACINT)most);
  uint64_t span = (uint64_t)most - (uint64_t)least + 1; /* 0: every integer */
  uint64_t offset = span ? below(hash, span) : hash;
  lua_pushinteger(L, (lua_Integer)((uint64_t)least + offset));
  return 1;
}

/* f:on(n): the index of the first of n frames that share a drawing. */
static int on(lua_State *L) {
  cs_userdata_self(L, &cs_kind_frame, "on");
  lua_Integer step = 0;
  if (!is_whole(L, 2, &step) || step < 1)
    return luaL_error(L, "on: takes a whole number of frames, 1 or more, f:on(2)");
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
  value->seed = seed_of(film, number);
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
