#include "plugins/sound/wave_file.h"

#include <math.h>
#include <string.h>

#include "common/bytes.h"
#include "inside/sinks.h"

enum { PIECE = 4096, HEAD = 58, WHOLE_HEAD = 44, FLOAT = 3, WHOLE = 1 };

typedef struct writing {
  const cs_wave_target *target;
  const cs_sound_stream *samples;
  bool is_float;
  double peak;
  float piece[PIECE];
  unsigned char bytes[PIECE * sizeof(float)];
} writing;

/* ---------------------------------------------------------------- bytes */

static unsigned char *put(unsigned char *at, uint32_t number, int size) {
  return cs_bytes_put_little(at, number, size);
}

static unsigned char *put_name(unsigned char *at, const char *name) {
  memcpy(at, name, 4);
  return at + 4;
}

/* A format of floats has the size of its extension, 0, and the number of moments. */
static size_t make_head(const writing *w, uint32_t moments, unsigned char out[HEAD]) {
  uint32_t channels = (uint32_t)w->samples->channels, rate = (uint32_t)w->samples->rate;
  uint32_t size = w->is_float ? 4 : 2, bytes = moments * channels * size;
  unsigned char *at = put_name(out, "RIFF");
  at = put_name(put(at, (w->is_float ? 50 : 36) + bytes, 4), "WAVE");
  at = put(put_name(at, "fmt "), w->is_float ? 18 : 16, 4);
  at = put(put(at, w->is_float ? FLOAT : WHOLE, 2), channels, 2);
  at = put(put(at, rate, 4), rate * channels * size, 4);
  at = put(put(at, channels * size, 2), 8 * size, 2);
  if (w->is_float)
    at = put(put(put_name(put(at, 0, 2), "fact"), 4, 4), moments, 4);
  at = put(put_name(at, "data"), bytes, 4);
  return (size_t)(at - out);
}

static unsigned char *put_sample(const writing *w, unsigned char *at, float sample) {
  uint32_t bits;
  memcpy(&bits, &sample, sizeof bits);
  if (w->is_float)
    return put(at, bits, 4);
  double code = fmax(-32768, fmin(32767, nearbyint((double)sample * 32768)));
  return put(at, (uint32_t)(int32_t)code, 2);
}

/* ---------------------------------------------------------------- the file */

static celspan_status write_piece(writing *w, celspan_context *context, size_t moments) {
  size_t count = moments * (size_t)w->samples->channels;
  unsigned char *at = w->bytes;
  for (size_t i = 0; i < count; i++) {
    w->peak = fmax(w->peak, fabs((double)w->piece[i]));
    at = put_sample(w, at, w->piece[i]);
  }
  return w->target->put(w->target->user, context, w->bytes, (size_t)(at - w->bytes));
}

static celspan_status write_all(writing *w, celspan_context *context, int64_t moments) {
  unsigned char head[HEAD];
  size_t most = PIECE / (size_t)w->samples->channels;
  size_t size = make_head(w, (uint32_t)moments, head);
  CS_TRY(w->target->put(w->target->user, context, head, size));
  while (moments > 0) {
    size_t got, wanted = moments < (int64_t)most ? (size_t)moments : most;
    CS_TRY(w->samples->read(w->samples->user, context, w->piece, wanted, &got));
    if (got < wanted)
      return cs_fail(context, CELSPAN_CANCELLED, "the sound was stopped");
    CS_TRY(write_piece(w, context, got));
    moments -= (int64_t)got;
  }
  return CELSPAN_OK;
}

int64_t cs_wave_file_size(const cs_sound_stream *samples, int64_t moments, bool is_float) {
  return (is_float ? HEAD : WHOLE_HEAD) + moments * samples->channels * (is_float ? 4 : 2);
}

celspan_status cs_wave_file_put(celspan_context *context, const char *name,
                                const cs_wave_target *target, const cs_sound_stream *samples,
                                int64_t moments, bool is_float, double *peak) {
  if (cs_wave_file_size(samples, moments, is_float) > (int64_t)UINT32_MAX)
    return cs_fail(context, CELSPAN_LIMIT,
                   "%s: %.0f seconds of sound: a WAV file has at most 4 GiB", name,
                   (double)moments / samples->rate);
  writing *w;
  CS_TRY(CS_MAKE(context, w, 1));
  w->target = target;
  w->samples = samples;
  w->is_float = is_float;
  celspan_status status = write_all(w, context, moments);
  *peak = w->peak;
  cs_mem_free(context->memory, w, sizeof *w);
  return status;
}

static celspan_status put_in_file(void *user, celspan_context *context, const void *bytes,
                                  size_t size) {
  return cs_file_write(user, context, bytes, size);
}

celspan_status cs_wave_file_write(celspan_context *context, const char *path,
                                  const cs_sound_stream *samples, int64_t moments, bool is_float,
                                  double *peak) {
  cs_file *file;
  CS_TRY(cs_file_create(context, NULL, path, &file));
  const cs_wave_target target = {file, put_in_file};
  celspan_status status =
      cs_wave_file_put(context, path, &target, samples, moments, is_float, peak);
  return cs_file_end(file, context, status);
}
