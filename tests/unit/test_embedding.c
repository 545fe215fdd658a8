/* celspan/lua.h as a host sees it: films and rostrums of a Lua state as values of the C interface,
 * under the host's context; whatever fails, no error is raised and the stack is unchanged. */
#include "celspan/lua.h"

#include <lauxlib.h>
#include <lualib.h>

#include "tests/support/check.h"
#include "tests/support/memory.h"

static const char FILM[] =
    "local celspan = require 'celspan'\n"
    "local dot = celspan.circle{ centre = {8, 6}, radius = 5, texture = '#fff' }\n"
    "local cel = celspan.cel{ dot }\n"
    "return celspan.film{ size = {16, 12}, fps = 12, first = 5, frames = 4, title = 'Dots',\n"
    "  sound = 'dots.wav', sound_offset = 0.5, frame = function(f)\n"
    "    if f.number == 8 then celspan.circle{ centre = {0, 0}, radius = -1 } end\n"
    "    if f.number == 7 then return { {celspan.rostrum{ cel }, 0.5}, {celspan.rostrum{}, 0.5} } "
    "end\n"
    "    return celspan.rostrum{ cel }\n"
    "end }\n";

static const char STILL[] = "local celspan = require 'celspan'\n"
                            "return celspan.rostrum{ back = '#fff' }\n";

static const char SCANLINE[] =
    "local celspan = require 'celspan'\n"
    "local lines = celspan.scanline{ bounds = {0, 0, 16, 12}, spans = function(y)\n"
    "  return { {0, 16, '#fff'} } end }\n"
    "return celspan.rostrum{ celspan.cel{ lines } }\n";

typedef struct host {
  memory_watch watch;
  celspan_context *context;
  lua_State *L;
} host;

static int no_panic(lua_State *L) {
  CHECK(!"an error left a protected call");
  fprintf(stderr, "%s\n", lua_tostring(L, -1));
  return 0;
}

static void open_host(host *h) {
  *h = (host){.L = luaL_newstate()};
  h->context = memory_watch_context(&h->watch);
  lua_atpanic(h->L, no_panic);
  luaL_openlibs(h->L);
  CHECK(!celspan_lua_context(h->L));
  CHECK(!celspan_lua_rostrum(h->L, LUA_REGISTRYINDEX));
  CHECK(celspan_lua_open(h->L, h->context) == CELSPAN_OK);
  CHECK(celspan_lua_context(h->L) == h->context);
}

static void close_host(host *h) {
  if (h->L)
    lua_close(h->L);
  celspan_context_destroy(h->context);
  CHECK(h->watch.blocks == 0 && h->watch.size_errors == 0);
}

static void run(host *h, const char *script) {
  lua_settop(h->L, 0);
  CHECK(luaL_loadbuffer(h->L, script, strlen(script), "=film") == LUA_OK);
  if (!CHECK(lua_pcall(h->L, 0, 1, 0) == LUA_OK))
    fprintf(stderr, "%s\n", lua_tostring(h->L, -1));
}

/* The alpha in the middle of a frame rendered 16 x 12. */
static int middle(celspan_context *context, celspan_frame_desc *frame) {
  unsigned char pixels[12][16][4] = {0};
  frame->width = 16;
  frame->height = 12;
  frame->workers = 1;
  CHECK(celspan_frame_pixels(context, frame, NULL, pixels, sizeof pixels[0], NULL) == CELSPAN_OK);
  return pixels[6][8][3];
}

static void check_films(void) {
  host h;
  open_host(&h);
  size_t before = h.watch.blocks;
  run(&h, FILM);
  CHECK(h.watch.blocks > before); /* the scene went through the host's function */
  celspan_film film = CELSPAN_FILM;
  CHECK(celspan_lua_film(h.L, -1, &film) == CELSPAN_OK);
  CHECK(film.width == 16 && film.height == 12 && film.frames_second == 12);
  CHECK(film.first == 5 && film.count == 4 && film.sound_offset == 0.5);
  CHECK_TEXT(film.title, "Dots");
  CHECK_TEXT(film.sound, "dots.wav");
  CHECK(!celspan_lua_rostrum(h.L, -1));

  celspan_frame_desc frame = CELSPAN_FRAME_DESC, second = CELSPAN_FRAME_DESC;
  CHECK(celspan_lua_frame(h.L, 1, 5, &frame) == CELSPAN_OK);
  CHECK(frame.exposure_count == 1 && frame.film_width == 16 && frame.width == 16);
  CHECK(celspan_lua_frame(h.L, -1, 7, &second) == CELSPAN_OK);
  CHECK(second.exposure_count == 2 && second.exposures[0].weight == 0.5);
  CHECK(lua_gettop(h.L) == 1);
  lua_close(h.L); /* frames remain valid */
  h.L = NULL;
  CHECK(middle(h.context, &frame) == 255);
  CHECK(middle(h.context, &second) == 128);
  celspan_lua_frame_drop(&frame);
  celspan_lua_frame_drop(&frame);
  celspan_lua_frame_drop(&second);
  close_host(&h);
}

static void check_rostrums(void) {
  host h;
  open_host(&h);
  run(&h, STILL);
  celspan_rostrum *rostrum = celspan_lua_rostrum(h.L, -1);
  celspan_film film = CELSPAN_FILM;
  CHECK(celspan_lua_film(h.L, -1, &film) == CELSPAN_OK);
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  CHECK(rostrum && film.count == 1 && film.width == 1920 && film.height == 1080 && !film.title);
  CHECK(celspan_lua_frame(h.L, -1, 1, &frame) == CELSPAN_OK);
  CHECK(frame.exposures[0].rostrum == rostrum && frame.exposures[0].weight == 1);
  CHECK(middle(h.context, &frame) == 255);
  celspan_lua_frame_drop(&frame);
  CHECK(lua_gettop(h.L) == 1);
  close_host(&h);
}

static void check_procedures(void) {
  host h;
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  open_host(&h);
  run(&h, SCANLINE);
  CHECK(celspan_lua_frame(h.L, -1, 1, &frame) == CELSPAN_OK);
  CHECK(frame.film_width == 1920);
  frame.film_width = 16;
  frame.film_height = 12;
  CHECK(middle(h.context, &frame) == 255);
  celspan_lua_frame_drop(&frame);
  close_host(&h);
}

static void check_faults(void) {
  host h, other;
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  open_host(&h);
  open_host(&other);
  CHECK(celspan_lua_open(h.L, h.context) == CELSPAN_OK);
  CHECK(celspan_lua_open(h.L, NULL) == CELSPAN_OK);
  CHECK(celspan_lua_open(h.L, other.context) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(other.context),
             "celspan is open in this Lua state with another context");

  run(&h, FILM);
  CHECK(celspan_lua_frame(h.L, -1, 9, &frame) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(h.context), "frame 9: the film has frames 5 to 8");
  CHECK(celspan_lua_frame(h.L, -1, INT64_MIN, &frame) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_lua_frame(h.L, -1, INT64_MAX, &frame) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_lua_frame(h.L, -1, 8, &frame) == CELSPAN_BAD_ARGUMENT);
  const char *sentence = celspan_context_error(h.context);
  CHECK(strstr(sentence, "film:6: frame 8: circle: ") == sentence);
  CHECK(!frame.exposures && lua_gettop(h.L) == 1);

  lua_pushinteger(h.L, 12);
  celspan_film none = CELSPAN_FILM;
  CHECK(celspan_lua_film(h.L, -1, &none) == CELSPAN_BAD_ARGUMENT && none.count == 0);
  CHECK_TEXT(celspan_context_error(h.context), "a film or a rostrum is needed, got number");
  CHECK(!celspan_lua_rostrum(h.L, -1));
  CHECK(celspan_lua_frame(h.L, -1, 1, &frame) == CELSPAN_BAD_ARGUMENT);
  CHECK(lua_gettop(h.L) == 2);
  close_host(&h);
  close_host(&other);
}

/* The memory of a Lua state, which runs out from some allocation on. */
typedef struct lua_memory {
  size_t made, fails_from;
} lua_memory;

static void *allocate(void *user, void *block, size_t old_size, size_t new_size) {
  lua_memory *memory = user;
  if (new_size == 0) {
    free(block);
    return NULL;
  }
  if (block && new_size <= old_size)
    return realloc(block, new_size);
  return ++memory->made > memory->fails_from ? NULL : realloc(block, new_size);
}

/* ---------------------------------------------------------------- the sandbox */

static int shown(lua_State *L) {
  lua_pushliteral(L, "by the host");
  return 1;
}

/* Calls a text within the limits: the first words of what went wrong, or its result. */
static const char *call(host *h, const char *text, celspan_status status) {
  lua_settop(h->L, 0);
  CHECK(luaL_loadbuffer(h->L, text, strlen(text), "=film") == LUA_OK);
  CHECK(celspan_lua_call(h->L, 0, 1) == status);
  CHECK(lua_gettop(h->L) == (status == CELSPAN_OK));
  return status == CELSPAN_OK ? lua_tostring(h->L, 1) : celspan_context_error(h->context);
}

static void check_refusals(host *h) {
  celspan_lua_limits limits = CELSPAN_LUA_LIMITS;
  limits.struct_size = 7;
  CHECK(celspan_lua_sandbox(h->L, &limits) == CELSPAN_BAD_ARGUMENT);
  limits = CELSPAN_LUA_LIMITS;
  limits.seconds = -1;
  CHECK(celspan_lua_sandbox(h->L, &limits) == CELSPAN_BAD_ARGUMENT);
  limits.seconds = 1;
  limits.folder_count = 1;
  CHECK(celspan_lua_sandbox(h->L, &limits) == CELSPAN_BAD_ARGUMENT);
}

static void check_sandbox(void) {
  host h;
  celspan_lua_limits limits = CELSPAN_LUA_LIMITS;
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  open_host(&h);
  run(&h, "kept = require 'celspan.ease' return 1"); /* before, with the whole of Lua */
  check_refusals(&h);
  limits.steps = 20000000;
  limits.memory = (size_t)8 << 20;
  CHECK(celspan_lua_sandbox(h.L, &limits) == CELSPAN_OK);
  CHECK(celspan_lua_sandbox(h.L, &limits) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(h.context), "sandbox: the Lua state has one already");
  lua_register(h.L, "shown", shown);

  CHECK_TEXT(call(&h, "return shown()", CELSPAN_OK), "by the host");
  CHECK_TEXT(call(&h, "return type(kept) .. #('x'):rep(9)", CELSPAN_OK), "nil9");
  CHECK_TEXT(call(&h, "return io", CELSPAN_CALLBACK), "film:1: io is not in the sandbox");
  CHECK_TEXT(call(&h, "local function turn() while true do end end turn()", CELSPAN_LIMIT),
             "film:1: more than 20000000 steps in a frame");
  CHECK_TEXT(call(&h, "return ('x'):rep(15000000)", CELSPAN_LIMIT),
             "film:1: the script needs more than 8 MiB");
  call(&h, FILM, CELSPAN_OK);
  CHECK(celspan_lua_frame(h.L, -1, 5, &frame) == CELSPAN_OK);
  CHECK(middle(h.context, &frame) == 255);
  celspan_lua_frame_drop(&frame);
  CHECK(celspan_lua_call(h.L, 4, 1) == CELSPAN_BAD_ARGUMENT);
  close_host(&h);
}

/* The context of the state ends before the last block of the state is freed. */
static void check_own_context(void) {
  lua_State *L = luaL_newstate();
  luaL_openlibs(L);
  CHECK(celspan_lua_sandbox(L, NULL) == CELSPAN_BAD_ARGUMENT); /* celspan is not open */
  CHECK(celspan_lua_open(L, NULL) == CELSPAN_OK);
  CHECK(celspan_lua_sandbox(L, NULL) == CELSPAN_OK);
  CHECK(luaL_loadstring(L, FILM) == LUA_OK && celspan_lua_call(L, 0, 1) == CELSPAN_OK);
  lua_close(L);
}

/* ---------------------------------------------------------------- memory */

/* Uses everything once, with `lua` more allocations of Lua allowed, or failing the context's
 * `core`-th allocation; true if nothing failed. (Without memory to record the line where a value
 * was made, the value is made nevertheless.) */
static bool visit(size_t lua, size_t core, bool is_sandboxed) {
  lua_memory memory = {.fails_from = (size_t)-1};
  host h = {.L = lua_newstate(allocate, &memory)};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  h.context = memory_watch_context(&h.watch);
  lua_atpanic(h.L, no_panic);
  luaL_openlibs(h.L);
  CHECK(luaL_loadstring(h.L, FILM) == LUA_OK);
  memory.fails_from = memory.made + lua;
  h.watch.fail_at = core ? h.watch.allocations + core : 0;
  celspan_status status = celspan_lua_open(h.L, h.context);
  if (status == CELSPAN_OK && is_sandboxed)
    status = celspan_lua_sandbox(h.L, NULL);
  if (status == CELSPAN_OK && lua_pcall(h.L, 0, 1, 0) == LUA_OK) {
    celspan_film film = CELSPAN_FILM;
    status = celspan_lua_film(h.L, -1, &film);
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    status = celspan_lua_frame(h.L, -1, film.count ? film.first : 5, &frame);
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    CHECK(lua_gettop(h.L) == 1);
  } else
    status = CELSPAN_NO_MEMORY;
  celspan_lua_frame_drop(&frame);
  memory.fails_from = (size_t)-1;
  bool has_failed = core && h.watch.allocations >= h.watch.fail_at;
  close_host(&h);
  return status == CELSPAN_OK && !has_failed;
}

static void check_memory(bool is_sandboxed) {
  size_t lua = 0, core = 1;
  while (lua < 100000 && !visit(lua, 0, is_sandboxed))
    lua += lua < 200 ? 1 : is_sandboxed ? 29 : 7;
  while (core < 1000 && !visit((size_t)1 << 40, core, is_sandboxed))
    core++;
  CHECK(lua > 100 && lua < 100000);
  CHECK(core > 5 && core < 1000);
}

int main(void) {
  check_films();
  check_rostrums();
  check_procedures();
  check_faults();
  check_sandbox();
  check_own_context();
  check_memory(false);
  check_memory(true);
  return check_done();
}
