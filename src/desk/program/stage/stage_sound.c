/* The sound of a film that is watched: a part of it as a WAV file in memory, and the amplitudes of
 * its wave. */
#include <math.h>
#include <string.h>

#include "lua/bind/userdata.h"
#include "plugins/sound/wave_file.h"
#include "program/film/soundtrack.h"
#include "program/stage/stage.h"

enum {
  SECONDS_MOST = 600, /* length of a WAV file in memory */
  COLUMNS_MOST = 10000,
  PIECE = 2048 /* moments that are read at a time */
};

static int fail(lua_State *L, const char *message) {
  luaL_pushfail(L);
  lua_pushstring(L, message);
  return 2;
}

CS_HOLDER_FINISH(close_stream, cs_sound_stream_close)

/* Pushes the holder of the mix of some frames. Argument 2: the first frame; 3: their number. NULL:
 * it failed, and nil and the message are pushed. */
static cs_sound_stream *push_mix(lua_State *L, cs_script *script, int64_t *moments) {
  int64_t first = luaL_checkinteger(L, 2), count = luaL_checkinteger(L, 3);
  cs_sound_stream *mix =
      cs_userdata_push_holder(L, "celspan.program.mix", sizeof *mix, close_stream);
  if (cs_soundtrack_mix(script, first, count, mix, moments) == CELSPAN_OK)
    return mix;
  mix->user = NULL;
  fail(L, celspan_context_error(script->context));
  return NULL;
}

/* ---------------------------------------------------------------- a WAV file */

static celspan_status put_bytes(void *user, celspan_context *context, const void *bytes,
                                size_t size) {
  unsigned char **at = user;
  (void)context;
  memcpy(*at, bytes, size);
  *at += size;
  return CELSPAN_OK;
}

/* film:sound(first, count) -> the mix of these frames as the bytes of a WAV file of 16 bits | nil,
 * message */
int cs_stage_sound(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  int64_t moments;
  double peak, count = (double)luaL_checkinteger(L, 3);
  if (count > SECONDS_MOST * script->film.frames_second)
    return fail(L, "more than 600 seconds of sound at once: ask for parts of it");
  const cs_sound_stream *mix = push_mix(L, script, &moments);
  if (!mix)
    return 2;
  size_t size = (size_t)cs_wave_file_size(mix, moments, false);
  unsigned char *bytes = lua_newuserdatauv(L, size, 0), *at = bytes;
  const cs_wave_target target = {&at, put_bytes};
  if (cs_wave_file_put(script->context, "sound", &target, mix, moments, false, &peak) != CELSPAN_OK)
    return fail(L, celspan_context_error(script->context));
  lua_pushlstring(L, (const char *)bytes, size);
  return 1;
}

/* ---------------------------------------------------------------- the wave */

/* Columns, filled from the left, each with the greatest magnitude of its moments. */
typedef struct wave {
  unsigned char *columns;
  int64_t count, moments;
  int64_t at; /* the next moment */
} wave;

static void add_moment(wave *w, const float *samples, int channels) {
  int64_t column = w->at++ * w->count / w->moments;
  for (int i = 0; i < channels; i++) {
    unsigned char height = (unsigned char)fmin(255, 255 * fabs((double)samples[i]));
    if (height > w->columns[column])
      w->columns[column] = height;
  }
}

static celspan_status read_wave(celspan_context *context, const cs_sound_stream *mix, wave *w) {
  float samples[PIECE * CS_MIX_CHANNELS];
  size_t got = 1;
  while (w->at < w->moments && got > 0) {
    int64_t left = w->moments - w->at;
    CS_TRY(mix->read(mix->user, context, samples, left < PIECE ? (size_t)left : PIECE, &got));
    for (size_t i = 0; i < got; i++)
      add_moment(w, samples + i * CS_MIX_CHANNELS, CS_MIX_CHANNELS);
  }
  return CELSPAN_OK;
}

/* film:wave(first, count, columns) -> a byte for each column: the amplitude of the mix of these
 * frames, from silence, 0, to full scale, 255 | nil, message */
int cs_stage_wave(lua_State *L) {
  cs_script *script = cs_service_opened(L);
  wave w = {.count = luaL_checkinteger(L, 4)};
  luaL_argcheck(L, w.count > 0 && w.count <= COLUMNS_MOST, 4, "out of range");
  const cs_sound_stream *mix = push_mix(L, script, &w.moments);
  if (!mix)
    return 2;
  w.columns = lua_newuserdatauv(L, (size_t)w.count, 0);
  memset(w.columns, 0, (size_t)w.count);
  if (read_wave(script->context, mix, &w) != CELSPAN_OK)
    return fail(L, celspan_context_error(script->context));
  lua_pushlstring(L, (const char *)w.columns, (size_t)w.count);
  return 1;
}
