/* Functions of the property `filter` as steps of recipes. */
#include "readers/svg/filters/filters.h"

#include <math.h>

#include "inside/number.h"
#include "readers/svg/filters/filter_colours.h"

/* Functions cut off nothing that is nearer than this, and no length is greater. */
#define FARTHEST 1e9

static double length_of(const cs_svg_filter_call *call, int index, const cs_svg_place *place) {
  return cs_number_clamp(cs_svg_resolve(call->lengths[index], CS_SVG_AXIS_X, &place->measure),
                         -FARTHEST, FARTHEST);
}

/* The radius of a blur is twice its deviation. */
static void read_blur(const cs_svg_filter_call *call, int index, const cs_svg_place *place,
                      cs_svg_step *step) {
  step->kind = CS_SVG_STEP_BLUR;
  step->radius.x = step->radius.y = 2 * length_of(call, index, place);
}

static void read_shadow(const cs_svg_reading *reading, const cs_svg_filter_call *call,
                        const cs_svg_place *place, cs_svg_step *step) {
  const cs_svg_colour *colour = call->has_colour ? &call->colour : &place->style.colour;
  read_blur(call, 2, place, step);
  step->kind = CS_SVG_STEP_SHADOW;
  step->offset = (celspan_point){length_of(call, 0, place), length_of(call, 1, place)};
  step->paint = cs_svg_paint_of(reading, colour, 1);
}

/* Every channel c becomes slope * c + intercept. */
static void set_line(celspan_grade_desc *desc, double slope, double intercept) {
  desc->has_matrix = true;
  for (int c = 0; c < 3; c++) {
    desc->matrix[c][c] = slope;
    desc->matrix[c][3] = intercept;
  }
}

/* Source: Filter Effects Module Level 1, 13.1.2. */
static void set_sepia(celspan_grade_desc *desc, double amount) {
  static const double brown[3][3] = {
      {0.393, 0.769, 0.189}, {0.349, 0.686, 0.168}, {0.272, 0.534, 0.131}};
  set_line(desc, 1 - amount, 0);
  for (int row = 0; row < 3; row++)
    for (int column = 0; column < 3; column++)
      desc->matrix[row][column] += amount * brown[row][column];
}

static void set_colours(const cs_svg_filter_call *call, celspan_grade_desc *desc) {
  double amount = call->amount;
  switch (call->kind) {
  case CS_SVG_FILTER_BRIGHTNESS:
    set_line(desc, amount, 0);
    break;
  case CS_SVG_FILTER_CONTRAST:
    set_line(desc, amount, 0.5 - 0.5 * amount);
    break;
  case CS_SVG_FILTER_INVERT:
    set_line(desc, 1 - 2 * amount, amount);
    break;
  case CS_SVG_FILTER_SEPIA:
    set_sepia(desc, amount);
    break;
  case CS_SVG_FILTER_HUE:
    cs_svg_hue_set(desc, amount);
    break;
  default:
    desc->saturation = call->kind == CS_SVG_FILTER_GRAYSCALE ? 1 - amount : amount;
  }
}

static celspan_status read_step(const cs_svg_reading *reading, const cs_svg_filter_call *call,
                                const cs_svg_place *place, cs_svg_step *step) {
  celspan_grade_desc desc = CELSPAN_GRADE_DESC;
  switch (call->kind) {
  case CS_SVG_FILTER_BLUR:
    read_blur(call, 0, place, step);
    return CELSPAN_OK;
  case CS_SVG_FILTER_SHADOW:
    read_shadow(reading, call, place, step);
    return CELSPAN_OK;
  case CS_SVG_FILTER_OPACITY:
    step->opacity = call->amount;
    return CELSPAN_OK;
  default:
    set_colours(call, &desc);
    return cs_svg_clamped_grade(reading, &desc, &step->grade);
  }
}

celspan_status cs_svg_filter_function_make(const cs_svg_reading *reading,
                                           const cs_svg_filter_call *call,
                                           const cs_svg_place *place, cs_svg_recipe *recipe) {
  const celspan_box everywhere = {-FARTHEST, -FARTHEST, 2 * FARTHEST, 2 * FARTHEST};
  cs_svg_step step = {
      .kind = CS_SVG_STEP_COLOUR, .box = everywhere, .input_count = 1, .opacity = 1};
  celspan_context *context = reading->context;
  step.space = reading->is_coded ? CELSPAN_SPACE_AROUND : CELSPAN_SPACE_SRGB;
  recipe->region = everywhere;
  CS_TRY(CS_ARRAY_APPEND(context, recipe->inputs, recipe->input_count, 0));
  CS_TRY(read_step(reading, call, place, &step));
  return cs_svg_recipe_append(context, recipe, &step);
}
