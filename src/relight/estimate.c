/* The light of a picture, from what is known of it.
 *
 *   uneven: terms of a field, from the picture or a blank (fit.h)      field = colour * shape
 *   clue GREY    mean of R / shape, over the picture     = colour * pigment
 *   clue PATCH   the same over the patch
 *   clue LIGHT   mean of shape, over the picture         = light / colour
 */
#include <math.h>

#include "relight/fit.h"
#include "relight/light_field.h"
#include "scene/check.h"

/* A value of an integer picture that may have been clipped, and the share of a patch that may be. */
#define CLIPPED 0.9999
#define FEW 0.01
/* Places along each axis over which the mean of a field is taken. */
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

/* The columns, or rows, of a picture whose centres lie from a place on, over a length. */
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
        "brighter than what is there tells; take a darker patch",
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
  CS_TRY(cs_check_given(context, "light", "the description", desc));
  if (desc->struct_size != sizeof *desc)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "light: struct_size is %zu; set it to sizeof(celspan_light_estimate_desc)",
                   desc->struct_size);
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
    return cs_fit_terms(context, original, field);
  CS_TRY(cs_original_open(context, "light", desc->blank, &blank));
  celspan_status status = cs_fit_terms(context, &blank, field);
  cs_original_close(context, &blank);
  return status;
}

static celspan_status estimate(celspan_context *context, const celspan_light_estimate_desc *desc,
                               cs_original *original, celspan_light_field *field) {
  const char *name = cs_picture_name(original->picture);
  CS_TRY(fit_terms(context, desc, original, field));
  CS_TRY(
      cs_light_field_check(context, name, field)); /* the picture, or the mean, is divided by it */
  if (desc->clue == CELSPAN_LIGHT_CLUE_LIGHT)
    scale_to_mean(desc->colour, field);
  else
    CS_TRY(estimate_from_pigment(context, original, desc, field));
  return cs_light_field_check(context, name, field);
}

celspan_status celspan_light_estimate(celspan_context *context,
                                      const celspan_light_estimate_desc *desc,
                                      celspan_light_field *out) {
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
