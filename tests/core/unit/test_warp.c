/* Objects bent by a map of the host: what a host gets, its errors, and memory that runs out. */
#include <math.h>
#include <string.h>

#include "celspan/celspan.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"

static celspan_status sway(void *user, celspan_context *context, celspan_point from,
                           celspan_point *to) {
  (void)context;
  ++*(int *)user;
  *to = (celspan_point){from.x + from.y * from.y / 100, 2 * from.y};
  return CELSPAN_OK;
}

static celspan_status refuse(void *user, celspan_context *context, celspan_point from,
                             celspan_point *to) {
  (void)user;
  *to = from;
  return from.x > 30 ? celspan_context_fail(context, CELSPAN_CALLBACK, "no further") : CELSPAN_OK;
}

static celspan_status give_no_number(void *user, celspan_context *context, celspan_point from,
                                     celspan_point *to) {
  (void)user;
  (void)context;
  *to = (celspan_point){from.x, NAN};
  return CELSPAN_OK;
}

typedef struct art {
  celspan_context *context;
  celspan_texture *texture;
  celspan_object *parts[3], *whole;
} art;

static void make(art *a, memory_watch *watch) {
  const celspan_stop stops[] = {{0, celspan_paint_rgb(0, 0, 0, 1)},
                                {1, celspan_paint_rgb(1, 1, 1, 1)}};
  const celspan_point points[] = {{10, 10}, {40, 12}, {30, 50}};
  celspan_stroke_desc stroke = CELSPAN_STROKE_DESC;
  a->context = memory_watch_context(watch);
  CHECK(celspan_texture_create_linear(a->context, (celspan_point){0, 0}, (celspan_point){40, 0},
                                      stops, 2, &a->texture) == CELSPAN_OK);
  CHECK(celspan_object_create_rect(
            a->context,
            &(celspan_rect_desc){sizeof(celspan_rect_desc), 0, 0, 40, 20, 0, a->texture},
            &a->parts[0]) == CELSPAN_OK);
  CHECK(celspan_object_create_ellipse(
            a->context, &(celspan_ellipse_desc){sizeof(celspan_ellipse_desc), {20, 20}, 9, 5, NULL},
            &a->parts[1]) == CELSPAN_OK);
  stroke.points = points;
  stroke.point_count = 3;
  stroke.degree = 2;
  stroke.width = 4;
  CHECK(celspan_object_create_stroke(a->context, &stroke, &a->parts[2]) == CELSPAN_OK);
  CHECK(celspan_object_create_boolean(a->context, CELSPAN_OPERATOR_UNION, a->parts, 3, &a->whole) ==
        CELSPAN_OK);
}

static void finish(art *a, const memory_watch *watch) {
  celspan_object_unref(a->whole);
  for (int i = 0; i < 3; i++)
    celspan_object_unref(a->parts[i]);
  celspan_texture_unref(a->texture);
  celspan_context_destroy(a->context);
  CHECK(watch->blocks == 0 && watch->bytes == 0 && watch->size_errors == 0);
}

static void bent_objects_lie_where_the_map_says(void) {
  memory_watch watch = {0};
  art a;
  int calls = 0;
  celspan_object *bent;
  celspan_box box;
  make(&a, &watch);
  celspan_warp_desc desc = CELSPAN_WARP_DESC;
  desc.map = sway;
  desc.user = &calls;
  CHECK(celspan_object_warp(a.context, a.parts[0], &desc, &bent) == CELSPAN_OK);
  CHECK(calls > 100 && celspan_object_bounds(bent, &box));
  CHECK(box.x == 0 && box.y == 0 && fabs(box.width - 44) < 1e-6 && box.height == 40);
  celspan_object_unref(bent);
  finish(&a, &watch);
}

static void errors_of_maps_end_the_warp(void) {
  memory_watch watch = {0};
  art a;
  celspan_object *bent = NULL;
  make(&a, &watch);
  celspan_warp_desc desc = CELSPAN_WARP_DESC;
  CHECK(celspan_object_warp(a.context, a.whole, &desc, &bent) == CELSPAN_BAD_ARGUMENT);
  CHECK(strcmp(celspan_context_error(a.context), "warp: map is missing") == 0);
  desc.map = refuse;
  CHECK(celspan_object_warp(a.context, a.whole, &desc, &bent) == CELSPAN_CALLBACK);
  CHECK(strcmp(celspan_context_error(a.context), "no further") == 0);
  desc.map = give_no_number;
  CHECK(celspan_object_warp(a.context, a.whole, &desc, &bent) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(a.context), "the map must give finite numbers"));
  finish(&a, &watch);
}

static void memory_that_runs_out_is_refused(void) {
  memory_watch watch = {0};
  art a;
  int calls = 0;
  size_t refused = 0;
  make(&a, &watch);
  celspan_warp_desc desc = CELSPAN_WARP_DESC;
  desc.map = sway;
  desc.user = &calls;
  desc.pieces = 30;
  desc.within = 1e-3;
  for (size_t n = 1; n < 100000; n++) {
    celspan_object *bent = NULL;
    watch.fail_at = watch.allocations + n;
    celspan_status status = celspan_object_warp(a.context, a.whole, &desc, &bent);
    celspan_object_unref(bent);
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    if (status == CELSPAN_OK)
      break;
    refused++;
  }
  CHECK(refused > 50);
  watch.fail_at = 0;
  finish(&a, &watch);
}

int main(void) {
  bent_objects_lie_where_the_map_says();
  errors_of_maps_end_the_warp();
  memory_that_runs_out_is_refused();
  return check_done();
}
