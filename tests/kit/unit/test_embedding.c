/* celspan/lua.h as a host sees it: films and rostrums of a Lua state as values of the C interface,
 * under the host's context; whatever fails, no error is raised and the stack is unchanged. */
#include "celspan/lua.h"

#include <lauxlib.h>
#include <lualib.h>
#include <math.h>
#include <unistd.h>

#include "tests/support/check.h"
#include "tests/support/memory.h"

static const char FILM[] =
    "local celspan = require 'celspan'\n"
    "local dot = celspan.circle{ centre = {8, 6}, radius = 5, texture = '#fff' }\n"
    "local cel = celspan.cel{ dot }\n"
    "return celspan.film{ size = {16, 12}, fps = 12, first = 5, frames = 4, title = 'Dots',\n"
    "  sound = 'dots.wav', sound_offset = 0.5, marks = { start = 5, [\"end\"] = {7, 8} },\n"
    "  frame = function(f)\n"
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

/* ---------------------------------------------------------------- hosts */

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

/* ---------------------------------------------------------------- films */

static void check_films(void) {
  host h;
  open_host(&h);
  size_t before = h.watch.blocks;
  run(&h, FILM);
  CHECK(h.watch.blocks > before); /* the scene went through the host's function */
  celspan_film film = CELSPAN_FILM;
  CHECK(celspan_lua_film(h.L, -1, &film) == CELSPAN_OK);
  CHECK(film.width == 16 && film.height == 12 && film.frames_second == 12);
  CHECK(film.first == 5 && film.count == 4 && film.mark_count == 2);
  CHECK_TEXT(film.title, "Dots");
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

static void check_marks(void) {
  host h;
  celspan_mark mark = CELSPAN_MARK;
  open_host(&h);
  run(&h, FILM);
  CHECK(celspan_lua_mark(h.L, -1, 0, &mark) == CELSPAN_OK);
  CHECK(mark.first == 5 && mark.last == 6);
  CHECK_TEXT(mark.name, "start");
  CHECK(celspan_lua_mark(h.L, -1, 1, &mark) == CELSPAN_OK && mark.first == 7 && mark.last == 8);
  CHECK_TEXT(mark.name, "end");
  CHECK(celspan_lua_mark(h.L, -1, 2, &mark) == CELSPAN_BAD_ARGUMENT && mark.first == 7);
  CHECK_TEXT(celspan_context_error(h.context), "mark 2: the film has 2");
  CHECK(celspan_lua_mark(h.L, -1, SIZE_MAX, &mark) == CELSPAN_BAD_ARGUMENT);
  mark.struct_size = 0; /* as it is without CELSPAN_MARK */
  CHECK(celspan_lua_mark(h.L, -1, 0, &mark) == CELSPAN_BAD_ARGUMENT && mark.first == 7);
  CHECK_TEXT(celspan_context_error(h.context),
             "mark: struct_size of the result is 0: begin with celspan_mark_initial, or set it to "
             "sizeof(celspan_mark), which is 32");
  mark.struct_size = offsetof(celspan_mark, last); /* of an earlier header */
  mark.last = 99;
  CHECK(celspan_lua_mark(h.L, -1, 0, &mark) == CELSPAN_OK && mark.first == 5 && mark.last == 99);
  CHECK(lua_gettop(h.L) == 1);
  run(&h, STILL);
  CHECK(celspan_lua_mark(h.L, -1, 0, &mark) == CELSPAN_BAD_ARGUMENT);
  close_host(&h);
}

/* A film whose sound is a film, four times as fast from second 10 on. */
static const char SOUNDS[] =
    "local celspan = require 'celspan'\n"
    "local function still() return celspan.rostrum{} end\n"
    "local shot = celspan.film{ duration = 8, frame = still,\n"
    "  sound = { '/none/a.wav', at = 2, from = 1, to = 5, gain = 0.5, fade = {1, 0}, pan = -1 } }\n"
    "return celspan.film{ duration = 20, frame = still, sound_offset = 10, sound = {\n"
    "  { shot, at = 0, speed = 4 },\n"
    "  { '/none/b.wav', name = 'b', under = 'voice', duck_depth = 20 },\n"
    "  { '/none/c.wav', name = 'voice' } } }\n";

static void check_sounds(void) {
  host h;
  size_t count = 9;
  celspan_sound sound = CELSPAN_SOUND;
  open_host(&h);
  run(&h, SOUNDS);
  CHECK(celspan_lua_sounds(h.L, 1, &count) == CELSPAN_OK && count == 3 && lua_gettop(h.L) == 2);
  lua_remove(h.L, 1); /* the sounds outlive the film */
  lua_gc(h.L, LUA_GCCOLLECT);
  CHECK(celspan_lua_sound(h.L, -1, 0, &sound) == CELSPAN_OK);
  CHECK_TEXT(sound.path, "/none/a.wav");
  CHECK(sound.start == 10.25 && sound.speed == 4 && sound.duckers && sound.ducker_count == 0);
  CHECK(sound.gain[0] > 0.7 && sound.gain[0] < 0.71 && sound.gain[1] < 1e-9);
  CHECK(sound.passage_count == 2 && sound.passages[0].begin == 10.5);
  CHECK(sound.passages[0].end == 11.5 && sound.passages[0].fade_in == 0.25);
  CHECK(celspan_lua_sound(h.L, -1, 1, &sound) == CELSPAN_OK && sound.ducker_count == 1);
  CHECK(sound.duckers[0].sound == 2 && sound.duckers[0].gain == 0.1 && sound.start == 10);
  CHECK(isinf(sound.passages[0].end));
  CHECK(celspan_lua_sound(h.L, -1, 3, &sound) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(h.context), "sound 3: the film has 3");
  sound.struct_size = 12;
  CHECK(celspan_lua_sound(h.L, -1, 0, &sound) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_lua_sounds(h.L, -1, &count) == CELSPAN_BAD_ARGUMENT && count == 3);
  CHECK(lua_gettop(h.L) == 1);
  run(&h, STILL);
  CHECK(celspan_lua_sound(h.L, -1, 0, &sound) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(h.context),
             "sounds are needed, as celspan_lua_sounds pushes them");
  CHECK(celspan_lua_sounds(h.L, -1, NULL) == CELSPAN_OK && lua_gettop(h.L) == 2);
  CHECK(celspan_lua_sound(h.L, -1, 0, &sound) == CELSPAN_BAD_ARGUMENT);
  close_host(&h);
}

/* ---------------------------------------------------------------- rostrums */

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

static void check_unready_states(void) {
  memory_watch watch = {0};
  celspan_context *context = memory_watch_context(&watch);
  lua_State *L = luaL_newstate();
  CHECK(celspan_lua_run(L, "film.lua", 0, NULL) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_lua_sandbox(L, NULL) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(celspan_lua_context(L)),
             "there is no context: celspan_context_create makes one, and celspan_lua_open opens "
             "celspan in a Lua state");
  CHECK(celspan_lua_open(L, context) == CELSPAN_OK);
  CHECK(celspan_lua_run(L, "scripts/booleans.lua", 0, NULL) == CELSPAN_CALLBACK);
  CHECK_TEXT(celspan_context_error(context),
             "the Lua state has no library 'package', with which scripts find celspan: call "
             "luaL_openlibs or celspan_lua_sandbox before celspan_lua_run");
  CHECK(lua_gettop(L) == 0);
  lua_close(L);
  celspan_context_destroy(context);
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
  CHECK(strstr(sentence, "film:7: frame 8: circle: ") == sentence);
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

/* ---------------------------------------------------------------- texts */

/* The status of a text as a script; what it left on the stack is removed. */
static celspan_status run_text(host *h, const char *name, const char *text) {
  int top = lua_gettop(h->L);
  celspan_status status =
      celspan_lua_run_text(h->L, name, text, text ? strlen(text) : 0, 1, (const char *[]){"7"});
  CHECK(lua_gettop(h->L) == top + (status == CELSPAN_OK));
  lua_settop(h->L, top);
  return status;
}

/* A text finds the modules of the folder in its name. */
static void check_beside(host *h) {
  static const char text[] = "require 'paper' return rostrum { back = white }";
  char folder[] = "/tmp/celspan-embedding-XXXXXX", module[64], name[64];
  CHECK(mkdtemp(folder));
  snprintf(module, sizeof module, "%s/paper.lua", folder);
  snprintf(name, sizeof name, "%s/none.lua", folder);
  FILE *file = fopen(module, "w");
  CHECK(file && fputs("return 1", file) >= 0 && fclose(file) == 0);
  CHECK(run_text(h, "none.lua", text) == CELSPAN_CALLBACK);
  CHECK(run_text(h, name, text) == CELSPAN_OK);
  CHECK(unlink(module) == 0 && rmdir(folder) == 0);
}

/* A text has the name, the folder and the arguments that it is given. */
static void check_texts(bool is_sandboxed) {
  host h;
  open_host(&h);
  if (is_sandboxed)
    CHECK(celspan_lua_sandbox(h.L, NULL) == CELSPAN_OK);
  CHECK(run_text(&h, "no/such/film.lua", "assert(... == '7') return rostrum { back = white }") ==
        CELSPAN_OK);
  CHECK(run_text(&h, "a.lua", "\n\nerror 'x'") == CELSPAN_CALLBACK);
  CHECK_TEXT(celspan_context_error(h.context), "a.lua:3: x");
  check_beside(&h);
  CHECK(run_text(&h, "block 3", "return 7") == CELSPAN_CALLBACK);
  CHECK_TEXT(celspan_context_error(h.context),
             "block 3 must return a film or a rostrum, got number");
  CHECK(run_text(&h, "film.lua", NULL) == CELSPAN_BAD_ARGUMENT);
  CHECK(run_text(&h, NULL, STILL) == CELSPAN_BAD_ARGUMENT);
  close_host(&h);
}

/* ---------------------------------------------------------------- parameters */

static const char PARAMETERS[] =
    "local p = require 'celspan'.parameters{ title = 'Hello', side = {'left', 'right'},\n"
    "  speed = {1, min = 0, about = 'Widths in a second'}, on = true, tint = {colour = "
    "'#f26419'},\n"
    "  take = {file = 'a.wav'} }\n"
    "seen = table.concat({ p.title, p.side, p.speed, tostring(p.on), p.tint, p.take }, ' ')\n"
    "return require 'celspan'.rostrum{}\n";

/* Runs the film of a file; its status. What it left on the stack is removed. */
static celspan_status run_file(host *h, const char *path, const char *text) {
  FILE *file = fopen(path, "w");
  CHECK(file && fputs(text, file) >= 0 && fclose(file) == 0);
  int top = lua_gettop(h->L);
  celspan_status status = celspan_lua_run(h->L, path, 0, NULL);
  CHECK(lua_gettop(h->L) == top + (status == CELSPAN_OK));
  lua_settop(h->L, top);
  return status;
}

static void check_seen(host *h, const char *expected) {
  CHECK(lua_getglobal(h->L, "seen") == LUA_TSTRING);
  CHECK_TEXT(lua_tostring(h->L, -1), expected);
  lua_pop(h->L, 1);
}

static celspan_parameter parameter_at(host *h, size_t place) {
  celspan_parameter parameter = CELSPAN_PARAMETER;
  CHECK(celspan_lua_parameter(h->L, place, &parameter) == CELSPAN_OK);
  return parameter;
}

static void check_listed(host *h) {
  celspan_parameter one = CELSPAN_PARAMETER;
  CHECK(celspan_lua_parameter_count(h->L) == 6); /* on, side, speed, take, tint, title */
  one = parameter_at(h, 0);
  CHECK(one.kind == CELSPAN_PARAMETER_BOOLEAN && one.number == 1 && !one.about && !one.choices);
  CHECK_TEXT(one.text, "true");
  one = parameter_at(h, 1);
  CHECK(one.kind == CELSPAN_PARAMETER_CHOICE && one.choice_count == 2);
  CHECK(one.choices == parameter_at(h, 1).choices); /* kept, so the first answer stays valid */
  CHECK_TEXT(one.choices[1], "right");
  one = parameter_at(h, 2);
  CHECK(one.kind == CELSPAN_PARAMETER_NUMBER && one.number == 1 && one.least == 0);
  CHECK(isinf(one.most) && one.most > 0);
  CHECK_TEXT(one.name, "speed");
  CHECK_TEXT(one.about, "Widths in a second");
  CHECK(parameter_at(h, 3).kind == CELSPAN_PARAMETER_FILE);
  CHECK(parameter_at(h, 4).kind == CELSPAN_PARAMETER_COLOUR);
  CHECK(parameter_at(h, 5).kind == CELSPAN_PARAMETER_TEXT);
  CHECK(celspan_lua_parameter(h->L, 6, &one) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(h->context), "parameter 6: the script has 6");
  one.struct_size = 1;
  CHECK(celspan_lua_parameter(h->L, 0, &one) == CELSPAN_BAD_ARGUMENT);
}

static void check_wrong_values(host *h, const char *path) {
  static const char *const wrong[][3] = {
      {"speed", "-1", "set: speed is '-1'; it must be a number of 0 or more"},
      {"side", "", "set: side is ''; it must be one of left, right"},
      {"sped", "2", "set: the script has no parameter 'sped'; did you mean 'speed'?"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    CHECK(celspan_lua_set(h->L, wrong[i][0], wrong[i][1]) == CELSPAN_OK);
    CHECK(run_file(h, path, PARAMETERS) == CELSPAN_BAD_ARGUMENT);
    CHECK_TEXT(celspan_context_error(h->context), wrong[i][2]);
  }
  CHECK(celspan_lua_set(h->L, NULL, "1") == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_lua_set(h->L, "speed", NULL) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(h->context), "set: the value is missing");
  CHECK(run_file(h, path, PARAMETERS) == CELSPAN_OK); /* each value was for one run */
  CHECK(celspan_lua_set(h->L, "a", "1") == CELSPAN_OK);
  CHECK(run_file(h, path, STILL) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(h->context),
             "set: the script declares no parameters (celspan.parameters)");
  CHECK(celspan_lua_parameter_count(h->L) == 0);
}

static void check_parameters(bool is_sandboxed) {
  host h;
  char path[] = "/tmp/celspan-embedding-XXXXXX";
  open_host(&h);
  int file = mkstemp(path);
  CHECK(file >= 0 && close(file) == 0);
  CHECK(celspan_lua_parameter_count(h.L) == 0);
  if (is_sandboxed)
    CHECK(celspan_lua_sandbox(h.L, NULL) == CELSPAN_OK);
  CHECK(run_file(&h, path, PARAMETERS) == CELSPAN_OK);
  check_seen(&h, "Hello left 1 true #f26419 a.wav");
  check_listed(&h);
  CHECK(celspan_lua_set(h.L, "speed", "7") == CELSPAN_OK);
  CHECK(celspan_lua_set(h.L, "side", "right") == CELSPAN_OK);
  CHECK(celspan_lua_set(h.L, "speed", "2.5") == CELSPAN_OK);
  CHECK(celspan_lua_set(h.L, "on", "no") == CELSPAN_OK);
  CHECK(run_file(&h, path, PARAMETERS) == CELSPAN_OK);
  check_seen(&h, "Hello right 2.5 false #f26419 a.wav");
  check_wrong_values(&h, path);
  unlink(path);
  close_host(&h);
}

/* Nothing is asked of a state without celspan, or of one that is closed. */
static void check_no_celspan(void) {
  lua_State *L = luaL_newstate();
  celspan_parameter parameter = CELSPAN_PARAMETER;
  celspan_mark mark = CELSPAN_MARK;
  celspan_sound sound = CELSPAN_SOUND;
  lua_pushinteger(L, 1);
  CHECK(celspan_lua_set(L, "a", "1") == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_lua_parameter_count(L) == 0);
  CHECK(celspan_lua_parameter(L, 0, &parameter) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_lua_mark(L, 1, 0, &mark) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_lua_sounds(L, 1, NULL) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_lua_sound(L, 1, 0, &sound) == CELSPAN_BAD_ARGUMENT && lua_gettop(L) == 1);
  lua_close(L);
}

/* ---------------------------------------------------------------- calls */

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
  CHECK_TEXT(call(&h, "return os", CELSPAN_CALLBACK), "film:1: os is not in the sandbox");
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

/* Gives a value, and reads a sound of the film on top of the stack, whose file a sandbox does not
 * let it look for. */
static celspan_status ask(host *h, bool is_sandboxed) {
  celspan_sound sound = CELSPAN_SOUND;
  celspan_status status = celspan_lua_set(h->L, "a", "1");
  if (status == CELSPAN_OK && !is_sandboxed)
    status = celspan_lua_sounds(h->L, -1, NULL);
  if (status != CELSPAN_OK || is_sandboxed)
    return status;
  status = celspan_lua_sound(h->L, -1, 0, &sound);
  lua_pop(h->L, 1);
  return status;
}

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
  /* Collected while there is no memory, a value is lost with what it holds: Lua cannot call its
   * finalizer then, and only warns. */
  lua_gc(h.L, LUA_GCSTOP);
  CHECK(luaL_loadstring(h.L, FILM) == LUA_OK);
  memory.fails_from = memory.made + lua;
  h.watch.fail_at = core ? h.watch.allocations + core : 0;
  celspan_status status = celspan_lua_open(h.L, h.context);
  if (status == CELSPAN_OK && is_sandboxed)
    status = celspan_lua_sandbox(h.L, NULL);
  if (status == CELSPAN_OK && lua_pcall(h.L, 0, 1, 0) == LUA_OK) {
    celspan_film film = CELSPAN_FILM;
    celspan_mark mark = CELSPAN_MARK;
    status = celspan_lua_film(h.L, -1, &film);
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    if (status == CELSPAN_OK)
      status = celspan_lua_mark(h.L, -1, 1, &mark);
    if (status == CELSPAN_OK)
      status = ask(&h, is_sandboxed);
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    bool is_asked = status == CELSPAN_OK;
    status = celspan_lua_frame(h.L, -1, film.count ? film.first : 5, &frame);
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    CHECK(lua_gettop(h.L) == 1);
    status = is_asked ? status : CELSPAN_NO_MEMORY;
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
  check_marks();
  check_sounds();
  check_texts(false);
  check_texts(true);
  check_parameters(false);
  check_parameters(true);
  check_no_celspan();
  check_rostrums();
  check_procedures();
  check_faults();
  check_unready_states();
  check_sandbox();
  check_own_context();
  check_memory(false);
  check_memory(true);
  return check_done();
}
