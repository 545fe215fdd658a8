/* SVG path data. Source: Scalable Vector Graphics 2, chapter 9 (grammar in 9.3.9, arcs in appendix
 * B.2). Offsets in messages count bytes from 1.
 *
 *       corner                         An elliptical arc becomes conics of at most a quarter turn.
 *     o---------* begin + step         The middle point of a conic lies where the tangents at its
 *     |      .'                        ends meet; in homogeneous form it is the point at the middle
 *     |    .'                          angle with the weight cos(step / 2), so that
 *     |   /                                point = weight * centre + axes * (cos, sin)
 *     |  |
 *     *  begin  + centre
 */
#include <math.h>
#include <string.h>

#include "base/decimal.h"
#include "base/elementary.h"
#include "base/number.h"
#include "model/geometry/outline.h"

#define PI 3.14159265358979323846
#define ARGUMENTS 7

typedef struct reader {
  celspan_context *context;
  cs_outline *outline;
  cs_outline_closed *closed; /* NULL: every contour is closed */
  const char *data;
  size_t at;
  celspan_point pen, start; /* start: of the subpath */
  celspan_point control;    /* the last control point of the last command, for S and T */
  char last;                /* the last command in upper case */
  bool is_drawing;          /* the outline's contour is open */
} reader;

/* ---------------------------------------------------------------- reading */

static celspan_status expected(reader *r, size_t at, const char *what) {
  unsigned char found = (unsigned char)r->data[at];
  if (found == 0)
    return cs_fail(r->context, CELSPAN_BAD_ARGUMENT,
                   "path data ends at byte %zu where %s is expected", at + 1, what);
  if (found > ' ' && found < 127)
    return cs_fail(r->context, CELSPAN_BAD_ARGUMENT,
                   "path data has '%c' at byte %zu where %s is expected", found, at + 1, what);
  return cs_fail(r->context, CELSPAN_BAD_ARGUMENT,
                 "path data has the byte %d at byte %zu where %s is expected", found, at + 1, what);
}

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

static void skip_space(reader *r) {
  while (r->data[r->at] != 0 && strchr(" \t\n\f\r", r->data[r->at]))
    r->at++;
}

/* Space and at most one comma. */
static void skip_separator(reader *r) {
  skip_space(r);
  if (r->data[r->at] == ',') {
    r->at++;
    skip_space(r);
  }
}

static celspan_status read_number(reader *r, double *out) {
  double value;
  size_t begin = r->at;
  const char *end = cs_decimal_read(r->data + begin, &value);
  if (!end)
    return expected(r, begin, "a number");
  r->at = (size_t)(end - r->data);
  if (!cs_number_is_sane(value))
    return cs_fail(r->context, CELSPAN_BAD_ARGUMENT,
                   "path data has a number beyond 1e12 at byte %zu", begin + 1);
  *out = value;
  return CELSPAN_OK;
}

static celspan_status read_flag(reader *r, double *out) {
  char c = r->data[r->at];
  if (c != '0' && c != '1')
    return expected(r, r->at, "an arc flag, 0 or 1,");
  *out = c - '0';
  r->at++;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- drawing */

static celspan_status begin_drawing(reader *r) {
  if (r->is_drawing)
    return CELSPAN_OK;
  r->is_drawing = true;
  return r->closed ? cs_outline_begin(r->context, r->outline, cs_hpoint_of(r->start))
                   : cs_outline_move(r->context, r->outline, cs_hpoint_of(r->start));
}

/* points: the `degree` points after the pen, the last of which becomes the pen. */
static celspan_status draw(reader *r, int degree, const celspan_point *points) {
  cs_hpoint piece[3];
  for (int i = 0; i < degree; i++)
    piece[i] = cs_hpoint_of(points[i]);
  CS_TRY(begin_drawing(r));
  CS_TRY(cs_outline_piece(r->context, r->outline, degree, piece));
  r->pen = points[degree - 1];
  r->control = degree > 1 ? points[degree - 2] : r->pen;
  return CELSPAN_OK;
}

/* The last control point, mirrored at the pen; or the pen, unless the last command was one of
 * `family`. */
static celspan_point reflected(const reader *r, const char *family) {
  if (!strchr(family, r->last))
    return r->pen;
  return (celspan_point){2 * r->pen.x - r->control.x, 2 * r->pen.y - r->control.y};
}

/* An arc of an ellipse: the image of a part of the unit circle. */
typedef struct ellipse_arc {
  celspan_point centre, axis_x, axis_y; /* axes: the images of the unit vectors */
  double begin, sweep;                  /* radians */
} ellipse_arc;

/* In the space where the ellipse is the unit circle and the middle of the chord is the origin, the
 * chord goes from u to -u, and the centre c lies on the line through the origin at a right angle to
 * it, `beside` chord lengths away. Returns false if the arc is a line. */
static bool find_arc(celspan_point from, celspan_point to, const double *a, ellipse_arc *out) {
  double sine, cosine, radius_x = fabs(a[0]), radius_y = fabs(a[1]);
  cs_elementary_sincos((a[2] - 360 * floor(a[2] / 360)) * (PI / 180), &sine, &cosine);
  double half_x = 0.5 * (from.x - to.x), half_y = 0.5 * (from.y - to.y);
  celspan_point u = {(cosine * half_x + sine * half_y) / radius_x,
                     (cosine * half_y - sine * half_x) / radius_y};
  double square = u.x * u.x + u.y * u.y;
  if (!(square > 0) || square - square != 0)
    return false;
  double enlarged = fmax(1, sqrt(square)), beside = sqrt(fmax(0, 1 / square - 1));
  u = (celspan_point){u.x / enlarged, u.y / enlarged};
  bool is_large = a[3] != 0, is_positive = a[4] != 0;
  if (is_large == is_positive)
    beside = -beside;
  celspan_point c = {beside * u.y, -beside * u.x};
  celspan_point begin = {u.x - c.x, u.y - c.y}, end = {-u.x - c.x, -u.y - c.y};
  out->axis_x = (celspan_point){cosine * radius_x * enlarged, sine * radius_x * enlarged};
  out->axis_y = (celspan_point){-sine * radius_y * enlarged, cosine * radius_y * enlarged};
  out->centre = (celspan_point){0.5 * (from.x + to.x) + out->axis_x.x * c.x + out->axis_y.x * c.y,
                                0.5 * (from.y + to.y) + out->axis_x.y * c.x + out->axis_y.y * c.y};
  out->begin = cs_elementary_atan2(begin.y, begin.x);
  out->sweep =
      cs_elementary_atan2(begin.x * end.y - begin.y * end.x, begin.x * end.x + begin.y * end.y);
  if (is_positive && out->sweep < 0)
    out->sweep += 2 * PI;
  if (!is_positive && out->sweep > 0)
    out->sweep -= 2 * PI;
  return true;
}

/* weight * centre + the unit vector at an angle, in homogeneous form: the weight is w. */
static cs_hpoint on_arc(const ellipse_arc *arc, double angle, double weight) {
  double sine, cosine;
  cs_elementary_sincos(angle, &sine, &cosine);
  return (cs_hpoint){weight * arc->centre.x + cosine * arc->axis_x.x + sine * arc->axis_y.x,
                     weight * arc->centre.y + cosine * arc->axis_x.y + sine * arc->axis_y.y,
                     weight};
}

/* Notes that the next piece of a line continues the arc of the previous one. */
static celspan_status note_inner(reader *r) {
  cs_outline_closed *closed = r->closed;
  if (!closed)
    return CELSPAN_OK;
  return CS_APPEND(r->context, closed->inner, closed->inner_count, closed->inner_capacity,
                   (uint32_t)r->outline->piece_count);
}

static celspan_status draw_arc(reader *r, const double *arguments, celspan_point to) {
  ellipse_arc arc;
  if (arguments[0] == 0 || arguments[1] == 0 || !find_arc(r->pen, to, arguments, &arc))
    return draw(r, 1, &to);
  CS_TRY(begin_drawing(r));
  int count = (int)fmax(1, ceil(fabs(arc.sweep) / (PI / 2) - 1e-9));
  double step = arc.sweep / count, sine, weight;
  cs_elementary_sincos(0.5 * step, &sine, &weight);
  for (int i = 0; i < count; i++) {
    if (i > 0)
      CS_TRY(note_inner(r));
    cs_hpoint piece[2] = {on_arc(&arc, arc.begin + (i + 0.5) * step, weight),
                          i + 1 == count ? cs_hpoint_of(to)
                                         : on_arc(&arc, arc.begin + (i + 1) * step, 1)};
    CS_TRY(cs_outline_piece(r->context, r->outline, 2, piece));
  }
  r->pen = r->control = to;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- commands */

static int argument_count(char command) {
  switch (command) {
  case 'M':
  case 'L':
  case 'T':
    return 2;
  case 'H':
  case 'V':
    return 1;
  case 'C':
    return 6;
  case 'S':
  case 'Q':
    return 4;
  case 'A':
    return 7;
  default:
    return 0;
  }
}

static celspan_status read_arguments(reader *r, char command, double *arguments) {
  int count = argument_count(command);
  for (int i = 0; i < count; i++) {
    if (i > 0)
      skip_separator(r);
    CS_TRY(command == 'A' && (i == 3 || i == 4) ? read_flag(r, &arguments[i])
                                                : read_number(r, &arguments[i]));
  }
  return CELSPAN_OK;
}

/* Adds the pen to relative coordinates and makes pairs of them; the last pair will become the
 * pen. */
static int pair_up(const reader *r, char command, bool is_relative, const double *arguments,
                   celspan_point *points) {
  celspan_point base = is_relative ? r->pen : (celspan_point){0, 0};
  if (command == 'H' || command == 'V') {
    points[0] = command == 'H' ? (celspan_point){base.x + arguments[0], r->pen.y}
                               : (celspan_point){r->pen.x, base.y + arguments[0]};
    return 1;
  }
  int first = command == 'A' ? 5 : 0, count = (argument_count(command) - first) / 2;
  for (int i = 0; i < count; i++)
    points[i] =
        (celspan_point){base.x + arguments[first + 2 * i], base.y + arguments[first + 2 * i + 1]};
  return count;
}

static celspan_status move_pen(reader *r, celspan_point to) {
  r->pen = r->start = r->control = to;
  r->is_drawing = false;
  return CELSPAN_OK;
}

/* Z. For a line, notes that the contour was closed. */
static celspan_status close_subpath(reader *r) {
  cs_outline_closed *closed = r->closed;
  if (closed) {
    if (!r->is_drawing || r->pen.x != r->start.x || r->pen.y != r->start.y)
      CS_TRY(draw(r, 1, &r->start));
    CS_TRY(cs_outline_closed_add(r->context, closed, r->outline->contour_count - 1));
  }
  return move_pen(r, r->start);
}

static celspan_status execute(reader *r, char command, const double *arguments,
                              const celspan_point *points) {
  switch (command) {
  case 'M':
    return move_pen(r, points[0]);
  case 'C':
    return draw(r, 3, points);
  case 'S':
    return draw(r, 3, (celspan_point[3]){reflected(r, "CS"), points[0], points[1]});
  case 'Q':
    return draw(r, 2, points);
  case 'T':
    return draw(r, 2, (celspan_point[2]){reflected(r, "QT"), points[0]});
  case 'A':
    return draw_arc(r, arguments, points[0]);
  case 'Z':
    return close_subpath(r);
  default:
    return draw(r, 1, points);
  }
}

/* One set of arguments of a command. */
static celspan_status read_set(reader *r, char command, bool is_relative) {
  double arguments[ARGUMENTS];
  celspan_point points[3];
  size_t begin = r->at;
  CS_TRY(read_arguments(r, command, arguments));
  int count = pair_up(r, command, is_relative, arguments, points);
  for (int i = 0; i < count; i++)
    if (!cs_number_is_sane(points[i].x) || !cs_number_is_sane(points[i].y))
      return cs_fail(r->context, CELSPAN_BAD_ARGUMENT,
                     "path data goes beyond 1e12 with the numbers at byte %zu", begin + 1);
  CS_TRY(execute(r, command, arguments, points));
  r->last = command;
  return CELSPAN_OK;
}

/* Whether another set of arguments follows; if so, the separator before it is skipped. A comma at
 * the end counts as a following set, so that the mistake is found when the set is read. */
static bool is_repeated(reader *r) {
  skip_space(r);
  size_t before = r->at;
  skip_separator(r);
  char c = r->data[r->at];
  return is_digit(c) || (c != 0 && strchr("+-.", c)) || r->at > before;
}

static celspan_status read_command(reader *r) {
  char letter = r->data[r->at];
  bool is_relative = letter >= 'a';
  char command = is_relative ? (char)(letter - 'a' + 'A') : letter;
  if (!strchr("MLHVCSQTAZ", command))
    return expected(r, r->at, "one of the commands MLHVCSQTAZ");
  if (r->last == 0 && command != 'M')
    return expected(r, r->at, "M, which every path begins with,");
  r->at++;
  skip_space(r);
  CS_TRY(read_set(r, command, is_relative));
  if (command == 'M')
    command = 'L';
  while (command != 'Z' && is_repeated(r))
    CS_TRY(read_set(r, command, is_relative));
  skip_space(r);
  return CELSPAN_OK;
}

static celspan_status read_all(reader *r) {
  skip_space(r);
  while (r->data[r->at] != 0)
    CS_TRY(read_command(r));
  return CELSPAN_OK;
}

celspan_status cs_outline_path(celspan_context *context, cs_outline *outline, const char *data) {
  reader r = {.context = context, .outline = outline, .data = data};
  CS_TRY(read_all(&r));
  return cs_outline_close(context, outline);
}

celspan_status cs_outline_path_open(celspan_context *context, cs_outline *outline,
                                    cs_outline_closed *closed, const char *data) {
  reader r = {.context = context, .outline = outline, .closed = closed, .data = data};
  return read_all(&r);
}

celspan_status cs_outline_closed_add(celspan_context *context, cs_outline_closed *closed,
                                     size_t contour) {
  return CS_APPEND(context, closed->contours, closed->count, closed->capacity, (uint32_t)contour);
}

void cs_outline_closed_finish(cs_outline_closed *closed, cs_memory *memory) {
  cs_mem_free(memory, closed->inner, closed->inner_capacity * sizeof *closed->inner);
  cs_mem_free(memory, closed->contours, closed->capacity * sizeof *closed->contours);
}
