#include "model/colour/grade.h"

#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "base/number.h"
#include "model/colour/primaries.h"
#include "model/colour/transfer.h"

#define LN2 0.69314718055994530942

static const double luma[3] = {CS_LUMA_RED, CS_LUMA_GREEN, CS_LUMA_BLUE};

/* ---------------------------------------------------------------- affine maps */

static const cs_grade_map same = {false, {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

/* The map that applies `first` and then `next`. */
static cs_grade_map then(const cs_grade_map *first, const cs_grade_map *next) {
  cs_grade_map both = {.is_given = true};
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 4; c++) {
      both.rows[r][c] = c == 3 ? next->rows[r][3] : 0;
      for (int k = 0; k < 3; k++)
        both.rows[r][c] += next->rows[r][k] * first->rows[k][c];
    }
  return both;
}

/* Multiplies each channel by its factor, and adds its number. */
static cs_grade_map scaling(const double factors[3], const double add[3]) {
  cs_grade_map map = {.is_given = true};
  for (int c = 0; c < 3; c++) {
    map.rows[c][c] = factors[c];
    map.rows[c][3] = add[c];
  }
  return map;
}

static cs_grade_map grey_scaling(double factor, double add) {
  return scaling((double[3]){factor, factor, factor}, (double[3]){add, add, add});
}

/* As feColorMatrix of Filter Effects Level 1, with luma of six digits. */
static cs_grade_map saturation_map(double s) {
  cs_grade_map map = {.is_given = true};
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++)
      map.rows[r][c] = luma[c] + s * ((r == c) - luma[c]);
  return map;
}

/* Also from there. The second row of the sines is the row in the standard. */
static cs_grade_map hue_map(double radians) {
  const double sines[3][3] = {
      {-luma[0], -luma[1], 1 - luma[2]}, {0.143, 0.140, -0.283}, {luma[0] - 1, luma[1], luma[2]}};
  double sine, cosine;
  cs_elementary_sincos(radians, &sine, &cosine);
  cs_grade_map map = {.is_given = true};
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++)
      map.rows[r][c] = luma[c] + cosine * ((r == c) - luma[c]) + sine * sines[r][c];
  return map;
}

static double power_of_two(double exponent) { return cs_elementary_exp(exponent * LN2); }

static cs_grade_map balance_map(double temperature, double tint) {
  double gains[3] = {power_of_two(temperature / 2), power_of_two(-tint / 2),
                     power_of_two(-temperature / 2)};
  double sum = luma[0] * gains[0] + luma[1] * gains[1] + luma[2] * gains[2];
  for (int c = 0; c < 3; c++)
    gains[c] /= sum;
  return scaling(gains, (double[3]){0, 0, 0});
}

static bool has_cdl(const celspan_grade_desc *desc) {
  bool has = false;
  for (int c = 0; c < 3; c++)
    has |= desc->slope[c] != 1 || desc->offset[c] != 0 || desc->power[c] != 1;
  return has;
}

static cs_grade_map cdl_of(const celspan_grade_desc *desc) {
  cs_grade_map exposed = grey_scaling(power_of_two(desc->exposure), 0);
  cs_grade_map next = scaling(desc->slope, desc->offset);
  return has_cdl(desc) ? then(&exposed, &next) : same;
}

static double pivot_of(const celspan_grade_desc *desc, int space) {
  return desc->has_pivot ? desc->pivot : space == CELSPAN_SPACE_SRGB ? 0.46 : 0.18;
}

static cs_grade_map balance_of(const celspan_grade_desc *desc, int space) {
  const double k = desc->contrast, pivot = pivot_of(desc, space);
  const struct {
    bool is_given;
    cs_grade_map map;
  } steps[] = {
      {desc->exposure != 0 && !has_cdl(desc), grey_scaling(power_of_two(desc->exposure), 0)},
      {k != 1, grey_scaling(k, pivot - k * pivot)},
      {desc->saturation != 1, saturation_map(desc->saturation)},
      {desc->hue_radians != 0, hue_map(desc->hue_radians)},
      {desc->temperature != 0 || desc->tint != 0, balance_map(desc->temperature, desc->tint)}};
  cs_grade_map map = same;
  for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
    if (steps[i].is_given)
      map = then(&map, &steps[i].map);
  return map;
}

static void apply_map(const cs_grade_map *map, double colour[3]) {
  double from[3];
  memcpy(from, colour, sizeof from);
  for (int r = 0; r < 3 && map->is_given; r++) {
    const double *row = map->rows[r];
    colour[r] = row[0] * from[0] + row[1] * from[1] + row[2] * from[2] + row[3];
  }
}

/* ---------------------------------------------------------------- curves */

/* The slopes of Fritsch and Carlson: the mean of the slopes on both sides, then reduced to the
 * circle of radius 3, in which a cubic does not overshoot. */
static void find_slopes(const cs_grade_curve *curve) {
  const celspan_point *p = curve->points;
  double before = 0;
  for (size_t i = 0; i + 1 < curve->count; i++) {
    double line = (p[i + 1].y - p[i].y) / (p[i + 1].x - p[i].x);
    curve->slopes[i] = i == 0 ? line : before * line <= 0 ? 0 : (before + line) / 2;
    curve->slopes[i + 1] = line;
    before = line;
  }
  for (size_t i = 0; i + 1 < curve->count; i++) {
    double line = (p[i + 1].y - p[i].y) / (p[i + 1].x - p[i].x);
    double a = line == 0 ? 0 : curve->slopes[i] / line;
    double b = line == 0 ? 0 : curve->slopes[i + 1] / line;
    double size = a * a + b * b, hold = size > 9 ? 3 / sqrt(size) : 1;
    curve->slopes[i] = hold * a * line;
    curve->slopes[i + 1] = hold * b * line;
  }
}

static celspan_status make_curve(celspan_context *context, const celspan_point *points,
                                 size_t count, cs_grade_curve *out) {
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(CS_MAKE(context, out->points, count));
  out->count = count;
  CS_TRY(CS_MAKE(context, out->slopes, count));
  memcpy(out->points, points, count * sizeof *points);
  find_slopes(out);
  return CELSPAN_OK;
}

/* The index of the piece that contains x, which is the index of the piece's first point. */
static size_t find_piece(const cs_grade_curve *curve, double x) {
  size_t low = 0, high = curve->count - 1;
  while (high - low > 1) {
    size_t middle = (low + high) / 2;
    if (curve->points[middle].x <= x)
      low = middle;
    else
      high = middle;
  }
  return low;
}

static double on_curve(const cs_grade_curve *curve, double x) {
  const size_t last = curve->count - 1;
  const celspan_point *p = curve->points;
  if (x <= p[0].x)
    return p[0].y + curve->slopes[0] * (x - p[0].x);
  if (x >= p[last].x)
    return p[last].y + curve->slopes[last] * (x - p[last].x);
  size_t i = find_piece(curve, x);
  double width = p[i + 1].x - p[i].x, u = (x - p[i].x) / width, v = 1 - u;
  return v * v * (1 + 2 * u) * p[i].y + u * u * (1 + 2 * v) * p[i + 1].y +
         u * v * width * (v * curve->slopes[i] - u * curve->slopes[i + 1]);
}

/* ---------------------------------------------------------------- grades */

celspan_status cs_grade_make(celspan_context *context, const celspan_grade_desc *desc,
                             cs_grade *out) {
  *out = (cs_grade){.cdl = cdl_of(desc),
                    .power = {desc->power[0], desc->power[1], desc->power[2]},
                    .exponent = 1 / desc->gamma,
                    .matrix = same,
                    .steps = desc->steps,
                    .cube_space = desc->lut_space};
  for (int space = CELSPAN_SPACE_LINEAR; space < CS_SPACES; space++)
    out->balance[space] = balance_of(desc, space);
  out->matrix.is_given = desc->has_matrix;
  if (desc->has_matrix)
    memcpy(out->matrix.rows, desc->matrix, sizeof out->matrix.rows);
  for (int c = 0; c < 3; c++)
    CS_TRY(make_curve(context, desc->curve[c], desc->curve_count[c], &out->curves[c]));
  return CELSPAN_OK;
}

void cs_grade_finish(cs_grade *grade, cs_memory *memory) {
  for (int c = 0; c < 3; c++) {
    cs_grade_curve *curve = &grade->curves[c];
    cs_mem_free(memory, curve->points, curve->count * sizeof *curve->points);
    cs_mem_free(memory, curve->slopes, curve->count * sizeof *curve->slopes);
  }
  cs_cube_unref(grade->cube);
}

static double bend(double value, double exponent) {
  value = cs_number_clamp(value, -CS_GRADE_MOST, CS_GRADE_MOST);
  double size = exponent == 1 ? fabs(value) : cs_elementary_pow(fabs(value), exponent);
  size = size < CS_GRADE_MOST ? size : CS_GRADE_MOST;
  return value < 0 ? -size : size;
}

static void apply_cdl(const cs_grade *grade, double colour[3]) {
  if (!grade->cdl.is_given)
    return;
  apply_map(&grade->cdl, colour);
  for (int c = 0; c < 3; c++)
    colour[c] = bend(fmax(colour[c], 0), grade->power[c]);
}

/* ---------------------------------------------------------------- in codes or in light */

/* The number of one space in another. */
static double converted(double value, celspan_space from, celspan_space to) {
  if (from == to)
    return value;
  return (double)(to == CELSPAN_SPACE_SRGB
                      ? cs_transfer_encode(CELSPAN_TRANSFER_SRGB, (float)value)
                      : cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)value));
}

/* A code that lies on a border, within CS_GRADE_BORDER, takes the upper step, so that rounding
 * decides nothing. */
static double step_of(double code, int steps) {
  double step = floor((code + CS_GRADE_BORDER) * steps);
  return cs_number_clamp(step, 0, steps - 1) / (steps - 1);
}

static void apply_steps(const cs_grade *grade, celspan_space space, double colour[3]) {
  for (int c = 0; c < 3 && grade->steps > 0; c++) {
    double code = converted(colour[c], space, CELSPAN_SPACE_SRGB);
    colour[c] = converted(step_of(code, grade->steps), CELSPAN_SPACE_SRGB, space);
  }
}

static void apply_cube(const cs_grade *grade, celspan_space space, double colour[3]) {
  if (!grade->cube)
    return;
  for (int c = 0; c < 3; c++)
    colour[c] = converted(colour[c], space, grade->cube_space);
  cs_cube_apply(grade->cube, colour);
  for (int c = 0; c < 3; c++)
    colour[c] = converted(colour[c], grade->cube_space, space);
}

/* ---------------------------------------------------------------- all steps */

void cs_grade_colour(const cs_grade *grade, celspan_space space, double colour[3]) {
  apply_cdl(grade, colour);
  apply_map(&grade->balance[space], colour);
  for (int c = 0; c < 3; c++)
    colour[c] = bend(colour[c], grade->exponent);
  apply_map(&grade->matrix, colour);
  for (int c = 0; c < 3; c++)
    if (grade->curves[c].count > 0)
      colour[c] = on_curve(&grade->curves[c], colour[c]);
  apply_steps(grade, space, colour);
  apply_cube(grade, space, colour);
  for (int c = 0; c < 3; c++)
    colour[c] = cs_number_clamp(colour[c], -CS_GRADE_MOST, CS_GRADE_MOST);
}

void cs_grade_light(const cs_grade *grade, celspan_space space, float alpha, float light[3]) {
  double colour[3], there = (double)alpha;
  for (int c = 0; c < 3 && !(alpha > 0); c++)
    there = fmax(there, fmin(fabs((double)light[c]), 1));
  if (!(there > 0))
    return;
  for (int c = 0; c < 3; c++)
    colour[c] = (double)light[c] / there;
  cs_grade_colour(grade, space, colour);
  for (int c = 0; c < 3; c++)
    light[c] = (float)(colour[c] * there);
}
