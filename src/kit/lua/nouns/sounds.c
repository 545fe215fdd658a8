#include "lua/nouns/sounds.h"

#include "common/address.h"
#include "lua/bind/fields.h"
#include "lua/bind/files.h"
#include "lua/bind/list.h"
#include "lua/bind/put.h"
#include "lua/nouns/nouns.h"

#define MOST_SECONDS 1e9
#define MOST_SOUNDS 10000 /* sounds of a film */

/* ---------------------------------------------------------------- one sound */

typedef struct sound_form {
  double at, from, to, speed, gain, fade[2], pan;
  bool has_to;
  const char *name, *duck, *under;
  double duck_depth, duck_attack, duck_release;
} sound_form;

#define PLAIN                                                                                      \
  (sound_form) { .speed = 1, .gain = 1, .duck_depth = 12, .duck_attack = 0.1, .duck_release = 0.1 }
#define SECONDS(member) CS_NUMBER(sound_form, member), .least = 0, .most = MOST_SECONDS
static const cs_field fields[] = {
    {"at", CS_NUMBER(sound_form, at), .least = -MOST_SECONDS, .most = MOST_SECONDS, .preset = "0",
     .about = "Second of the film at which it begins"},
    {"from", SECONDS(from), .preset = "0", .about = "Second of the file at which it begins"},
    {"to", SECONDS(to), CS_HAS(sound_form, has_to), .is_above = true,
     .about = "Second of the file at which it ends", .fallback = "the end of the file"},
    {"speed", CS_NUMBER(sound_form, speed), .least = 0.01, .most = 100, .preset = "1",
     .about = "2: twice as fast; the pitch is kept"},
    {"gain", CS_NUMBER(sound_form, gain), .least = 0, .most = 1000, .preset = "1",
     .about = "A factor of the amplitude"},
    {"fade", CS_NUMBERS(sound_form, fade), .shape = "two times {in, out}, in seconds",
     .about = "Linear in amplitude", .fallback = "{0, 0}"},
    {"pan", CS_NUMBER(sound_form, pan), .least = -1, .most = 1, .preset = "0",
     .about = "-1: left, 1: right, with constant power"},
    {"name", CS_TEXT(sound_form, name), .about = "For `duck` and `under`"},
    {"duck", CS_TEXT(sound_form, duck),
     .about = "The name of sounds that are lower while this one sounds"},
    {"under", CS_TEXT(sound_form, under),
     .about = "The name of sounds under which this one is lower, also of sounds of films"},
    {"duck_depth", CS_NUMBER(sound_form, duck_depth), .least = 0, .most = 200, .preset = "12",
     .about = "By how many decibels `duck` and `under` make it lower"},
    {"duck_attack", SECONDS(duck_attack), .preset = "0.1",
     .about = "Seconds in which it becomes lower, before"},
    {"duck_release", SECONDS(duck_release), .preset = "0.1",
     .about = "Seconds in which it becomes louder again, after"},
    {0}};
const cs_noun cs_noun_sound = {
    .name = "film: sound",
    .about = "A sound of a film, and when it is heard.",
    .table = "celspan.film.sound",
    .list = CS_LIST_TUPLE,
    .item = "file",
    .item_written = "string|celspan.film",
    .item_about = "A file, an address data:... of one, or a film whose sounds are meant",
    .fields = fields};

/* Raises an error unless the value on top of the stack is the name of a file or, inside a table, a
 * film. */
static void check_file(const cs_form *form, bool is_in_table) {
  lua_State *L = form->L;
  bool is_text = lua_type(L, -1) == LUA_TSTRING;
  if (is_text && lua_tostring(L, -1)[0])
    return;
  if (is_text)
    cs_form_fail(form, "the name of the file is an empty text");
  if (!is_in_table || !cs_userdata_test(L, -1, &cs_kind_film))
    cs_form_fail(form, "must be the name of a file%s, got %s",
                 is_in_table ? " or a film, { \"voice.wav\", at = 2 }" : "",
                 cs_userdata_type(L, -1));
}

static void read_times(const cs_form *form, sound_form *out) {
  cs_fields_read(form, out);
  if (out->has_to && out->to <= out->from)
    cs_form_fail(form, "field 'to' must be above 'from', %s, got %s",
                 cs_form_digits(form->L, out->from), cs_form_digits(form->L, out->to));
  for (int i = 0; i < 2; i++)
    if (!(out->fade[i] >= 0 && out->fade[i] <= MOST_SECONDS))
      cs_form_fail(form, "fade[%d] must be 0 or more seconds, got %s", i + 1,
                   cs_form_digits(form->L, out->fade[i]));
}

/* Opens the form of the sound on top of the stack, a table, and pushes its file. */
static cs_form open_sound(lua_State *L, const cs_noun *noun, sound_form *out) {
  *out = PLAIN;
  cs_form form = cs_form_open(L, noun, -1);
  if (cs_form_length(&form) > 1)
    cs_form_fail(&form,
                 "takes one file, { \"voice.wav\", at = 2 }, got %d: write a list "
                 "{ { \"a.wav\" }, { \"b.wav\" } }",
                 cs_form_length(&form));
  read_times(&form, out);
  lua_rawgeti(L, form.table, 1);
  return form;
}

static void check_sound(lua_State *L, const cs_noun *noun) {
  sound_form read;
  int top = lua_gettop(L);
  if (!lua_istable(L, -1)) {
    check_file(&(cs_form){.L = L, .noun = noun, .table = top}, false);
    return;
  }
  cs_form form = open_sound(L, noun, &read);
  check_file(&form, true);
  lua_settop(L, top);
}

/* ---------------------------------------------------------------- lists */

/* Whether the table on top of the stack is a list of sounds; it may also be a single sound. */
static bool is_list(lua_State *L) {
  lua_Integer length = cs_list_length(L, -1);
  int type = lua_rawgeti(L, -1, 1);
  lua_pop(L, 1);
  if (type == LUA_TTABLE || (length > 0 && (type == LUA_TNIL || type == LUA_TBOOLEAN)))
    return true;
  lua_pushnil(L);
  bool is_empty = lua_next(L, -2) == 0;
  if (!is_empty)
    lua_pop(L, 2);
  return is_empty;
}

/* Pushes sound i, from 1, of the value on top of the stack. Returns false and pushes nothing if i
 * is greater than the number of sounds. Places of a list without a sound give nil or false. */
static bool push_item(lua_State *L, lua_Integer i) {
  if (lua_istable(L, -1) && is_list(L)) {
    if (i > cs_list_length(L, -1))
      return false;
    lua_rawgeti(L, -1, i);
    return true;
  }
  if (i == 1)
    lua_pushvalue(L, -1);
  return i == 1;
}

/* Whether a sound of the value on top of the stack, or of a film in it, has the name at index
 * `name`. but: the index of a sound that does not count, or of another value. */
static bool has_name(lua_State *L, int name, int but) {
  int top = lua_gettop(L);
  bool is_found = false;
  luaL_checkstack(L, 20, "films in films");
  for (lua_Integer i = 1; !is_found && push_item(L, i); lua_settop(L, top), i++) {
    if (!lua_istable(L, -1) || lua_rawequal(L, -1, but))
      continue;
    lua_getfield(L, -1, "name");
    lua_rawgeti(L, -2, 1);
    is_found = lua_rawequal(L, -2, name);
    if (!is_found && cs_userdata_test(L, -1, &cs_kind_film)) {
      cs_userdata_push_fields(L, -1);
      lua_getfield(L, -1, "sound");
      is_found = !lua_isnil(L, -1) && has_name(L, name, name);
    }
  }
  return is_found;
}

/* Raises if a field of the sound on top of the stack, `duck` or `under`, is a name that no other
 * sound has. */
static void check_name(lua_State *L, const cs_noun *noun, int list, const char *field) {
  int sound = lua_gettop(L);
  bool is_given = lua_istable(L, sound) && lua_getfield(L, sound, field) != LUA_TNIL;
  lua_pushvalue(L, list);
  if (is_given && !has_name(L, sound + 1, sound))
    cs_form_fail(&(cs_form){.L = L, .noun = noun, .table = sound},
                 "field '%s' must be the name of another sound of the film, got \"%s\", which none "
                 "has",
                 field, lua_tostring(L, sound + 1));
  lua_settop(L, sound);
}

/* Checks sound i, which is on top of the stack. */
static void check_item(lua_State *L, lua_Integer i, int list) {
  cs_noun named = cs_noun_sound;
  named.name = lua_pushfstring(L, "film: sound %I", (LUAI_UACINT)i);
  lua_insert(L, -2);
  check_sound(L, &named);
  check_name(L, &named, list, "duck");
  check_name(L, &named, list, "under");
}

void cs_sounds_check(const cs_form *film) {
  lua_State *L = film->L;
  int type = cs_form_get(film, "sound"), list = lua_gettop(L);
  if (type == LUA_TSTRING && !lua_tostring(L, -1)[0])
    cs_form_fail(film, "field 'sound' must be the name of a file, got an empty text");
  if (type != LUA_TSTRING && type != LUA_TTABLE && type != LUA_TNIL)
    cs_form_fail(film,
                 "field 'sound' must be the name of a file, { \"voice.wav\", at = 2 } or a list "
                 "of such tables, got %s",
                 cs_userdata_type(L, -1));
  for (lua_Integer i = 1; type == LUA_TTABLE && push_item(L, i); lua_settop(L, list), i++) {
    if (i > MOST_SOUNDS)
      cs_form_fail(film, "field 'sound' has more than %d sounds", MOST_SOUNDS);
    if (lua_toboolean(L, -1))
      check_item(L, i, list);
  }
  lua_settop(L, list - 1);
}

/* ---------------------------------------------------------------- what is wanted */

/* Sets the file, in the table on top of the stack, to that of the sound below, which is a name. */
static void put_file(lua_State *L, const char *folder) {
  const char *tried;
  lua_pushvalue(L, -2);
  lua_rawseti(L, -2, 1);
  if (lua_type(L, -2) != LUA_TSTRING)
    return;
  if (cs_address_is_data(lua_tostring(L, -2))) {
    cs_put_text(L, "path", lua_tostring(L, -2));
    return;
  }
  cs_files_find_from(L, folder, cs_files_name(L, -2), &tried);
  lua_setfield(L, -3, "tried");
  lua_setfield(L, -2, "path");
}

/* Replaces the sound on top of the stack by a new table that describes it. */
static void complete(lua_State *L, const char *folder) {
  sound_form read = PLAIN;
  int sound = lua_gettop(L);
  if (lua_istable(L, -1))
    open_sound(L, &cs_noun_sound, &read);
  lua_pushvalue(L, -1);
  lua_createtable(L, 1, 16);
  put_file(L, folder);
  cs_put_number(L, "at", read.at);
  cs_put_number(L, "from", read.from);
  if (read.has_to)
    cs_put_number(L, "to", read.to);
  cs_put_number(L, "speed", read.speed);
  cs_put_number(L, "gain", read.gain);
  cs_put_number(L, "fade_in", read.fade[0]);
  cs_put_number(L, "fade_out", read.fade[1]);
  cs_put_number(L, "pan", read.pan);
  cs_put_text(L, "name", read.name);
  cs_put_text(L, "duck", read.duck);
  cs_put_text(L, "under", read.under);
  cs_put_number(L, "duck_depth", read.duck_depth);
  cs_put_number(L, "duck_attack", read.duck_attack);
  cs_put_number(L, "duck_release", read.duck_release);
  lua_replace(L, sound);
  lua_settop(L, sound);
}

void cs_sounds_push(lua_State *L, int film, const char *folder) {
  film = lua_absindex(L, film);
  lua_newtable(L);
  int list = lua_gettop(L);
  lua_Integer count = 0;
  luaL_checkstack(L, 40, "sounds");
  if (lua_getfield(L, film, "sound") != LUA_TNIL)
    for (lua_Integer i = 1; push_item(L, i); lua_settop(L, list + 1), i++)
      if (lua_toboolean(L, -1)) {
        complete(L, folder);
        cs_put_integer(L, "number", i);
        lua_rawseti(L, list, ++count);
      }
  lua_settop(L, list);
}
