/* Path operators in C: what a host gets, what it is refused, and memory that runs out. */
#include <math.h>
#include <string.h>

#include "celspan/operators.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"

typedef struct art {
  celspan_context *context;
  celspan_object *parts[2], *whole;
} art;

/* A rounded rectangle and a dashed line. */
static void make(art *a, memory_watch *watch) {
  static const double radii[4] = {0, 4, 8, 30}, dashes[2] = {3, 2};
  const celspan_rect_desc rect = {sizeof rect, 0, 0, 40, 20, 0, NULL};
  celspan_stroke_desc stroke = CELSPAN_STROKE_DESC;
  a->context = memory_watch_context(watch);
  CHECK(celspan_object_create_rounded(a->context, &rect, radii, &a->parts[0]) == CELSPAN_OK);
  stroke.data = "M0 0L20 0L20 30C40 60 60 20 0 50Z";
  stroke.width = 2;
  stroke.dashes = dashes;
  stroke.dash_count = 2;
  CHECK(celspan_object_create_stroke(a->context, &stroke, &a->parts[1]) == CELSPAN_OK);
  CHECK(celspan_object_create_boolean(a->context, CELSPAN_OPERATOR_UNION, a->parts, 2, &a->whole) ==
        CELSPAN_OK);
}

static void finish(art *a, const memory_watch *watch) {
  celspan_object_unref(a->whole);
  for (int i = 0; i < 2; i++)
    celspan_object_unref(a->parts[i]);
  celspan_context_destroy(a->context);
  CHECK(watch->blocks == 0 && watch->bytes == 0 && watch->size_errors == 0);
}

#define OPERATORS 8

static celspan_status operate(const art *a, int which, celspan_object **out) {
  const celspan_point centre = {10, 10};
  switch (which) {
  case 0:
    return celspan_object_trim(a->context, a->whole, 0.2, 0.9, 0.5, true, out);
  case 1:
    return celspan_object_trim(a->context, a->whole, 0.9, 0.2, 0.6, false, out);
  case 2:
    return celspan_object_round_corners(a->context, a->whole, 3, out);
  case 3:
    return celspan_object_zigzag(a->context, a->whole, 1, 2, true, out);
  case 4:
    return celspan_object_pucker(a->context, a->whole, -0.5, out);
  case 5:
    return celspan_object_offset(a->context, a->whole, 3, CELSPAN_STROKE_JOIN_MITER, 4, out);
  case 6:
    return celspan_object_offset(a->context, a->whole, -1, CELSPAN_STROKE_JOIN_ROUND, 4, out);
  default:
    return celspan_object_twist(a->context, a->whole, 1, &centre, out);
  }
}

static void a_trimmed_rectangle_ends_at_its_chord(void) {
  memory_watch watch = {0};
  art a;
  celspan_object *square, *half;
  celspan_box box;
  make(&a, &watch);
  const celspan_rect_desc rect = {sizeof rect, 0, 0, 40, 40, 0, NULL};
  CHECK(celspan_object_create_rect(a.context, &rect, &square) == CELSPAN_OK);
  CHECK(celspan_object_trim(a.context, square, 0, 0.375, 0, false, &half) == CELSPAN_OK);
  CHECK(celspan_object_bounds(half, &box));
  CHECK(box.x == 0 && box.y == 0 && box.width == 40 && fabs(box.height - 20) < 1e-9);
  celspan_object_unref(half);
  celspan_object_unref(square);
  finish(&a, &watch);
}

/* Also in a transform that is uneven. */
static void an_offset_counts_around_the_object(void) {
  memory_watch watch = {0};
  art a;
  celspan_object *placed, *grown;
  celspan_box box;
  make(&a, &watch);
  const celspan_matrix uneven = {{2, 0, 5, 0, 0.5, 7, 0, 0, 1}};
  CHECK(celspan_object_transform(a.context, a.parts[0], &uneven, &placed) == CELSPAN_OK);
  CHECK(celspan_object_offset(a.context, placed, 3, CELSPAN_STROKE_JOIN_MITER, 4, &grown) ==
        CELSPAN_OK);
  CHECK(celspan_object_bounds(grown, &box));
  CHECK(fabs(box.x - 2) < 1e-9 && fabs(box.y - 4) < 1e-9);
  CHECK(fabs(box.width - 86) < 1e-9 && fabs(box.height - 16) < 1e-9);
  celspan_object_unref(grown);
  CHECK(celspan_object_offset(a.context, placed, 0, CELSPAN_STROKE_JOIN_MITER, 4, &grown) ==
            CELSPAN_OK &&
        grown == placed);
  celspan_object_unref(grown);
  celspan_object_unref(placed);
  finish(&a, &watch);
}

static void wrong_numbers_are_refused(void) {
  memory_watch watch = {0};
  art a;
  celspan_object *made = NULL;
  make(&a, &watch);
  CHECK(celspan_object_trim(a.context, NULL, 0, 1, 0, false, &made) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_trim(a.context, a.whole, NAN, 1, 0, false, &made) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_trim(a.context, a.whole, 0, 0.5, 1e308, false, &made) ==
        CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_round_corners(a.context, a.whole, -1, &made) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_zigzag(a.context, a.whole, 1, 10001, false, &made) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_zigzag(a.context, a.whole, 1e308, 1, false, &made) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_pucker(a.context, a.whole, 1.5, &made) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_twist(a.context, a.whole, INFINITY, NULL, &made) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(a.context), "twist: the angle"));
  const celspan_stroke_join join = CELSPAN_STROKE_JOIN_ROUND;
  CHECK(celspan_object_offset(a.context, a.whole, 2e12, join, 4, &made) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_offset(a.context, a.whole, 1, join, 0.5, &made) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_offset(a.context, a.whole, 1, (celspan_stroke_join)3, 4, &made) ==
        CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_object_offset(a.context, NULL, 1, join, 4, &made) == CELSPAN_BAD_ARGUMENT);
  finish(&a, &watch);
}

static void memory_that_runs_out_is_refused(void) {
  memory_watch watch = {0};
  art a;
  make(&a, &watch);
  for (int which = 0; which < OPERATORS; which++) {
    size_t refused = 0;
    for (size_t n = 1; n < 10000; n++) {
      celspan_object *made = NULL;
      watch.fail_at = watch.allocations + n;
      celspan_status status = operate(&a, which, &made);
      celspan_object_unref(made);
      CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
      if (status == CELSPAN_OK)
        break;
      refused++;
    }
    CHECK(refused > 10);
  }
  watch.fail_at = 0;
  finish(&a, &watch);
}

int main(void) {
  a_trimmed_rectangle_ends_at_its_chord();
  an_offset_counts_around_the_object();
  wrong_numbers_are_refused();
  memory_that_runs_out_is_refused();
  return check_done();
}
