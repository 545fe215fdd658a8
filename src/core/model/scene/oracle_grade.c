/* Grades in doubles, step by step, from the description of a grade. They share nothing with the
 * formulas of model/colour/grade.c and cube.c, which the tests compare with these. */
#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "base/number.h"
#include "model/scene/oracle.h"

static double luma_of(const double c[3]) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

static double two_to(double exponent) { return cs_elementary_pow(2, exponent); }

static void expose(double exposure, double c[3]) {
  for (int i = 0; i < 3; i++)
    c[i] *= two_to(exposure);
}

/* The text of the ASC CDL clamps to 0..1 before the power; films have brighter light, so only
 * negative numbers are held. */
static void decide(const celspan_grade_desc *desc, double c[3]) {
  bool is_idle = true;
  for (int i = 0; i < 3; i++)
    is_idle = is_idle && desc->slope[i] == 1 && desc->offset[i] == 0 && desc->power[i] == 1;
  for (int i = 0; i < 3 && !is_idle; i++)
    c[i] = cs_elementary_pow(fmax(0, c[i] * desc->slope[i] + desc->offset[i]), desc->power[i]);
}

static void spread(const celspan_grade_desc *desc, celspan_space space, double c[3]) {
  double usual = space == CELSPAN_SPACE_SRGB ? 0.46 : 0.18;
  double pivot = desc->has_pivot ? desc->pivot : usual;
  for (int i = 0; i < 3; i++)
    c[i] = (c[i] - pivot) * desc->contrast + pivot;
}

static void saturate(double saturation, double c[3]) {
  double grey = luma_of(c);
  for (int i = 0; i < 3; i++)
    c[i] = grey + (c[i] - grey) * saturation;
}

static void turn(double hue, double c[3]) {
  double grey = luma_of(c), sine, cosine;
  cs_elementary_sincos(hue, &sine, &cosine);
  const double across[3] = {c[2] - grey, 0.143 * c[0] + 0.14 * c[1] - 0.283 * c[2],
                            -0.7874 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]};
  for (int i = 0; i < 3; i++)
    c[i] = grey + (c[i] - grey) * cosine + across[i] * sine;
}

static void warm(double temperature, double tint, double c[3]) {
  const double gains[3] = {two_to(temperature / 2), two_to(-tint / 2), two_to(-temperature / 2)};
  for (int i = 0; i < 3; i++)
    c[i] = c[i] * gains[i] / luma_of(gains);
}

static void bend(double gamma, double c[3]) {
  for (int i = 0; i < 3; i++)
    c[i] = copysign(cs_elementary_pow(fabs(c[i]), 1 / gamma), c[i]);
}

static void multiply(const celspan_grade_desc *desc, double c[3]) {
  const double from[4] = {c[0], c[1], c[2], 1};
  for (int i = 0; i < 3 && desc->has_matrix; i++) {
    c[i] = 0;
    for (int k = 0; k < 4; k++)
      c[i] += desc->matrix[i][k] * from[k];
  }
}

/* ---------------------------------------------------------------- curves */

static double rise(const celspan_point *p) { return (p[1].y - p[0].y) / (p[1].x - p[0].x); }

/* The slopes at all points, in order: the limit on one piece also changes the next piece. */
static void find_slopes(const celspan_point *p, size_t count, double *slopes) {
  slopes[0] = rise(p);
  for (size_t i = 0; i + 1 < count; i++) {
    double line = rise(p + i), ahead = i + 2 < count ? rise(p + i + 1) : line;
    double next = i + 2 < count ? (line + ahead) / 2 : line;
    next = line * ahead > 0 ? next : 0;
    double a = slopes[i] / line, b = next / line; /* not finite if the line is level */
    double hold = line == 0 ? 0 : fmin(1, 3 / sqrt(a * a + b * b));
    slopes[i] *= hold;
    slopes[i + 1] = next * hold;
  }
}

/* Evaluates the piece as a Bezier curve with four points. */
static double curve_at(const celspan_point *p, size_t count, double x) {
  double slopes[CS_GRADE_POINTS];
  size_t i = 0;
  find_slopes(p, count, slopes);
  if (x < p[0].x)
    return p[0].y + slopes[0] * (x - p[0].x);
  if (x > p[count - 1].x)
    return p[count - 1].y + slopes[count - 1] * (x - p[count - 1].x);
  while (i + 2 < count && x > p[i + 1].x)
    i++;
  double width = p[i + 1].x - p[i].x, t = (x - p[i].x) / width;
  double y[4] = {p[i].y, p[i].y + slopes[i] * width / 3, p[i + 1].y - slopes[i + 1] * width / 3,
                 p[i + 1].y};
  for (int left = 3; left > 0; left--)
    for (int k = 0; k < left; k++)
      y[k] += t * (y[k + 1] - y[k]);
  return y[0];
}

/* ---------------------------------------------------------------- tables */

/* The sum of the corners of the box, each multiplied by its share. */
static void sum_corners(const cs_cube *cube, double c[3]) {
  double at[3], sum[3] = {0, 0, 0};
  for (int i = 0; i < 3; i++)
    at[i] = (cs_number_clamp(c[i], cube->domain[i], cube->domain[3 + i]) - cube->domain[i]) /
            (cube->domain[3 + i] - cube->domain[i]) * (double)(cube->side - 1);
  for (size_t k = 0; k < cube->count && cube->is_solid; k++) {
    const size_t place[3] = {k % cube->side, k / cube->side % cube->side,
                             k / cube->side / cube->side};
    double share = 1;
    for (int i = 0; i < 3; i++)
      share *= fmax(0, 1 - fabs(at[i] - (double)place[i]));
    for (int i = 0; i < 3; i++)
      sum[i] += share * (double)cube->values[k][i];
  }
  for (size_t k = 0; k < cube->count && !cube->is_solid; k++)
    for (int i = 0; i < 3; i++)
      sum[i] += fmax(0, 1 - fabs(at[i] - (double)k)) * (double)cube->values[k][i];
  memcpy(c, sum, sizeof sum);
}

/* ---------------------------------------------------------------- in codes or in light */

static void convert(celspan_space from, celspan_space to, double c[3]) {
  for (int i = 0; i < 3 && from != to; i++)
    c[i] = cs_oracle_convert(to, c[i], 1);
}

/* The step whose band contains the code: band k is from k/n to (k + 1)/n. */
static void round_codes(int steps, double c[3]) {
  for (int i = 0; i < 3; i++) {
    int k = 0;
    while (k < steps - 1 && c[i] + CS_GRADE_BORDER >= (k + 1.0) / steps)
      k++;
    c[i] = k / (steps - 1.0);
  }
}

/* ---------------------------------------------------------------- keys */

typedef struct chroma {
  double cb, cr;
} chroma;

static chroma chroma_of(const double c[3]) {
  return (chroma){(c[2] - luma_of(c)) / (2 * (1 - 0.0722)),
                  (c[0] - luma_of(c)) / (2 * (1 - 0.2126))};
}

static double length_of(chroma c) { return sqrt(c.cb * c.cb + c.cr * c.cr); }

/* 0 at `from`, 1 after `width`, which may be negative and is 1/1024 at least. */
static double share_of(double from, double width, double at) {
  double least = copysign(1.0 / 1024, width);
  return cs_number_clamp((at - from) / (fabs(width) < fabs(least) ? least : width), 0, 1);
}

/* How much of the screen there is in a chroma: it is clear of it 60 degrees from its hue. */
static double spill_of(chroma own, chroma screen) {
  double size = length_of(screen), root = 1.7320508075688772;
  double along = (own.cb * screen.cb + own.cr * screen.cr) / size;
  double across = (own.cr * screen.cb - own.cb * screen.cr) / size;
  return fmax(0, along - fabs(across) / root) / size;
}

static void clean(const double screen[3], double share, double c[3]) {
  double most = fmax(1, fmax(c[0], fmax(c[1], c[2])));
  for (int i = 0; i < 3 && share > 0; i++)
    c[i] = cs_number_clamp((c[i] - share * screen[i]) / (1 - fmin(share, 0.9)), 0, most);
}

/* ---------------------------------------------------------------- grades */

static void grade_colour(const celspan_grade *grade, celspan_space space, double c[3]) {
  const celspan_grade_desc *desc = &grade->desc;
  expose(desc->exposure, c);
  decide(desc, c);
  spread(desc, space, c);
  saturate(desc->saturation, c);
  turn(desc->hue_radians, c);
  warm(desc->temperature, desc->tint, c);
  bend(desc->gamma, c);
  multiply(desc, c);
  for (int i = 0; i < 3; i++)
    if (desc->curve_count[i] > 0)
      c[i] = curve_at(desc->curve[i], desc->curve_count[i], c[i]);
  if (desc->steps > 0) {
    convert(space, CELSPAN_SPACE_SRGB, c);
    round_codes(desc->steps, c);
    convert(CELSPAN_SPACE_SRGB, space, c);
  }
  if (grade->steps.cube) {
    convert(space, desc->lut_space, c);
    sum_corners(grade->steps.cube, c);
    convert(desc->lut_space, space, c);
  }
}

/* The share of the colour that a key leaves there; the colour loses its spill. */
static double key_colour(const celspan_grade *grade, celspan_space space, double c[3]) {
  const celspan_key_desc *key = &grade->key;
  double stays = 1;
  convert(space, CELSPAN_SPACE_SRGB, c);
  if (key->by == CELSPAN_KEY_LUMA) {
    stays = share_of(key->from, key->to - key->from, luma_of(c));
  } else {
    double screen[3] = {(double)grade->screen[0], (double)grade->screen[1],
                        (double)grade->screen[2]};
    convert(CELSPAN_SPACE_LINEAR, CELSPAN_SPACE_SRGB, screen);
    const chroma of_screen = chroma_of(screen), own = chroma_of(c);
    stays = share_of(key->tolerance, key->softness,
                     length_of((chroma){own.cb - of_screen.cb, own.cr - of_screen.cr}));
    clean(screen, key->spill * spill_of(own, of_screen), c);
  }
  convert(CELSPAN_SPACE_SRGB, space, c);
  return stays;
}

void cs_oracle_grade(const celspan_grade *grade, celspan_space space, cs_oracle_sight *sight) {
  double alpha = cs_oracle_alpha(sight), c[3], stays = 1;
  double *light = sight->light;
  if (alpha <= 0)
    alpha = fmin(fmax(fabs(light[0]), fmax(fabs(light[1]), fabs(light[2]))), 1);
  if (alpha <= 0)
    return;
  for (int i = 0; i < 3; i++)
    c[i] = light[i] / alpha;
  if (cs_grade_keys(grade))
    stays = key_colour(grade, space, c);
  else
    grade_colour(grade, space, c);
  for (int i = 0; i < 3; i++)
    light[i] = c[i] * alpha;
  if (cs_grade_keys(grade))
    *sight = cs_oracle_fade(sight, stays);
}
