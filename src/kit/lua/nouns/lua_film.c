#include "lua/nouns/lua_film.h"
#include "lua/nouns/grain.h"

#include <lauxlib.h>
#include <math.h>
#include <string.h>

#include "inside/films.h"
#include "lua/bind/caller.h"
#include "lua/bind/construct.h"
#include "lua/bind/fields.h"
#include "lua/bind/files.h"
#include "lua/bind/host.h"
#include "lua/bind/list.h"
#include "lua/bind/lua_error.h"
#include "lua/bind/put.h"
#include "lua/bind/require.h"
#include "lua/bind/take.h"
#include "lua/nouns/nouns.h"
#include "lua/nouns/random.h"
#include "lua/nouns/shown.h"
#include "lua/nouns/sounds.h"
#include "lua/nouns/space.h"

/* half a year of film: numbers of frames are exact, and lists of frames are possible */
#define MOST_FRAMES 1000000000
#define MOST_SIDE 1048576

/* User values: the folder of the file that named the sounds, and the marks (sounds.h). */
enum { SOUND_FOLDER = 2, MARKS = 3 };

/* ---------------------------------------------------------------- the value */

/* The fields while they are checked; the value keeps the table with them. */
typedef struct film_form {
  int32_t size[2];
  double fps, duration, sound_offset;
  int frames, first;
  const char *title;
  cs_own_space space;
  celspan_texture *background;
} film_form;

static int64_t count_frames(const film_form *film) {
  return film->duration > 0 ? (int64_t)fmax(1, floor(film->duration * film->fps + 0.5))
                            : film->frames;
}

/* Reads a frame of a film: its number, or a time such as "2s". false: it is neither. */
static bool read_poster(lua_State *L, int index, const cs_film_info *film, int64_t *out) {
  if (lua_type(L, index) == LUA_TSTRING)
    return cs_sequence_at_time(film, lua_tostring(L, index), out);
  double number = lua_type(L, index) == LUA_TNUMBER ? lua_tonumber(L, index) : NAN;
  if (!(number >= (double)film->first && number < (double)(film->first + film->count)))
    return false;
  *out = (int64_t)number;
  return number == (double)*out;
}

static void check_poster(const cs_form *form, const film_form *read) {
  lua_State *L = form->L;
  const cs_film_info film = {
      .frames_second = read->fps, .first = read->first, .count = count_frames(read)};
  int64_t poster;
  int type = cs_form_get(form, "poster"), index = lua_gettop(L);
  if (type != LUA_TNIL && !read_poster(L, index, &film, &poster))
    cs_form_fail(form,
                 "field 'poster' must be a frame of the film, %s to %s, or a time in it, such "
                 "as \"2s\", got %s",
                 cs_form_digits(L, (double)film.first),
                 cs_form_digits(L, (double)(film.first + film.count - 1)),
                 type == LUA_TSTRING || type == LUA_TNUMBER ? luaL_tolstring(L, index, NULL)
                                                            : cs_userdata_type(L, index));
  lua_pop(L, 1);
}

static void check_captions(const cs_form *form) {
  lua_State *L = form->L;
  int type = cs_form_get(form, "captions");
  if (type != LUA_TNIL && type != LUA_TTABLE && type != LUA_TSTRING)
    cs_form_fail(form,
                 "field 'captions' must be the name of a file, or captions as celspan.captions "
                 "reads them, got %s",
                 cs_userdata_type(L, -1));
  lua_pop(L, 1);
}

/* The palettes are kept for `celspan check`, which asks the module for them. */
static void check_colours(const cs_form *form) {
  lua_State *L = form->L;
  if (cs_form_get(form, "palettes") != LUA_TNIL) {
    cs_require_module(L, "celspan.ink_recolour");
    lua_getfield(L, -1, "keep");
    lua_pushvalue(L, -3);
    lua_call(L, 1, 0);
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
}

static void check_film(const cs_form *form, cs_userdata *value) {
  lua_State *L = form->L;
  int film = lua_gettop(L);
  film_form read = {.fps = 24, .frames = 1, .first = 1};
  (void)value;
  if (cs_caller_push_folder(L))
    lua_setiuservalue(L, film, SOUND_FOLDER);
  cs_fields_read(form, &read);
  if (!(read.duration * read.fps <= MOST_FRAMES))
    cs_form_fail(form, "field 'duration' must be at most %d frames, got %s", MOST_FRAMES,
                 cs_form_digits(form->L, read.duration));
  cs_sounds_check(form);
  cs_marks_push(form, read.first, count_frames(&read));
  lua_setiuservalue(L, film, MARKS);
  check_poster(form, &read);
  check_captions(form);
  check_colours(form);
  cs_grain_check(form);
  if (cs_form_get(form, "frame") != LUA_TFUNCTION)
    cs_form_fail(form, "field 'frame' must be a function(f) that returns a rostrum, got %s",
                 cs_userdata_type(L, -1));
}

/* Adds the fields that were left out: the size, and the number of frames from the duration, or the
 * duration from the number of frames.
 */
static void complete(lua_State *L, int table) {
  if (lua_getfield(L, table, "size") == LUA_TNIL) {
    lua_pushvalue(L, table);
    cs_put_pair(L, "size", 1920, 1080);
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
    {"size", CS_PIXELS(film_form, size), .least = 1, .most = MOST_SIDE, .shape = "a size {w, h}",
     .read = "integer[]", .fallback = "{1920, 1080}"},
    {"fps", CS_NUMBER(film_form, fps), .is_above = true, .most = 1e6, .preset = "24",
     .about = "Frames per second"},
    {"frames", CS_WHOLE(film_form, frames), .least = 1, .most = MOST_FRAMES, .read = "integer",
     .about = "How many", .fallback = "1"},
    {"duration", CS_NUMBER(film_form, duration), CS_ABOVE_0, .read = "number",
     .about = "Seconds, instead of frames"},
    {"first", CS_WHOLE(film_form, first), .least = -MOST_FRAMES, .most = MOST_FRAMES, .preset = "1",
     .about = "The number of the first frame"},
    {"title", CS_TEXT(film_form, title)},
    CS_OWN_SPACE(film_form, space, "linear"),
    CS_GRAIN_FIELD,
    {"background", CS_SURFACE(film_form, background), .fallback = "nothing",
     .about = "Covers each frame behind everything, and no camera moves it"},
    {"sound", CS_OWN("string|celspan.film.sound|celspan.film.sound[]"),
     .about = "A file, a sound, or a list of sounds, which are mixed"},
    {"sound_offset", CS_NUMBER(film_form, sound_offset), .least = -MOST_FRAMES, .most = MOST_FRAMES,
     .preset = "0",
     .about = "Seconds by which all sounds begin later; a negative value cuts the beginning"},
    {"marks", CS_OWN("table<string, integer>"),
     .about = "Names of frames, { title = 1 }, for --frames"},
    {"captions", CS_OWN("string|celspan.captions"),
     .about = "A .srt or .vtt file, or captions: a track of subtitles in videos"},
    {"palettes", CS_OWN("(celspan.colour.palette|table<string, celspan.colour>)[]"),
     .about = "`celspan check` warns of colours that are in none"},
    {"poster", CS_OWN("integer|string"),
     .about = "The frame that stands for the film, by its number or a time such as \"2s\""},
    {"frame", CS_OWN("fun(f: celspan.frame): celspan.shown"), .is_required = true,
     .about = "A pure function of f"},
    {0}};
const cs_noun cs_noun_film = {.name = "film",
                              .about = "The value that a script returns.",
                              .kind = &cs_kind_film,
                              .fields = fields,
                              .either = {"frames", "duration"},
                              .create = check_film,
                              .complete = complete};

/* film:at(number): the result of the frame function, for tests and tools. */
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

/* If no new sound is given, the new film keeps the old sound and the folder of its files. */
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
  cs_put_pair(L, "size", width, height);
  if (lua_getfield(L, rostrum, "size") != LUA_TNIL)
    lua_setfield(L, form, "size");
  lua_getfield(L, rostrum, "space");
  lua_setfield(L, form, "space");
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

static const luaL_Reg methods[] = {{"with", film_with}, {"at", film_at}, {NULL, NULL}};
const cs_kind cs_kind_film = {.name = "celspan.film", .methods = methods, .kept = 2};

/* ---------------------------------------------------------------- reading */

static celspan_space read_space(lua_State *L, int table) {
  const char *word = cs_take_text(L, table, "space");
  return word && strcmp(word, cs_space_words[1]) == 0 ? CELSPAN_SPACE_SRGB : CELSPAN_SPACE_LINEAR;
}

void cs_lua_film_read(lua_State *L, int film, cs_film_info *out) {
  film = lua_absindex(L, film);
  lua_getiuservalue(L, film, 1);
  int table = lua_gettop(L);
  lua_getfield(L, table, "size");
  lua_rawgeti(L, -1, 1);
  lua_rawgeti(L, -2, 2);
  *out = (cs_film_info){.width = (int32_t)lua_tonumber(L, -2),
                        .height = (int32_t)lua_tonumber(L, -1),
                        .frames_second = cs_take_number(L, table, "fps", 0),
                        .first = (int64_t)cs_take_number(L, table, "first", 0),
                        .count = (int64_t)cs_take_number(L, table, "frames", 0),
                        .space = read_space(L, table),
                        .title = cs_take_text(L, table, "title")};
  int type = lua_getfield(L, table, "sound");
  out->has_sound = type == LUA_TSTRING || (type == LUA_TTABLE && cs_list_length(L, -1) > 0);
  lua_getiuservalue(L, film, MARKS);
  out->marks = cs_marks_read(L, -1, &out->mark_count);
  out->has_captions = lua_getfield(L, table, "captions") != LUA_TNIL;
  out->poster = out->first;
  out->has_poster = lua_getfield(L, table, "poster") != LUA_TNIL;
  read_poster(L, -1, out, &out->poster);
  lua_settop(L, table - 1);
}

int cs_lua_film_sounds(lua_State *L) {
  cs_userdata_self(L, &cs_kind_film, "sounds");
  lua_settop(L, 1);
  lua_getiuservalue(L, 1, 1);
  lua_getiuservalue(L, 1, SOUND_FOLDER);
  cs_sounds_push(L, 2, lua_tostring(L, 3));
  return 1;
}

int cs_lua_film_captions(lua_State *L) {
  const char *tried;
  cs_userdata_self(L, &cs_kind_film, "captions");
  lua_settop(L, 1);
  lua_getiuservalue(L, 1, SOUND_FOLDER);
  lua_getiuservalue(L, 1, 1);
  if (lua_getfield(L, 3, "captions") != LUA_TSTRING)
    return 1;
  cs_files_find_from(L, lua_tostring(L, 2), lua_tostring(L, 4), &tried);
  return 3;
}

/* ---------------------------------------------------------------- the `f` of frame functions */

#define ALWAYS(type) CS_OWN(type), .is_required = true
static const cs_field frame_fields[] = {
    {"number", ALWAYS("integer"), .about = "Counted from `first`"},
    {"index", ALWAYS("integer"), .about = "From 0"},
    {"time", ALWAYS("number"), .about = "Seconds: index / fps"},
    {"middle", ALWAYS("number"), .about = "Seconds at the middle of the frame"},
    {"count", ALWAYS("integer")},
    {"fps", ALWAYS("number")},
    {"width", ALWAYS("integer")},
    {"height", ALWAYS("integer")},
    {"size", ALWAYS("integer[]"), .about = "{width, height}"},
    {"progress", ALWAYS("number"), .about = "0 at the first frame, 1 at the last"},
    {0}};
const cs_noun cs_noun_frame = {.name = "frame",
                               .about = "The argument of a frame function.",
                               .table = "celspan.frame",
                               .kind = &cs_kind_frame,
                               .fields = frame_fields};

/* The seed is made of the film's title and size, and the frame's number. */
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

/* Whether the value is a whole number; 2.0 is a whole number, too. */
static bool is_whole(lua_State *L, int index, lua_Integer *out) {
  int good = 0;
  if (lua_type(L, index) == LUA_TNUMBER)
    *out = lua_tointegerx(L, index, &good);
  return good;
}

/* The index of the first of `step` frames that share the drawing of the frame at 1. */
static lua_Integer held_index(lua_State *L, lua_Integer step) {
  lua_getiuservalue(L, 1, 1);
  lua_getfield(L, -1, "index");
  lua_Integer index = lua_tointeger(L, -1);
  return index - index % step;
}

/* f:on(n): the index held for n frames */
static int on(lua_State *L) {
  cs_userdata_self(L, &cs_kind_frame, "on");
  lua_Integer step = 0;
  if (!is_whole(L, 2, &step) || step < 1)
    return cs_caller_error(L, "on: takes a whole number of frames, 1 or more, f:on(2), got %s",
                           cs_userdata_number(L, 2));
  lua_pushinteger(L, held_index(L, step));
  return 1;
}

/* The time held for `step` frames. */
static int push_held_time(lua_State *L, const char *method, lua_Integer step) {
  cs_userdata_self(L, &cs_kind_frame, method);
  const double index = (double)held_index(L, step);
  lua_getfield(L, -2, "fps");
  lua_pushnumber(L, index / lua_tonumber(L, -1));
  return 1;
}

static int twos(lua_State *L) { return push_held_time(L, "twos", 2); }
static int threes(lua_State *L) { return push_held_time(L, "threes", 3); }

static const luaL_Reg frame_methods[] = {
    {"on", on}, {"twos", twos}, {"threes", threes}, {"random", random_number}, {NULL, NULL}};
const cs_kind cs_kind_frame = {
    .name = "celspan.frame", .methods = frame_methods, .own_size = sizeof(uint64_t)};

static void push_frame(lua_State *L, const cs_film_info *film, int64_t number) {
  int64_t index = number - film->first;
  cs_userdata *value = cs_userdata_push(L, &cs_noun_frame);
  *(uint64_t *)cs_userdata_own(value) = seed_of(film, number);
  lua_createtable(L, 0, 10);
  cs_put_pair(L, "size", film->width, film->height);
  cs_put_integer(L, "number", number);
  cs_put_integer(L, "index", index);
  cs_put_integer(L, "count", film->count);
  cs_put_integer(L, "width", film->width);
  cs_put_integer(L, "height", film->height);
  cs_put_number(L, "fps", film->frames_second);
  cs_put_number(L, "time", (double)index / film->frames_second);
  cs_put_number(L, "middle", ((double)index + 0.5) / film->frames_second);
  cs_put_number(L, "progress", film->count > 1 ? (double)index / (double)(film->count - 1) : 0);
  lua_setiuservalue(L, -2, 1);
}

/* ---------------------------------------------------------------- frames */

/* Replaces the rostrum on top of the stack by what a function makes of it for the frame. */
static void change(lua_State *L, int function) {
  lua_pushvalue(L, function);
  lua_insert(L, -2);
  lua_pushvalue(L, 3);
  lua_getfield(L, 2, "number");
  lua_call(L, 3, 1);
}

/* Adds to each rostrum on top of the stack, in a list of exposures or alone, what celspan's module
 * of this name makes of the field of the film, if the film has it. */
static void add(lua_State *L, const char *field, const char *module) {
  int shown = lua_gettop(L), function = shown + 1;
  if (lua_getfield(L, 3, field) != LUA_TNIL) {
    cs_require_module(L, module);
    lua_getfield(L, -1, "of_rostrum");
    lua_replace(L, function);
    if (lua_istable(L, shown)) {
      for (lua_Integer i = 1; lua_rawgeti(L, shown, i) != LUA_TNIL; i++) {
        lua_rawgeti(L, -1, 1);
        change(L, function);
        lua_rawseti(L, -2, 1);
        lua_pop(L, 1);
      }
    } else {
      lua_pushvalue(L, shown);
      change(L, function);
      lua_replace(L, shown);
    }
  }
  lua_settop(L, shown);
}

/* frame function, f, film -> exposures */
static int call_frame(lua_State *L) {
  lua_pushvalue(L, 1);
  lua_pushvalue(L, 2);
  lua_call(L, 1, 2);
  if (!lua_isnil(L, -1))
    return cs_caller_error(L, "the frame function returned two values: write return { a, b }");
  lua_pop(L, 1);
  int result = lua_gettop(L);
  celspan_frame_desc desc;
  cs_shown_read(L, result, "the frame function's result", &desc);
  lua_settop(L, result);
  add(L, "background", "celspan.background");
  add(L, "grain", "celspan.grain");
  return 1;
}

/* Pushes the exposures, or the message; returns the result of lua_pcall. film: an absolute index.
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
  push_frame(L, &info, number);
  lua_pushvalue(L, film);
  int64_t before = cs_grain_begin(L, number);
  cs_host_begin(L, CS_HOST_FRAME, number);
  int outcome = cs_lua_error_settle(L, lua_pcall(L, 3, 1, handler), 1);
  cs_host_end(L);
  cs_grain_begin(L, before);
  lua_remove(L, handler);
  return outcome;
}

void cs_lua_film_push_frame(lua_State *L, int film, int64_t number) {
  if (protected_frame(L, lua_absindex(L, film), number) != LUA_OK)
    lua_error(L);
}

/* A request for one frame from outside of Lua. */
typedef struct request {
  int64_t number;
  cs_film_frame frame;
  celspan_status status; /* the status of the core, if it did not accept the exposures */
} request;

/* film, light userdata: fills the request. Runs protected. */
static int build_frame(lua_State *L) {
  request *r = lua_touserdata(L, 2);
  cs_lua_film_push_frame(L, 1, r->number);
  celspan_frame_desc desc;
  cs_shown_read(L, -1, "the frame function's result", &desc);
  cs_film_info film;
  cs_lua_film_read(L, 1, &film);
  r->status = /* the last step: a later error of Lua would lose the exposures */
      cs_film_frame_init(&r->frame, cs_host_context(L), desc.exposures, desc.exposure_count);
  r->frame.repeats = film.count > 1;
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
