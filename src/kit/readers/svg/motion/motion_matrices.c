/* Lists of transforms that do not have the same functions, mixed. */
#include "readers/svg/motion/motion_values.h"

#include <math.h>
#include <string.h>

#include "inside/elementary.h"
#include "readers/svg/words/transforms.h"

#define PI 3.14159265358979323846

/* ---------------------------------------------------------------- longer lists */

/* What the number at a place of the frame is in a function that does nothing: 1 for scales and for
 * the diagonal of a matrix. */
static double neutral(const char *frame, size_t function, size_t argument) {
  if (strncmp(frame + function, "scale", 5) == 0)
    return 1;
  return strncmp(frame + function, "matrix(", 7) == 0 && (argument == 0 || argument == 3);
}

/* The list `shorter`, continued as `longer` is. */
static celspan_status continue_list(const cs_css_place *place, const cs_svg_mixed *shorter,
                                    const cs_svg_mixed *longer, cs_svg_mixed *out) {
  size_t function = strlen(shorter->frame), argument = 0, number = shorter->count;
  *out = *longer;
  out->text = NULL;
  out->numbers = cs_arena_take(place->context, place->arena, longer->count * sizeof *out->numbers);
  if (!out->numbers)
    return CELSPAN_NO_MEMORY;
  memcpy(out->numbers, longer->numbers, longer->count * sizeof *out->numbers);
  if (shorter->count > 0)
    memcpy(out->numbers, shorter->numbers, shorter->count * sizeof *out->numbers);
  for (size_t at = function; longer->frame[at] && number < longer->count; at++) {
    if (longer->frame[at] == '#')
      out->numbers[number++].value = neutral(longer->frame, function, argument++);
    if (longer->frame[at] == ')') {
      function = at + 1;
      argument = 0;
    }
  }
  return CELSPAN_OK;
}

static bool continues(const cs_svg_mixed *a, const cs_svg_mixed *b) {
  return a->frame && b->frame && a->count < b->count &&
         strncmp(a->frame, b->frame, strlen(a->frame)) == 0;
}

celspan_status cs_svg_matrices_add(const cs_css_place *place, const cs_svg_mixed *a,
                                   const cs_svg_mixed *b, cs_svg_mixed *out) {
  const char *frame = a->frame;
  bool is_bare = *frame == '#'; /* as the property scale has it */
  size_t function = 0, argument = 0, number = 0;
  CS_TRY(cs_svg_mixed_add(place, a, b, 1, out));
  for (size_t at = 0; frame[at]; at++) {
    if (frame[at] == '#')
      out->numbers[number++].value -= is_bare ? 1 : neutral(frame, function, argument++);
    if (frame[at] == ')') {
      function = at + 1;
      argument = 0;
    }
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- matrices */

/* A matrix of the plane: first the scales, then the slant, the turn and the shift. */
typedef struct parts {
  double shift[2], scale[2], slant, angle;
} parts;

static bool take_apart(const celspan_matrix *matrix, parts *out) {
  double a = matrix->m[0], c = matrix->m[1], b = matrix->m[3], d = matrix->m[4];
  double length = sqrt(a * a + b * b), determinant = a * d - b * c;
  if (length == 0 || determinant == 0)
    return false;
  *out = (parts){{matrix->m[2], matrix->m[5]},
                 {length, determinant / length},
                 (a * c + b * d) / determinant,
                 cs_elementary_atan2(b, a)};
  return true;
}

static double mix(double a, double b, double share) { return a + (b - a) * share; }

static void put_together(const parts *from, const parts *to, double share, double out[6]) {
  double turn = to->angle - from->angle; /* the short way */
  turn -= 2 * PI * floor((turn + PI) / (2 * PI));
  double sine, cosine, slant = mix(from->slant, to->slant, share);
  double x = mix(from->scale[0], to->scale[0], share), y = mix(from->scale[1], to->scale[1], share);
  cs_elementary_sincos(from->angle + turn * share, &sine, &cosine);
  out[0] = cosine * x;
  out[1] = sine * x;
  out[2] = (cosine * slant - sine) * y;
  out[3] = (sine * slant + cosine) * y;
  out[4] = mix(from->shift[0], to->shift[0], share);
  out[5] = mix(from->shift[1], to->shift[1], share);
}

/* Shares of the viewport have no size here: lists with them change in the middle. */
static bool read_parts(const cs_svg_mixed *value, parts *out) {
  const cs_svg_measure measure = {.font_size = 16, .root_font_size = 16};
  celspan_matrix matrix;
  return value->text && !strchr(value->text, '%') &&
         cs_svg_parse_transform(value->text, &measure, &matrix) && take_apart(&matrix, out);
}

celspan_status cs_svg_matrices_mix(const cs_css_place *place, const cs_svg_mixed *a,
                                   const cs_svg_mixed *b, double share, cs_svg_mixed *out) {
  static const char frame[] = "matrix(######)";
  cs_svg_mixed longer;
  parts from, to;
  double numbers[6];
  *out = share < 0.5 ? *a : *b;
  bool is_first = continues(a, b);
  if (is_first || continues(b, a)) {
    CS_TRY(continue_list(place, is_first ? a : b, is_first ? b : a, &longer));
    return cs_svg_mixed_mix(place, is_first ? &longer : a, is_first ? b : &longer, share, false,
                            out);
  }
  if (!read_parts(a, &from) || !read_parts(b, &to))
    return CELSPAN_OK;
  put_together(&from, &to, share, numbers);
  *out = (cs_svg_mixed){.text = NULL};
  CS_TRY(cs_svg_mixed_fit(place, numbers, 6, out));
  out->frame = frame;
  return CELSPAN_OK;
}
