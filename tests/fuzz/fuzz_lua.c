/* Any bytes as the choices or the input of a Lua script, FUZZ_SCRIPT.lua next to this file: the
 * script returns a module whose try_bytes(bytes) raises an error if a promise is broken.
 *
 * All inputs share one Lua state, whose memory is bounded; a script keeps nothing between them. The
 * executed lines of celspan's own Lua modules, and their sequences, are reported to the fuzzer as
 * coverage, which it records by itself only for C.
 */
#include "tests/fuzz/target.h"

#include <lauxlib.h>
#include <lualib.h>
#include <string.h>

#include "celspan/lua.h"

#define MOST_BYTES ((size_t)256 << 20)
#define MOST_STEPS 200000000 /* instructions of Lua in one run: a mouth for every frame of a day */
#define HOOK_STEPS 10000
/* Only a fuzzer asks for the lines: counting them makes a replay many times as long. */
#ifdef REPLAY_MAIN
#define HOOK_MASK LUA_MASKCOUNT
#else
#define HOOK_MASK (LUA_MASKLINE | LUA_MASKCOUNT)
#endif

/* ---------------------------------------------------------------- what runs */

/* libFuzzer reads this section as additional counters. */
__attribute__((section("__libfuzzer_extra_counters"))) static uint8_t seen[1 << 16];
static uint32_t before;
static size_t steps;

static void count_steps(lua_State *L) {
  steps += HOOK_STEPS;
  if (steps > MOST_STEPS)
    luaL_error(L, "more than %d steps", MOST_STEPS);
}

static void watch(lua_State *L, lua_Debug *at) {
  if (at->event == LUA_HOOKCOUNT) {
    count_steps(L);
    return;
  }
  lua_getinfo(L, "S", at);
  if (strncmp(at->source, "@celspan/", 9) != 0)
    return;
  uint32_t place = (uint32_t)at->currentline;
  for (const char *c = at->source; *c; c++)
    place = place * 31 + (uint8_t)*c;
  uint8_t *count = &seen[(place ^ before) % sizeof seen];
  *count = (uint8_t)(*count + (*count < 255));
  before = place >> 1;
}

/* ---------------------------------------------------------------- the state */

static void *bounded(void *user, void *block, size_t old_size, size_t new_size) {
  size_t *held = user, old = block ? old_size : 0;
  if (new_size > old && new_size - old > MOST_BYTES - *held)
    return NULL;
  *held = *held - old + new_size;
  if (new_size > 0)
    return realloc(block, new_size);
  free(block);
  return NULL;
}

static void demand_outcome(lua_State *L, int outcome) {
  if (outcome != LUA_OK)
    demand(false, luaL_tolstring(L, -1, NULL));
}

static int trace(lua_State *L) {
  luaL_traceback(L, L, luaL_tolstring(L, 1, NULL), 1);
  return 1;
}

/* The stack of the state: the handler of errors, the function of the script. */
static lua_State *open_state(void) {
  static size_t held;
  lua_State *L = lua_newstate(bounded, &held);
  demand(L, "no Lua state");
  luaL_openlibs(L);
  demand(celspan_lua_open(L, NULL) == CELSPAN_OK, "celspan cannot be opened");
  lua_pushcfunction(L, trace);
  demand_outcome(L, luaL_dostring(L, "package.path = '" TEST_ROOT "/?.lua'"));
  demand_outcome(L, luaL_loadfile(L, TEST_ROOT "/tests/fuzz/" FUZZ_SCRIPT ".lua"));
  demand_outcome(L, lua_pcall(L, 0, 1, 1));
  lua_getfield(L, -1, "try_bytes");
  lua_replace(L, -2);
  lua_sethook(L, watch, HOOK_MASK, HOOK_STEPS);
  return L;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static lua_State *L;
  static int runs;
  if (!L)
    L = open_state();
  before = 0;
  steps = 0;
  lua_pushvalue(L, 2);
  lua_pushlstring(L, size > 0 ? (const char *)data : "", size);
  demand_outcome(L, lua_pcall(L, 1, 0, 1));
  lua_settop(L, 2);
  if (++runs % 16 == 0)
    lua_gc(L, LUA_GCCOLLECT);
  return 0;
}

#ifdef REPLAY_MAIN
#include "tests/fuzz/replay.h"
#endif
