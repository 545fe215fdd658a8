/* math: where C libraries differ between machines, the functions are celspan's own. Random numbers
 * are the same in every run and every frame. */
#include <lauxlib.h>
#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "base/splitmix.h"
#include "lua/sandbox/library.h"

/* celspan's functions are for finite numbers and angles of moderate size; the C library handles all
 * others. */
#define ANGLE_MOST 1e6

/* The library keeps the sign of 0. */
static bool is_angle(double x) { return x != 0 && fabs(x) <= ANGLE_MOST; }

static void find_sincos(double x, double *s, double *c) {
  if (is_angle(x)) {
    cs_elementary_sincos(x, s, c);
    return;
  }
  *s = sin(x);
  *c = cos(x);
}

static int sine(lua_State *L) {
  double s, c;
  find_sincos(luaL_checknumber(L, 1), &s, &c);
  lua_pushnumber(L, s);
  return 1;
}

static int cosine(lua_State *L) {
  double s, c;
  find_sincos(luaL_checknumber(L, 1), &s, &c);
  lua_pushnumber(L, c);
  return 1;
}

static int tangent(lua_State *L) {
  double x = luaL_checknumber(L, 1);
  lua_pushnumber(L, is_angle(x) ? cs_elementary_tan(x) : tan(x));
  return 1;
}

static double arc_tangent_of(double y, double x) {
  return isfinite(x) && isfinite(y) ? cs_elementary_atan2(y, x) : atan2(y, x);
}

static int arc_tangent(lua_State *L) {
  lua_pushnumber(L, arc_tangent_of(luaL_checknumber(L, 1), luaL_optnumber(L, 2, 1)));
  return 1;
}

static int arc_sine(lua_State *L) {
  double x = luaL_checknumber(L, 1);
  lua_pushnumber(L, arc_tangent_of(x, sqrt((1 - x) * (1 + x))));
  return 1;
}

static int arc_cosine(lua_State *L) {
  double x = luaL_checknumber(L, 1);
  lua_pushnumber(L, arc_tangent_of(sqrt((1 - x) * (1 + x)), x));
  return 1;
}

static int exponential(lua_State *L) {
  double x = luaL_checknumber(L, 1);
  lua_pushnumber(L, isfinite(x) ? cs_elementary_exp(x) : exp(x));
  return 1;
}

/* Whole powers of two are exact, for base 2. */
static double logarithm_of(double x) {
  return x > 0 && isfinite(x) ? cs_elementary_log(x) : x == 0 ? -INFINITY : x > 0 ? x : NAN;
}

static int logarithm(lua_State *L) {
  double x = luaL_checknumber(L, 1), base = luaL_optnumber(L, 2, 0);
  int power;
  if (lua_isnoneornil(L, 2))
    lua_pushnumber(L, logarithm_of(x));
  else if (base == 2 && isfinite(x) && frexp(x, &power) == 0.5)
    lua_pushnumber(L, power - 1);
  else
    lua_pushnumber(L, logarithm_of(x) / logarithm_of(base));
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
