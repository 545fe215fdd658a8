#include "lua/nouns/random.h"

#include <lauxlib.h>

#include "inside/elementary.h"
#include "lua/bind/caller.h"
#include "lua/bind/numbers.h"
#include "lua/bind/userdata.h"

#define FNV_PRIME 1099511628211u

const uint64_t cs_random_begin = 14695981039346656037u;

uint64_t cs_random_bytes(uint64_t hash, const char *bytes, size_t size) {
  for (size_t i = 0; i < size; i++)
    hash = (hash ^ (unsigned char)bytes[i]) * FNV_PRIME;
  return hash;
}

uint64_t cs_random_integer(uint64_t hash, uint64_t number) {
  for (int i = 0; i < 8; i++)
    hash = (hash ^ (number >> (8 * i) & 255)) * FNV_PRIME;
  return hash;
}

static uint64_t finalise(uint64_t hash) { return cs_splitmix_next(&hash); }

/* 0..span-1, each equally likely: values that would make some numbers likelier are drawn again. */
static uint64_t below(uint64_t hash, uint64_t span) {
  uint64_t reject = (0 - span) % span; /* 2^64 mod span */
  while (hash < reject)
    hash = finalise(hash);
  return hash % span;
}

static lua_Integer whole(lua_State *L, int index, const char *name) {
  int good = 0;
  lua_Integer number = lua_type(L, index) == LUA_TNUMBER ? lua_tointegerx(L, index, &good) : 0;
  if (!good) /* 2.0 is a whole number, too */
    cs_caller_error(L, "random: %s must be a whole number, got %s", name,
                    cs_userdata_number(L, index));
  return number;
}

/* The hash with the text of the argument added, which is a string or a number. */
static uint64_t add_word(lua_State *L, uint64_t hash, int index, const char *name) {
  int type = lua_type(L, index);
  if (type != LUA_TSTRING && type != LUA_TNUMBER)
    cs_caller_error(L, "random: %s must be a string or a number, got %s", name,
                    cs_userdata_type(L, index));
  if (type == LUA_TNUMBER) /* C libraries write NaN with or without a sign */
    cs_numbers_check(L, index, "random", name);
  size_t size;
  const char *word = luaL_tolstring(L, index, &size);
  hash = cs_random_bytes(hash, word, size);
  lua_pop(L, 1);
  return hash;
}

int cs_random_push(lua_State *L, uint64_t seed, int first) {
  uint64_t hash = finalise(add_word(L, seed, first, "the label"));
  if (lua_isnoneornil(L, first + 1)) {
    lua_pushnumber(L, (lua_Number)(hash >> 11) * 0x1p-53);
    return 1;
  }
  bool has_two = !lua_isnoneornil(L, first + 2);
  lua_Integer least = has_two ? whole(L, first + 1, "m") : 1;
  lua_Integer most = has_two ? whole(L, first + 2, "n") : whole(L, first + 1, "m");
  if (least > most)
    return cs_caller_error(L, "random: there is no number from %I to %I", (LUAI_UACINT)least,
                           (LUAI_UACINT)most);
  uint64_t span = (uint64_t)most - (uint64_t)least + 1; /* 0: every integer */
  uint64_t offset = span ? below(hash, span) : hash;
  lua_pushinteger(L, (lua_Integer)((uint64_t)least + offset));
  return 1;
}

static int draw(lua_State *L) {
  return cs_random_push(L, (uint64_t)lua_tointeger(L, lua_upvalueindex(1)), 1);
}

int cs_random_make(lua_State *L) {
  uint64_t seed = add_word(L, cs_random_begin, 1, "the seed");
  /* The label must be separated from the seed: random("a")("b") is not random("ab")(""). */
  lua_pushinteger(L, (lua_Integer)cs_random_integer(seed, lua_rawlen(L, 1)));
  lua_pushcclosure(L, draw, 1);
  return 1;
}
