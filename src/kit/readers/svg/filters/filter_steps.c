#include "readers/svg/filters/filter_steps.h"

#include <math.h>
#include <string.h>

#include "inside/colour.h"
#include "inside/geometry.h"
#include "inside/number.h"
#include "readers/svg/document/shapes.h"
#include "readers/svg/draw/image.h"
#include "readers/svg/draw/regions.h"
#include "readers/svg/filters/filter_colours.h"
#include "readers/svg/filters/filter_nearby.h"
#include "readers/svg/filters/filter_turbulence.h"

/* ---------------------------------------------------------------- inputs */

static celspan_status add_input(cs_svg_filter *f, size_t number) {
  cs_svg_recipe *recipe = f->recipe;
  f->step.input_count++;
  return CS_ARRAY_APPEND(f->reading->context, recipe->inputs, recipe->input_count, number);
}

size_t cs_svg_filter_last(const cs_svg_filter *f) {
  return f->recipe->step_count > 0 ? CS_SVG_SOURCES + f->recipe->step_count - 1 : 0;
}

static bool find_result(const cs_svg_filter *f, const char *name, size_t *out) {
  for (size_t i = f->name_count; i-- > 0;)
    if (strcmp(f->names[i].name, name) == 0) {
      *out = f->names[i].number;
      return true;
    }
  return false;
}

/* The input that an attribute of `node` names. */
static celspan_status take_input(cs_svg_filter *f, const cs_svg_node *node, cs_svg_name attribute) {
  const char *text = cs_svg_node_value(node, attribute);
  size_t number = cs_svg_filter_last(f);
  if (text && !find_result(f, text, &number)) {
    if (cs_svg_is_word(text, "SourceGraphic"))
      number = 0;
    else if (cs_svg_is_word(text, "SourceAlpha"))
      number = 1;
    else if (cs_svg_words_have("BackgroundImage|BackgroundAlpha|FillPaint|StrokePaint", text))
      f->reason = "with such an input";
  }
  return add_input(f, number);
}

static celspan_status take_both(cs_svg_filter *f) {
  CS_TRY(take_input(f, f->node, CS_SVG_IN));
  return take_input(f, f->node, CS_SVG_IN2);
}

/* ---------------------------------------------------------------- places */

/* One side of the step's box; by default the same side of the region. */
static celspan_status read_side(const cs_svg_filter *f, cs_svg_name name, cs_svg_axis axis,
                                const cs_svg_measure *measure, double *side) {
  const char *text = cs_svg_node_value(f->node, name);
  const bool is_x = axis == CS_SVG_AXIS_X, is_size = name == CS_SVG_WIDTH || name == CS_SVG_HEIGHT;
  cs_svg_length length;
  double value;
  CS_TRY(cs_svg_number_of(f->reading->context, f->node, name, axis, measure, &value));
  if (!text || !cs_svg_parse_length(text, &length))
    return CELSPAN_OK;
  if (f->is_in_shares)
    value = (is_size ? 0
             : is_x  ? f->box.x
                     : f->box.y) +
            value * (is_x ? f->box.width : f->box.height);
  *side = value;
  return CELSPAN_OK;
}

/* The box of an input; the box of the sources is the region. */
static const celspan_box *box_of(const cs_svg_filter *f, size_t number) {
  return number < CS_SVG_SOURCES ? &f->recipe->region
                                 : &f->recipe->steps[number - CS_SVG_SOURCES].box;
}

/* The box of a step that specifies none: the box around its inputs' boxes, as in browsers. */
static celspan_box usual_box(const cs_svg_filter *f) {
  const cs_svg_recipe *recipe = f->recipe;
  if (f->step.input_count == 0 || f->step.kind == CS_SVG_STEP_TILE)
    return recipe->region;
  const size_t *inputs = recipe->inputs + f->step.first_input;
  celspan_box box = *box_of(f, inputs[0]);
  for (size_t i = 1; i < f->step.input_count; i++)
    box = cs_outline_box_around(box, *box_of(f, inputs[i]));
  return box;
}

static celspan_status find_box(cs_svg_filter *f) {
  cs_svg_measure measure = f->place->measure;
  celspan_box *box = &f->step.box;
  *box = usual_box(f);
  if (f->is_in_shares)
    measure.width = measure.height = 1;
  CS_TRY(read_side(f, CS_SVG_X, CS_SVG_AXIS_X, &measure, &box->x));
  CS_TRY(read_side(f, CS_SVG_Y, CS_SVG_AXIS_Y, &measure, &box->y));
  CS_TRY(read_side(f, CS_SVG_WIDTH, CS_SVG_AXIS_X, &measure, &box->width));
  return read_side(f, CS_SVG_HEIGHT, CS_SVG_AXIS_Y, &measure, &box->height);
}

/* The intersection of two boxes; its size is 0 if they do not meet. */
static celspan_box common(const celspan_box *a, const celspan_box *b) {
  double left = fmax(a->x, b->x), right = fmin(a->x + a->width, b->x + b->width);
  double top = fmax(a->y, b->y), bottom = fmin(a->y + a->height, b->y + b->height);
  return (celspan_box){left, top, fmax(0, right - left), fmax(0, bottom - top)};
}

celspan_status cs_svg_filter_read_box(cs_svg_filter *f) {
  celspan_status status = find_box(f);
  f->step.box = common(&f->step.box, &f->recipe->region);
  return status;
}

/* A vector in user units, computed from the numbers of an attribute. */
static celspan_point scaled(const cs_svg_filter *f, double x, double y) {
  return f->is_in_shares ? (celspan_point){x * f->box.width, y * f->box.height}
                         : (celspan_point){x, y};
}

/* ---------------------------------------------------------------- steps */

static celspan_status read_offset(cs_svg_filter *f) {
  f->step.kind = CS_SVG_STEP_OFFSET;
  f->step.offset = scaled(f, cs_svg_filter_number(f->node, CS_SVG_DX, 0),
                          cs_svg_filter_number(f->node, CS_SVG_DY, 0));
  return take_input(f, f->node, CS_SVG_IN);
}

/* The radius of a blur is twice its deviation; a negative deviation means no blur. */
static void read_deviations(cs_svg_filter *f, double least) {
  double values[2] = {least, least};
  size_t count = cs_svg_filter_numbers(f->node, CS_SVG_STD_DEVIATION, values, 2);
  if (count == 0)
    values[0] = least;
  if (count < 2)
    values[1] = values[0];
  bool is_blurred = values[0] >= 0 && values[1] >= 0;
  f->step.radius = is_blurred ? scaled(f, 2 * values[0], 2 * values[1]) : (celspan_point){0, 0};
}

static celspan_status read_blur(cs_svg_filter *f) {
  const char *edge = cs_svg_node_value(f->node, CS_SVG_EDGE_MODE);
  f->step.kind = CS_SVG_STEP_BLUR;
  read_deviations(f, 0);
  if (edge && cs_svg_words_have("duplicate|wrap", edge)) /* drawn as `none`, as in browsers */
    CS_TRY(cs_svg_skip(f->reading, f->node, "edgeMode \"%.10s\"", cs_svg_skip_space(edge)));
  return take_input(f, f->node, CS_SVG_IN);
}

static celspan_channel channel_of(const cs_svg_filter *f, cs_svg_name name) {
  static const char *const words[] = {"R", "G", "B"};
  const char *word = cs_svg_node_value(f->node, name);
  for (int i = 0; word && i < 3; i++)
    if (cs_svg_is_word(word, words[i]))
      return (celspan_channel)(CELSPAN_CHANNEL_RED + i);
  return CELSPAN_CHANNEL_ALPHA;
}

static celspan_status read_displacement(cs_svg_filter *f) {
  const double scale = cs_svg_filter_number(f->node, CS_SVG_SCALE, 0);
  f->step.kind = CS_SVG_STEP_DISPLACE;
  f->step.channels[0] = channel_of(f, CS_SVG_X_CHANNEL_SELECTOR);
  f->step.channels[1] = channel_of(f, CS_SVG_Y_CHANNEL_SELECTOR);
  f->step.scale = scaled(f, scale, scale).x;
  return take_both(f);
}

/* The greatest and the least of the surrounding pixels are shapes if all pixels have one colour. */
static celspan_status read_morphology(cs_svg_filter *f) {
  const bool grows = cs_svg_node_says(f->node, CS_SVG_OPERATOR, "dilate");
  double values[2] = {0, 0};
  size_t count = cs_svg_filter_numbers(f->node, CS_SVG_RADIUS, values, 2);
  if (count == 1)
    values[1] = values[0];
  f->step.kind = grows ? CS_SVG_STEP_GROW : CS_SVG_STEP_SHRINK;
  f->step.radius = scaled(f, fmax(0, values[0]), fmax(0, values[1]));
  CS_TRY(take_input(f, f->node, CS_SVG_IN));
  if (fmax(f->step.radius.x, f->step.radius.y) > 0 &&
      !cs_svg_filter_one_paint(f->reading, f->element, f->place, f->recipe,
                               f->recipe->inputs[f->step.first_input], &f->step.paint))
    f->reason = "of several colours";
  return CELSPAN_OK;
}

static celspan_status read_flood(cs_svg_filter *f) {
  f->step.kind = CS_SVG_STEP_FLOOD;
  f->step.paint = cs_svg_paint_of(f->reading, &f->style.flood_colour, 1);
  return CELSPAN_OK;
}

static celspan_status read_shadow(cs_svg_filter *f) {
  const double dx = cs_svg_filter_number(f->node, CS_SVG_DX, 2);
  const double dy = cs_svg_filter_number(f->node, CS_SVG_DY, 2);
  CS_TRY(read_flood(f));
  f->step.kind = CS_SVG_STEP_SHADOW;
  f->step.offset = scaled(f, dx, dy);
  read_deviations(f, 2);
  return take_input(f, f->node, CS_SVG_IN);
}

static celspan_status read_merge(cs_svg_filter *f) {
  f->step.kind = CS_SVG_STEP_MERGE;
  for (const cs_svg_node *child = f->node->first; child; child = child->next)
    if (child->element == CS_SVG_ELEMENT_FE_MERGE_NODE)
      CS_TRY(take_input(f, child, CS_SVG_IN));
  return CELSPAN_OK;
}

static celspan_status read_blend(cs_svg_filter *f) {
  const char *mode = cs_svg_node_value(f->node, CS_SVG_MODE);
  f->step.kind = CS_SVG_STEP_BLEND;
  for (int i = 0; mode && i < CELSPAN_BLEND_ADD; i++)
    if (cs_svg_is_word(mode, cs_blend_words[i]))
      f->step.blend = (celspan_blend)i;
  return take_both(f);
}

/* Subtraction is not possible, and one factor of a product must be a flood. */
static celspan_status read_sum(cs_svg_filter *f) {
  double *weights = f->step.weights;
  f->step.kind = CS_SVG_STEP_SUM;
  weights[0] = cs_svg_filter_number(f->node, CS_SVG_K2, 0);
  weights[1] = cs_svg_filter_number(f->node, CS_SVG_K3, 0);
  weights[2] = fmin(1, cs_svg_filter_number(f->node, CS_SVG_K4, 0));
  weights[3] = cs_svg_filter_number(f->node, CS_SVG_K1, 0);
  for (int i = 0; i < 4; i++)
    if (!(weights[i] >= 0 && weights[i] <= CS_SVG_SUM_MOST))
      f->reason = "with such numbers";
  return weights[3] > 0 && !f->reason
             ? cs_svg_product_read(f->reading, f->recipe, &f->step, &f->reason)
             : CELSPAN_OK;
}

static celspan_status read_composite(cs_svg_filter *f) {
  static const struct {
    const char *word;
    cs_svg_step_kind kind;
  } operators[] = {{"in", CS_SVG_STEP_IN},
                   {"out", CS_SVG_STEP_OUT},
                   {"atop", CS_SVG_STEP_ATOP},
                   {"xor", CS_SVG_STEP_XOR}};
  const char *word = cs_svg_node_value(f->node, CS_SVG_OPERATOR);
  f->step.kind = CS_SVG_STEP_BLEND; /* in the normal mode: over */
  for (size_t i = 0; word && i < sizeof operators / sizeof *operators; i++)
    if (cs_svg_is_word(word, operators[i].word))
      f->step.kind = operators[i].kind;
  if (cs_svg_is_word(word, "lighter"))
    f->step.blend = CELSPAN_BLEND_ADD;
  CS_TRY(take_both(f));
  return cs_svg_is_word(word, "arithmetic") ? read_sum(f) : CELSPAN_OK;
}

static celspan_status read_matrix(cs_svg_filter *f) {
  CS_TRY(take_input(f, f->node, CS_SVG_IN));
  return cs_svg_colour_matrix_read(f->reading, f->node, &f->step, &f->reason);
}

static celspan_status read_transfer(cs_svg_filter *f) {
  CS_TRY(take_input(f, f->node, CS_SVG_IN));
  return cs_svg_transfer_read(f->reading, f->node, &f->step, &f->reason);
}

/* Reads the box before the others do, as rules need it. */
static celspan_status take_boxed(cs_svg_filter *f) {
  CS_TRY(take_input(f, f->node, CS_SVG_IN));
  CS_TRY(cs_svg_filter_read_box(f));
  f->step.box = common(&f->step.box, &f->recipe->region);
  return CELSPAN_OK;
}

static celspan_status read_weights(cs_svg_filter *f) {
  CS_TRY(take_boxed(f));
  return cs_svg_weights_read(f->reading, f->node, &f->step, &f->reason);
}

static celspan_status read_lighting(cs_svg_filter *f) {
  const cs_svg_filter_units units = {f->is_in_shares, &f->box};
  CS_TRY(take_boxed(f));
  return cs_svg_lighting_read(f->reading, f->node, &f->style, &units, &f->step, &f->reason);
}

/* The box of the input is repeated. */
static celspan_status read_tile(cs_svg_filter *f) {
  f->step.kind = CS_SVG_STEP_TILE;
  CS_TRY(take_input(f, f->node, CS_SVG_IN));
  f->step.tile = *box_of(f, f->recipe->inputs[f->step.first_input]);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- images */

/* Draws an element of the file in the same way as `use` does. */
static celspan_status draw_element(cs_svg_filter *f, const cs_svg_node *shown) {
  const cs_svg_open open = {f->owner, f->place->open};
  cs_svg_place place = {.matrix = celspan_matrix_identity(),
                        .measure = f->place->measure,
                        .style = cs_svg_style_initial(),
                        .open = &open};
  if (cs_svg_is_open(f->place->open, shown)) {
    f->reason = "of an element that it is inside of";
    return CELSPAN_OK;
  }
  if (shown->parent)
    CS_TRY(cs_svg_style_in_file(f->reading, shown->parent, &place.style));
  if (f->is_in_shares)
    place.matrix = cs_svg_box_matrix(&f->box);
  return f->reading->draw(f->reading, shown, true, &place, &f->step.object);
}

static celspan_status read_image(cs_svg_filter *f) {
  const cs_svg_node *shown = cs_svg_linked(f->reading, f->node);
  f->step.kind = CS_SVG_STEP_IMAGE;
  CS_TRY(cs_svg_filter_read_box(f));
  return shown ? draw_element(f, shown)
               : cs_svg_image_in_box(f->reading, f->node, &f->step.box, &f->step.object);
}

/* ---------------------------------------------------------------- turbulence */

static celspan_status read_turbulence(cs_svg_filter *f) {
  double octaves = cs_svg_filter_number(f->node, CS_SVG_NUM_OCTAVES, 1);
  double values[2] = {0, 0};
  f->step.kind = CS_SVG_STEP_IMAGE;
  CS_TRY(cs_svg_filter_read_box(f));
  if (cs_svg_filter_numbers(f->node, CS_SVG_BASE_FREQUENCY, values, 2) == 1)
    values[1] = values[0];
  const cs_svg_turbulence turbulence = {
      .matrix = f->recipe->matrix,
      .box = common(&f->step.box, &f->recipe->region),
      .frequency = {fmax(0, values[0]), fmax(0, values[1])},
      .octaves = cs_number_to_int32(octaves),
      .seed = cs_number_to_int32(cs_svg_filter_number(f->node, CS_SVG_SEED, 0)),
      .is_fractal = cs_svg_node_says(f->node, CS_SVG_TYPE, "fractalNoise"),
      .is_stitched = cs_svg_node_says(f->node, CS_SVG_STITCH_TILES, "stitch"),
      .is_coded = f->style.filters_codes};
  return cs_svg_turbulence_make(f->reading, f->node, &turbulence, &f->step.object);
}

/* ---------------------------------------------------------------- primitives */

cs_svg_step_reader *cs_svg_step_reader_of(cs_svg_element element) {
  static const struct {
    cs_svg_element element;
    cs_svg_step_reader *read;
  } readers[] = {{CS_SVG_ELEMENT_FE_BLEND, read_blend},
                 {CS_SVG_ELEMENT_FE_COLOR_MATRIX, read_matrix},
                 {CS_SVG_ELEMENT_FE_COMPONENT_TRANSFER, read_transfer},
                 {CS_SVG_ELEMENT_FE_COMPOSITE, read_composite},
                 {CS_SVG_ELEMENT_FE_CONVOLVE_MATRIX, read_weights},
                 {CS_SVG_ELEMENT_FE_DIFFUSE_LIGHTING, read_lighting},
                 {CS_SVG_ELEMENT_FE_DISPLACEMENT_MAP, read_displacement},
                 {CS_SVG_ELEMENT_FE_DROP_SHADOW, read_shadow},
                 {CS_SVG_ELEMENT_FE_FLOOD, read_flood},
                 {CS_SVG_ELEMENT_FE_GAUSSIAN_BLUR, read_blur},
                 {CS_SVG_ELEMENT_FE_IMAGE, read_image},
                 {CS_SVG_ELEMENT_FE_MERGE, read_merge},
                 {CS_SVG_ELEMENT_FE_MORPHOLOGY, read_morphology},
                 {CS_SVG_ELEMENT_FE_OFFSET, read_offset},
                 {CS_SVG_ELEMENT_FE_SPECULAR_LIGHTING, read_lighting},
                 {CS_SVG_ELEMENT_FE_TILE, read_tile},
                 {CS_SVG_ELEMENT_FE_TURBULENCE, read_turbulence}};
  for (size_t i = 0; i < sizeof readers / sizeof *readers; i++)
    if (readers[i].element == element)
      return readers[i].read;
  return NULL;
}
