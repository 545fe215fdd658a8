#include "lua/module/heard.h"

#include <lauxlib.h>

#include "celspan/lua.h"
#include "inside/description.h"
#include "lua/bind/require.h"
#include "lua/bind/take.h"
#include "lua/module/visit.h"

/* the kind of the value; user value 1: everything that it keeps alive */
#define KIND "celspan.sounds"

/* Memory that lives as long as the table at `list`. */
static void *keep(lua_State *L, int list, size_t count, size_t size) {
  void *piece = lua_newuserdatauv(L, count * size + 1, 0);
  lua_rawseti(L, list, (lua_Integer)lua_rawlen(L, list) + 1);
  return piece;
}

/* Reads the passages of the sound on top of the stack. */
static void read_passages(lua_State *L, int kept, cs_mix_sound *out) {
  lua_getfield(L, -1, "passages");
  out->passage_count = lua_rawlen(L, -1);
  celspan_sound_passage *passages = keep(L, kept, out->passage_count, sizeof *passages);
  for (size_t i = 0; i < out->passage_count; i++) {
    double numbers[4];
    lua_rawgeti(L, -1, (lua_Integer)i + 1);
    for (int k = 0; k < 4; k++, lua_pop(L, 1)) {
      lua_rawgeti(L, -1, k + 1);
      numbers[k] = lua_tonumber(L, -1);
    }
    passages[i] = (celspan_sound_passage){numbers[0], numbers[1], numbers[2], numbers[3]};
    lua_pop(L, 1);
  }
  out->passages = passages;
  lua_pop(L, 1);
}

static void read_duckers(lua_State *L, int kept, cs_mix_sound *out) {
  lua_getfield(L, -1, "duckers");
  out->ducker_count = lua_rawlen(L, -1);
  celspan_sound_ducker *duckers = keep(L, kept, out->ducker_count, sizeof *duckers);
  for (size_t i = 0; i < out->ducker_count; i++, lua_pop(L, 1)) {
    lua_rawgeti(L, -1, (lua_Integer)i + 1);
    duckers[i] = (celspan_sound_ducker){
        (size_t)cs_take_number(L, -1, "place", 0) - 1, cs_take_number(L, -1, "gain", 0),
        cs_take_number(L, -1, "attack", 0), cs_take_number(L, -1, "release", 0)};
  }
  out->duckers = duckers;
  lua_pop(L, 1);
}

static void read_sound(lua_State *L, int kept, cs_mix_sound *out) {
  *out =
      (cs_mix_sound){.path = cs_take_text(L, -1, "path"),
                     .tried = cs_take_text(L, -1, "tried"),
                     .stem = cs_take_text(L, -1, "stem"),
                     .number = (int)cs_take_number(L, -1, "number", 0),
                     .start = cs_take_number(L, -1, "start", 0),
                     .speed = cs_take_number(L, -1, "speed", 0),
                     .from = cs_take_number(L, -1, "from", 0),
                     .gain = {cs_take_number(L, -1, "left", 0), cs_take_number(L, -1, "right", 0)}};
  read_passages(L, kept, out);
  read_duckers(L, kept, out);
}

/* film -> the value. Runs protected, within the limits of scripts. */
static int read_film(lua_State *L) {
  cs_heard *out = lua_newuserdatauv(L, sizeof *out, 1);
  luaL_newmetatable(L, KIND);
  lua_setmetatable(L, 2);
  lua_newtable(L);
  cs_require_module(L, "celspan.soundtrack");
  lua_getfield(L, -1, "of");
  lua_pushvalue(L, 1);
  lua_call(L, 1, 1);
  int list = lua_gettop(L);
  lua_pushvalue(L, list);
  lua_rawseti(L, 3, 1);
  out->count = lua_rawlen(L, list);
  cs_mix_sound *sounds = keep(L, 3, out->count, sizeof *sounds);
  for (size_t i = 0; i < out->count; i++, lua_settop(L, list)) {
    lua_rawgeti(L, list, (lua_Integer)i + 1);
    read_sound(L, 3, &sounds[i]);
  }
  out->sounds = sounds;
  lua_settop(L, 3);
  lua_setiuservalue(L, 2, 1);
  return 1;
}

celspan_status cs_heard_push(lua_State *L, int index, cs_heard *out) {
  cs_film_info film;
  CS_TRY(cs_visit_film(L, index, &film));
  lua_pushcfunction(L, read_film);
  lua_insert(L, -2);
  CS_TRY(celspan_lua_call(L, 1, 1));
  *out = *(const cs_heard *)lua_touserdata(L, -1);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- for hosts */

celspan_status celspan_lua_sounds(lua_State *L, int index, size_t *count) {
  cs_heard heard;
  CS_TRY(cs_heard_push(L, index, &heard));
  if (count)
    *count = heard.count;
  return CELSPAN_OK;
}

typedef struct question {
  size_t place;
  celspan_sound answer;
} question;

/* value, light userdata: the question. Runs protected. */
static int read_one(lua_State *L) {
  question *q = lua_touserdata(L, 2);
  const cs_heard *heard = luaL_testudata(L, 1, KIND);
  if (!heard)
    return luaL_error(L, "sounds are needed, as celspan_lua_sounds pushes them");
  if (q->place >= heard->count)
    return luaL_error(L, "sound %I: the film has %I", (LUAI_UACINT)q->place,
                      (LUAI_UACINT)heard->count);
  const cs_mix_sound *sound = &heard->sounds[q->place];
  q->answer = (celspan_sound){.struct_size = sizeof q->answer,
                              .path = sound->path,
                              .start = sound->start,
                              .speed = sound->speed,
                              .gain = {sound->gain[0], sound->gain[1]},
                              .passages = sound->passages,
                              .passage_count = sound->passage_count,
                              .duckers = sound->duckers,
                              .ducker_count = sound->ducker_count};
  return 0;
}

celspan_status celspan_lua_sound(lua_State *L, int index, size_t place, celspan_sound *out) {
  question q = {.place = place};
  CS_TRY(cs_visit(L, index, read_one, &q, 0));
  return CS_RESULT(celspan_lua_context(L), "sound", celspan_sound, &q.answer, out);
}
