#include "plugins/sound/mix.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "plugins/sound/sound.h"

enum { PIECE = 4096 /* moments that are mixed at a time */ };

/* One sound while it is mixed. Places are in moments of the film. */
typedef struct part {
  cs_mix_sound sound;
  int64_t origin;          /* of its first sample */
  double end;              /* second at which it ends by itself */
  bool is_whole;           /* that is known, and not only that it is later than matters */
  int64_t heard, silent;   /* it is heard from `heard` to before `silent` */
  cs_sound_stream samples; /* owned; none: it is closed */
  int64_t place;           /* of the next sample that is read */
} part;

typedef struct mix {
  celspan_context *context; /* of the caller that opened it, for memory */
  part *parts;              /* owned */
  size_t count, open;
  int64_t place, end;    /* of the next moment, and after the last one */
  pthread_mutex_t mutex; /* held while samples are opened or closed, and by `stop` */
  bool stops;            /* protected by the mutex */
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

/* Sounds of more channels than two are mixed down by ffmpeg. */
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
                 sound->path);
}

/* The moments of the sound, `most` at most. */
static celspan_status count_moments(celspan_context *context, const cs_mix_sound *sound,
                                    int64_t most, float *scratch, int64_t *out) {
  cs_sound_stream samples;
  CS_TRY(open_samples(context, sound, &samples));
  celspan_status status = CELSPAN_OK;
  size_t got = PIECE;
  for (*out = 0; status == CELSPAN_OK && got == PIECE && *out < most; *out += (int64_t)got)
    status = samples.read(samples.user, context, scratch, PIECE, &got);
  cs_sound_stream_close(&samples);
  return status;
}

/* The last second of the film that can matter to how the sound is heard. */
static double last_second(const mix *m, const cs_mix_sound *sound) {
  double last = (double)m->end / CS_MIX_RATE;
  for (size_t i = 0; i < sound->passage_count; i++)
    last = fmin(last, sound->passages[i].end);
  return last;
}

/* The length of an earlier part with the same samples; -1: there is none that was counted as far.
 */
static int64_t known_moments(const mix *m, const part *p, int64_t most) {
  for (const part *q = m->parts; q < p; q++) {
    int64_t moments = moment_of(q->end - q->sound.start);
    bool is_same = q->sound.speed == p->sound.speed && strcmp(q->sound.path, p->sound.path) == 0;
    if (is_same && (q->is_whole || moments >= most))
      return moments;
  }
  return -1;
}

static celspan_status refuse_from(celspan_context *context, const cs_mix_sound *sound,
                                  int64_t moments) {
  double seconds = (double)moments / CS_MIX_RATE * sound->speed;
  return cs_fail(context, CELSPAN_INPUT,
                 "field 'from' must be below the length of %s, %.6g seconds, got %.6g", sound->path,
                 seconds, sound->from);
}

/* Whether it is heard in the mix, or close enough to duck what is. */
static bool matters(const mix *m, const cs_mix_sound *sound) {
  double first = (double)m->place / CS_MIX_RATE, last = (double)m->end / CS_MIX_RATE;
  for (size_t i = 0; i < sound->passage_count; i++)
    if (sound->passages[i].begin > last + CS_MIX_DUCK_SECONDS ||
        sound->passages[i].end < first - CS_MIX_DUCK_SECONDS)
      return false;
  return true;
}

/* Finds out when the sound ends. */
static celspan_status measure(mix *m, celspan_context *context, part *p) {
  const cs_mix_sound *sound = &p->sound;
  double last = last_second(m, sound) + sound->passages[0].fade_out;
  int64_t most = moment_of(fmax(last, sound->passages[0].begin) - sound->start) + 1;
  int64_t moments = known_moments(m, p, most);
  if (moments < 0)
    CS_TRY(count_moments(context, sound, most, m->samples, &moments));
  p->end = sound->start + (double)moments / CS_MIX_RATE;
  p->is_whole = moments < most;
  if (sound->from > 0 && p->origin + moments <= moment_of(sound->passages[0].begin))
    return refuse_from(context, sound, moments);
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
    const cs_mix_passage *passage = &p->sound.passages[i];
    gain *= fade_at(seconds - passage->begin, passage->fade_in) *
            fade_at(passage_end(p, i) - seconds, passage->fade_out);
  }
  return gain;
}

/* The least gain of those that its duckers ask for. */
static double duck_at(const mix *m, const part *p, int64_t place) {
  double far = 1, ramp = CS_MIX_DUCK_SECONDS * CS_MIX_RATE;
  for (size_t i = 0; i < p->sound.ducker_count; i++) {
    const part *q = &m->parts[p->sound.duckers[i]];
    if (q->heard >= q->silent)
      continue;
    double before = (double)(q->heard - place), after = (double)(place - q->silent + 1);
    far = fmin(far, fmax(0, fmax(before, after)) / ramp);
  }
  return CS_MIX_DUCKED + (1 - CS_MIX_DUCKED) * far;
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

/* Reads up to PIECE samples; *got: fewer at the end. */
static celspan_status read_part(mix *m, celspan_context *context, part *p, int64_t count,
                                size_t *got) {
  CS_TRY(p->samples.read(p->samples.user, context, m->samples, (size_t)count, got));
  p->place += (int64_t)*got;
  return CELSPAN_OK;
}

/* Leaves out the samples before a place. *is_there: there is one at that place. */
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

static void add_samples(mix *m, const part *p, int64_t place, size_t count) {
  int32_t channels = p->samples.channels;
  double *sum = m->sum + (place - m->place) * CS_MIX_CHANNELS;
  for (size_t i = 0; i < count; i++) {
    int64_t at = place + (int64_t)i;
    double gain = passages_at(p, (double)at / CS_MIX_RATE) * duck_at(m, p, at);
    for (int c = 0; c < CS_MIX_CHANNELS; c++)
      sum[i * CS_MIX_CHANNELS + (size_t)c] +=
          (double)m->samples[i * (size_t)channels + (size_t)(c < channels ? c : 0)] * gain *
          p->sound.gain[c];
  }
}

/* Adds what is heard of the part before `end`. */
static celspan_status add_part(mix *m, celspan_context *context, part *p, int64_t end) {
  int64_t from = p->heard > m->place ? p->heard : m->place, to = p->silent < end ? p->silent : end;
  bool is_there;
  size_t got = 0;
  if (from >= to)
    return CELSPAN_OK;
  if (!p->samples.user)
    CS_TRY(open_part(m, context, p));
  CS_TRY(skip_to(m, context, p, from, &is_there));
  if (is_there)
    CS_TRY(read_part(m, context, p, to - from, &got));
  add_samples(m, p, from, got);
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
  for (size_t i = 0; i < m->count; i++)
    close_part(m, &m->parts[i]);
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

/* What does not matter is never heard. */
static celspan_status measure_all(mix *m, celspan_context *context) {
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
