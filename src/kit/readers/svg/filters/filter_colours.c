#include "readers/svg/filters/filter_colours.h"

#include <math.h>

#include "inside/colour.h"
#include "inside/elementary.h"
#include "inside/number.h"

#define DEGREES_TO_RADIANS (3.14159265358979323846 / 180)
/* Values of a table, at most. */
#define VALUES 128
/* Points of a curve: five around each place where a table bends, or the points of a power. */
#define POWER_POINTS 256
#define POINTS (5 * VALUES + 8)
/* Half of the width that replaces a bend or a jump. */
#define NEAR 1e-6
/* Colours are clamped up to this far outside of 0..1. */
#define FAR 1e6

/* ---------------------------------------------------------------- numbers */

size_t cs_svg_filter_numbers(const cs_svg_node *node, cs_svg_name name, double *out, size_t most) {
  const char *text = cs_svg_node_value(node, name);
  size_t count = 0;
  for (text = cs_svg_skip_space(text ? text : ""); *text; text = cs_svg_skip_comma(text))
    if (count == most || !cs_svg_take_number(&text, &out[count++]))
      return 0;
  return count;
}

double cs_svg_filter_number(const cs_svg_node *node, cs_svg_name name, double fallback) {
  double value;
  return cs_svg_filter_numbers(node, name, &value, 1) == 1 ? value : fallback;
}

/* ---------------------------------------------------------------- functions of one channel */

typedef enum function_kind {
  FUNCTION_IDENTITY,
  FUNCTION_TABLE,
  FUNCTION_DISCRETE,
  FUNCTION_LINEAR,
  FUNCTION_GAMMA
} function_kind;

typedef struct function {
  function_kind kind;
  double values[VALUES];
  size_t count;
  double slope, intercept, amplitude, exponent, offset;
} function;

/* Source: Filter Effects Module Level 1, 9.7. */
static double value_at(const function *f, double x) {
  double at = x * (double)(f->kind == FUNCTION_TABLE ? f->count - 1 : f->count);
  size_t last = f->count - 1, k = at < (double)last ? (size_t)at : last;
  switch (f->kind) {
  case FUNCTION_TABLE:
    return k == last ? f->values[k]
                     : f->values[k] + (at - (double)k) * (f->values[k + 1] - f->values[k]);
  case FUNCTION_DISCRETE:
    return f->values[k];
  case FUNCTION_LINEAR:
    return f->slope * x + f->intercept;
  case FUNCTION_GAMMA:
    return f->amplitude * cs_elementary_pow(x, f->exponent) + f->offset;
  default:
    return x;
  }
}

/* The type as written; a table without values is no function. */
static function_kind kind_of(const cs_svg_node *node, size_t count) {
  static const char *const words[] = {"identity", "table", "discrete", "linear", "gamma"};
  const char *type = cs_svg_node_value(node, CS_SVG_TYPE);
  for (int kind = FUNCTION_TABLE; type && kind <= FUNCTION_GAMMA; kind++)
    if (cs_svg_is_word(type, words[kind]))
      return count > 0 || kind > FUNCTION_DISCRETE ? (function_kind)kind : FUNCTION_IDENTITY;
  return FUNCTION_IDENTITY;
}

static void read_function(const cs_svg_node *node, function *out) {
  *out = (function){.slope = cs_svg_filter_number(node, CS_SVG_SLOPE, 1),
                    .intercept = cs_svg_filter_number(node, CS_SVG_INTERCEPT, 0),
                    .amplitude = cs_svg_filter_number(node, CS_SVG_AMPLITUDE, 1),
                    .exponent =
                        cs_number_clamp(cs_svg_filter_number(node, CS_SVG_EXPONENT, 1), 0, 1e3),
                    .offset = cs_svg_filter_number(node, CS_SVG_OFFSET, 0)};
  out->count = cs_svg_filter_numbers(node, CS_SVG_TABLE_VALUES, out->values, VALUES);
  out->kind = kind_of(node, out->count);
}

/* ---------------------------------------------------------------- curves */

/* A curve of a grade to which points are added. INVARIANT: x ascends. */
typedef struct curve {
  celspan_point points[POINTS];
  size_t count;
} curve;

static void add_point(curve *c, double x, double y) {
  if (c->count < POINTS && (c->count == 0 || x > c->points[c->count - 1].x + NEAR / 2))
    c->points[c->count++] = (celspan_point){x, cs_number_clamp(y, 0, 1)};
}

/* Adds points on both sides of a bend, so that the part between two bends remains straight. */
static void add_bend(curve *c, const function *f, double x) {
  for (int side = -2; side <= 2; side++)
    if ((side != 0 || f->kind != FUNCTION_DISCRETE) && x + side * NEAR >= 0 && x + side * NEAR <= 1)
      add_point(c, x + side * NEAR, value_at(f, x + side * NEAR));
}

/* Adds the points at which a line leaves 0..1. */
static void add_line(curve *c, const function *f) {
  double low = f->slope != 0 ? (0 - f->intercept) / f->slope : 0;
  double high = f->slope != 0 ? (1 - f->intercept) / f->slope : 0;
  add_bend(c, f, fmin(low, high));
  add_bend(c, f, fmax(low, high));
}

static const curve *curve_of(const function *f, curve *out) {
  out->count = 0;
  add_point(out, 0, value_at(f, 0));
  if (f->kind == FUNCTION_LINEAR)
    add_line(out, f);
  for (size_t k = 1; f->kind == FUNCTION_TABLE && k + 1 < f->count; k++)
    add_bend(out, f, (double)k / (double)(f->count - 1));
  for (size_t k = 1; f->kind == FUNCTION_DISCRETE && k < f->count; k++)
    add_bend(out, f, (double)k / (double)f->count);
  for (int i = 1; f->kind == FUNCTION_GAMMA && i < POWER_POINTS; i++) {
    double x = (double)i * i / (POWER_POINTS * POWER_POINTS);
    add_point(out, x, value_at(f, x));
  }
  add_point(out, 1, value_at(f, 1));
  return out;
}

/* The curve that clamps colours to 0..1. */
static void clamping_curve(curve *out) {
  const function identity = {.kind = FUNCTION_LINEAR, .slope = 1};
  out->count = 0;
  add_point(out, -FAR, 0);
  add_point(out, -2 * NEAR, 0);
  add_point(out, -NEAR, 0);
  add_bend(out, &identity, 0);
  add_bend(out, &identity, 1);
  add_point(out, 1 + NEAR, 1);
  add_point(out, 1 + 2 * NEAR, 1);
  add_point(out, FAR, 1);
}

static void give_curve(const curve *from, int channel, celspan_grade_desc *desc) {
  desc->curve[channel] = from->points;
  desc->curve_count[channel] = from->count;
}

/* ---------------------------------------------------------------- feComponentTransfer */

/* Whether a function multiplies alpha by a share. */
static bool is_share(const function *f, double *share) {
  *share = value_at(f, 1);
  bool is_straight = *share >= 0 && *share <= 1;
  for (int i = 0; i < 16; i++)
    is_straight = is_straight && fabs(value_at(f, i / 16.0) - *share * (i / 16.0)) < NEAR;
  return is_straight;
}

/* ---------------------------------------------------------------- functions of alpha */

/* Gives the step a function of alpha. ground: the colour where there is nothing. */
static celspan_status give_alpha(const cs_svg_reading *reading, const function *f,
                                 const double ground[3], cs_svg_step *step) {
  celspan_context *context = reading->context;
  cs_nearby fields = {.kind = CS_NEARBY_ALPHA, .count = CS_NEARBY_TABLE};
  float *values;
  CS_TRY(CS_MAKE(context, values, CS_NEARBY_TABLE));
  for (size_t i = 0; i < CS_NEARBY_TABLE; i++)
    values[i] = (float)cs_number_clamp(value_at(f, (double)i / (CS_NEARBY_TABLE - 1)), 0, 1);
  for (int c = 0; c < 3; c++)
    fields.ground[c] = cs_number_clamp(ground[c], 0, 1);
  fields.numbers = values;
  celspan_status status = cs_nearby_create(context, &fields, &step->nearby);
  cs_mem_free(context->memory, values, CS_NEARBY_TABLE * sizeof *values);
  return status;
}

/* Whether some values could not be read: there are more than VALUES, or they are no numbers. */
static bool has_other_values(const cs_svg_node *node, const function *f) {
  const char *text = cs_svg_node_value(node, CS_SVG_TABLE_VALUES);
  return text && *cs_svg_skip_space(text) && f->count == 0;
}

/* The functions of the channels that have elements. */
static celspan_status read_functions(const cs_svg_reading *reading, const cs_svg_node *node,
                                     curve curves[3], celspan_grade_desc *desc, cs_svg_step *step,
                                     const char **reason) {
  static const cs_svg_element channels[] = {CS_SVG_ELEMENT_FE_FUNC_R, CS_SVG_ELEMENT_FE_FUNC_G,
                                            CS_SVG_ELEMENT_FE_FUNC_B, CS_SVG_ELEMENT_FE_FUNC_A};
  function f, alpha = {.kind = FUNCTION_IDENTITY};
  double ground[3] = {0, 0, 0};
  for (const cs_svg_node *child = node->first; child; child = child->next)
    for (int channel = 0; channel < 4; channel++) {
      if (child->element != channels[channel])
        continue;
      read_function(child, &f);
      if (has_other_values(child, &f))
        *reason = "with such tableValues";
      else if (channel == 3)
        alpha = f;
      else {
        desc->curve_count[channel] = 0;
        ground[channel] = value_at(&f, 0);
        if (f.kind != FUNCTION_IDENTITY)
          give_curve(curve_of(&f, &curves[channel]), channel, desc);
      }
    }
  if (is_share(&alpha, &step->opacity))
    return CELSPAN_OK;
  step->opacity = 1;
  return give_alpha(reading, &alpha, ground, step);
}

celspan_status cs_svg_transfer_read(cs_svg_reading *reading, const cs_svg_node *node,
                                    cs_svg_step *step, const char **reason) {
  celspan_grade_desc desc = CELSPAN_GRADE_DESC;
  curve *curves;
  step->kind = CS_SVG_STEP_COLOUR;
  CS_TRY(CS_MAKE(reading->context, curves, 3));
  celspan_status status = read_functions(reading, node, curves, &desc, step, reason);
  if (status == CELSPAN_OK && !*reason)
    status = celspan_grade_create(reading->context, &desc, &step->grade);
  cs_mem_free(reading->context->memory, curves, 3 * sizeof *curves);
  return status;
}

/* ---------------------------------------------------------------- feColorMatrix */

/* 20 numbers, row by row; a matrix of another size has no effect. */
static celspan_status read_matrix(const cs_svg_reading *reading, const cs_svg_node *node,
                                  celspan_grade_desc *desc, cs_svg_step *step,
                                  const char **reason) {
  double values[20];
  if (cs_svg_filter_numbers(node, CS_SVG_VALUES, values, 20) != 20)
    return CELSPAN_OK;
  const double *alpha = &values[15];
  const function line = {.kind = FUNCTION_LINEAR, .slope = alpha[3], .intercept = alpha[4]};
  const double ground[3] = {values[4], values[9], values[14]};
  if (alpha[0] != 0 || alpha[1] != 0 || alpha[2] != 0)
    *reason = "with alpha that depends on colours";
  desc->has_matrix = true;
  for (int row = 0; row < 3; row++) {
    if (values[5 * row + 3] != 0)
      *reason = "with colours that depend on alpha";
    for (int column = 0; column < 4; column++)
      desc->matrix[row][column] = values[5 * row + (column < 3 ? column : 4)];
  }
  if (*reason || is_share(&line, &step->opacity))
    return CELSPAN_OK;
  step->opacity = 1;
  return give_alpha(reading, &line, ground, step);
}

/* ---------------------------------------------------------------- products */

static bool is_flood(const cs_svg_recipe *recipe, size_t number) {
  return number >= CS_SVG_SOURCES &&
         recipe->steps[number - CS_SVG_SOURCES].kind == CS_SVG_STEP_FLOOD;
}

/* If an input is multiplied by a flood, the product of the two colours is drawn where the flood
 * is. */
celspan_status cs_svg_product_read(const cs_svg_reading *reading, const cs_svg_recipe *recipe,
                                   cs_svg_step *step, const char **reason) {
  const size_t *inputs = recipe->inputs + step->first_input;
  celspan_grade_desc desc = CELSPAN_GRADE_DESC;
  step->flood = is_flood(recipe, inputs[1]);
  if (!is_flood(recipe, inputs[step->flood])) {
    *reason = "with such a k1";
    return CELSPAN_OK;
  }
  const celspan_paint *paint = &recipe->steps[inputs[step->flood] - CS_SVG_SOURCES].paint;
  desc.has_matrix = true;
  for (int c = 0; c < 3; c++)
    desc.matrix[c][c] = step->space == CELSPAN_SPACE_SRGB
                            ? cs_transfer_encode(CELSPAN_TRANSFER_SRGB, paint->pigment[c])
                            : paint->pigment[c];
  return celspan_grade_create(reading->context, &desc, &step->grade);
}

/* ---------------------------------------------------------------- types of matrices */

void cs_svg_hue_set(celspan_grade_desc *desc, double degrees) {
  desc->hue_radians = DEGREES_TO_RADIANS * fmod(degrees, 360);
}

celspan_status cs_svg_clamped_grade(const cs_svg_reading *reading, celspan_grade_desc *desc,
                                    celspan_grade **out) {
  curve *clamp;
  CS_TRY(CS_MAKE(reading->context, clamp, 1));
  clamping_curve(clamp);
  for (int channel = 0; channel < 3; channel++)
    give_curve(clamp, channel, desc);
  celspan_status status = celspan_grade_create(reading->context, desc, out);
  cs_mem_free(reading->context->memory, clamp, sizeof *clamp);
  return status;
}

celspan_status cs_svg_colour_matrix_read(cs_svg_reading *reading, const cs_svg_node *node,
                                         cs_svg_step *step, const char **reason) {
  celspan_grade_desc desc = CELSPAN_GRADE_DESC;
  step->kind = CS_SVG_STEP_COLOUR;
  if (cs_svg_node_says(node, CS_SVG_TYPE, "luminanceToAlpha")) {
    step->kind = CS_SVG_STEP_LUMA;
    return CELSPAN_OK;
  }
  if (cs_svg_node_says(node, CS_SVG_TYPE, "saturate"))
    desc.saturation = fmax(0, cs_svg_filter_number(node, CS_SVG_VALUES, 1));
  else if (cs_svg_node_says(node, CS_SVG_TYPE, "hueRotate"))
    cs_svg_hue_set(&desc, cs_svg_filter_number(node, CS_SVG_VALUES, 0));
  else
    CS_TRY(read_matrix(reading, node, &desc, step, reason));
  return *reason ? CELSPAN_OK : cs_svg_clamped_grade(reading, &desc, &step->grade);
}
