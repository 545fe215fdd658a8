/* The light of a picture, estimated from known facts about it.
 *
 *   uneven: terms of a field, from the picture or a blank              field = colour * shape
 *   clue GREY    mean of R / shape, over the picture     = colour * pigment
 *   clue PATCH   the same over the patch
 *   clue LIGHT   mean of shape, over the picture         = light / colour
 */
#include <math.h>

#include "celspan/relight.h"
#include "common/solve.h"
#include "inside/description.h"
#include "inside/elementary.h"
#include "inside/scene.h"
#include "tools/relight/light_field.h"
#include "tools/relight/original.h"

CS_DESCRIBE(celspan_light_estimate_desc, picture, .colour = {0.18, 0.18, 0.18})

/* ---------------------------------------------------------------- terms of a field */

/* A light field fitted to how bright a picture is, part by part.
 *
 *   picture --means of up to 32 x 32 parts--> logarithms --least squares, robust--> terms
 *
 * The logarithm of a part's mean is that of the light there plus that of its mean pigment. Parts
 * whose pigments differ from the others' stick out from the smooth field, and count the less the
 * farther they do.
 */

#define SIDE 32                                  /* the most parts along a side */
#define UNKNOWNS (CELSPAN_LIGHT_FIELD_TERMS + 1) /* the terms of the field, and a constant */
#define LEAST_PARTS (3 * UNKNOWNS)
#define DARK 1e-5 /* a part with less light gives no information */
#define ROUNDS 12
/* Residuals greater than this multiple of their spread count less and less (Huber). */
#define STEADY 1.5

/* One part of the picture. */
typedef struct part {
  double sum[4]; /* the sum of premultiplied light, and of alpha */
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

static celspan_status average_parts(celspan_context *context, cs_original *original, parts *out) {
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
  double value; /* the logarithm of the mean */
  double share; /* the share of its pixels that are not clear */
  double weight;
} sample;

/* The samples of a channel. Returns their number. */
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

static double residual(const sample *s, const double terms[UNKNOWNS]) {
  double sum = -s->value;
  for (int i = 0; i < UNKNOWNS; i++)
    sum += terms[i] * s->basis[i];
  return fabs(sum);
}

/* Sets the weights from the residuals of the last round. */
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
    /* False if the samples do not determine all unknowns. */
    if (!cs_solve(matrix[0], UNKNOWNS, UNKNOWNS + 1, 1e-9 * matrix[0][0], terms))
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

/* The memory for a fit. */
typedef struct workspace {
  parts all;
  sample samples[SIDE * SIDE];
} workspace;

/* Sets the terms of *field, but not its colours. Errors: those of pictures; BAD_ARGUMENT if too few
 * parts are lit to determine a field. */
static CELSPAN_CHECKED celspan_status fit_shape(celspan_context *context, cs_original *original,
                                                celspan_light_field *field) {
  workspace *w;
  CS_TRY(CS_MAKE(context, w, 1));
  celspan_status status = average_parts(context, original, &w->all);
  for (int c = 0; c < 3 && status == CELSPAN_OK; c++)
    status = fit_channel(context, original, &w->all, c, w->samples, field);
  cs_mem_free(context->memory, w, sizeof *w);
  return status;
}

/* ---------------------------------------------------------------- the field and its colours */

/* From this value on, a number of an integer picture may have been clipped; and the share of such
 * numbers that a patch may have. */
#define CLIPPED 0.9999
#define FEW 0.01
/* The number of places along each axis for the mean of a field. */
#define MEAN_SIDE 64

/* Sums over the pixels of a region. */
typedef struct means {
  double sum[3], alpha;
  double pixels, clipped;
} means;

static void add_pixel(means *m, const float light[4], const double shape[3]) {
  bool is_clipped = false;
  for (int c = 0; c < 3; c++) {
    m->sum[c] += (double)light[c] / shape[c];
    is_clipped = is_clipped || (double)light[c] >= CLIPPED * (double)light[3];
  }
  m->alpha += (double)light[3];
  m->pixels++;
  m->clipped += light[3] > 0 && is_clipped;
}

/* The columns, or rows, of a picture whose centres lie within `length` from a place on. */
static void inside(double from, double length, int32_t size, int32_t *first, int32_t *end) {
  double low = ceil(from - 0.5), high = ceil(from + length - 0.5);
  *first = low < 0 ? 0 : low > size ? size : (int32_t)low;
  *end = high < 0 ? 0 : high > size ? size : (int32_t)high;
}

/* shape: a field of colour 1. */
static celspan_status find_means(celspan_context *context, cs_original *original,
                                 const celspan_box *region, const celspan_light_field *shape,
                                 means *out) {
  const celspan_picture_info *info = &original->info;
  int32_t x0, x1, y0, y1;
  inside(region->x, region->width, info->width, &x0, &x1);
  inside(region->y, region->height, info->height, &y0, &y1);
  *out = (means){{0}, 0, 0, 0};
  for (int32_t first = y0 / CS_ORIGINAL_ROWS * CS_ORIGINAL_ROWS; first < y1;
       first += CS_ORIGINAL_ROWS) {
    CS_TRY(cs_original_read(context, original, first));
    for (int32_t y = first < y0 ? y0 : first; y < y1 && y < first + CS_ORIGINAL_ROWS; y++) {
      cs_light_row row = cs_light_row_make(shape, info->width, info->height, y);
      for (int32_t x = x0; x < x1; x++) {
        double rgb[3];
        cs_light_row_at(&row, x, rgb);
        add_pixel(out, cs_original_at(original, x, y), rgb);
      }
    }
  }
  return CELSPAN_OK;
}

static celspan_status check_means(celspan_context *context, const cs_original *original,
                                  const char *place, const means *m, bool is_patch) {
  const char *name = cs_picture_name(original->picture);
  if (!(m->alpha > 0))
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: there is nothing in %s, so no light can be estimated from it", name, place);
  for (int c = 0; c < 3; c++)
    if (!(m->sum[c] > 0))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "%s: there is no %s in %s, so none of the light can be estimated from it",
                     name, cs_light_field_channel(c), place);
  if (is_patch && !original->info.is_float && m->clipped > FEW * m->pixels)
    return cs_fail(
        context, CELSPAN_BAD_ARGUMENT,
        "%s: %.3g %% of %s is as bright as the picture can be, so the light may have been "
        "brighter than these pixels show; take a darker patch",
        name, 100 * m->clipped / m->pixels, place);
  return CELSPAN_OK;
}

static celspan_status estimate_from_pigment(celspan_context *context, cs_original *original,
                                            const celspan_light_estimate_desc *desc,
                                            celspan_light_field *field) {
  bool is_patch = desc->clue == CELSPAN_LIGHT_CLUE_PATCH;
  const celspan_box whole = {0, 0, original->info.width, original->info.height};
  means m;
  CS_TRY(find_means(context, original, is_patch ? &desc->patch : &whole, field, &m));
  CS_TRY(check_means(context, original, is_patch ? "the patch" : "the picture", &m, is_patch));
  for (int c = 0; c < 3; c++)
    field->colour[c] = m.sum[c] / m.alpha / desc->colour[c];
  return CELSPAN_OK;
}

static void scale_to_mean(const double mean[3], celspan_light_field *field) {
  double sum[3] = {0, 0, 0}, rgb[3];
  for (int i = 0; i < MEAN_SIDE * MEAN_SIDE; i++) {
    celspan_light_field_at(field, (i % MEAN_SIDE + 0.5) / MEAN_SIDE,
                           (i / MEAN_SIDE + 0.5) / MEAN_SIDE, rgb);
    for (int c = 0; c < 3; c++)
      sum[c] += rgb[c];
  }
  for (int c = 0; c < 3; c++)
    field->colour[c] = mean[c] * MEAN_SIDE * MEAN_SIDE / sum[c];
}

/* ---------------------------------------------------------------- the whole */

static celspan_status check_desc(celspan_context *context,
                                 const celspan_light_estimate_desc *desc) {
  CS_TRY(cs_check_choice(context, "light", "clue", (unsigned)desc->clue,
                         CELSPAN_LIGHT_CLUE_LIGHT + 1));
  celspan_light_field colour =
      celspan_light_field_flat(desc->colour[0], desc->colour[1], desc->colour[2]);
  CS_TRY(cs_light_field_check(context, "light", &colour));
  return desc->clue == CELSPAN_LIGHT_CLUE_PATCH
             ? cs_check_box(context, "light", "patch", &desc->patch)
             : CELSPAN_OK;
}

static celspan_status fit_terms(celspan_context *context, const celspan_light_estimate_desc *desc,
                                cs_original *original, celspan_light_field *field) {
  cs_original blank;
  if (!desc->is_uneven)
    return CELSPAN_OK;
  if (!desc->blank)
    return fit_shape(context, original, field);
  CS_TRY(cs_original_open(context, "light", desc->blank, &blank));
  celspan_status status = fit_shape(context, &blank, field);
  cs_original_close(context, &blank);
  return status;
}

static celspan_status estimate(celspan_context *context, const celspan_light_estimate_desc *desc,
                               cs_original *original, celspan_light_field *field) {
  const char *name = cs_picture_name(original->picture);
  CS_TRY(fit_terms(context, desc, original, field));
  CS_TRY(
      /* the picture, or the mean, will be divided by it */
      cs_light_field_check(context, name, field));
  if (desc->clue == CELSPAN_LIGHT_CLUE_LIGHT)
    scale_to_mean(desc->colour, field);
  else
    CS_TRY(estimate_from_pigment(context, original, desc, field));
  return cs_light_field_check(context, name, field);
}

celspan_status celspan_light_estimate(celspan_context *context,
                                      const celspan_light_estimate_desc *desc,
                                      celspan_light_field *out) {
  CS_READ(context, "light", celspan_light_estimate_desc, desc);
  CS_TRY(check_desc(context, desc));
  celspan_light_field field = celspan_light_field_flat(1, 1, 1);
  cs_original original;
  CS_TRY(cs_original_open(context, "light", desc->picture, &original));
  celspan_status status = estimate(context, desc, &original, &field);
  cs_original_close(context, &original);
  if (status == CELSPAN_OK)
    *out = field;
  return status;
}
