#include "plugins/sound/spectrum.h"

#include <string.h>

#include "inside/elementary.h"
#include "plugins/sound/sound.h"

enum { WINDOW = 2048 /* moments */, HALF = WINDOW / 2, FULL = 240 /* quarters of a decibel */ };
#define LOWEST 40.0 /* Hz */
#define RANGE 400.0 /* the highest frequency by the lowest: 16 kHz */
#define TURN 6.283185307179586

typedef struct listening {
  const cs_sound_stream *samples;
  cs_spectrum *out;
  float *heard;  /* the last WINDOW moments, round: moment i is at i % WINDOW */
  int64_t count; /* moments that were heard, with HALF silent ones before the first */
  double weights[WINDOW], sines[HALF], cosines[HALF];
  double real[WINDOW], imaginary[WINDOW];
  double power[HALF];                  /* by frequency, summed over the channels */
  double edges[CS_SPECTRUM_BANDS + 1]; /* the edges of the bands, in frequencies of the transform */
} listening;

/* Hann's window, the angles of the transform, and the bands. */
static void prepare(listening *l) {
  for (int i = 0; i < HALF; i++)
    cs_elementary_sincos(TURN * i / WINDOW, &l->sines[i], &l->cosines[i]);
  for (int i = 0; i < WINDOW; i++)
    l->weights[i] = 0.5 - 0.5 * (i < HALF ? l->cosines[i] : -l->cosines[i - HALF]);
  for (int i = 0; i <= CS_SPECTRUM_BANDS; i++)
    l->edges[i] = LOWEST * cs_elementary_pow(RANGE, (double)i / CS_SPECTRUM_BANDS) * WINDOW /
                  CS_SOUND_HEARD_RATE;
}

/* ---------------------------------------------------------------- the transform */

static int reversed(int i) {
  int out = 0;
  for (int bit = 1; bit < WINDOW; bit *= 2)
    out = 2 * out + ((i & bit) != 0);
  return out;
}

/* Fourier's transform by halves, in place: the values must be in the order of `reversed`. */
static void transform(listening *l) {
  for (int half = 1; half < WINDOW; half *= 2) {
    for (int i = 0; i < WINDOW; i += 2 * half) {
      for (int k = 0; k < half; k++) {
        int a = i + k, b = a + half, turn = k * (HALF / half);
        double c = l->cosines[turn], s = l->sines[turn];
        double x = l->real[b] * c + l->imaginary[b] * s, y = l->imaginary[b] * c - l->real[b] * s;
        l->real[b] = l->real[a] - x, l->imaginary[b] = l->imaginary[a] - y;
        l->real[a] += x, l->imaginary[a] += y;
      }
    }
  }
}

/* Adds the powers of channels c and c + 1, if there is one: a pair is one complex number, as the
 * powers of both frequencies k and -k have the same sum for the pair as for its parts. */
static void add_pair(listening *l, int32_t c) {
  int32_t channels = l->samples->channels;
  for (int i = 0; i < WINDOW; i++) {
    const float *moment = l->heard + (l->count + i) % WINDOW * channels;
    int at = reversed(i);
    l->real[at] = l->weights[i] * (double)moment[c];
    l->imaginary[at] = c + 1 < channels ? l->weights[i] * (double)moment[c + 1] : 0;
  }
  transform(l);
  for (int k = 1; k < HALF; k++)
    l->power[k] += l->real[k] * l->real[k] + l->imaginary[k] * l->imaginary[k] +
                   l->real[WINDOW - k] * l->real[WINDOW - k] +
                   l->imaginary[WINDOW - k] * l->imaginary[WINDOW - k];
}

/* ---------------------------------------------------------------- bands */

/* The power below a frequency; that of frequency k is spread evenly from k - 1/2 to k + 1/2. sums:
 * of all frequencies before each. */
static double power_below(const listening *l, const double *sums, double frequency) {
  int k = (int)(frequency + 0.5);
  return sums[k] + (frequency + 0.5 - k) * l->power[k];
}

/* share: the mean power of the channels, where a sine of full scale has 1. */
static unsigned char level_of(double share) {
  double level = share > 0 ? FULL + 40 * cs_function_log10(share) : 0;
  return (unsigned char)(level <= 0 ? 0 : level >= FULL ? FULL : level + 0.5);
}

/* The power of a sine of full scale is half its square; the mean square of the window is 3/8. A
 * pair's sum has both frequencies, k and -k, of which each has a half. */
static cs_spectrum_step bands_of(const listening *l) {
  const double whole = (double)WINDOW * WINDOW * 3 / 16 * l->samples->channels;
  double sums[HALF] = {0}, before;
  cs_spectrum_step out;
  for (int k = 1; k < HALF; k++)
    sums[k] = sums[k - 1] + l->power[k - 1];
  before = power_below(l, sums, l->edges[0]);
  for (int i = 0; i < CS_SPECTRUM_BANDS; i++) {
    double after = power_below(l, sums, l->edges[i + 1]);
    out.levels[i] = level_of((after - before) / whole);
    before = after;
  }
  return out;
}

/* ---------------------------------------------------------------- steps */

/* The step whose window ends at the moment that was heard last. */
static celspan_status add_step(listening *l, celspan_context *context) {
  memset(l->power, 0, sizeof l->power);
  for (int32_t c = 0; c < l->samples->channels; c += 2)
    add_pair(l, c);
  return CS_APPEND(context, l->out->steps, l->out->count, l->out->capacity, bands_of(l));
}

/* moment: NULL: a silent one. */
static celspan_status add_moment(listening *l, celspan_context *context, const float *moment) {
  size_t size = (size_t)l->samples->channels;
  float *to = l->heard + (size_t)(l->count % WINDOW) * size;
  if (moment)
    memcpy(to, moment, size * sizeof *to);
  else
    memset(to, 0, size * sizeof *to);
  l->count++;
  return l->count >= WINDOW && (l->count - WINDOW) % CS_SPECTRUM_STEP == 0 ? add_step(l, context)
                                                                           : CELSPAN_OK;
}

static celspan_status add_moments(void *user, celspan_context *context, const float *moments,
                                  size_t count) {
  listening *l = user;
  for (size_t i = 0; i < count; i++)
    CS_TRY(add_moment(l, context, moments ? moments + i * (size_t)l->samples->channels : NULL));
  return CELSPAN_OK;
}

/* Half a window of silence before the first moment and behind the last: windows are around their
 * steps. */
static celspan_status listen(listening *l, celspan_context *context, const char *name) {
  prepare(l);
  CS_TRY(add_moments(l, context, NULL, HALF));
  CS_TRY(cs_sound_each(context, l->samples, name, add_moments, l));
  return add_moments(l, context, NULL, HALF);
}

static celspan_status hear(celspan_context *context, const cs_sound_stream *samples,
                           const char *name, cs_spectrum *out) {
  listening *l;
  size_t count = WINDOW * (size_t)samples->channels;
  CS_TRY(CS_MAKE(context, l, 1));
  *l = (listening){.samples = samples, .out = out};
  celspan_status status = CS_MAKE(context, l->heard, count);
  if (status == CELSPAN_OK)
    status = listen(l, context, name);
  cs_mem_free(context->memory, l->heard, l->heard ? count * sizeof *l->heard : 0);
  cs_mem_free(context->memory, l, sizeof *l);
  return status;
}

celspan_status cs_spectrum_measure(celspan_context *context, const char *path, const char *tried,
                                   cs_spectrum *out) {
  const cs_sound_request request = {.path = path, .tried = tried, .rate = CS_SOUND_HEARD_RATE};
  cs_sound_stream samples;
  *out = (cs_spectrum){.steps = NULL};
  CS_TRY(cs_sound_open(context, &request, &samples));
  celspan_status status = hear(context, &samples, path, out);
  cs_sound_stream_close(&samples);
  if (status != CELSPAN_OK)
    cs_spectrum_finish(out, context);
  return status;
}

void cs_spectrum_finish(cs_spectrum *spectrum, celspan_context *context) {
  cs_mem_free(context->memory, spectrum->steps, spectrum->capacity * sizeof *spectrum->steps);
  *spectrum = (cs_spectrum){.steps = NULL};
}
