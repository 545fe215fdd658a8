/* The bounding boxes of strokes, for which their outlines are made: tight if there is memory; if
 * not, an error for callers that draw by the box, and a larger box for the others.
 */
#include "model/scene/bounds.h"

#include "base/context.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"

typedef struct drawn {
  celspan_context *context;
  celspan_object *object;
  celspan_cel *cel;
} drawn;

/* A stroke whose box without its outline is too large, because miters might reach that far. */
static void make(drawn *out, memory_watch *watch) {
  const celspan_point points[] = {{10, 10}, {40, 12}, {30, 50}, {12, 33}};
  celspan_stroke_desc stroke = CELSPAN_STROKE_DESC;
  stroke.points = points;
  stroke.point_count = 4;
  stroke.degree = 3;
  stroke.width = 6;
  out->context = memory_watch_context(watch);
  CHECK(celspan_object_create_stroke(out->context, &stroke, &out->object) == CELSPAN_OK);
  celspan_cel_desc cel = CELSPAN_CEL_DESC;
  cel.objects = &out->object;
  cel.object_count = 1;
  CHECK(celspan_cel_create(out->context, &cel, &out->cel) == CELSPAN_OK);
}

static void finish(drawn *d, const memory_watch *watch) {
  celspan_cel_unref(d->cel);
  celspan_object_unref(d->object);
  celspan_context_destroy(d->context);
  CHECK(watch->blocks == 0 && watch->bytes == 0 && watch->size_errors == 0);
}

static bool is_same(celspan_box a, celspan_box b) {
  return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

static bool is_larger(celspan_box a, celspan_box b) {
  return a.x <= b.x && a.y <= b.y && a.x + a.width >= b.x + b.width &&
         a.y + a.height >= b.y + b.height && !is_same(a, b);
}

static void boxes_are_tight_or_refused(void) {
  memory_watch watch = {0};
  drawn d;
  celspan_box tight, box;
  bool is_there = false;
  make(&d, &watch);
  CHECK(cs_bounds_object(d.context, d.object, &is_there, &tight) == CELSPAN_OK && is_there);
  CHECK(celspan_object_bounds(d.object, &box) && is_same(box, tight));
  CHECK(celspan_cel_bounds(d.cel, &box) && is_same(box, tight));
  int refused = 0;
  for (size_t n = 1; n < 1000; n++) {
    watch.fail_at = watch.allocations + n;
    celspan_status status = n % 2 ? cs_bounds_object(d.context, d.object, &is_there, &box)
                                  : cs_bounds_cel(d.context, d.cel, &is_there, &box);
    CHECK(status == CELSPAN_OK ? is_there && is_same(box, tight) : status == CELSPAN_NO_MEMORY);
    if (status == CELSPAN_OK)
      break;
    refused++;
    watch.fail_at = watch.allocations + n;
    CHECK(celspan_object_bounds(d.object, &box) && is_larger(box, tight));
  }
  CHECK(refused > 2);
  watch.fail_at = 0;
  finish(&d, &watch);
}

int main(void) {
  boxes_are_tight_or_refused();
  return check_done();
}
