#include "bind/lua_film.h"

#include <lauxlib.h>
#include <math.h>

#include "bind/caller.h"
#include "bind/construct.h"
#include "bind/files.h"
#include "bind/host.h"
#include "bind/lua_error.h"
#include "bind/lua_frame.h"
#include "bind/openers.h"
#include "bind/options.h"
#include "bind/userdata.h"

#define MOST_FRAMES 1000000000 /* half a year of film: numbers stay exact, lists stay possible */
#define MOST_SIDE 1048576

enum { SOUND_FOLDER = 2 }; /* the user value with the folder of the file that named the sound */

const cs_kind cs_kind_film = {.name = "celspan.film", .kept = 1};

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
  int film = lua_gettop(L);
  (void)value;
  if (cs_caller_push_folder(L))
    lua_setiuservalue(L, film, SOUND_FOLDER);
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
  const char *sound = cs_form_text_or(form, "sound", NULL);
  if (sound && !sound[0])
    cs_form_fail(form, "field 'sound' must be the name of a file, got an empty text");
  double offset = cs_form_number_or(form, "sound_offset", 0);
  if (!(fabs(offset) <= MOST_FRAMES))
    cs_form_fail(form, "field 'sound_offset' must be from -%d to %d seconds, got %s", MOST_FRAMES,
                 MOST_FRAMES, cs_form_digits(form->L, offset));
  lua_pushliteral(L, "frame");
  if (lua_rawget(L, form->table) != LUA_TFUNCTION)
    cs_form_fail(form, "field 'frame' must be a function(f) that returns a rostrum, got %s",
                 cs_userdata_type(L, -1));
}

/* Adds what was left out: the size, and the number of frames from the duration or the other way
 * round.
 */
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
  cs_film_info film;
  cs_lua_film_read(L, 1, &film);
  double number = cs_form_argument(L, 2, "at", "the frame's number"),
         last = (double)(film.first + film.count - 1);
  if (!(number >= (double)film.first && number <= last) || number != floor(number))
    return cs_caller_error(L, "at: the frame's number must be a whole number from %s to %s, got %s",
                           cs_form_digits(L, (double)film.first), cs_form_digits(L, last),
                           cs_form_digits(L, number));
  cs_lua_film_push_frame(L, 1, (int64_t)number);
  return 1;
}

/* A sound that is not named anew stays where it is. */
static int film_with(lua_State *L) {
  cs_construct_with(L);
  if (lua_getfield(L, 2, "sound") == LUA_TNIL) {
    lua_getiuservalue(L, 1, SOUND_FOLDER);
    lua_setiuservalue(L, -3, SOUND_FOLDER);
  }
  lua_pop(L, 1);
  return 1;
}

static int constant_frame(lua_State *L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  return 1;
}

void cs_lua_film_push_still(lua_State *L, int rostrum, int32_t width, int32_t height) {
  rostrum = lua_absindex(L, rostrum);
  lua_createtable(L, 0, 2);
  int form = lua_gettop(L);
  if (lua_getfield(L, rostrum, "size") == LUA_TNIL) {
    lua_createtable(L, 2, 0);
    lua_pushinteger(L, width);
    lua_rawseti(L, -2, 1);
    lua_pushinteger(L, height);
    lua_rawseti(L, -2, 2);
  }
  lua_setfield(L, form, "size");
  lua_settop(L, form);
  lua_pushvalue(L, rostrum);
  lua_pushcclosure(L, constant_frame, 1);
  lua_setfield(L, -2, "frame");
  cs_construct_value(L, &cs_noun_film, lua_gettop(L));
  lua_remove(L, -2);
}

bool cs_lua_film_push(lua_State *L, int index) {
  if (cs_userdata_test(L, index, &cs_kind_film))
    lua_pushvalue(L, index);
  else if (cs_userdata_test(L, index, &cs_kind_rostrum))
    cs_lua_film_push_still(L, index, 1920, 1080);
  else
    return false;
  return true;
}

void cs_open_film(lua_State *L) {
  static const luaL_Reg methods[] = {{"with", film_with}, {"at", film_at}, {NULL, NULL}};
  cs_userdata_register(L, &cs_kind_film, methods);
  cs_lua_frame_register(L);
  cs_construct_push(L, &cs_noun_film);
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
  const char *text = lua_tostring(L, -1); /* the film's fields keep it alive */
  lua_pop(L, 1);
  return text;
}

void cs_lua_film_read(lua_State *L, int film, cs_film_info *out) {
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

/* film -> path, tried. Runs protected. */
static int find_sound(lua_State *L) {
  const char *tried;
  lua_getiuservalue(L, 1, 1);
  lua_getiuservalue(L, 1, SOUND_FOLDER);
  const char *folder = lua_tostring(L, -1);
  if (lua_getfield(L, 2, "sound") == LUA_TNIL)
    lua_pushnil(L);
  else
    cs_files_find_from(L, folder, lua_tostring(L, -1), &tried);
  return 2;
}

celspan_status cs_lua_film_push_sound(lua_State *L, int film) {
  film = lua_absindex(L, film);
  if (!lua_checkstack(L, 4))
    return celspan_context_fail(cs_host_context(L), CELSPAN_LIMIT, "Lua's stack is full");
  lua_pushcfunction(L, find_sound);
  lua_pushvalue(L, film);
  int outcome = lua_pcall(L, 1, 2, 0);
  return outcome == LUA_OK ? CELSPAN_OK : cs_lua_error_report(L, outcome);
}

/* ---------------------------------------------------------------- frames */

/* Pushes "script.lua:12: the frame function's result". */
static const char *push_result_name(lua_State *L, int function) {
  cs_caller_push_function(L, function);
  lua_pushliteral(L, "the frame function's result");
  lua_concat(L, 2);
  return lua_tostring(L, -1);
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

/* Pushes the exposures, or the message; the answer is that of lua_pcall. film: an absolute index.
 */
static int protected_frame(lua_State *L, int film, int64_t number) {
  cs_film_info info;
  cs_lua_film_read(L, film, &info);
  const char *label = lua_pushfstring(L, "frame %I: ", (LUAI_UACINT)number);
  cs_lua_error_push_handler(L, label, call_frame);
  lua_remove(L, -2);
  int handler = lua_gettop(L);
  lua_pushcfunction(L, call_frame);
  lua_getiuservalue(L, film, 1);
  lua_getfield(L, -1, "frame");
  lua_remove(L, -2);
  cs_lua_frame_push(L, &info, number);
  cs_host_begin(L, CS_HOST_FRAME, number);
  int outcome = lua_pcall(L, 2, 1, handler);
  cs_host_end(L);
  lua_remove(L, handler);
  return outcome;
}

void cs_lua_film_push_frame(lua_State *L, int film, int64_t number) {
  if (protected_frame(L, lua_absindex(L, film), number) != LUA_OK)
    lua_error(L);
}

/* One frame that is asked for from outside of Lua. */
typedef struct request {
  int64_t number;
  cs_film_frame frame;
  celspan_status status; /* of the core, when it could not take the exposures */
} request;

/* film, light userdata: fills the request. Runs protected. */
static int build_frame(lua_State *L) {
  request *r = lua_touserdata(L, 2);
  cs_lua_film_push_frame(L, 1, r->number);
  celspan_frame_desc desc;
  cs_options_exposures(L, -1, "the frame function's result", &desc);
  r->status =
      cs_film_frame_init(&r->frame, cs_host_context(L), desc.exposures, desc.exposure_count);
  return 0;
}

celspan_status cs_lua_film_build(lua_State *L, int film, int64_t number, cs_film_frame *out) {
  film = lua_absindex(L, film);
  request r = {.number = number, .status = CELSPAN_OK};
  cs_host_get(L)->failure = CELSPAN_OK;
  if (!lua_checkstack(L, 10))
    return celspan_context_fail(cs_host_context(L), CELSPAN_LIMIT, "Lua's stack is full");
  lua_pushcfunction(L, build_frame);
  lua_pushvalue(L, film);
  lua_pushlightuserdata(L, &r);
  int outcome = lua_pcall(L, 2, 0, 0);
  if (outcome != LUA_OK)
    return cs_lua_error_report(L, outcome);
  if (r.status == CELSPAN_OK)
    *out = r.frame;
  return r.status;
}
