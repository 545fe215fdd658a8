#include "plugins/sound/loudness.h"

#include <math.h>
#include <string.h>

#include "inside/elementary.h"
#include "plugins/sound/sound.h"

enum { LOW_FREQUENCY = 1 << 3 /* its bit among the places of WAV files */ };
#define BEHIND ((uint32_t)0x38730) /* the places beside and behind the listener */

/* A filter of second order: y = b0 x + b1 x' + b2 x'' - a1 y' - a2 y''. */
typedef struct biquad {
  double b0, b1, b2, a1, a2;
} biquad;

/* BS.1770-4, tables 1 and 2, for 48,000 moments in a second. */
static const biquad shelf = {1.53512485958697, -2.69169618940638, 1.19839281085285,
                             -1.69065929318241, 0.73248077421585};
static const biquad high_pass = {1, -2, 1, -1.99004745483398, 0.99007225036621};

/* The state of a filter for a channel: the direct form II, transposed. */
typedef struct memory {
  double a, b;
} memory;

typedef struct listening {
  const cs_sound_stream *samples;
  cs_loudness *out;
  memory kept[CS_SOUND_STREAM_CHANNELS][2];
  double weights[CS_SOUND_STREAM_CHANNELS];
  double sum;
} listening;

static double pass(const biquad *f, memory *kept, double x) {
  double y = f->b0 * x + kept->a;
  kept->a = f->b1 * x - f->a1 * y + kept->b;
  kept->b = f->b2 * x - f->a2 * y;
  return y;
}

/* ---------------------------------------------------------------- channels */

/* The usual places for this number of channels in WAV files, for sounds that do not specify
 * them. */
static uint32_t usual_places(int32_t channels) {
  static const uint32_t usual[] = {0, 0x4, 0x3, 0x7, 0x107, 0x37, 0x3f, 0x13f, 0x63f};
  return channels < (int32_t)(sizeof usual / sizeof *usual) ? usual[channels] : 0;
}

/* Channels behind the listener count more; the channel for low frequencies does not count. */
static void set_weights(listening *l) {
  uint32_t places = l->samples->places ? l->samples->places : usual_places(l->samples->channels);
  for (int32_t c = 0; c < l->samples->channels; c++) {
    uint32_t place = places & (~places + 1);
    places &= places - 1;
    l->weights[c] = place == LOW_FREQUENCY ? 0 : place & BEHIND ? 1.41 : 1;
  }
}

/* ---------------------------------------------------------------- sums */

static celspan_status add_sum(listening *l, celspan_context *context) {
  return CS_APPEND(context, l->out->sums, l->out->count, l->out->capacity, l->sum);
}

static celspan_status add_moment(listening *l, celspan_context *context, const float *moment) {
  for (int32_t c = 0; c < l->samples->channels; c++) {
    l->out->peak = fmax(l->out->peak, fabs((double)moment[c]));
    double y = pass(&high_pass, &l->kept[c][1], pass(&shelf, &l->kept[c][0], (double)moment[c]));
    l->sum += l->weights[c] * y * y;
  }
  return ++l->out->moments % CS_LOUDNESS_STEP == 0 ? add_sum(l, context) : CELSPAN_OK;
}

static celspan_status add_moments(void *user, celspan_context *context, const float *moments,
                                  size_t count) {
  listening *l = user;
  for (size_t i = 0; i < count; i++)
    CS_TRY(add_moment(l, context, moments + i * (size_t)l->samples->channels));
  return CELSPAN_OK;
}

static celspan_status listen(listening *l, celspan_context *context, const char *name) {
  CS_TRY(add_sum(l, context));
  set_weights(l);
  CS_TRY(cs_sound_each(context, l->samples, name, add_moments, l));
  return add_sum(l, context);
}

celspan_status cs_loudness_hear(celspan_context *context, const cs_sound_stream *samples,
                                const char *name, cs_loudness *out) {
  listening l = {.samples = samples, .out = out};
  *out = (cs_loudness){.sums = NULL};
  celspan_status status = listen(&l, context, name);
  if (status != CELSPAN_OK)
    cs_loudness_finish(out, context);
  return status;
}

celspan_status cs_loudness_measure(celspan_context *context, const char *path, const char *tried,
                                   cs_loudness *out) {
  const cs_sound_request request = {.path = path, .tried = tried, .rate = CS_SOUND_HEARD_RATE};
  cs_sound_stream samples;
  *out = (cs_loudness){.sums = NULL};
  CS_TRY(cs_sound_open(context, &request, &samples));
  celspan_status status = cs_loudness_hear(context, &samples, path, out);
  cs_sound_stream_close(&samples);
  return status;
}

/* ---------------------------------------------------------------- the whole */

enum { MOMENTARY = 40, STRIDE = 10 /* steps */ };
#define OFFSET 0.691       /* LUFS */
#define LEAST_LOUD (-70.0) /* LUFS */
#define BELOW_MEAN 0.1     /* a share: 10 LU */

/* The mean square at which a sound has this loudness. */
static double power_at(double lufs) { return cs_elementary_pow(10, (lufs + OFFSET) / 10); }

/* The mean square of the parts of 0.4 s above a limit; 0: there are none. A shorter sound is one
 * part. */
static double mean_above(const cs_loudness *l, double limit) {
  size_t steps = (size_t)(l->moments / CS_LOUDNESS_STEP), used = 0;
  double sum = 0;
  if (steps < MOMENTARY)
    return l->moments > 0 ? l->sums[l->count - 1] / (double)l->moments : 0;
  for (size_t i = 0; i + MOMENTARY <= steps; i += STRIDE) {
    double power = (l->sums[i + MOMENTARY] - l->sums[i]) / (MOMENTARY * CS_LOUDNESS_STEP);
    sum += power > limit ? power : 0;
    used += power > limit;
  }
  return used > 0 ? sum / (double)used : 0;
}

double cs_loudness_gain(const cs_loudness *loudness, double lufs) {
  double least = power_at(LEAST_LOUD), mean = mean_above(loudness, least);
  double power = mean_above(loudness, fmax(least, mean * BELOW_MEAN));
  return power > least ? sqrt(power_at(lufs) / power) : 0;
}

void cs_loudness_finish(cs_loudness *loudness, celspan_context *context) {
  cs_mem_free(context->memory, loudness->sums, loudness->capacity * sizeof *loudness->sums);
  *loudness = (cs_loudness){.sums = NULL};
}
