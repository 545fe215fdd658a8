/* A sound that ffmpeg decodes in a worker (plugins/isolate/sound_worker.h), as a stream of samples.
 *
 * INVARIANT: everything from the worker is checked, because a malicious sound may control the
 * worker: the form of the samples has bounds, and infinite samples become 0.
 */
#include "plugins/sound/sound.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.h"
#include "frames/process/interrupt.h"
#include "frames/process/spawn.h"
#include "frames/process/words.h"
#include "frames/video/sound_stream.h"
#include "plugins/isolate/client.h"
#include "plugins/isolate/sound_worker.h"
#include "plugins/isolate/worker.h"

enum { PAUSE = 50 /* milliseconds between two checks for a signal to stop */ };

typedef struct decoder {
  celspan_context *context; /* of the caller that opened it, for memory */
  size_t size;              /* bytes of this structure */
  int pipe, socket;         /* samples and messages of the worker; -1: closed */
  uint32_t number;          /* of the worker in the zygote */
  bool has_worker;
  size_t moment;     /* bytes */
  cs_words words;    /* of ffmpeg */
  double seconds;    /* the most seconds until more samples arrive; 0: any */
  uint64_t memory;   /* the limit; 0: any */
  atomic_bool stops; /* a read must end */
  char path[];
} decoder;

/* ---------------------------------------------------------------- failures */

static celspan_status fail_late(const decoder *d, celspan_context *context) {
  return cs_fail(context, CELSPAN_LIMIT,
                 "the sound %s cannot be read: for %g seconds no samples came of it, and decoding "
                 "was stopped (--limit picture-time=SECONDS)",
                 d->path, d->seconds);
}

/* Removes the name under which the worker has opened the file, because many messages begin with
 * it. */
static void remove_name(cs_words *words) {
  static const char name[] = CS_SOUND_WORKER_FILE ": ";
  for (char *at; (at = strstr(words->text, name));) {
    memmove(at, at + strlen(name), strlen(at + strlen(name)) + 1);
    words->size -= strlen(name);
  }
}

/* Whether the worker had no memory. A system without memory kills processes. */
static bool is_starved(const decoder *d, int ending) {
  return ending == -1 || (WIFSIGNALED(ending) && WTERMSIG(ending) == SIGKILL) ||
         strstr(d->words.text, "Cannot allocate memory") ||
         strstr(d->words.text, "failed to map segment");
}

/* The failure of ffmpeg. ending: the status of waitpid; -1: it is not known. */
static celspan_status fail_ending(decoder *d, celspan_context *context, int ending) {
  char how[CS_WORDS + 64];
  bool is_exit = ending != -1 && WIFEXITED(ending);
  remove_name(&d->words);
  if (is_exit && WEXITSTATUS(ending) == CS_SOUND_WORKER_MISSING)
    return cs_fail(context, CELSPAN_OUTPUT,
                   "the sound %s cannot be read: ffmpeg, which reads sounds, is not in PATH: "
                   "install the package ffmpeg",
                   d->path);
  if (is_starved(d, ending))
    return cs_fail(context, CELSPAN_NO_MEMORY,
                   "the sound %s cannot be read: out of memory: decoding it needs more than %llu "
                   "MiB, or than the system has (--limit picture-memory=SIZE)",
                   d->path, (unsigned long long)(d->memory >> 20));
  cs_words_describe(&d->words, ending, how, sizeof how);
  return cs_fail(context, CELSPAN_INPUT, "the sound %s cannot be read: ffmpeg %s", d->path, how);
}

/* ---------------------------------------------------------------- what the worker sends */

static void hear(decoder *d) {
  char bytes[CS_WORDS];
  ssize_t size = recv(d->socket, bytes, sizeof bytes, MSG_DONTWAIT);
  if (size > 0) {
    cs_words_add(&d->words, bytes, (size_t)size);
  } else if (size == 0 || (errno != EINTR && errno != EAGAIN)) {
    close(d->socket);
    d->socket = -1;
  }
}

/* Waits until the pipe has bytes or has ended. If the pipe is closed, waits for the socket instead.
 * false: the time limit is reached, or a signal or `stop` has come. */
static bool wait_for_more(decoder *d, bool *is_late) {
  double start = cs_clock_seconds();
  *is_late = false;
  while (d->pipe >= 0 || d->socket >= 0) {
    struct pollfd both[] = {{.fd = d->pipe, .events = POLLIN}, {.fd = d->socket, .events = POLLIN}};
    int count = poll(both, 2, PAUSE);
    if (cs_interrupt_signal() || atomic_load(&d->stops))
      return false;
    if (count > 0 && both[1].revents)
      hear(d);
    if (count > 0 && both[0].revents)
      return true;
    *is_late = d->seconds > 0 && cs_clock_seconds() - start > d->seconds;
    if (*is_late)
      return false;
  }
  return true;
}

/* Reads `size` bytes, or fewer at the end. */
static celspan_status read_bytes(decoder *d, celspan_context *context, unsigned char *out,
                                 size_t size, size_t *got) {
  *got = 0;
  while (*got < size && d->pipe >= 0) {
    bool is_late;
    if (!wait_for_more(d, &is_late))
      return is_late                 ? fail_late(d, context)
             : cs_interrupt_signal() ? cs_fail(context, CELSPAN_CANCELLED, "%s: stopped", d->path)
                                     : CELSPAN_OK;
    ssize_t part = read(d->pipe, out + *got, size - *got);
    if (part < 0 && errno == EINTR)
      continue;
    if (part <= 0) {
      close(d->pipe);
      d->pipe = -1;
    }
    *got += part > 0 ? (size_t)part : 0;
  }
  return CELSPAN_OK;
}

/* The outcome of the worker after its last sample. There are no messages after its end. */
static celspan_status conclude(decoder *d, celspan_context *context) {
  bool is_late = false;
  if (!d->has_worker)
    return CELSPAN_OK;
  if (d->socket >= 0 && !wait_for_more(d, &is_late))
    return is_late ? fail_late(d, context) : CELSPAN_OK;
  int ending = cs_client_end(d->number);
  d->has_worker = false;
  cs_words_join(&d->words);
  return ending == 0 ? CELSPAN_OK : fail_ending(d, context, ending);
}

/* ---------------------------------------------------------------- the stream */

static celspan_status read_samples(void *user, celspan_context *context, float *out, size_t count,
                                   size_t *got) {
  decoder *d = user;
  size_t bytes, whole = d->moment / sizeof *out;
  CS_TRY(read_bytes(d, context, (unsigned char *)out, count * d->moment, &bytes));
  *got = bytes / d->moment;
  for (size_t i = 0; i < *got * whole; i++)
    out[i] = isfinite(out[i]) ? out[i] : 0;
  return d->pipe >= 0 ? CELSPAN_OK : conclude(d, context);
}

static void stop(void *user) {
  decoder *d = user;
  atomic_store(&d->stops, true);
}

static void destroy(void *user) {
  decoder *d = user;
  if (d->has_worker)
    cs_client_end(d->number);
  if (d->pipe >= 0)
    close(d->pipe);
  if (d->socket >= 0)
    close(d->socket);
  cs_mem_free(d->context->memory, d, d->size);
}

/* ---------------------------------------------------------------- opening */

static decoder *create(celspan_context *context, const char *path) {
  const cs_worker_limits limits = cs_worker_limits_set();
  size_t size = sizeof(decoder) + strlen(path) + 1;
  decoder *d = cs_mem_resize(context->memory, NULL, 0, size);
  if (!d)
    return NULL;
  *d = (decoder){.context = context,
                 .size = size,
                 .pipe = -1,
                 .socket = -1,
                 .seconds = limits.seconds,
                 .memory = limits.memory};
  strcpy(d->path, path);
  return d;
}

static celspan_status start_worker(decoder *d, celspan_context *context,
                                   const cs_decoder_desc *desc) {
  const cs_message_start start = {.memory = d->memory ? d->memory + CS_SOUND_WORKER_LOADED : 0,
                                  .task = CS_WORKER_LISTENS};
  cs_message message = {
      .kind = CS_MESSAGE_OPEN,
      .sound = {.rate = desc->rate, .channels = desc->channels, .speed = desc->speed}};
  cs_picture_failure failure;
  int ends[2];
  int error = cs_spawn_pipe(ends);
  if (error)
    return cs_fail(context, CELSPAN_NO_MEMORY, "the sound %s cannot be read: no pipe: %s", d->path,
                   strerror(error));
  d->pipe = ends[0];
  celspan_status status = cs_client_start(&start, ends[1], &d->socket, &d->number, &failure);
  close(ends[1]);
  if (status != CELSPAN_OK)
    return cs_fail(context, status, "the sound %s cannot be read: %s", d->path, failure.text);
  d->has_worker = true;
  snprintf(message.text, sizeof message.text, "%s", desc->kind);
  /* If the message cannot be sent, the worker has ended, and the first read finds this. */
  (void)!cs_message_send(d->socket, &message, desc->descriptor);
  return CELSPAN_OK;
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
  b->status = read_bytes(b->d, b->context, bytes, size, &got);
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
  CS_TRY(d->pipe >= 0 ? CELSPAN_OK : conclude(d, context));
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
