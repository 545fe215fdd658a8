#include "plugins/sound/mix.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "common/address.h"
#include "inside/files.h"
#include "plugins/sound/sound.h"

enum {
  PIECE = 4096,                    /* moments that are mixed at a time */
  KEPT_MOMENTS = 10 * CS_MIX_RATE, /* the length of a sound whose samples are kept, ... */
  KEPT_ALL = 16 * 1024 * 1024      /* ... and the most samples of all sounds */
};

/* One sound while it is mixed. Positions are in moments of the film. */
typedef struct part {
  cs_mix_sound sound;
  int64_t origin; /* the origin of its first sample */
  double end;     /* second at which it ends by itself */
  bool is_whole;  /* the end is known exactly; otherwise it is only known to be late enough */
  int64_t heard, silent;   /* the sound is heard from `heard` until before `silent` */
  cs_sound_stream samples; /* owned; without one it is closed */
  int64_t place;           /* the place of the next sample that is read */
  float *kept;      /* the counted samples, if they are few, so that the file is not opened again */
  size_t capacity;  /* the capacity of the kept samples; 0: they belong to another part */
  int32_t channels; /* how many the samples have */
  int64_t moments;
} part;

typedef struct mix {
  celspan_context *context; /* the context of the caller that opened it, for memory */
  part *parts;              /* owned */
  size_t count, open;
  size_t kept;           /* samples of all parts */
  double slope;          /* seconds: the longest slope of all duckers */
  int64_t place, end;    /* the next moment; the end of the last one */
  pthread_mutex_t mutex; /* held while samples are opened or closed, and by `stop` */
  bool stops;            /* protected by the mutex */
  double gains[PIECE];
  double sum[PIECE * CS_MIX_CHANNELS];
  float samples[PIECE * CS_MIX_CHANNELS];
} mix;

static int64_t moment_of(double seconds) { return llround(seconds * CS_MIX_RATE); }

/* ---------------------------------------------------------------- failures */

/* Puts the place of the sound before the sentence. */
static celspan_status name_sound(celspan_context *context, const cs_mix_sound *sound,
                                 celspan_status status) {
  char sentence[CS_ERROR_SIZE];
  if (status != CELSPAN_INPUT)
    return status;
  snprintf(sentence, sizeof sentence, "%s", context->error);
  return cs_fail(context, status, "film: sound %d: %s", sound->number, sentence);
}

/* ---------------------------------------------------------------- lengths */

/* ffmpeg mixes sounds of more than two channels down to two. */
static celspan_status open_samples(celspan_context *context, const cs_mix_sound *sound,
                                   cs_sound_stream *out) {
  cs_sound_request request = {.path = sound->path, .rate = CS_MIX_RATE, .speed = sound->speed};
  CS_TRY(cs_sound_open(context, &request, out));
  if (out->channels <= CS_MIX_CHANNELS && out->rate == CS_MIX_RATE)
    return CELSPAN_OK;
  cs_sound_stream_close(out);
  request.channels = CS_MIX_CHANNELS;
  CS_TRY(cs_sound_open(context, &request, out));
  if (out->channels == CS_MIX_CHANNELS && out->rate == CS_MIX_RATE)
    return CELSPAN_OK;
  cs_sound_stream_close(out);
  return cs_fail(context, CELSPAN_INPUT,
                 "the sound %s cannot be read: its decoder sent invalid samples; it is damaged or "
                 "malicious",
                 cs_sound_name(sound->path));
}

static void drop_kept(mix *m, part *p) {
  if (p->capacity > 0)
    cs_mem_free(m->context->memory, p->kept, p->capacity * sizeof *p->kept);
  m->kept -= p->capacity;
  p->kept = NULL;
  p->capacity = 0;
}

/* Keeps samples that were read, after the kept ones, as long as their number is small. */
static celspan_status keep_samples(mix *m, celspan_context *context, part *p, size_t count) {
  size_t used = (size_t)(p->moments * p->channels), before = p->capacity;
  bool is_first = p->moments == 0;
  if (count == 0 || (!is_first && !p->kept))
    return CELSPAN_OK;
  if (p->moments >= KEPT_MOMENTS || m->kept > KEPT_ALL) {
    drop_kept(m, p);
    return CELSPAN_OK;
  }
  CS_TRY(CS_RESERVE(context, p->kept, p->capacity, used + count));
  m->kept += p->capacity - before;
  memcpy(p->kept + used, m->samples, count * sizeof *p->kept);
  return CELSPAN_OK;
}

/* Reads up to `most` moments of the sound, to count them. */
static celspan_status count_moments(mix *m, celspan_context *context, part *p, int64_t most) {
  cs_sound_stream samples;
  CS_TRY(open_samples(context, &p->sound, &samples));
  celspan_status status = CELSPAN_OK;
  p->channels = samples.channels;
  for (size_t got = PIECE; status == CELSPAN_OK && got == PIECE && p->moments < most;) {
    status = samples.read(samples.user, context, m->samples, PIECE, &got);
    if (status == CELSPAN_OK)
      status = keep_samples(m, context, p, got * (size_t)samples.channels);
    p->moments += status == CELSPAN_OK ? (int64_t)got : 0;
    p->is_whole = got < PIECE;
  }
  cs_sound_stream_close(&samples);
  return status;
}

/* The last second of the film that can affect how the sound is heard. */
static double last_second(const mix *m, const cs_mix_sound *sound) {
  double last = (double)m->end / CS_MIX_RATE;
  for (size_t i = 0; i < sound->passage_count; i++)
    last = fmin(last, sound->passages[i].end);
  return last;
}

/* Takes the length from an earlier part with the same samples; false: no earlier part was counted
 * as far as this one needs. */
static bool take_known(const mix *m, part *p, int64_t most) {
  for (const part *q = m->parts; q < p; q++) {
    bool is_same = q->sound.speed == p->sound.speed && strcmp(q->sound.path, p->sound.path) == 0;
    if (is_same && (q->is_whole || q->moments >= most)) {
      p->moments = q->moments;
      p->is_whole = q->is_whole;
      p->kept = q->kept;
      p->channels = q->channels;
      return true;
    }
  }
  return false;
}

static celspan_status refuse_from(celspan_context *context, const part *p) {
  const cs_mix_sound *sound = &p->sound;
  double seconds = (double)p->moments / CS_MIX_RATE * sound->speed;
  return cs_fail(context, CELSPAN_INPUT,
                 "field 'from' must be below the length of %s, %.6g seconds, got %.6g",
                 cs_sound_name(sound->path), seconds, sound->from);
}

/* Whether a sound is heard in the mix, or is close enough to duck a sound that is heard. */
static bool matters(const mix *m, const cs_mix_sound *sound) {
  double first = (double)m->place / CS_MIX_RATE, last = (double)m->end / CS_MIX_RATE;
  for (size_t i = 0; i < sound->passage_count; i++)
    if (sound->passages[i].begin > last + m->slope || sound->passages[i].end < first - m->slope)
      return false;
  return true;
}

/* Finds out when the sound ends. */
static celspan_status measure(mix *m, celspan_context *context, part *p) {
  const cs_mix_sound *sound = &p->sound;
  double last = last_second(m, sound) + sound->passages[0].fade_out;
  int64_t most = moment_of(fmax(last, sound->passages[0].begin) - sound->start) + 1;
  if (!take_known(m, p, most))
    CS_TRY(count_moments(m, context, p, most));
  p->end = sound->start + (double)p->moments / CS_MIX_RATE;
  if (sound->from > 0 && p->origin + p->moments <= moment_of(sound->passages[0].begin))
    return refuse_from(context, p);
  return CELSPAN_OK;
}

static double passage_end(const part *p, size_t i) {
  double end = p->sound.passages[i].end;
  return i == 0 ? fmin(end, p->end) : end;
}

static void set_heard(part *p) {
  p->heard = INT64_MIN;
  p->silent = INT64_MAX;
  for (size_t i = 0; i < p->sound.passage_count; i++) {
    int64_t begin = moment_of(p->sound.passages[i].begin), end = moment_of(passage_end(p, i));
    p->heard = begin > p->heard ? begin : p->heard;
    p->silent = end < p->silent ? end : p->silent;
  }
}

/* ---------------------------------------------------------------- gains */

static double fade_at(double distance, double length) {
  return length > 0 ? fmax(0, fmin(1, distance / length)) : 1;
}

static double passages_at(const part *p, double seconds) {
  double gain = 1;
  for (size_t i = 0; i < p->sound.passage_count; i++) {
    const celspan_sound_passage *passage = &p->sound.passages[i];
    gain *= fade_at(seconds - passage->begin, passage->fade_in) *
            fade_at(passage_end(p, i) - seconds, passage->fade_out);
  }
  return gain;
}

/* The position of a moment on a slope: 0 at its lower end and beyond, 1 at the upper end. */
static double slope_at(double distance, double length) {
  return distance <= 0 ? 0 : distance < length ? distance / length : 1;
}

/* Lowers the gains, from a place on, to the gains that a ducker allows. */
static void duck(mix *m, const celspan_sound_ducker *ducker, int64_t place, size_t count) {
  const part *q = &m->parts[ducker->sound];
  double attack = ducker->attack * CS_MIX_RATE, release = ducker->release * CS_MIX_RATE;
  if (q->heard >= q->silent || (double)(q->heard - place) > (double)count + attack ||
      (double)(place - q->silent) > release)
    return;
  for (size_t i = 0; i < count; i++) {
    int64_t at = place + (int64_t)i;
    double before = slope_at((double)(q->heard - at), attack);
    double after = slope_at((double)(at - q->silent + 1), release);
    double left = ducker->gain + (1 - ducker->gain) * fmax(before, after);
    m->gains[i] = fmin(m->gains[i], left);
  }
}

/* Sets the gains of a part from a place on: first, the gains that its duckers allow. */
static void set_gains(mix *m, const part *p, int64_t place, size_t count) {
  for (size_t i = 0; i < count; i++)
    m->gains[i] = 1;
  for (size_t i = 0; i < p->sound.ducker_count; i++)
    duck(m, &p->sound.duckers[i], place, count);
  for (size_t i = 0; i < count; i++)
    m->gains[i] *= passages_at(p, (double)(place + (int64_t)i) / CS_MIX_RATE);
}

/* ---------------------------------------------------------------- parts */

static void close_part(mix *m, part *p) {
  pthread_mutex_lock(&m->mutex);
  m->open -= p->samples.user != NULL;
  cs_sound_stream_close(&p->samples);
  pthread_mutex_unlock(&m->mutex);
}

/* Opening may take long, so `stop` need not wait for it. */
static celspan_status open_part(mix *m, celspan_context *context, part *p) {
  cs_sound_stream samples;
  if (m->open == CS_MIX_OPEN)
    return cs_fail(context, CELSPAN_LIMIT,
                   "film: more than %d sounds are heard at second %.3f, which is the limit: mix "
                   "some of them beforehand",
                   CS_MIX_OPEN, (double)m->place / CS_MIX_RATE);
  CS_TRY(open_samples(context, &p->sound, &samples));
  pthread_mutex_lock(&m->mutex);
  p->samples = samples;
  p->place = p->origin;
  m->open++;
  if (m->stops)
    samples.stop(samples.user);
  pthread_mutex_unlock(&m->mutex);
  return CELSPAN_OK;
}

/* Reads up to PIECE samples. *got: fewer only at the end. */
static celspan_status read_part(mix *m, celspan_context *context, part *p, int64_t count,
                                size_t *got) {
  CS_TRY(p->samples.read(p->samples.user, context, m->samples, (size_t)count, got));
  p->place += (int64_t)*got;
  return CELSPAN_OK;
}

/* Skips the samples before a place. *is_there: there is a sample at this place. */
static celspan_status skip_to(mix *m, celspan_context *context, part *p, int64_t place,
                              bool *is_there) {
  size_t got = 1;
  while (p->place < place && got > 0) {
    int64_t left = place - p->place;
    CS_TRY(read_part(m, context, p, left < PIECE ? left : PIECE, &got));
  }
  *is_there = p->place == place;
  return CELSPAN_OK;
}

static void add_samples(mix *m, const part *p, int64_t place, const float *samples,
                        int32_t channels, size_t count) {
  double *sum = m->sum + (place - m->place) * CS_MIX_CHANNELS;
  set_gains(m, p, place, count);
  for (size_t i = 0; i < count; i++)
    for (int c = 0; c < CS_MIX_CHANNELS; c++)
      sum[i * CS_MIX_CHANNELS + (size_t)c] +=
          (double)samples[i * (size_t)channels + (size_t)(c < channels ? c : 0)] * m->gains[i] *
          p->sound.gain[c];
}

/* Adds the kept samples from one place to another. */
static void add_kept(mix *m, const part *p, int64_t from, int64_t to) {
  int64_t end = p->origin + p->moments;
  if (from < end)
    add_samples(m, p, from, p->kept + (from - p->origin) * p->channels, p->channels,
                (size_t)((to < end ? to : end) - from));
}

/* Adds the samples from the part's decoder. */
static celspan_status add_read(mix *m, celspan_context *context, part *p, int64_t from,
                               int64_t to) {
  bool is_there;
  size_t got = 0;
  if (!p->samples.user)
    CS_TRY(open_part(m, context, p));
  CS_TRY(skip_to(m, context, p, from, &is_there));
  if (is_there)
    CS_TRY(read_part(m, context, p, to - from, &got));
  add_samples(m, p, from, m->samples, p->samples.channels, got);
  return CELSPAN_OK;
}

/* Adds the part's samples before `end`. */
static celspan_status add_part(mix *m, celspan_context *context, part *p, int64_t end) {
  int64_t from = p->heard > m->place ? p->heard : m->place, to = p->silent < end ? p->silent : end;
  if (from >= to)
    return CELSPAN_OK;
  if (p->kept)
    add_kept(m, p, from, to);
  else
    CS_TRY(add_read(m, context, p, from, to));
  if (p->silent <= end)
    close_part(m, p);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the stream */

static celspan_status mix_piece(mix *m, celspan_context *context, float *out, size_t count) {
  int64_t end = m->place + (int64_t)count;
  memset(m->sum, 0, count * CS_MIX_CHANNELS * sizeof *m->sum);
  for (size_t i = 0; i < m->count; i++)
    CS_TRY(name_sound(context, &m->parts[i].sound, add_part(m, context, &m->parts[i], end)));
  for (size_t i = 0; i < count * CS_MIX_CHANNELS; i++)
    out[i] = (float)m->sum[i];
  m->place = end;
  return CELSPAN_OK;
}

static bool is_stopped(mix *m) {
  pthread_mutex_lock(&m->mutex);
  bool stops = m->stops;
  pthread_mutex_unlock(&m->mutex);
  return stops;
}

static celspan_status read_mix(void *user, celspan_context *context, float *out, size_t count,
                               size_t *got) {
  mix *m = user;
  for (*got = 0; *got < count && m->place < m->end && !is_stopped(m);) {
    int64_t left = m->end - m->place, wanted = (int64_t)(count - *got);
    int64_t most = wanted < left ? wanted : left;
    size_t size = (size_t)(most < PIECE ? most : PIECE);
    CS_TRY(mix_piece(m, context, out + *got * CS_MIX_CHANNELS, size));
    *got += size;
  }
  return CELSPAN_OK;
}

static void stop_mix(void *user) {
  mix *m = user;
  pthread_mutex_lock(&m->mutex);
  m->stops = true;
  for (size_t i = 0; i < m->count; i++)
    if (m->parts[i].samples.user)
      m->parts[i].samples.stop(m->parts[i].samples.user);
  pthread_mutex_unlock(&m->mutex);
}

static void close_mix(void *user) {
  mix *m = user;
  cs_memory *memory = m->context->memory;
  for (size_t i = 0; i < m->count; i++) {
    close_part(m, &m->parts[i]);
    drop_kept(m, &m->parts[i]);
  }
  pthread_mutex_destroy(&m->mutex);
  cs_mem_free(memory, m->parts, m->count * sizeof *m->parts);
  cs_mem_free(memory, m, sizeof *m);
}

/* ---------------------------------------------------------------- opening */

celspan_status cs_mix_find(celspan_context *context, const cs_mix_sound *sounds, size_t count) {
  for (size_t i = 0; i < count; i++)
    CS_TRY(
        name_sound(context, &sounds[i], cs_sound_find(context, sounds[i].path, sounds[i].tried)));
  return CELSPAN_OK;
}

static void hash_sound(cs_hash *hash, const cs_mix_sound *sound) {
  cs_hash_text(hash, sound->path);
  if (!cs_address_is_data(sound->path))
    cs_open_hash(hash, sound->path);
  cs_hash_numbers(hash, (double[]){sound->start, sound->speed, sound->gain[0], sound->gain[1]}, 4);
  cs_hash_word(hash, sound->passage_count);
  for (size_t i = 0; i < sound->passage_count; i++) {
    const celspan_sound_passage *p = &sound->passages[i];
    cs_hash_numbers(hash, (double[]){p->begin, p->end, p->fade_in, p->fade_out}, 4);
  }
  cs_hash_word(hash, sound->ducker_count);
  for (size_t i = 0; i < sound->ducker_count; i++) {
    const celspan_sound_ducker *d = &sound->duckers[i];
    cs_hash_word(hash, d->sound);
    cs_hash_numbers(hash, (double[]){d->gain, d->attack, d->release}, 3);
  }
}

void cs_mix_hash(cs_hash *hash, const cs_mix_sound *sounds, size_t count) {
  cs_hash_word(hash, count);
  for (size_t i = 0; i < count; i++)
    hash_sound(hash, &sounds[i]);
}

static celspan_status create(celspan_context *context, const cs_mix_sound *sounds, size_t count,
                             mix **out) {
  CS_TRY(CS_MAKE(context, *out, 1));
  mix *m = *out;
  m->context = context;
  if (pthread_mutex_init(&m->mutex, NULL) == 0) {
    m->parts = cs_mem_array(context->memory, count, sizeof *m->parts);
    if (m->parts || count == 0) {
      m->count = count;
      for (size_t i = 0; i < count; i++)
        m->parts[i] = (part){.sound = sounds[i], .origin = moment_of(sounds[i].start)};
      return CELSPAN_OK;
    }
    pthread_mutex_destroy(&m->mutex);
  }
  cs_mem_free(context->memory, m, sizeof *m);
  return cs_fail_memory(context);
}

static void find_slope(mix *m) {
  m->slope = 0;
  for (size_t i = 0; i < m->count; i++)
    for (size_t k = 0; k < m->parts[i].sound.ducker_count; k++) {
      const celspan_sound_ducker *ducker = &m->parts[i].sound.duckers[k];
      m->slope = fmax(m->slope, fmax(ducker->attack, ducker->release));
    }
}

/* A sound that does not matter is never heard. */
static celspan_status measure_all(mix *m, celspan_context *context) {
  find_slope(m);
  for (size_t i = 0; i < m->count; i++) {
    part *p = &m->parts[i];
    if (!matters(m, &p->sound))
      continue;
    CS_TRY(name_sound(context, &p->sound, measure(m, context, p)));
    set_heard(p);
  }
  return CELSPAN_OK;
}

celspan_status cs_mix_open(celspan_context *context, const cs_mix_sound *sounds, size_t count,
                           double begin, int64_t moments, cs_sound_stream *out) {
  mix *m;
  *out = (cs_sound_stream){.user = NULL};
  CS_TRY(cs_mix_find(context, sounds, count));
  CS_TRY(create(context, sounds, count, &m));
  m->place = moment_of(begin);
  m->end = m->place + moments;
  celspan_status status = measure_all(m, context);
  if (status != CELSPAN_OK) {
    close_mix(m);
    return status;
  }
  *out = (cs_sound_stream){.user = m,
                           .rate = CS_MIX_RATE,
                           .channels = CS_MIX_CHANNELS,
                           .read = read_mix,
                           .stop = stop_mix,
                           .close = close_mix};
  return CELSPAN_OK;
}
