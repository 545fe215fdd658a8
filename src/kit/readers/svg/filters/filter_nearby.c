#include "readers/svg/filters/filter_nearby.h"

#include <math.h>

#include "inside/elementary.h"
#include "inside/number.h"

#define DEGREES_TO_RADIANS (3.14159265358979323846 / 180)
#define EXPONENT_MOST 128

/* ---------------------------------------------------------------- feConvolveMatrix */

/* The columns and rows of the matrix. */
static bool read_order(const cs_svg_node *node, int32_t size[2]) {
  double values[2] = {3, 3};
  size_t count = cs_svg_filter_numbers(node, CS_SVG_ORDER, values, 2);
  if (count == 0 && cs_svg_node_value(node, CS_SVG_ORDER))
    return false;
  for (int axis = 0; axis < 2; axis++) {
    double value = values[count == 1 ? 0 : axis];
    if (!(value >= 1 && value <= CS_NEARBY_WEIGHTS_MOST) || value != floor(value))
      return false;
    size[axis] = (int32_t)value;
  }
  return true;
}

static bool read_target(const cs_svg_node *node, const int32_t size[2], int32_t target[2]) {
  static const cs_svg_name names[2] = {CS_SVG_TARGET_X, CS_SVG_TARGET_Y};
  for (int axis = 0; axis < 2; axis++) {
    double value = cs_svg_filter_number(node, names[axis], floor(size[axis] / 2.0));
    if (!(value >= 0 && value < size[axis]) || value != floor(value))
      return false;
    target[axis] = (int32_t)value;
  }
  return true;
}

/* The weights as they are applied: the matrix is turned by half a turn, and divided. */
static bool read_weights(const cs_svg_node *node, size_t count, double *values, float *weights) {
  double sum = 0;
  if (cs_svg_filter_numbers(node, CS_SVG_KERNEL_MATRIX, values, count) != count)
    return false;
  for (size_t i = 0; i < count; i++)
    sum += values[i];
  double divisor = cs_svg_filter_number(node, CS_SVG_DIVISOR, 0);
  divisor = divisor != 0 ? divisor : sum != 0 ? sum : 1;
  for (size_t i = 0; i < count; i++)
    weights[i] = (float)cs_number_clamp(values[count - 1 - i] / divisor, -1e6, 1e6);
  return true;
}

/* What lies beyond the edges: the pixels on them; the other side of the box, as a tile; nothing. */
static void read_edges(const cs_svg_node *node, cs_svg_step *step, cs_nearby *fields) {
  fields->continues = !cs_svg_node_says(node, CS_SVG_EDGE_MODE, "none");
  if (!cs_svg_node_says(node, CS_SVG_EDGE_MODE, "wrap"))
    return;
  fields->continues = false;
  step->tile = step->box;
}

celspan_status cs_svg_weights_read(const cs_svg_reading *reading, const cs_svg_node *node,
                                   cs_svg_step *step, const char **reason) {
  double values[CS_NEARBY_WEIGHTS_MOST];
  float weights[CS_NEARBY_WEIGHTS_MOST];
  cs_nearby fields = {.kind = CS_NEARBY_WEIGHTS, .box = step->box, .numbers = weights};
  step->kind = CS_SVG_STEP_NEARBY;
  if (!read_order(node, fields.size))
    *reason = "with such an order";
  else if (fields.size[0] * fields.size[1] > CS_NEARBY_WEIGHTS_MOST)
    *reason = "with more than 1,024 numbers";
  else if (!read_target(node, fields.size, fields.target))
    *reason = "with such a target";
  fields.count = *reason ? 0 : (size_t)(fields.size[0] * fields.size[1]);
  if (!*reason && !read_weights(node, fields.count, values, weights))
    *reason = "with such a kernelMatrix";
  if (*reason)
    return CELSPAN_OK;
  fields.bias = cs_number_clamp(cs_svg_filter_number(node, CS_SVG_BIAS, 0), -1e6, 1e6);
  fields.keeps_alpha = cs_svg_node_says(node, CS_SVG_PRESERVE_ALPHA, "true");
  read_edges(node, step, &fields);
  return cs_nearby_create(reading->context, &fields, &step->nearby);
}

/* ---------------------------------------------------------------- lights */

/* The direction to a light from its angles. */
static void read_direction(const cs_svg_node *node, double out[3]) {
  const double azimuth = fmod(cs_svg_filter_number(node, CS_SVG_AZIMUTH, 0), 360);
  const double elevation = fmod(cs_svg_filter_number(node, CS_SVG_ELEVATION, 0), 360);
  double across, along, up, flat;
  cs_elementary_sincos(DEGREES_TO_RADIANS * azimuth, &across, &along);
  cs_elementary_sincos(DEGREES_TO_RADIANS * elevation, &up, &flat);
  out[0] = along * flat;
  out[1] = across * flat;
  out[2] = up;
}

/* Three numbers as a place in user units, the height last. */
static void read_place(const cs_svg_node *node, const cs_svg_name names[3],
                       const cs_svg_filter_units *units, double out[3]) {
  const celspan_box *box = units->box;
  for (int k = 0; k < 3; k++)
    out[k] = cs_svg_filter_number(node, names[k], 0);
  if (!units->is_in_shares)
    return;
  out[0] = box->x + out[0] * box->width;
  out[1] = box->y + out[1] * box->height;
  out[2] *= cs_number_length(box->width, box->height) / sqrt(2);
}

static void read_spot(const cs_svg_node *node, const cs_svg_filter_units *units,
                      cs_nearby_light *out) {
  static const cs_svg_name names[3] = {CS_SVG_POINTS_AT_X, CS_SVG_POINTS_AT_Y, CS_SVG_POINTS_AT_Z};
  const double angle = fabs(cs_svg_filter_number(node, CS_SVG_LIMITING_CONE_ANGLE, 90));
  double sine;
  read_place(node, names, units, out->towards);
  out->focus =
      cs_number_clamp(cs_svg_filter_number(node, CS_SVG_SPECULAR_EXPONENT, 1), 1, EXPONENT_MOST);
  cs_elementary_sincos(DEGREES_TO_RADIANS * fmin(angle, 90), &sine, &out->cone);
}

/* The first light source inside an element; false: there is none. */
static bool read_source(const cs_svg_node *node, const cs_svg_filter_units *units,
                        cs_nearby_light *out) {
  static const cs_svg_name names[3] = {CS_SVG_X, CS_SVG_Y, CS_SVG_Z};
  const cs_svg_node *child = node->first;
  while (child && child->element != CS_SVG_ELEMENT_FE_DISTANT_LIGHT &&
         child->element != CS_SVG_ELEMENT_FE_POINT_LIGHT &&
         child->element != CS_SVG_ELEMENT_FE_SPOT_LIGHT)
    child = child->next;
  if (!child)
    return false;
  if (child->element == CS_SVG_ELEMENT_FE_DISTANT_LIGHT) {
    out->source = CS_NEARBY_DISTANT;
    read_direction(child, out->from);
    return true;
  }
  out->source = CS_NEARBY_POINT;
  read_place(child, names, units, out->from);
  if (child->element == CS_SVG_ELEMENT_FE_SPOT_LIGHT) {
    out->source = CS_NEARBY_SPOT;
    read_spot(child, units, out);
  }
  return true;
}

celspan_status cs_svg_lighting_read(const cs_svg_reading *reading, const cs_svg_node *node,
                                    const cs_svg_style *style, const cs_svg_filter_units *units,
                                    cs_svg_step *step, const char **reason) {
  const bool is_specular = node->element == CS_SVG_ELEMENT_FE_SPECULAR_LIGHTING;
  const cs_svg_name constant = is_specular ? CS_SVG_SPECULAR_CONSTANT : CS_SVG_DIFFUSE_CONSTANT;
  const celspan_paint colour = cs_svg_paint_of(reading, &style->light_colour, 1);
  cs_nearby fields = {.kind = CS_NEARBY_LIGHT, .box = step->box};
  cs_nearby_light *light = &fields.light;
  step->kind = CS_SVG_STEP_NEARBY;
  if (!read_source(node, units, light)) {
    *reason = "without a light source";
    return CELSPAN_OK;
  }
  light->is_specular = is_specular;
  light->height = cs_number_clamp(cs_svg_filter_number(node, CS_SVG_SURFACE_SCALE, 1), -1e6, 1e6);
  light->constant = cs_number_clamp(cs_svg_filter_number(node, constant, 1), 0, 1e6);
  light->exponent =
      cs_number_clamp(cs_svg_filter_number(node, CS_SVG_SPECULAR_EXPONENT, 1), 1, EXPONENT_MOST);
  for (int c = 0; c < 3; c++)
    light->colour[c] = colour.pigment[c];
  return cs_nearby_create(reading->context, &fields, &step->nearby);
}
