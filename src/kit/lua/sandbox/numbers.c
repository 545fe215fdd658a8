/* math: where C libraries differ between machines, the functions are celspan's own. Random numbers
 * are the same in every run and every frame. */
#include <lauxlib.h>
#include <string.h>

#include "inside/elementary.h"
#include "lua/sandbox/library.h"

#define FUNCTION(name, value)                                                                      \
  static int name(lua_State *L) {                                                                  \
    double x = luaL_checknumber(L, 1);                                                             \
    lua_pushnumber(L, value);                                                                      \
    return 1;                                                                                      \
  }

FUNCTION(sine, cs_function_sin(x))
FUNCTION(cosine, cs_function_cos(x))
FUNCTION(tangent, cs_function_tan(x))
FUNCTION(arc_sine, cs_function_asin(x))
FUNCTION(arc_cosine, cs_function_acos(x))
FUNCTION(arc_tangent, cs_function_atan2(x, luaL_optnumber(L, 2, 1)))
FUNCTION(exponential, cs_elementary_exp(x))

static int logarithm(lua_State *L) {
  double x = luaL_checknumber(L, 1), base = luaL_optnumber(L, 2, 0);
  if (lua_isnoneornil(L, 2))
    lua_pushnumber(L, cs_elementary_log(x));
  else if (base == 2)
    lua_pushnumber(L, cs_function_log2(x));
  else
    lua_pushnumber(L, cs_elementary_log(x) / cs_elementary_log(base));
  return 1;
}

/* ---------------------------------------------------------------- random numbers */

static const char seed_key =
    0; /* its address is the key of a userdata with the state in the registry */

static uint64_t next_word(lua_State *L) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &seed_key);
  uint64_t *state = lua_touserdata(L, -1);
  lua_pop(L, 1);
  return cs_splitmix_next(state);
}

void cs_library_seed(lua_State *L, uint64_t seed) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &seed_key);
  uint64_t *state = lua_touserdata(L, -1);
  lua_pop(L, 1);
  if (state)
    *state = seed;
}

/* A uniform random number below `count`; count 0: any 64-bit number. */
static uint64_t word_below(lua_State *L, uint64_t count) {
  uint64_t word = next_word(L);
  if (count == 0)
    return word;
  uint64_t most = UINT64_MAX - UINT64_MAX % count;
  while (word >= most)
    word = next_word(L);
  return word % count;
}

static int random_number(lua_State *L) {
  lua_Integer low = 1, high;
  if (lua_gettop(L) == 0) {
    lua_pushnumber(L, (double)(next_word(L) >> 11) * 0x1p-53);
    return 1;
  }
  if (lua_gettop(L) > 2)
    return luaL_error(L, "wrong number of arguments");
  high = luaL_checkinteger(L, lua_gettop(L));
  if (lua_gettop(L) == 2)
    low = luaL_checkinteger(L, 1);
  else if (high == 0) {
    lua_pushinteger(L, (lua_Integer)next_word(L));
    return 1;
  }
  luaL_argcheck(L, low <= high, 1, "interval is empty");
  uint64_t count = (uint64_t)high - (uint64_t)low + 1;
  lua_pushinteger(L, (lua_Integer)((uint64_t)low + word_below(L, count)));
  return 1;
}

static int seed_random(lua_State *L) {
  if (lua_isnone(L, 1))
    return luaL_error(L, "randomseed: give a number: without one, random numbers would differ in "
                         "each run");
  double number = luaL_checknumber(L, 1);
  uint64_t seed;
  memcpy(&seed, &number, sizeof seed);
  cs_library_seed(L, lua_isinteger(L, 1) ? (uint64_t)lua_tointeger(L, 1) : seed);
  return 0;
}

void cs_library_push_math(lua_State *L) {
  static const luaL_Reg own[] = {{"sin", sine},
                                 {"cos", cosine},
                                 {"tan", tangent},
                                 {"atan", arc_tangent},
                                 {"asin", arc_sine},
                                 {"acos", arc_cosine},
                                 {"exp", exponential},
                                 {"log", logarithm},
                                 {"random", random_number},
                                 {"randomseed", seed_random},
                                 {NULL, NULL}};
  static const char *const same[] = {"abs", "ceil", "deg",       "floor",      "fmod",       "huge",
                                     "max", "min",  "modf",      "maxinteger", "mininteger", "pi",
                                     "rad", "sqrt", "tointeger", "type",       "ult",        NULL};
  uint64_t *state = lua_newuserdatauv(L, sizeof *state, 0);
  *state = 0;
  lua_rawsetp(L, LUA_REGISTRYINDEX, &seed_key);
  cs_library_push_part(L, "math", same, own);
}
