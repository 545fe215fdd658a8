/* Tapers: the width of a stroke grows with the distance from its beginning and falls with the
 * distance to its end, whatever the pieces of its line. A taper that is lost, or begins at the
 * wrong place, leaves a blunt end or a kink.
 */
#include "celspan/celspan.h"
#include "tests/support/check.h"

#define WIDTH 4.0
#define PI 3.14159265358979323846

/* A line whose points are known as a function of the distance along it. */
typedef struct line {
  const char *data;
  double length;
  celspan_point (*at)(double way, celspan_point *across); /* across: a unit vector */
} line;

static celspan_point on_straight(double way, celspan_point *across) {
  *across = (celspan_point){0, 1};
  return (celspan_point){way, 0};
}

/* Three sides of a square of 40. */
static celspan_point on_corners(double way, celspan_point *across) {
  *across = way < 40 || way > 80 ? (celspan_point){0, 1} : (celspan_point){1, 0};
  return way < 40   ? (celspan_point){way, 0}
         : way < 80 ? (celspan_point){40, way - 40}
                    : (celspan_point){120 - way, 40};
}

/* A circle of radius 40 about 0, 0. */
static celspan_point on_circle(double way, celspan_point *across) {
  *across = (celspan_point){cos(way / 40), sin(way / 40)};
  return (celspan_point){40 * across->x, 40 * across->y};
}

/* The straight line again, as one piece with a low speed at its ends. */
static const line lines[] = {
    {"M0 0H120", 120, on_straight},
    {"M0 0H10H30H31H120", 120, on_straight},
    {"M0 0C0 0 120 0 120 0", 120, on_straight},
    {"M0 0H40V40H0", 120, on_corners},
    {"M40 0A40 40 0 0 1 0 40", 20 * PI, on_circle},
    {"M40 0A40 40 0 0 1 -40 0A40 40 0 0 1 0 -40", 60 * PI, on_circle},
};

static double half_width(double way, double length, double begin, double end, bool is_round) {
  double scale = begin + end > length ? length / (begin + end) : 1, share = 1;
  if (begin > 0)
    share = fmin(share, way / (scale * begin));
  if (end > 0)
    share = fmin(share, (length - way) / (scale * end));
  return 0.5 * WIDTH * (is_round ? share * (2 - share) : share);
}

/* Slopes are so small that a disc touches the side almost exactly across from its centre. */
static void check(celspan_context *context, const line *l, double begin, double end,
                  bool is_round) {
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  celspan_object *object = NULL;
  desc.data = l->data;
  desc.width = WIDTH;
  desc.taper[0] = begin;
  desc.taper[1] = end;
  desc.profile = is_round ? CELSPAN_STROKE_PROFILE_ROUND : CELSPAN_STROKE_PROFILE_STRAIGHT;
  int wrong = 0;
  if (!CHECK(celspan_object_create_stroke(context, &desc, &object) == CELSPAN_OK))
    return;
  for (double way = 0.37; way < l->length; way += 1.3) {
    celspan_point across, at = l->at(way, &across);
    double half = half_width(way, l->length, begin, end, is_round);
    double shares[] = {-1.04, -0.96, 0.96, 1.04};
    for (int k = 0; k < 4 && (l->at != on_corners || fabs(fmod(way, 40) - 20) < 17); k++) {
      celspan_point p = {at.x + shares[k] * half * across.x, at.y + shares[k] * half * across.y};
      wrong += celspan_object_contains(object, p) != (fabs(shares[k]) < 1);
    }
  }
  if (!CHECK(wrong == 0))
    fprintf(stderr, "  %s, %s tapers of %g and %g: %d points\n", l->data,
            is_round ? "round" : "straight", begin, end, wrong);
  celspan_object_unref(object);
}

int main(void) {
  celspan_context *context;
  static const double tapers[][2] = {{50, 0}, {0, 50},  {20, 35}, {35, 20},  {30, 30},
                                     {0, 0},  {200, 0}, {0, 200}, {90, 120}, {120, 90}};
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
    for (size_t k = 0; k < sizeof tapers / sizeof *tapers; k++)
      for (int round = 0; round < 2; round++)
        check(context, &lines[i], tapers[k][0], tapers[k][1], round != 0);
  celspan_context_destroy(context);
  return check_done();
}
