#include "readers/svg/words/transforms.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "inside/geometry.h"
#include "inside/number.h"

#define PI 3.14159265358979323846
#define ARGUMENTS 16

/* One argument: a number, an angle in degrees, or a length. The index of a length decides along
 * which axis it is. */
typedef struct argument {
  double value;
  bool is_percent; /* the value is a share */
} argument;

/* A call of a function, and the sizes to which its lengths refer. */
typedef struct call {
  const cs_svg_measure *measure;
  argument items[ARGUMENTS];
  int count;
} call;

bool cs_svg_take_angle(const char **text, double *degrees) {
  static const struct {
    const char *word;
    double degrees;
  } units[] = {{"deg", 1}, {"grad", 0.9}, {"rad", 180 / PI}, {"turn", 360}};
  const char *at = *text;
  if (!cs_svg_take_number(&at, degrees))
    return false;
  for (size_t i = 0; i < sizeof units / sizeof *units; i++)
    if (cs_svg_take_word(&at, units[i].word)) {
      *degrees *= units[i].degrees;
      break;
    }
  *text = at;
  return true;
}

/* ---------------------------------------------------------------- arguments */

static bool has_angle_unit(const char *text) {
  double value;
  return cs_svg_take_number(&text, &value) &&
         (cs_svg_take_word(&text, "deg") || cs_svg_take_word(&text, "grad") ||
          cs_svg_take_word(&text, "rad") || cs_svg_take_word(&text, "turn"));
}

static bool take_argument(const char **text, const cs_svg_measure *measure, argument *out) {
  cs_svg_length length;
  out->is_percent = false;
  if (has_angle_unit(*text))
    return cs_svg_take_angle(text, &out->value);
  if (!cs_svg_take_length(text, &length))
    return false;
  out->is_percent = length.unit == CS_SVG_UNIT_PERCENT;
  out->value =
      out->is_percent ? length.value / 100 : cs_svg_resolve(length, CS_SVG_AXIS_BOTH, measure);
  return cs_number_is_sane(out->value);
}

/* The arguments between parentheses. */
static bool take_arguments(const char **text, call *out) {
  const char *at = cs_svg_skip_space(*text);
  out->count = 0;
  if (*at++ != '(')
    return false;
  for (at = cs_svg_skip_space(at); *at != ')'; at = cs_svg_skip_comma(at))
    if (out->count == ARGUMENTS || !take_argument(&at, out->measure, &out->items[out->count++]))
      return false;
  *text = at + 1;
  return true;
}

/* The argument at `index` as a distance along an axis. */
static double distance(const call *c, int index, cs_svg_axis axis) {
  double whole = axis == CS_SVG_AXIS_X ? c->measure->width : c->measure->height;
  return index >= c->count            ? 0
         : c->items[index].is_percent ? c->items[index].value * whole
                                      : c->items[index].value;
}

static double number(const call *c, int index) { return c->items[index].value; }

static double tangent(double degrees) { return fmod(degrees, 360) * (PI / 180); }

/* ---------------------------------------------------------------- functions */

typedef bool make_function(const call *c, celspan_matrix *out);

static bool make_matrix(const call *c, celspan_matrix *out) {
  *out = (celspan_matrix){{number(c, 0), number(c, 2), number(c, 4), number(c, 1), number(c, 3),
                           number(c, 5), 0, 0, 1}};
  return true;
}

/* A matrix in columns of four, which must not leave the plane. */
static bool make_matrix3d(const call *c, celspan_matrix *out) {
  static const struct {
    int index, value;
  } fixed[] = {{2, 0}, {3, 0}, {6, 0}, {7, 0}, {8, 0}, {9, 0}, {10, 1}, {11, 0}, {14, 0}, {15, 1}};
  for (size_t i = 0; i < sizeof fixed / sizeof *fixed; i++)
    if (number(c, fixed[i].index) != fixed[i].value)
      return false;
  *out = (celspan_matrix){{number(c, 0), number(c, 4), number(c, 12), number(c, 1), number(c, 5),
                           number(c, 13), 0, 0, 1}};
  return true;
}

static bool make_translate(const call *c, celspan_matrix *out) {
  *out = celspan_matrix_translation(distance(c, 0, CS_SVG_AXIS_X), distance(c, 1, CS_SVG_AXIS_Y));
  return c->count < 3 || number(c, 2) == 0;
}

static bool make_translate_y(const call *c, celspan_matrix *out) {
  *out = celspan_matrix_translation(0, distance(c, 0, CS_SVG_AXIS_Y));
  return true;
}

static bool make_scale(const call *c, celspan_matrix *out) {
  *out = celspan_matrix_scaling(number(c, 0), number(c, c->count > 1));
  return true;
}

static bool make_scale_x(const call *c, celspan_matrix *out) {
  *out = celspan_matrix_scaling(number(c, 0), 1);
  return true;
}

static bool make_scale_y(const call *c, celspan_matrix *out) {
  *out = celspan_matrix_scaling(1, number(c, 0));
  return true;
}

static bool make_rotate(const call *c, celspan_matrix *out) {
  const celspan_point centre = {c->count == 3 ? number(c, 1) : 0, c->count == 3 ? number(c, 2) : 0};
  *out = cs_matrix_turn(number(c, 0), centre);
  return c->count != 2;
}

/* A rotation about an axis: only the z axis keeps the plane. */
static bool make_rotate3d(const call *c, celspan_matrix *out) {
  double along = number(c, 2);
  *out = cs_matrix_turn(along < 0 ? -number(c, 3) : number(c, 3), (celspan_point){0, 0});
  return number(c, 3) == 0 || (number(c, 0) == 0 && number(c, 1) == 0 && along != 0);
}

static bool make_skew(const call *c, celspan_matrix *out) {
  *out = celspan_matrix_skewing(tangent(number(c, 0)), c->count > 1 ? tangent(number(c, 1)) : 0);
  return true;
}

static bool make_skew_y(const call *c, celspan_matrix *out) {
  *out = celspan_matrix_skewing(0, tangent(number(c, 0)));
  return true;
}

/* Functions that do not change the plane: a shift along z, or a rotation by 0 about x or y. */
static bool make_nothing(const call *c, celspan_matrix *out) {
  *out = celspan_matrix_identity();
  return number(c, 0) == 0;
}

static const struct function {
  const char *name;
  int least, most; /* arguments */
  make_function *make;
} functions[] = {{"matrix", 6, 6, make_matrix},        {"matrix3d", 16, 16, make_matrix3d},
                 {"rotate", 1, 3, make_rotate},        {"rotate3d", 4, 4, make_rotate3d},
                 {"rotateX", 1, 1, make_nothing},      {"rotateY", 1, 1, make_nothing},
                 {"rotateZ", 1, 1, make_rotate},       {"scale", 1, 2, make_scale},
                 {"scale3d", 3, 3, make_scale},        {"scaleX", 1, 1, make_scale_x},
                 {"scaleY", 1, 1, make_scale_y},       {"skew", 1, 2, make_skew},
                 {"skewX", 1, 1, make_skew},           {"skewY", 1, 1, make_skew_y},
                 {"translate", 1, 2, make_translate},  {"translate3d", 3, 3, make_translate},
                 {"translateX", 1, 1, make_translate}, {"translateY", 1, 1, make_translate_y},
                 {"translateZ", 1, 1, make_nothing}};

/* The function whose name and '(' are at *text; moves *text after them; NULL: none. */
static const struct function *take_function(const char **text) {
  size_t size = strcspn(*text, " \t\r\n\f(");
  for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
    if (strlen(functions[i].name) == size && strncasecmp(*text, functions[i].name, size) == 0) {
      *text += size;
      return &functions[i];
    }
  return NULL;
}

bool cs_svg_parse_transform(const char *text, const cs_svg_measure *measure, celspan_matrix *out) {
  celspan_matrix whole = celspan_matrix_identity();
  call c = {.measure = measure};
  text = cs_svg_skip_space(text);
  if (cs_svg_take_word(&text, "none"))
    text = cs_svg_skip_space(text);
  for (; *text; text = cs_svg_skip_comma(text)) {
    const struct function *found = take_function(&text);
    celspan_matrix step;
    if (!found || !take_arguments(&text, &c) || c.count < found->least || c.count > found->most ||
        !found->make(&c, &step))
      return false;
    whole = celspan_matrix_then(step, whole);
  }
  *out = whole;
  return cs_matrix_is_sane(&whole);
}

/* ---------------------------------------------------------------- properties */

/* Arguments without parentheses. */
static bool take_list(const char *text, int least, int most, call *out) {
  out->count = 0;
  for (text = cs_svg_skip_space(text); *text; text = cs_svg_skip_space(text))
    if (out->count == most || !take_argument(&text, out->measure, &out->items[out->count++]))
      return false;
  return out->count >= least;
}

static bool is_none(const char *text, celspan_matrix *out) {
  *out = celspan_matrix_identity();
  return cs_svg_is_word(text, "none");
}

bool cs_svg_parse_translate(const char *text, const cs_svg_measure *measure, celspan_matrix *out) {
  call c = {.measure = measure};
  return is_none(text, out) || (take_list(text, 1, 3, &c) && make_translate(&c, out));
}

bool cs_svg_parse_scale(const char *text, celspan_matrix *out) {
  const cs_svg_measure measure = {.width = 1, .height = 1};
  call c = {.measure = &measure};
  return is_none(text, out) || (take_list(text, 1, 3, &c) && make_scale(&c, out));
}

/* [z | 0 0 z] angle; the axis may be before or after the angle. */
bool cs_svg_parse_rotate(const char *text, celspan_matrix *out) {
  double degrees, x, y, z = 1;
  if (is_none(text, out))
    return true;
  text = cs_svg_skip_space(text);
  const char *list = text;
  if (!cs_svg_take_word(&text, "z") && cs_svg_take_number(&list, &x) && *list == ' ') {
    list = cs_svg_skip_space(list);
    bool has_y = cs_svg_take_number(&list, &y);
    list = cs_svg_skip_space(list);
    if (!has_y || !cs_svg_take_number(&list, &z) || x != 0 || y != 0 || z == 0)
      return false;
    text = list;
  }
  text = cs_svg_skip_space(text);
  if (!cs_svg_take_angle(&text, &degrees))
    return false;
  text = cs_svg_skip_space(text);
  (void)cs_svg_take_word(&text, "z");
  *out = cs_matrix_turn(z < 0 ? -degrees : degrees, (celspan_point){0, 0});
  return !*cs_svg_skip_space(text);
}
