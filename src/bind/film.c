#include "bind/film.h"

#include <lauxlib.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bind/frame.h"
#include "bind/host.h"
#include "bind/module.h"
#include "bind/options.h"
#include "bind/userdata.h"

#define MOST_FRAMES 1000000000 /* half a year of film: numbers stay exact, lists stay possible */
#define MOST_SIDE 1048576

const cs_kind cs_kind_film = {.name = "celspan.film"};

static const char traceback_key = 0; /* an address in the registry */

/* ---------------------------------------------------------------- the value */

static void check_text(const cs_form *form, const char *name) { cs_form_text_or(form, name, NULL); }

static void check_size(const cs_form *form) {
  double size[2];
  if (!cs_form_numbers(form, "size", 2, size))
    return;
  for (int i = 0; i < 2; i++)
    if (!(size[i] >= 1 && size[i] <= MOST_SIDE) || size[i] != floor(size[i]))
      cs_form_fail(form, "field 'size' must hold whole numbers from 1 to %d, got %s", MOST_SIDE,
                   cs_form_digits(form->L, size[i]));
}

static void check_whole(const cs_form *form, const char *name, double least) {
  double number = cs_form_number_or(form, name, least);
  if (!(number >= least && number <= MOST_FRAMES) || number != floor(number))
    cs_form_fail(form, "field '%s' must be a whole number from %s to %d, got %s", name,
                 cs_form_digits(form->L, least), MOST_FRAMES, cs_form_digits(form->L, number));
}

static void check_film(const cs_form *form, cs_userdata *value) {
  lua_State *L = form->L;
  (void)value;
  check_size(form);
  double fps = cs_form_number_or(form, "fps", 24);
  if (!(fps > 0 && fps <= 1e6))
    cs_form_fail(form, "field 'fps' must be above 0 and at most 1000000, got %s",
                 cs_form_digits(form->L, fps));
  double duration = cs_form_number_or(form, "duration", 1);
  if (!(duration > 0 && duration * fps <= MOST_FRAMES))
    cs_form_fail(form, "field 'duration' must be above 0 seconds and at most %d frames, got %s",
                 MOST_FRAMES, cs_form_digits(form->L, duration));
  check_whole(form, "frames", 1);
  check_whole(form, "first", -MOST_FRAMES);
  check_text(form, "title");
  check_text(form, "sound");
  if (!isfinite(cs_form_number_or(form, "sound_offset", 0)))
    cs_form_fail(form, "field 'sound_offset' must be a number of seconds");
  lua_pushliteral(L, "frame");
  if (lua_rawget(L, form->table) != LUA_TFUNCTION)
    cs_form_fail(form, "field 'frame' must be a function(f) that returns a rostrum, got %s",
                 cs_userdata_type(L, -1));
}

/* What was left out: size, and frames from the duration or the other way round. */
static void complete(lua_State *L, int table) {
  if (lua_getfield(L, table, "size") == LUA_TNIL) {
    lua_createtable(L, 2, 0);
    lua_pushinteger(L, 1920);
    lua_rawseti(L, -2, 1);
    lua_pushinteger(L, 1080);
    lua_rawseti(L, -2, 2);
    lua_setfield(L, table, "size");
  }
  lua_getfield(L, table, "fps");
  double fps = lua_tonumber(L, -1), frames = 1;
  if (lua_getfield(L, table, "duration") != LUA_TNIL)
    frames = fmax(1, floor(lua_tonumber(L, -1) * fps + 0.5));
  else if (lua_getfield(L, table, "frames") != LUA_TNIL)
    frames = lua_tonumber(L, -1);
  lua_pushinteger(L, (lua_Integer)frames);
  lua_setfield(L, table, "frames");
  lua_pushnumber(L, frames / fps);
  lua_setfield(L, table, "duration");
  lua_settop(L, table);
}

static const cs_field fields[] = {
    {"size", NULL},  {"fps", "24"},   {"frames", NULL},      {"duration", NULL}, {"first", "1"},
    {"title", NULL}, {"sound", NULL}, {"sound_offset", "0"}, {"frame", NULL},    {0}};
const cs_noun cs_noun_film = {.name = "film",
                              .kind = &cs_kind_film,
                              .fields = fields,
                              .either = {"frames", "duration"},
                              .create = check_film,
                              .complete = complete};

/* film:at(number): what the frame function returns, for tests and tools. */
static int film_at(lua_State *L) {
  cs_userdata_self(L, &cs_kind_film, "at");
  lua_Integer number = luaL_checkinteger(L, 2);
  cs_film_push_frame(L, 1, number);
  return 1;
}

static int constant_frame(lua_State *L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  return 1;
}

void cs_film_push_still(lua_State *L, int rostrum, int32_t width, int32_t height) {
  rostrum = lua_absindex(L, rostrum);
  lua_createtable(L, 0, 2);
  lua_createtable(L, 2, 0);
  lua_pushinteger(L, width);
  lua_rawseti(L, -2, 1);
  lua_pushinteger(L, height);
  lua_rawseti(L, -2, 2);
  lua_setfield(L, -2, "size");
  lua_pushvalue(L, rostrum);
  lua_pushcclosure(L, constant_frame, 1);
  lua_setfield(L, -2, "frame");
  cs_userdata_construct(L, &cs_noun_film, lua_gettop(L));
  lua_remove(L, -2);
}

void cs_open_film(lua_State *L) {
  static const luaL_Reg methods[] = {{"with", cs_userdata_with}, {"at", film_at}, {NULL, NULL}};
  cs_userdata_register(L, &cs_kind_film, methods);
  cs_frame_register(L);
  cs_userdata_push_constructor(L, &cs_noun_film);
  lua_setfield(L, -2, cs_noun_film.name);
}

/* ---------------------------------------------------------------- reading */

static double read_number(lua_State *L, int table, const char *name) {
  lua_getfield(L, table, name);
  double number = lua_tonumber(L, -1);
  lua_pop(L, 1);
  return number;
}

static const char *read_text(lua_State *L, int table, const char *name) {
  lua_getfield(L, table, name);
  const char *text = lua_tostring(L, -1); /* held by the film's fields */
  lua_pop(L, 1);
  return text;
}

void cs_film_read(lua_State *L, int film, cs_film_info *out) {
  lua_getiuservalue(L, film, 1);
  int table = lua_gettop(L);
  lua_getfield(L, table, "size");
  lua_rawgeti(L, -1, 1);
  lua_rawgeti(L, -2, 2);
  *out = (cs_film_info){.width = (int32_t)lua_tonumber(L, -2),
                        .height = (int32_t)lua_tonumber(L, -1),
                        .frames_second = read_number(L, table, "fps"),
                        .first = (int64_t)read_number(L, table, "first"),
                        .count = (int64_t)read_number(L, table, "frames"),
                        .title = read_text(L, table, "title"),
                        .sound = read_text(L, table, "sound"),
                        .sound_offset = read_number(L, table, "sound_offset")};
  lua_settop(L, table - 1);
}

/* ---------------------------------------------------------------- frames */

/* Where "script.lua:12: " ends; 0 when the message does not begin so. */
static size_t position_length(const char *message) {
  for (const char *colon = strchr(message, ':'); colon; colon = strchr(colon + 1, ':')) {
    size_t digits = strspn(colon + 1, "0123456789");
    if (digits && strncmp(colon + 1 + digits, ": ", 2) == 0)
      return (size_t)(colon + 1 + digits + 2 - message);
  }
  return 0;
}

/* Pushes the traceback without the lines of C functions, which mean nothing to a script's author.
 */
static void push_traceback(lua_State *L) {
  luaL_Buffer kept;
  luaL_traceback(L, L, NULL, 2);
  const char *line = lua_tostring(L, -1);
  luaL_buffinit(L, &kept);
  while (*line) {
    size_t length = strcspn(line, "\n");
    length += line[length] == '\n';
    if (!memmem(line, length, "[C]:", 4))
      luaL_addlstring(&kept, line, length);
    line += length;
  }
  luaL_pushresult(&kept);
  lua_remove(L, -2);
}

/* Pushes "script.lua:12: ", where the innermost function that has lines is; "" when none has. */
static void push_position(lua_State *L) {
  lua_Debug info;
  for (int level = 1; lua_getstack(L, level, &info); level++) {
    lua_getinfo(L, "Sl", &info);
    if (info.currentline > 0) {
      lua_pushfstring(L, "%s:%d: ", info.short_src, info.currentline);
      return;
    }
  }
  lua_pushliteral(L, "");
}

/* Message handler: puts "frame 37: " (upvalue 1, may be "") after the position of the message,
 * which it finds out for a message without one, and keeps the traceback. A frame built inside a
 * frame has its name already. */
static int handle_error(lua_State *L) {
  lua_settop(L, 1);
  const char *message = lua_type(L, 1) == LUA_TSTRING ? lua_tostring(L, 1) : NULL;
  if (!message)
    message = lua_pushfstring(L, "the error is not a message: %s", cs_userdata_type(L, 1));
  push_traceback(L);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &traceback_key);
  const char *label = lua_tostring(L, lua_upvalueindex(1));
  if (strstr(message, label))
    label = "";
  size_t position = position_length(message);
  if (position)
    lua_pushlstring(L, message, position);
  else
    push_position(L);
  lua_pushfstring(L, "%s%s", label, message + position);
  lua_concat(L, 2);
  return 1;
}

/* Pushes "script.lua:12: the frame function's result": where the function at index begins, because
 * what it returns has no line of its own. */
static const char *push_result_name(lua_State *L, int function) {
  lua_Debug info;
  lua_pushvalue(L, function);
  lua_getinfo(L, ">S", &info);
  return info.linedefined > 0 ? lua_pushfstring(L, "%s:%d: the frame function's result",
                                                info.short_src, info.linedefined)
                              : lua_pushliteral(L, "the frame function's result");
}

/* frame function, f -> exposures */
static int call_frame(lua_State *L) {
  const char *name = push_result_name(L, 1);
  lua_pushvalue(L, 1);
  lua_pushvalue(L, 2);
  lua_call(L, 1, 1);
  int result = lua_gettop(L);
  celspan_frame_desc desc;
  cs_options_exposures(L, result, name, &desc);
  lua_settop(L, result);
  return 1;
}

/* Pushes exposures or the message; the film at absolute index. */
static int protected_frame(lua_State *L, int film, int64_t number) {
  cs_film_info info;
  cs_film_read(L, film, &info);
  lua_pushfstring(L, "frame %I: ", (LUAI_UACINT)number);
  lua_pushcclosure(L, handle_error, 1);
  int handler = lua_gettop(L);
  lua_pushcfunction(L, call_frame);
  lua_getiuservalue(L, film, 1);
  lua_getfield(L, -1, "frame");
  lua_remove(L, -2);
  cs_frame_push(L, &info, number);
  int outcome = lua_pcall(L, 2, 1, handler);
  lua_remove(L, handler);
  return outcome;
}

void cs_film_push_frame(lua_State *L, int film, int64_t number) {
  if (protected_frame(L, lua_absindex(L, film), number) != LUA_OK)
    lua_error(L);
}

/* ---------------------------------------------------------------- for the command line */

const char *cs_film_traceback(lua_State *L) {
  lua_rawgetp(L, LUA_REGISTRYINDEX, &traceback_key);
  const char *text = lua_tostring(L, -1); /* held by the registry */
  lua_pop(L, 1);
  return text ? text : "";
}

/* Turns the message on top of the stack into the context's sentence, and pops it. */
static celspan_status report(lua_State *L, celspan_status status) {
  const char *message = lua_tostring(L, -1);
  char copy[1024]; /* the message may quote the sentence that is about to be replaced */
  snprintf(copy, sizeof copy, "%s", message ? message : "the error is not a message");
  lua_pop(L, 1);
  return celspan_context_fail(cs_host_context(L), status, "%s", copy);
}

static celspan_status blame(lua_State *L, int outcome) {
  const char *message = lua_tostring(L, -1);
  return outcome == LUA_ERRMEM ? CELSPAN_NO_MEMORY
         : message             ? cs_host_blame(L, message)
                               : CELSPAN_CALLBACK;
}

typedef struct build {
  int64_t number;
  cs_film_frame frame;
  bool is_out_of_memory;
} build;

/* film, light userdata: fills the build. Runs protected. */
static int build_frame(lua_State *L) {
  build *b = lua_touserdata(L, 2);
  cs_film_push_frame(L, 1, b->number);
  celspan_frame_desc desc;
  cs_options_exposures(L, -1, "the frame function's result", &desc);
  size_t size = (desc.exposure_count ? desc.exposure_count : 1) * sizeof(celspan_exposure);
  b->frame.exposures = malloc(size);
  b->is_out_of_memory = !b->frame.exposures;
  if (b->is_out_of_memory)
    return 0;
  for (size_t i = 0; i < desc.exposure_count; i++) {
    b->frame.exposures[i] = desc.exposures[i];
    celspan_rostrum_ref(desc.exposures[i].rostrum);
  }
  b->frame.count = desc.exposure_count;
  return 0;
}

celspan_status cs_film_build(lua_State *L, int film, int64_t number, cs_film_frame *out) {
  film = lua_absindex(L, film);
  build b = {.number = number};
  cs_host_get(L)->failure = CELSPAN_OK;
  if (!lua_checkstack(L, 10))
    return celspan_context_fail(cs_host_context(L), CELSPAN_LIMIT, "Lua's stack is full");
  lua_pushcfunction(L, build_frame);
  lua_pushvalue(L, film);
  lua_pushlightuserdata(L, &b);
  int outcome = lua_pcall(L, 2, 0, 0);
  if (outcome != LUA_OK)
    return report(L, blame(L, outcome));
  if (b.is_out_of_memory)
    return celspan_context_fail(cs_host_context(L), CELSPAN_NO_MEMORY,
                                "not enough memory for the exposures of frame %lld",
                                (long long)number);
  *out = b.frame;
  return CELSPAN_OK;
}

void cs_film_finish_frame(cs_film_frame *frame) {
  for (size_t i = 0; i < frame->count; i++)
    celspan_rostrum_unref(frame->exposures[i].rostrum);
  free(frame->exposures);
  *frame = (cs_film_frame){0};
}

/* Pushes the folder of a path: "" without one. */
static const char *push_folder(lua_State *L, const char *path) {
  const char *slash = strrchr(path, '/');
  if (!slash)
    return lua_pushliteral(L, "");
  return lua_pushlstring(L, path, slash == path ? 1 : (size_t)(slash - path));
}

/* Replaces package[field]: `before`, then what it was without the current directory. */
static void set_path(lua_State *L, const char *field, const char *before, const char *const *here) {
  lua_getglobal(L, "package");
  int package = lua_gettop(L);
  lua_getfield(L, package, field);
  lua_pushfstring(L, ";%s", luaL_optstring(L, -1, ""));
  for (; *here; here++)
    luaL_gsub(L, lua_tostring(L, -1), *here, "");
  const char *rest = lua_tostring(L, -1);
  lua_pushfstring(L, "%s%s", before, before[0] ? rest : rest + (rest[0] == ';'));
  lua_setfield(L, package, field);
  lua_settop(L, package - 1);
}

/* require looks into the script's own folder, then $CELSPAN_PATH, then where Lua is installed;
 * into the current directory only when the script lies there. */
static void set_search_path(lua_State *L, const char *folder) {
  static const char *const here[] = {";./?.lua", ";./?/init.lua", NULL};
  static const char *const here_c[] = {";./?.so", NULL};
  const char *at = folder[0] ? folder : ".", *more = getenv("CELSPAN_PATH");
  const char *before = lua_pushfstring(L, "%s/?.lua;%s/?/init.lua%s%s", at, at,
                                       more && more[0] ? ";" : "", more ? more : "");
  set_path(L, "path", before, here);
  set_path(L, "cpath", "", here_c);
  lua_pop(L, 1);
}

typedef struct script {
  const char *path;
  int argument_count;
  const char *const *arguments;
  bool is_missing;
} script;

/* light userdata -> film. Runs protected. */
static int run_script(lua_State *L) {
  script *s = lua_touserdata(L, 1);
  const char *folder = push_folder(L, s->path);
  cs_host_set_folder(L, folder);
  set_search_path(L, folder);
  int outcome = luaL_loadfilex(L, s->path, "t");
  s->is_missing = outcome == LUA_ERRFILE;
  if (outcome == LUA_ERRSYNTAX && position_length(lua_tostring(L, -1)) == 0)
    return luaL_error(L, "%s: %s", s->path, lua_tostring(L, -1)); /* a compiled chunk */
  if (outcome != LUA_OK)
    return lua_error(L);
  luaL_checkstack(L, s->argument_count + 4, "too many arguments");
  for (int i = 0; i < s->argument_count; i++)
    lua_pushstring(L, s->arguments[i]);
  lua_call(L, s->argument_count, 1);
  if (cs_userdata_test(L, -1, &cs_kind_rostrum))
    cs_film_push_still(L, -1, 1920, 1080);
  if (!cs_userdata_test(L, -1, &cs_kind_film))
    luaL_error(L, "%s must return a film or a rostrum, got %s", s->path, cs_userdata_type(L, -1));
  return 1;
}

celspan_status cs_film_load(lua_State *L, const char *path, int argument_count,
                            const char *const *arguments) {
  script s = {path, argument_count, arguments, false};
  cs_host_get(L)->failure = CELSPAN_OK;
  lua_pushliteral(L, "");
  lua_pushcclosure(L, handle_error, 1);
  int handler = lua_gettop(L);
  lua_pushcfunction(L, run_script);
  lua_pushlightuserdata(L, &s);
  int outcome = lua_pcall(L, 1, 1, handler);
  lua_remove(L, handler);
  if (outcome == LUA_OK)
    return CELSPAN_OK;
  return report(L, s.is_missing ? CELSPAN_INPUT : blame(L, outcome));
}
