#include "video/encoder.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "inside/threads.h"
#include "process/interrupt.h"

#define THREADS_NEEDED 32          /* as many as the codecs of a film may start */
#define NANOSECONDS 1000000000     /* in a second */
#define PAUSE_NANOSECONDS 50000000 /* the pause between two checks for a signal */
#define LAST_SECONDS 2.0 /* for an encoder that has stopped reading to write its message and end */
#define PART 8192        /* samples that are read at a time */

/* ---------------------------------------------------------------- the feeder */

/* An encoder that needs no more sound closes its end of the pipe. *is_over: the end is closed. */
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

/* Starts to write the samples to the descriptor, which it closes in any case. *samples: moved to
 * the feeder. out: must not move while it is open. Errors: LIMIT. */
static celspan_status start_feeder(cs_feeder *out, celspan_context *context,
                                   cs_sound_stream *samples, int descriptor) {
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

/* Whether the samples cannot be read or written. */
static bool feeder_has_failed(const cs_feeder *feeder) {
  return atomic_load(&feeder->status) != CELSPAN_OK;
}

/* Ends the thread after the encoder has ended, and closes the samples; does nothing if it is not
 * open. */
static void end_feeder(cs_feeder *feeder) {
  if (!feeder->is_open)
    return;
  feeder->samples.stop(feeder->samples.user);
  cs_threads_join(&feeder->thread, 1);
  cs_sound_stream_close(&feeder->samples);
  feeder->is_open = false;
}

/* The outcome of a feeder that has ended. Errors: those of the samples; OUTPUT. */
static celspan_status outcome_of_feeder(const cs_feeder *feeder, celspan_context *context) {
  celspan_status status = (celspan_status)atomic_load(&feeder->status);
  return status == CELSPAN_OK ? status : cs_fail(context, status, "%s", feeder->branch.error);
}

/* ---------------------------------------------------------------- the writing thread */

/* The place at the head of the queue; -1 when there are no more frames. Locked. */
static int wait_for_frame(cs_encoder *encoder) {
  while (encoder->waiting == 0 && !encoder->is_complete)
    pthread_cond_wait(&encoder->changed, &encoder->mutex);
  return encoder->waiting > 0 ? encoder->queue[encoder->head] : -1;
}

static void drop_head(cs_encoder *encoder) {
  encoder->places[encoder->queue[encoder->head]].queued--;
  encoder->head = (encoder->head + 1) % CS_ENCODER_QUEUE;
  encoder->waiting--;
}

static void write_frames(void *user, int worker) {
  cs_encoder *encoder = user;
  (void)worker;
  pthread_mutex_lock(&encoder->mutex);
  for (int place; !encoder->is_broken && (place = wait_for_frame(encoder)) >= 0;) {
    pthread_mutex_unlock(&encoder->mutex);
    int error =
        cs_child_write(encoder->process.input, encoder->places[place].pixels, encoder->frame_size);
    pthread_mutex_lock(&encoder->mutex);
    encoder->is_broken = error != 0;
    encoder->error = error == EPIPE ? 0 : error;
    drop_head(encoder);
    pthread_cond_broadcast(&encoder->changed);
  }
  close(encoder->process.input);
  encoder->is_done = true;
  pthread_cond_broadcast(&encoder->changed);
  pthread_mutex_unlock(&encoder->mutex);
}

/* ---------------------------------------------------------------- opening */

static celspan_status fail_start(celspan_context *context, const char *name, const char *program,
                                 int error) {
  if (error == ENOENT)
    return cs_fail(context, CELSPAN_OUTPUT,
                   "%s: %s, which makes videos, is not in PATH: install the package ffmpeg", name,
                   program);
  bool is_starved = error == ENOMEM || error == EAGAIN;
  return cs_fail(context, is_starved ? CELSPAN_NO_MEMORY : CELSPAN_OUTPUT,
                 "%s: %s cannot be started: %s", name, program, strerror(error));
}

static void free_places(cs_encoder *encoder) {
  for (int i = 0; i < CS_ENCODER_PLACES; i++)
    cs_mem_free(encoder->context->memory, encoder->places[i].pixels, encoder->frame_size);
}

static celspan_status make_places(cs_encoder *encoder) {
  for (int i = 0; i < CS_ENCODER_PLACES; i++) {
    encoder->places[i].pixels =
        cs_mem_resize(encoder->context->memory, NULL, 0, encoder->frame_size);
    if (!encoder->places[i].pixels)
      return cs_fail_memory(encoder->context);
  }
  return CELSPAN_OK;
}

static celspan_status start_writer(cs_encoder *encoder) {
  if (cs_threads_start(&encoder->writer, 1, write_frames, encoder) == 1)
    return CELSPAN_OK;
  return cs_fail(encoder->context, CELSPAN_NO_MEMORY,
                 "%s: the system allows no thread for the encoder", encoder->name);
}

static celspan_status start_threads(cs_encoder *encoder, cs_sound_stream *samples) {
  celspan_status status = CELSPAN_OK;
  if (samples->user)
    status = start_feeder(&encoder->feeder, encoder->context, samples, encoder->process.samples);
  if (status == CELSPAN_OK)
    status = start_writer(encoder);
  if (status == CELSPAN_OK)
    return status;
  close(encoder->process.input);
  cs_child_end(&encoder->process, 0);
  end_feeder(&encoder->feeder);
  return status;
}

static celspan_status start(cs_encoder *encoder, const char *const *arguments,
                            cs_sound_stream *samples) {
  CS_TRY(make_places(encoder));
  int error = cs_child_start(&encoder->process, arguments, samples->user != NULL);
  return error ? fail_start(encoder->context, encoder->name, arguments[0], error)
               : start_threads(encoder, samples);
}

static void free_all(cs_encoder *encoder) {
  free_places(encoder);
  pthread_cond_destroy(&encoder->changed);
  pthread_mutex_destroy(&encoder->mutex);
}

celspan_status cs_encoder_open(cs_encoder *out, celspan_context *context, const char *name,
                               const char *const *arguments, size_t frame_size,
                               cs_sound_stream *samples) {
  pthread_condattr_t attributes;
  *out = (cs_encoder){.context = context, .name = name, .frame_size = frame_size, .last = -1};
  pthread_condattr_init(&attributes);
  pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
  pthread_cond_init(&out->changed, &attributes);
  pthread_condattr_destroy(&attributes);
  pthread_mutex_init(&out->mutex, NULL);
  celspan_status status = start(out, arguments, samples);
  out->is_open = status == CELSPAN_OK;
  if (status != CELSPAN_OK)
    free_all(out);
  return status;
}

/* ---------------------------------------------------------------- the end */

/* Ends the encoder. Returns the result of cs_child_end. */
static bool close_encoder(cs_encoder *encoder, double seconds) {
  bool is_over = cs_child_end(&encoder->process, seconds);
  pthread_mutex_lock(&encoder->mutex);
  encoder->is_broken = encoder->is_broken || !encoder->is_done;
  encoder->is_complete = true;
  pthread_cond_broadcast(&encoder->changed);
  pthread_mutex_unlock(&encoder->mutex);
  cs_threads_join(&encoder->writer, 1);
  end_feeder(&encoder->feeder);
  free_all(encoder);
  encoder->is_open = false;
  return is_over;
}

void cs_encoder_discard(cs_encoder *encoder) {
  if (encoder->is_open)
    close_encoder(encoder, 0);
}

static celspan_status stop(cs_encoder *encoder) {
  cs_encoder_discard(encoder);
  return cs_fail(encoder->context, CELSPAN_CANCELLED, "%s: stopped", encoder->name);
}

/* ffmpeg does not say that its codecs could start no threads. */
static celspan_status fail_threads(const cs_encoder *encoder) {
  char how[CS_WORDS + 64];
  cs_words_describe(&encoder->process.words, encoder->process.ending, how, sizeof how);
  return cs_fail(encoder->context, CELSPAN_NO_MEMORY,
                 "%s: ffmpeg %s; the system allows fewer than %d more threads, which it may need",
                 encoder->name, how, THREADS_NEEDED);
}

/* Waits for the end of an encoder that has read all frames, or has stopped reading. */
static celspan_status end(cs_encoder *encoder, bool has_read_all) {
  char how[CS_WORDS + 64];
  const cs_child *process = &encoder->process;
  bool has_failed = feeder_has_failed(&encoder->feeder);
  bool is_over = close_encoder(encoder, has_read_all ? INFINITY : has_failed ? 0 : LAST_SECONDS);
  if (!is_over && cs_interrupt_signal())
    return stop(encoder);
  CS_TRY(outcome_of_feeder(&encoder->feeder, encoder->context));
  if (has_read_all && process->ending == 0)
    return CELSPAN_OK;
  if (WIFEXITED(process->ending) && !cs_threads_are_free(THREADS_NEEDED))
    return fail_threads(encoder);
  if (encoder->error)
    return cs_fail(encoder->context, CELSPAN_OUTPUT, "%s: cannot write to ffmpeg: %s",
                   encoder->name, strerror(encoder->error));
  cs_words_describe(&process->words, process->ending, how, sizeof how);
  return cs_fail(encoder->context, CELSPAN_OUTPUT, "%s: ffmpeg %s", encoder->name,
                 !is_over               ? "stopped reading frames, but did not end"
                 : process->ending == 0 ? "ended before it had read every frame"
                                        : how);
}

celspan_status cs_encoder_run(celspan_context *context, const char *name,
                              const char *const *arguments) {
  cs_child process;
  char how[CS_WORDS + 64];
  int error = cs_child_start(&process, arguments, false);
  if (error)
    return fail_start(context, name, arguments[0], error);
  close(process.input);
  if (!cs_child_end(&process, INFINITY))
    return cs_fail(context, CELSPAN_CANCELLED, "%s: stopped", name);
  if (process.ending == 0)
    return CELSPAN_OK;
  cs_words_describe(&process.words, process.ending, how, sizeof how);
  return cs_fail(context, CELSPAN_OUTPUT, "%s: ffmpeg %s", name, how);
}

/* ---------------------------------------------------------------- waiting */

/* Waits for the writing thread while `holds` returns true. false: a signal asks to stop. Locked. */
static bool wait_while(cs_encoder *encoder, bool (*holds)(const cs_encoder *encoder)) {
  while (holds(encoder) && !encoder->is_broken) {
    struct timespec until;
    encoder->is_broken = feeder_has_failed(&encoder->feeder);
    if (cs_interrupt_signal())
      return false;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += PAUSE_NANOSECONDS;
    until.tv_sec += until.tv_nsec / NANOSECONDS;
    until.tv_nsec %= NANOSECONDS;
    pthread_cond_timedwait(&encoder->changed, &encoder->mutex, &until);
  }
  return true;
}

/* The same, and fails if the encoder has stopped reading. */
static celspan_status wait_for(cs_encoder *encoder, bool (*holds)(const cs_encoder *encoder)) {
  pthread_mutex_lock(&encoder->mutex);
  bool continues = wait_while(encoder, holds), is_broken = encoder->is_broken;
  pthread_mutex_unlock(&encoder->mutex);
  if (!continues)
    return stop(encoder);
  return is_broken ? end(encoder, false) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- frames */

static int free_place(const cs_encoder *encoder) {
  for (int i = 0; i < CS_ENCODER_PLACES; i++)
    if (i != encoder->last && encoder->places[i].queued == 0)
      return i;
  return -1;
}

static bool is_full(const cs_encoder *encoder) { return encoder->waiting == CS_ENCODER_QUEUE; }
static bool has_no_place(const cs_encoder *encoder) {
  return is_full(encoder) || free_place(encoder) < 0;
}
static bool is_writing(const cs_encoder *encoder) { return !encoder->is_done; }

/* Locked. */
static void queue(cs_encoder *encoder, int place) {
  encoder->queue[(encoder->head + encoder->waiting++) % CS_ENCODER_QUEUE] = place;
  encoder->places[place].queued++;
  encoder->last = place;
  pthread_cond_broadcast(&encoder->changed);
}

celspan_status cs_encoder_give(cs_encoder *encoder, unsigned char **pixels) {
  CS_TRY(wait_for(encoder, has_no_place));
  pthread_mutex_lock(&encoder->mutex);
  int place = free_place(encoder);
  unsigned char *given = *pixels;
  *pixels = encoder->places[place].pixels;
  encoder->places[place].pixels = given;
  queue(encoder, place);
  pthread_mutex_unlock(&encoder->mutex);
  return CELSPAN_OK;
}

celspan_status cs_encoder_repeat(cs_encoder *encoder) {
  CS_TRY(wait_for(encoder, is_full));
  pthread_mutex_lock(&encoder->mutex);
  queue(encoder, encoder->last);
  pthread_mutex_unlock(&encoder->mutex);
  return CELSPAN_OK;
}

celspan_status cs_encoder_finish(cs_encoder *encoder) {
  pthread_mutex_lock(&encoder->mutex);
  encoder->is_complete = true;
  pthread_cond_broadcast(&encoder->changed);
  pthread_mutex_unlock(&encoder->mutex);
  CS_TRY(wait_for(encoder, is_writing));
  return end(encoder, true);
}
