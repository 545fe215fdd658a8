/* A sound that ffmpeg decodes in a worker (plugins/isolate/media.h), as a stream of samples.
 *
 * INVARIANT: everything from the worker is checked, because a malicious sound may control the
 * worker: the form of the samples has bounds, and infinite samples become 0.
 */
#include "plugins/sound/sound.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "common/sound_stream.h"
#include "plugins/isolate/media.h"

typedef struct decoder {
  celspan_context *context; /* the context of the caller that opened it, for memory */
  size_t size;              /* bytes of this structure */
  cs_media media;
  size_t moment; /* bytes */
  char path[];
} decoder;

/* ---------------------------------------------------------------- the stream */

static celspan_status read_samples(void *user, celspan_context *context, float *out, size_t count,
                                   size_t *got) {
  decoder *d = user;
  size_t bytes, whole = d->moment / sizeof *out;
  CS_TRY(cs_media_read(&d->media, context, (unsigned char *)out, count * d->moment, &bytes));
  *got = bytes / d->moment;
  for (size_t i = 0; i < *got * whole; i++)
    out[i] = isfinite(out[i]) ? out[i] : 0;
  return d->media.pipe >= 0 ? CELSPAN_OK : cs_media_conclude(&d->media, context);
}

static void stop(void *user) {
  decoder *d = user;
  atomic_store(&d->media.stops, true);
}

static void destroy(void *user) {
  decoder *d = user;
  cs_media_close(&d->media);
  cs_mem_free(d->context->memory, d, d->size);
}

/* ---------------------------------------------------------------- opening */

static decoder *create(celspan_context *context, const char *path) {
  size_t size = sizeof(decoder) + strlen(path) + 1;
  decoder *d = cs_mem_resize(context->memory, NULL, 0, size);
  if (!d)
    return NULL;
  *d = (decoder){.context = context, .size = size, .media = CS_MEDIA("sound", "samples", d->path)};
  strcpy(d->path, path);
  return d;
}

static celspan_status start_worker(decoder *d, celspan_context *context,
                                   const cs_decoder_desc *desc) {
  cs_message message = {
      .kind = CS_MESSAGE_OPEN,
      .sound = {.rate = desc->rate, .channels = desc->channels, .speed = desc->speed}};
  snprintf(message.text, sizeof message.text, "%s", desc->kind);
  return cs_media_start(&d->media, context, CS_WORKER_LISTENS, &message, desc->descriptor);
}

/* ---------------------------------------------------------------- the form of the samples */

/* The beginning of a WAV file of 32-bit float samples without a known end: the form in which
 * samples come through a pipe from ffmpeg.
 *
 *   "RIFF" size "WAVE" | "fmt " size, form of the samples | ... | "data" size | samples
 *
 * INVARIANT: sizes of the whole are not read, because a pipe has none; all other numbers are
 * checked.
 */

typedef struct wave {
  int32_t rate, channels;
  uint32_t places; /* see sound_stream.h */
} wave;

enum {
  EXTENSIBLE = 0xfffe, /* the form is in a longer chunk, which also has the places */
  WAVE_FORM = 40,      /* bytes of that chunk */
  PLAIN_FORM = 16,     /* the least number of bytes of the chunk */
  CHUNK_MOST = 4096,   /* bytes of other chunks before the samples */
  CHUNKS_MOST = 16
};

/* Samples are floats: the first word of the identifier is the usual number of the form. */
static const unsigned char FLOATS[16] = {3,    0, 0, 0,    0, 0,    0x10, 0,
                                         0x80, 0, 0, 0xaa, 0, 0x38, 0x9b, 0x71};

typedef struct beginning {
  decoder *d;
  celspan_context *context;
  celspan_status status;
} beginning;

/* false: fewer than `size` bytes are left. */
static bool read_beginning(beginning *b, unsigned char *bytes, size_t size) {
  size_t got = 0;
  b->status = cs_media_read(&b->d->media, b->context, bytes, size, &got);
  return b->status == CELSPAN_OK && got == size;
}

static uint32_t get(const unsigned char *at, int bytes) {
  uint32_t value = 0;
  for (int i = 0; i < bytes; i++)
    value |= (uint32_t)at[i] << (8 * i);
  return value;
}

static bool read_wave_form(const unsigned char *form, uint32_t size, wave *out) {
  bool is_longer = get(form, 2) == EXTENSIBLE;
  if (size < PLAIN_FORM || (is_longer && size < WAVE_FORM))
    return false;
  uint32_t channels = get(form + 2, 2), rate = get(form + 4, 4);
  *out = (wave){.rate = rate <= CS_SOUND_STREAM_RATE ? (int32_t)rate : 0,
                .channels = channels <= CS_SOUND_STREAM_CHANNELS ? (int32_t)channels : 0,
                .places = is_longer ? get(form + 20, 4) : 0};
  bool is_float = is_longer ? memcmp(form + 24, FLOATS, sizeof FLOATS) == 0 : get(form, 2) == 3;
  return is_float && get(form + 14, 2) == 32 && out->rate > 0 && out->channels > 0;
}

/* Reads the beginning, up to the first sample. false: it is missing, or has another form. */
static bool read_wave(beginning *b, wave *out) {
  unsigned char head[12], chunk[CHUNK_MOST];
  *out = (wave){0};
  if (!read_beginning(b, head, 12) || memcmp(head, "RIFF", 4) != 0 ||
      memcmp(head + 8, "WAVE", 4) != 0)
    return false;
  for (int i = 0; i < CHUNKS_MOST; i++) {
    if (!read_beginning(b, head, 8))
      return false;
    uint32_t size = get(head + 4, 4);
    if (memcmp(head, "data", 4) == 0)
      return out->rate > 0;
    if (size > CHUNK_MOST || !read_beginning(b, chunk, size + size % 2))
      return false;
    if (memcmp(head, "fmt ", 4) == 0 && !read_wave_form(chunk, size, out))
      return false;
  }
  return false;
}

/* ffmpeg writes the form of the samples after it has decoded the first ones. */
static celspan_status read_form(decoder *d, celspan_context *context, wave *out) {
  beginning b = {d, context, CELSPAN_OK};
  if (read_wave(&b, out))
    return CELSPAN_OK;
  CS_TRY(b.status);
  CS_TRY(d->media.pipe >= 0 ? CELSPAN_OK : cs_media_conclude(&d->media, context));
  return cs_fail(context, CELSPAN_INPUT,
                 "the sound %s cannot be read: its decoder sent invalid samples; it is damaged or "
                 "malicious",
                 d->path);
}

static celspan_status begin(decoder *d, celspan_context *context, const cs_decoder_desc *desc,
                            wave *form) {
  CS_TRY(start_worker(d, context, desc));
  CS_TRY(read_form(d, context, form));
  d->moment = (size_t)form->channels * sizeof(float);
  return CELSPAN_OK;
}

celspan_status cs_decoder_open(celspan_context *context, const cs_decoder_desc *desc,
                               cs_sound_stream *out) {
  wave form;
  decoder *d = create(context, desc->path);
  if (!d)
    return cs_fail_memory(context);
  celspan_status status = begin(d, context, desc, &form);
  if (status != CELSPAN_OK) {
    destroy(d);
    return status;
  }
  *out = (cs_sound_stream){.user = d,
                           .rate = form.rate,
                           .channels = form.channels,
                           .places = form.places,
                           .read = read_samples,
                           .stop = stop,
                           .close = destroy};
  return CELSPAN_OK;
}
