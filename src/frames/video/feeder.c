#include "frames/video/feeder.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "frames/process/child.h"

enum { PART = 8192 }; /* samples that are read at a time */

/* ---------------------------------------------------------------- the thread */

/* An encoder that has enough of the sound closes its end. *is_over: it has. */
static celspan_status put(cs_feeder *feeder, const void *bytes, size_t size, bool *is_over) {
  int error = cs_child_write(feeder->descriptor, bytes, size);
  *is_over = error != 0;
  if (error == 0 || error == EPIPE)
    return CELSPAN_OK;
  return cs_fail(&feeder->branch, CELSPAN_OUTPUT, "the sound cannot be written to ffmpeg: %s",
                 strerror(error));
}

static celspan_status feed(cs_feeder *feeder) {
  float part[PART];
  const cs_sound_stream *samples = &feeder->samples;
  size_t moments = PART / (size_t)samples->channels, got = moments;
  bool is_over = false;
  while (!is_over && got == moments) {
    CS_TRY(samples->read(samples->user, &feeder->branch, part, moments, &got));
    CS_TRY(put(feeder, part, got * (size_t)samples->channels * sizeof *part, &is_over));
  }
  return CELSPAN_OK;
}

static void run(void *user, int worker) {
  cs_feeder *feeder = user;
  (void)worker;
  atomic_store(&feeder->status, (int)feed(feeder));
  close(feeder->descriptor);
}

/* ---------------------------------------------------------------- start and end */

celspan_status cs_feeder_open(cs_feeder *out, celspan_context *context, cs_sound_stream *samples,
                              int descriptor) {
  out->samples = *samples;
  samples->user = NULL;
  out->descriptor = descriptor;
  atomic_init(&out->status, CELSPAN_OK);
  cs_context_branch(&out->branch, context);
  out->is_open = cs_threads_start(&out->thread, 1, run, out) == 1;
  if (out->is_open)
    return CELSPAN_OK;
  close(descriptor);
  cs_sound_stream_close(&out->samples);
  return cs_fail(context, CELSPAN_NO_MEMORY, "no thread can be started for the sound");
}

bool cs_feeder_has_failed(const cs_feeder *feeder) {
  return atomic_load(&feeder->status) != CELSPAN_OK;
}

void cs_feeder_end(cs_feeder *feeder) {
  if (!feeder->is_open)
    return;
  feeder->samples.stop(feeder->samples.user);
  cs_threads_join(&feeder->thread, 1);
  cs_sound_stream_close(&feeder->samples);
  feeder->is_open = false;
}

celspan_status cs_feeder_outcome(const cs_feeder *feeder, celspan_context *context) {
  celspan_status status = (celspan_status)atomic_load(&feeder->status);
  return status == CELSPAN_OK ? status : cs_fail(context, status, "%s", feeder->branch.error);
}
