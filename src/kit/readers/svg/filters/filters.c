/* One file, because all primitives take the results of others by one list. */
#include "readers/svg/filters/filters.h"

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

#define REPEATS "that repeats its input too often"

/* A result with a name. */
typedef struct named_result {
  const char *name;
  size_t number; /* counted in the same way as the inputs of steps */
} named_result;

/* A filter that is being read, and the element in it that becomes the next step. */
typedef struct filter {
  cs_svg_reading *reading;
  const cs_svg_node *element; /* the element that is filtered */
  const cs_svg_place *place;  /* of that */
  const cs_svg_node *owner;   /* the filter; NULL: a function */
  celspan_box box;            /* the box of the element, in its user units */
  bool is_in_shares;          /* numbers are shares of that box */
  cs_svg_recipe *recipe;
  named_result *names;
  size_t name_count, name_capacity;
  uint32_t *uses; /* for each source, and then for each step: how often both sources are in it */
  size_t use_count, use_capacity;
  uint32_t weight; /* how often the element is in the last result; at first: in the source */
  const cs_svg_node *node;
  cs_svg_style style;
  cs_svg_step step;
  const char *reason; /* why a step cannot be made; NULL: no step has failed */
} filter;

/* ---------------------------------------------------------------- inputs */

static celspan_status add_input(filter *f, size_t number) {
  cs_svg_recipe *recipe = f->recipe;
  f->step.input_count++;
  return CS_APPEND(f->reading->context, recipe->inputs, recipe->input_count, recipe->input_capacity,
                   number);
}

/* The default input: the previous step, or the element if there is none. */
static size_t last_result(const filter *f) {
  return f->recipe->step_count > 0 ? CS_SVG_SOURCES + f->recipe->step_count - 1 : 0;
}

static bool find_result(const filter *f, const char *name, size_t *out) {
  for (size_t i = f->name_count; i-- > 0;)
    if (strcmp(f->names[i].name, name) == 0) {
      *out = f->names[i].number;
      return true;
    }
  return false;
}

/* The input that an attribute of `node` names. */
static celspan_status take_input(filter *f, const cs_svg_node *node, cs_svg_name attribute) {
  const char *text = cs_svg_node_value(node, attribute);
  size_t number = last_result(f);
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

static celspan_status take_both(filter *f) {
  CS_TRY(take_input(f, f->node, CS_SVG_IN));
  return take_input(f, f->node, CS_SVG_IN2);
}

/* ---------------------------------------------------------------- places */

/* One side of the step's box; by default the same side of the region. */
static celspan_status read_side(const filter *f, cs_svg_name name, cs_svg_axis axis,
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
static const celspan_box *box_of(const filter *f, size_t number) {
  return number < CS_SVG_SOURCES ? &f->recipe->region
                                 : &f->recipe->steps[number - CS_SVG_SOURCES].box;
}

/* The box of a step that specifies none: the box around its inputs' boxes, as in browsers. */
static celspan_box usual_box(const filter *f) {
  const cs_svg_recipe *recipe = f->recipe;
  if (f->step.input_count == 0 || f->step.kind == CS_SVG_STEP_TILE)
    return recipe->region;
  const size_t *inputs = recipe->inputs + f->step.first_input;
  celspan_box box = *box_of(f, inputs[0]);
  for (size_t i = 1; i < f->step.input_count; i++)
    box = cs_outline_box_around(box, *box_of(f, inputs[i]));
  return box;
}

/* Finds the box of the step, whose inputs are known. */
static celspan_status read_box(filter *f) {
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

/* A vector in user units, computed from the numbers of an attribute. */
static celspan_point scaled(const filter *f, double x, double y) {
  return f->is_in_shares ? (celspan_point){x * f->box.width, y * f->box.height}
                         : (celspan_point){x, y};
}

/* ---------------------------------------------------------------- steps */

static celspan_status read_offset(filter *f) {
  f->step.kind = CS_SVG_STEP_OFFSET;
  f->step.offset = scaled(f, cs_svg_filter_number(f->node, CS_SVG_DX, 0),
                          cs_svg_filter_number(f->node, CS_SVG_DY, 0));
  return take_input(f, f->node, CS_SVG_IN);
}

/* The radius of a blur is twice its deviation; a negative deviation means no blur. */
static void read_deviations(filter *f, double least) {
  double values[2] = {least, least};
  size_t count = cs_svg_filter_numbers(f->node, CS_SVG_STD_DEVIATION, values, 2);
  if (count == 0)
    values[0] = least;
  if (count < 2)
    values[1] = values[0];
  bool is_blurred = values[0] >= 0 && values[1] >= 0;
  f->step.radius = is_blurred ? scaled(f, 2 * values[0], 2 * values[1]) : (celspan_point){0, 0};
}

static celspan_status read_blur(filter *f) {
  const char *edge = cs_svg_node_value(f->node, CS_SVG_EDGE_MODE);
  f->step.kind = CS_SVG_STEP_BLUR;
  read_deviations(f, 0);
  if (edge && cs_svg_words_have("duplicate|wrap", edge)) /* drawn as `none`, as in browsers */
    CS_TRY(cs_svg_skip(f->reading, f->node, "edgeMode \"%.10s\"", cs_svg_skip_space(edge)));
  return take_input(f, f->node, CS_SVG_IN);
}

static celspan_channel channel_of(const filter *f, cs_svg_name name) {
  static const char *const words[] = {"R", "G", "B"};
  const char *word = cs_svg_node_value(f->node, name);
  for (int i = 0; word && i < 3; i++)
    if (cs_svg_is_word(word, words[i]))
      return (celspan_channel)(CELSPAN_CHANNEL_RED + i);
  return CELSPAN_CHANNEL_ALPHA;
}

static celspan_status read_displacement(filter *f) {
  const double scale = cs_svg_filter_number(f->node, CS_SVG_SCALE, 0);
  f->step.kind = CS_SVG_STEP_DISPLACE;
  f->step.channels[0] = channel_of(f, CS_SVG_X_CHANNEL_SELECTOR);
  f->step.channels[1] = channel_of(f, CS_SVG_Y_CHANNEL_SELECTOR);
  f->step.scale = scaled(f, scale, scale).x;
  return take_both(f);
}

/* The greatest and the least of the surrounding pixels are shapes if all pixels have one colour. */
static celspan_status read_morphology(filter *f) {
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

static celspan_status read_flood(filter *f) {
  f->step.kind = CS_SVG_STEP_FLOOD;
  f->step.paint = cs_svg_paint_of(f->reading, &f->style.flood_colour, 1);
  return CELSPAN_OK;
}

static celspan_status read_shadow(filter *f) {
  const double dx = cs_svg_filter_number(f->node, CS_SVG_DX, 2);
  const double dy = cs_svg_filter_number(f->node, CS_SVG_DY, 2);
  CS_TRY(read_flood(f));
  f->step.kind = CS_SVG_STEP_SHADOW;
  f->step.offset = scaled(f, dx, dy);
  read_deviations(f, 2);
  return take_input(f, f->node, CS_SVG_IN);
}

static celspan_status read_merge(filter *f) {
  f->step.kind = CS_SVG_STEP_MERGE;
  for (const cs_svg_node *child = f->node->first; child; child = child->next)
    if (child->element == CS_SVG_ELEMENT_FE_MERGE_NODE)
      CS_TRY(take_input(f, child, CS_SVG_IN));
  return CELSPAN_OK;
}

static celspan_status read_blend(filter *f) {
  const char *mode = cs_svg_node_value(f->node, CS_SVG_MODE);
  f->step.kind = CS_SVG_STEP_BLEND;
  for (int i = 0; mode && i < CELSPAN_BLEND_ADD; i++)
    if (cs_svg_is_word(mode, cs_blend_words[i]))
      f->step.blend = (celspan_blend)i;
  return take_both(f);
}

/* Subtraction is not possible, and one factor of a product must be a flood. */
static celspan_status read_sum(filter *f) {
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

static celspan_status read_composite(filter *f) {
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

static celspan_status read_matrix(filter *f) {
  CS_TRY(take_input(f, f->node, CS_SVG_IN));
  return cs_svg_colour_matrix_read(f->reading, f->node, &f->step, &f->reason);
}

static celspan_status read_transfer(filter *f) {
  CS_TRY(take_input(f, f->node, CS_SVG_IN));
  return cs_svg_transfer_read(f->reading, f->node, &f->step, &f->reason);
}

/* Reads the box before the others do, as rules need it. */
static celspan_status take_boxed(filter *f) {
  CS_TRY(take_input(f, f->node, CS_SVG_IN));
  CS_TRY(read_box(f));
  f->step.box = common(&f->step.box, &f->recipe->region);
  return CELSPAN_OK;
}

static celspan_status read_weights(filter *f) {
  CS_TRY(take_boxed(f));
  return cs_svg_weights_read(f->reading, f->node, &f->step, &f->reason);
}

static celspan_status read_lighting(filter *f) {
  const cs_svg_filter_units units = {f->is_in_shares, &f->box};
  CS_TRY(take_boxed(f));
  return cs_svg_lighting_read(f->reading, f->node, &f->style, &units, &f->step, &f->reason);
}

/* The box of the input is repeated. */
static celspan_status read_tile(filter *f) {
  f->step.kind = CS_SVG_STEP_TILE;
  CS_TRY(take_input(f, f->node, CS_SVG_IN));
  f->step.tile = *box_of(f, f->recipe->inputs[f->step.first_input]);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- images */

/* Draws an element of the file in the same way as `use` does. */
static celspan_status draw_element(filter *f, const cs_svg_node *shown) {
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

static celspan_status read_image(filter *f) {
  const cs_svg_node *shown = cs_svg_linked(f->reading, f->node);
  f->step.kind = CS_SVG_STEP_IMAGE;
  CS_TRY(read_box(f));
  return shown ? draw_element(f, shown)
               : cs_svg_image_in_box(f->reading, f->node, &f->step.box, &f->step.object);
}

/* ---------------------------------------------------------------- turbulence */

static celspan_status read_turbulence(filter *f) {
  double octaves = cs_svg_filter_number(f->node, CS_SVG_NUM_OCTAVES, 1);
  double values[2] = {0, 0};
  f->step.kind = CS_SVG_STEP_IMAGE;
  CS_TRY(read_box(f));
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

typedef celspan_status step_reader(filter *f);

/* NULL: recipes do not have this step. */
static step_reader *reader_of(cs_svg_element element) {
  static const struct {
    cs_svg_element element;
    step_reader *read;
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

/* Both sources contain the element as often as the filters before this one have put it there. */
static celspan_status start_uses(filter *f) {
  for (size_t i = 0; i < CS_SVG_SOURCES; i++)
    CS_TRY(CS_APPEND(f->reading->context, f->uses, f->use_count, f->use_capacity, f->weight));
  return CELSPAN_OK;
}

/* Counts how often the result of the step contains the sources. */
static celspan_status count_uses(filter *f) {
  uint32_t uses = 0;
  const size_t factor = f->step.kind == CS_SVG_STEP_SUM      ? 2 * CS_SVG_SUM_MOST
                        : f->step.kind == CS_SVG_STEP_SHADOW ? 2
                                                             : 1;
  for (size_t i = 0; i < f->step.input_count && uses <= CS_SVG_RECIPE_USES; i++)
    uses += (uint32_t)factor * f->uses[f->recipe->inputs[f->step.first_input + i]];
  if (uses > CS_SVG_RECIPE_USES)
    f->reason = REPEATS;
  f->weight = uses;
  return CS_APPEND(f->reading->context, f->uses, f->use_count, f->use_capacity, uses);
}

static celspan_status read_step(filter *f, step_reader *read) {
  const cs_svg_reading *reading = f->reading;
  const char *name = cs_svg_node_value(f->node, CS_SVG_RESULT);
  CS_TRY(cs_svg_style_in_file(f->reading, f->node, &f->style));
  f->step = (cs_svg_step){.opacity = 1, .first_input = f->recipe->input_count};
  if (!reading->is_coded)
    f->step.space = f->style.filters_codes ? CELSPAN_SPACE_SRGB : CELSPAN_SPACE_LINEAR;
  celspan_status status = read(f);
  if (status == CELSPAN_OK)
    status = read_box(f);
  f->step.box = common(&f->step.box, &f->recipe->region);
  if (status == CELSPAN_OK)
    status = count_uses(f);
  CS_TRY(cs_svg_recipe_append(f->reading->context, f->recipe, &f->step));
  if (status == CELSPAN_OK && name && *name)
    status = CS_APPEND(f->reading->context, f->names, f->name_count, f->name_capacity,
                       (named_result){name, last_result(f)});
  return status;
}

/* Reads steps until one of them cannot be made. */
static celspan_status read_steps(filter *f) {
  CS_TRY(start_uses(f));
  for (const cs_svg_node *node = f->owner->first; node && !f->reason; node = node->next) {
    step_reader *read = reader_of(node->element);
    f->node = node;
    if (read)
      CS_TRY(read_step(f, read));
    else if (strncmp(node->tag, "fe", 2) == 0)
      f->reason = "";
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- functions */

static celspan_status make_function(filter *f, const cs_svg_filter_call *call) {
  f->weight *= call->kind == CS_SVG_FILTER_SHADOW ? 2 : 1;
  if (f->weight > CS_SVG_RECIPE_USES)
    f->reason = REPEATS;
  return cs_svg_filter_function_make(f->reading, call, f->place, f->recipe);
}

/* ---------------------------------------------------------------- the whole */

/* Notes the step that cannot be made, at its line. */
static celspan_status note(const filter *f, const cs_svg_filter_call *call) {
  bool is_function = call->kind != CS_SVG_FILTER_REFERENCE;
  const char *name = is_function ? cs_svg_filter_name(call->kind) : f->node->tag;
  return cs_svg_skip(f->reading, is_function ? f->element : f->node, "filter of %.40s: %.40s%s%s",
                     f->element->tag, name, *f->reason ? " " : "", f->reason);
}

/* The region in user units. If it has no size, nothing is drawn, and there are no steps. */
static celspan_status make_steps(filter *f) {
  cs_svg_recipe *recipe = f->recipe;
  cs_svg_region region;
  CS_TRY(
      cs_svg_region_find(f->reading, f->owner, CS_SVG_FILTER_UNITS, f->element, f->place, &region));
  f->is_in_shares = cs_svg_node_says(f->owner, CS_SVG_PRIMITIVE_UNITS, "objectBoundingBox");
  if (!region.is_sized || (f->is_in_shares && !region.has_box))
    return CELSPAN_OK;
  const celspan_matrix user = celspan_matrix_then(region.own, recipe->back);
  recipe->region = cs_svg_box_mapped(&region.box, &user);
  f->box = region.element;
  return read_steps(f);
}

static celspan_status make_recipe(filter *f, const cs_svg_filter_call *call) {
  cs_memory *memory = f->reading->context->memory;
  cs_svg_recipe *recipe = f->recipe;
  recipe->space = f->reading->is_coded ? CELSPAN_SPACE_AROUND : f->reading->space;
  recipe->matrix = f->place->matrix;
  if (!celspan_matrix_inverse(recipe->matrix, &recipe->back) || !cs_matrix_is_sane(&recipe->back))
    return CELSPAN_OK;
  celspan_status status = f->owner ? make_steps(f) : make_function(f, call);
  if (status == CELSPAN_OK && f->reason)
    status = note(f, call);
  cs_mem_free(memory, f->names, f->name_capacity * sizeof *f->names);
  cs_mem_free(memory, f->uses, f->use_capacity * sizeof *f->uses);
  return status;
}

/* The filter that a reference means. *is_there: false: it is missing or circular, and this is
 * noted. */
static celspan_status find_owner(filter *f, cs_svg_reference reference, bool *is_there) {
  f->owner = cs_svg_referred(f->reading, reference);
  *is_there = f->owner && f->owner->element == CS_SVG_ELEMENT_FILTER;
  if (!*is_there)
    return cs_svg_skip(f->reading, f->element, "filter of %.40s", f->element->tag);
  *is_there = !cs_svg_is_open(f->place->open, f->owner);
  return *is_there ? CELSPAN_OK
                   : cs_svg_skip(f->reading, f->element, "filter that shows what it filters");
}

/* The recipe of a call. weight: how often the filtered picture contains the element; updated. *out:
 * new; NULL: it cannot be made. */
static celspan_status add_recipe(filter f, const cs_svg_filter_call *call, uint32_t *weight,
                                 cs_svg_recipe **out) {
  bool is_there = true;
  f.weight = *weight;
  if (call->kind == CS_SVG_FILTER_REFERENCE)
    CS_TRY(find_owner(&f, call->reference, &is_there));
  if (!is_there)
    return CELSPAN_OK;
  CS_TRY(cs_svg_recipe_create(f.reading->context, &f.recipe));
  celspan_status status = make_recipe(&f, call);
  *weight = f.weight;
  if (status == CELSPAN_OK && !f.reason)
    *out = f.recipe;
  else
    cs_svg_recipe_unref(f.recipe);
  return status;
}

celspan_status cs_svg_filter_make(cs_svg_reading *reading, const cs_svg_node *node,
                                  const cs_svg_place *place, cs_svg_recipe **out) {
  const filter whole = {.reading = reading, .element = node, .place = place};
  const char *text = place->style.filter;
  celspan_status status = CELSPAN_OK;
  cs_svg_filter_call call;
  cs_svg_recipe **last = out;
  uint32_t weight = 1;
  bool is_complete = true;
  *out = NULL;
  while (status == CELSPAN_OK && is_complete && cs_svg_take_filter(&text, &call)) {
    status = add_recipe(whole, &call, &weight, last);
    is_complete = *last;
    last = is_complete ? &(*last)->next : last;
  }
  if (is_complete && status == CELSPAN_OK)
    return CELSPAN_OK;
  cs_svg_recipe_unref(*out);
  *out = NULL;
  return status;
}
