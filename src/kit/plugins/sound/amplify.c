/* A stream with all samples of another one, louder or softer. */
#include "plugins/sound/loudness.h"

typedef struct amplifier {
  cs_sound_stream samples; /* owned */
  float gain;
  cs_memory *memory; /* borrowed from the context */
} amplifier;

static celspan_status read_louder(void *user, celspan_context *context, float *out, size_t count,
                                  size_t *got) {
  const amplifier *a = user;
  CS_TRY(a->samples.read(a->samples.user, context, out, count, got));
  for (size_t i = 0; i < *got * (size_t)a->samples.channels; i++)
    out[i] *= a->gain;
  return CELSPAN_OK;
}

static void stop(void *user) {
  const amplifier *a = user;
  a->samples.stop(a->samples.user);
}

static void close_both(void *user) {
  amplifier *a = user;
  cs_sound_stream_close(&a->samples);
  cs_mem_free(a->memory, a, sizeof *a);
}

celspan_status cs_amplify(celspan_context *context, cs_sound_stream *samples, double gain) {
  amplifier *a;
  celspan_status status = CS_MAKE(context, a, 1);
  if (status != CELSPAN_OK) {
    cs_sound_stream_close(samples);
    return status;
  }
  *a = (amplifier){*samples, (float)gain, context->memory};
  samples->user = a;
  samples->read = read_louder;
  samples->stop = stop;
  samples->close = close_both;
  return CELSPAN_OK;
}
