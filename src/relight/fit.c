#include "relight/fit.h"

#include <math.h>

#include "base/elementary.h"
#include "relight/light_field.h"

#define SIDE 32                                  /* parts along a side, at most */
#define UNKNOWNS (CELSPAN_LIGHT_FIELD_TERMS + 1) /* the terms, and a constant */
#define LEAST_PARTS (3 * UNKNOWNS)
#define DARK 1e-5 /* light of a part that tells nothing */
#define ROUNDS 12
/* Residuals beyond this multiple of their spread count less and less (Huber). */
#define STEADY 1.5

/* One part of the picture. */
typedef struct part {
  double sum[4]; /* of premultiplied light, and of alpha */
  double x, y;   /* sums of the places of its pixels */
  double pixels;
} part;

typedef struct parts {
  int32_t columns, rows;
  part list[SIDE * SIDE];
} parts;

/* ---------------------------------------------------------------- means */

static void add_row(parts *all, const cs_original *original, int32_t y) {
  int32_t width = original->info.width;
  part *row = all->list + (size_t)((int64_t)y * all->rows / original->info.height * all->columns);
  for (int32_t x = 0; x < width; x++) {
    const float *light = cs_original_at(original, x, y);
    part *at = row + (int64_t)x * all->columns / width;
    for (int c = 0; c < 4; c++)
      at->sum[c] += (double)light[c];
    at->x += (x + 0.5) / width;
    at->y += (y + 0.5) / original->info.height;
    at->pixels++;
  }
}

static celspan_status find_means(celspan_context *context, cs_original *original, parts *out) {
  const celspan_picture_info *info = &original->info;
  *out = (parts){.columns = info->width < SIDE ? info->width : SIDE,
                 .rows = info->height < SIDE ? info->height : SIDE};
  for (int32_t first = 0; first < info->height; first += CS_ORIGINAL_ROWS) {
    CS_TRY(cs_original_read(context, original, first));
    for (int32_t y = first; y < cs_original_end(original, first); y++)
      add_row(out, original, y);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- least squares */

/* What is known of one channel of one part. */
typedef struct sample {
  double basis[UNKNOWNS];
  double value; /* the logarithm of its mean */
  double share; /* of its pixels that are there */
  double weight;
} sample;

/* The samples of a channel; returns how many. */
static int find_samples(const parts *all, int channel, sample *out) {
  int count = 0;
  for (int32_t i = 0; i < all->columns * all->rows; i++) {
    const part *at = &all->list[i];
    double mean = at->sum[3] > 0 ? at->sum[channel] / at->sum[3] : 0;
    if (!(mean > DARK))
      continue;
    sample *s = &out[count++];
    s->basis[0] = 1;
    cs_light_field_basis(2 * at->x / at->pixels - 1, 2 * at->y / at->pixels - 1, s->basis + 1);
    s->value = cs_elementary_log(mean);
    s->weight = s->share = at->sum[3] / at->pixels;
  }
  return count;
}

static void add_sample(const sample *s, double matrix[UNKNOWNS][UNKNOWNS + 1]) {
  for (int i = 0; i < UNKNOWNS; i++) {
    for (int j = 0; j < UNKNOWNS; j++)
      matrix[i][j] += s->weight * s->basis[i] * s->basis[j];
    matrix[i][UNKNOWNS] += s->weight * s->basis[i] * s->value;
  }
}

static void swap_rows(double a[UNKNOWNS + 1], double b[UNKNOWNS + 1]) {
  for (int j = 0; j <= UNKNOWNS; j++) {
    double kept = a[j];
    a[j] = b[j];
    b[j] = kept;
  }
}

/* Gauss's elimination, with the largest pivots; false where the samples do not tell all unknowns. */
static bool solve(double matrix[UNKNOWNS][UNKNOWNS + 1], double out[UNKNOWNS]) {
  for (int k = 0; k < UNKNOWNS; k++) {
    int pivot = k;
    for (int i = k + 1; i < UNKNOWNS; i++)
      pivot = fabs(matrix[i][k]) > fabs(matrix[pivot][k]) ? i : pivot;
    if (!(fabs(matrix[pivot][k]) > 1e-9 * matrix[0][0]))
      return false;
    swap_rows(matrix[k], matrix[pivot]);
    for (int i = k + 1; i < UNKNOWNS; i++) {
      double factor = matrix[i][k] / matrix[k][k];
      for (int j = k; j <= UNKNOWNS; j++)
        matrix[i][j] -= factor * matrix[k][j];
    }
  }
  for (int k = UNKNOWNS - 1; k >= 0; k--) {
    double sum = matrix[k][UNKNOWNS];
    for (int j = k + 1; j < UNKNOWNS; j++)
      sum -= matrix[k][j] * out[j];
    out[k] = sum / matrix[k][k];
  }
  return true;
}

static double residual(const sample *s, const double terms[UNKNOWNS]) {
  double sum = -s->value;
  for (int i = 0; i < UNKNOWNS; i++)
    sum += terms[i] * s->basis[i];
  return fabs(sum);
}

/* Weights anew, from the residuals of the last round. */
static void weigh(sample *samples, int count, const double terms[UNKNOWNS]) {
  double sum = 0;
  for (int i = 0; i < count; i++)
    sum += residual(&samples[i], terms);
  double limit = STEADY * sum / count;
  for (int i = 0; i < count; i++) {
    double off = residual(&samples[i], terms);
    samples[i].weight = samples[i].share * (off > limit ? limit / off : 1);
  }
}

static bool fit(sample *samples, int count, double terms[UNKNOWNS]) {
  for (int round = 0; round < ROUNDS; round++) {
    double matrix[UNKNOWNS][UNKNOWNS + 1] = {{0}};
    for (int i = 0; i < count; i++)
      add_sample(&samples[i], matrix);
    if (!solve(matrix, terms))
      return false;
    weigh(samples, count, terms);
  }
  return true;
}

/* ---------------------------------------------------------------- all channels */

static celspan_status fit_channel(celspan_context *context, const cs_original *original,
                                  const parts *all, int channel, sample *samples,
                                  celspan_light_field *field) {
  double terms[UNKNOWNS];
  int count = find_samples(all, channel, samples);
  if (count < LEAST_PARTS || !fit(samples, count, terms))
    return cs_fail(
        context, CELSPAN_BAD_ARGUMENT,
        "%s: only %d of %d parts of the picture have any %s, so no field of uneven light "
        "can be fitted; it takes %d, in all directions",
        cs_picture_name(original->picture), count, all->columns * all->rows,
        cs_light_field_channel(channel), LEAST_PARTS);
  for (int k = 0; k < CELSPAN_LIGHT_FIELD_TERMS; k++)
    field->terms[channel][k] = terms[k + 1];
  return CELSPAN_OK;
}

/* What a fit works on. */
typedef struct workspace {
  parts all;
  sample samples[SIDE * SIDE];
} workspace;

celspan_status cs_fit_terms(celspan_context *context, cs_original *original,
                            celspan_light_field *field) {
  workspace *w = cs_mem_array(context->memory, 1, sizeof *w);
  if (!w)
    return cs_fail_memory(context);
  celspan_status status = find_means(context, original, &w->all);
  for (int c = 0; c < 3 && status == CELSPAN_OK; c++)
    status = fit_channel(context, original, &w->all, c, w->samples, field);
  cs_mem_free(context->memory, w, sizeof *w);
  return status;
}
