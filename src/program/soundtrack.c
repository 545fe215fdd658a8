#include "program/soundtrack.h"
#include "lua/bind/require.h"

#include <lauxlib.h>
#include <math.h>

#include "lua/bind/lua_error.h"
#include "lua/module/core.h"

/* ---------------------------------------------------------------- from Lua */

static double number_of(lua_State *L, const char *name) {
  lua_getfield(L, -1, name);
  double number = lua_tonumber(L, -1);
  lua_pop(L, 1);
  return number;
}

static const char *text_of(lua_State *L, const char *name) {
  lua_getfield(L, -1, name);
  const char *text = lua_tostring(L, -1); /* the list keeps it alive */
  lua_pop(L, 1);
  return text;
}

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
  cs_mix_passage *passages = keep(L, kept, out->passage_count, sizeof *passages);
  for (size_t i = 0; i < out->passage_count; i++) {
    double numbers[4];
    lua_rawgeti(L, -1, (lua_Integer)i + 1);
    for (int k = 0; k < 4; k++, lua_pop(L, 1)) {
      lua_rawgeti(L, -1, k + 1);
      numbers[k] = lua_tonumber(L, -1);
    }
    passages[i] = (cs_mix_passage){numbers[0], numbers[1], numbers[2], numbers[3]};
    lua_pop(L, 1);
  }
  out->passages = passages;
  lua_pop(L, 1);
}

static void read_duckers(lua_State *L, int kept, cs_mix_sound *out) {
  lua_getfield(L, -1, "duckers");
  out->ducker_count = lua_rawlen(L, -1);
  cs_mix_ducker *duckers = keep(L, kept, out->ducker_count, sizeof *duckers);
  for (size_t i = 0; i < out->ducker_count; i++, lua_pop(L, 1)) {
    lua_rawgeti(L, -1, (lua_Integer)i + 1);
    duckers[i] = (cs_mix_ducker){(uint32_t)number_of(L, "place") - 1, number_of(L, "gain"),
                                 number_of(L, "attack"), number_of(L, "release")};
  }
  out->duckers = duckers;
  lua_pop(L, 1);
}

static void read_sound(lua_State *L, int kept, cs_mix_sound *out) {
  *out = (cs_mix_sound){.path = text_of(L, "path"),
                        .tried = text_of(L, "tried"),
                        .number = (int)number_of(L, "number"),
                        .start = number_of(L, "start"),
                        .speed = number_of(L, "speed"),
                        .from = number_of(L, "from"),
                        .gain = {number_of(L, "left"), number_of(L, "right")}};
  read_passages(L, kept, out);
  read_duckers(L, kept, out);
}

/* film, light userdata: the soundtrack -> what keeps it alive. Runs protected. */
static int read_film(lua_State *L) {
  cs_soundtrack *out = lua_touserdata(L, 2);
  lua_settop(L, 1);
  lua_newtable(L);
  cs_require_module(L, "celspan.soundtrack");
  lua_getfield(L, -1, "of");
  lua_pushvalue(L, 1);
  lua_call(L, 1, 1);
  int list = lua_gettop(L);
  lua_pushvalue(L, list);
  lua_rawseti(L, 2, 1);
  out->count = lua_rawlen(L, list);
  cs_mix_sound *sounds = keep(L, 2, out->count, sizeof *sounds);
  for (size_t i = 0; i < out->count; i++, lua_settop(L, list)) {
    lua_rawgeti(L, list, (lua_Integer)i + 1);
    read_sound(L, 2, &sounds[i]);
  }
  out->sounds = sounds;
  lua_settop(L, 2);
  return 1;
}

celspan_status cs_soundtrack_read(cs_script *script, cs_soundtrack *out) {
  lua_State *L = script->L;
  *out = (cs_soundtrack){.sounds = NULL};
  if (!lua_checkstack(L, 4))
    return cs_fail(script->context, CELSPAN_LIMIT, "Lua's stack is full");
  lua_pushcfunction(L, read_film);
  lua_pushvalue(L, CS_SCRIPT_FILM);
  lua_pushlightuserdata(L, out);
  int outcome = lua_pcall(L, 2, 1, 0); /* its result stays on the stack */
  return outcome == LUA_OK ? CELSPAN_OK : cs_lua_error_report(L, outcome);
}

celspan_status cs_soundtrack_hash(cs_script *script, cs_hash *hash) {
  cs_soundtrack track;
  CS_TRY(cs_soundtrack_read(script, &track));
  cs_mix_hash(hash, track.sounds, track.count);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- mixing */

static int64_t moments_of(double seconds) { return llround(seconds * CS_MIX_RATE); }

celspan_status cs_soundtrack_check(cs_script *script, bool is_deep) {
  cs_soundtrack track;
  cs_sound_stream samples = {.user = NULL};
  const cs_film_info *film = &script->film;
  CS_TRY(cs_soundtrack_read(script, &track));
  if (!is_deep)
    return cs_mix_find(script->context, track.sounds, track.count);
  celspan_status status =
      cs_mix_open(script->context, track.sounds, track.count, 0,
                  moments_of((double)film->count / film->frames_second), &samples);
  cs_sound_stream_close(&samples);
  return status == CELSPAN_OUTPUT ? CELSPAN_OK : status;
}

static bool is_run(const cs_sequence *frames) {
  for (size_t i = 1; i < frames->count; i++)
    if (frames->frames[i] != frames->frames[i - 1] + 1)
      return false;
  return true;
}

celspan_status cs_soundtrack_mix(cs_script *script, int64_t first, int64_t count,
                                 cs_sound_stream *out, int64_t *moments) {
  cs_soundtrack track;
  double rate = script->film.frames_second;
  *moments = moments_of((double)count / rate);
  CS_TRY(cs_soundtrack_read(script, &track));
  return cs_mix_open(script->context, track.sounds, track.count,
                     (double)(first - script->film.first) / rate, *moments, out);
}

cs_exit cs_soundtrack_open(cs_script *script, const cs_request *request, const cs_sequence *frames,
                           cs_sound_stream *out, int64_t *moments) {
  if (!is_run(frames))
    return cs_report_usage("--frames %s: the film has a sound, which goes with one run of frames "
                           "such as 10-20",
                           cs_request_text(request, "--frames"));
  celspan_status status =
      cs_soundtrack_mix(script, frames->frames[0], (int64_t)frames->count, out, moments);
  return cs_report_failure(script->context, status, NULL);
}
