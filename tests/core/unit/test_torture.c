/* A frame while memory fails: whichever allocation fails, the status says so, nothing leaks, and
 * the same context then makes the same frame. Making a frame for the second time allocates nothing
 * more.
 */
#include "tests/support/memory.h"
#include "tests/support/random.h"
#include "tests/support/scene.h"

#define WIDTH 61
#define HEIGHT 47

static celspan_status stripes(void *user, celspan_context *context, double y,
                              const celspan_scanline_row *row, celspan_scanline_output *output) {
  celspan_paint paints[2] = {celspan_paint_rgb(1, 0, 0, 1), celspan_paint_gel(0, 1, 0.5f)};
  (void)user, (void)context, (void)row;
  for (int i = 0; i < 3; i++) {
    celspan_status status =
        celspan_scanline_emit(output, 10 * i + 0.1 * y, 10 * i + 6, paints, i == 1 ? 2 : 1);
    if (status != CELSPAN_OK)
      return status;
  }
  return CELSPAN_OK;
}

static celspan_object *random_blob(studio *s, test_random *random) {
  celspan_point points[5];
  celspan_stop stops[3] = {{0, celspan_paint_rgb(1, 0.5f, 0, 0.75f)},
                           {0.5, celspan_paint_gel(0.5f, 1, 0.5f)},
                           {1, celspan_paint_rgb(0, 0, 1, 1)}};
  for (int i = 0; i < 5; i++)
    points[i] = random_point(random, -10, WIDTH + 10, -10, HEIGHT + 10);
  celspan_texture *textures[] = {studio_paint(s, stops[0].paint),
                                 studio_radial(s, (celspan_point){30, 20}, 25, stops, 3),
                                 studio_conic(s, (celspan_point){30, 20}, 2, stops, 3)};
  celspan_texture *texture = textures[random_below(random, 3)];
  return studio_polygon(s, points, 5, CELSPAN_RULE_NONZERO, texture);
}

static celspan_texture *make_lamp(studio *s) {
  celspan_stop stops[2] = {{0, celspan_paint_rgb(1, 1, 0.5f, 1)},
                           {1, celspan_paint_rgb(0, 0, 1, 0)}};
  return studio_radial(s, (celspan_point){20, 30}, 50, stops, 2);
}

/* A cel that contains the scene as a composition of its own, under lights with a shape. radius: of
 * its defocus. */
static celspan_rostrum *nest(studio *s, celspan_cel *cel, double radius) {
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.has_size = true;
  desc.width = 50;
  desc.height = 40;
  desc.back = (celspan_light){0.5f, 0, 0, 0.5f};
  celspan_rostrum *inner = studio_rostrum(s, desc, &cel, 1);
  celspan_object *object = NULL;
  studio_check(s, celspan_object_create_rostrum(s->context, inner, &object));
  if (object)
    s->objects[s->object_count++] = object;
  celspan_cel_desc outer = CELSPAN_CEL_DESC;
  outer.defocus_radius = radius;
  outer.front_texture.texture = outer.back_texture.texture = make_lamp(s);
  outer.back_texture.on = CELSPAN_LIGHT_ON_CEL;
  celspan_cel *lit = studio_cel(s, outer, &object, 1);
  return studio_rostrum(s, CELSPAN_ROSTRUM_DESC, &lit, 1);
}

/* Twelve shapes, two of them in a faded difference, and a scan-line primitive: in a
 * composition inside another one. radius: of the defocus of both. */
static celspan_rostrum *make_scene(studio *s, double radius) {
  test_random random = {4};
  celspan_object *objects[12];
  for (int i = 0; i < 12; i++)
    objects[i] = random_blob(s, &random);
  objects[3] = studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, objects[3], random_blob(s, &random));
  celspan_scanline_desc desc = {
      .struct_size = sizeof desc, .bounds = {5, 5, 40, 30}, .spans = stripes, .any_thread = true};
  celspan_object *lines = NULL;
  studio_check(s, celspan_object_create_scanline(s->context, &desc, &lines));
  if (lines)
    s->objects[s->object_count++] = objects[7] = lines;
  celspan_cel_desc cel_desc = CELSPAN_CEL_DESC;
  cel_desc.opacity = 0.9;
  cel_desc.defocus_radius = radius;
  return nest(s, studio_cel(s, cel_desc, objects, 12), radius);
}

static celspan_frame_desc frame_of(const celspan_exposure *exposures,
                                   const celspan_antialias_mode *mode) {
  celspan_frame_desc desc = studio_frame(exposures, 2, WIDTH, HEIGHT, mode);
  desc.workers = 1;
  return desc;
}

static void check_failures_of(studio *s, memory_watch *watch, const celspan_frame_desc *desc) {
  uint64_t expected[2], digest[2];
  studio_check(s, celspan_frame_digest(s->context, desc, NULL, expected));
  size_t bytes = watch->bytes, failures = 0;
  for (celspan_status status = CELSPAN_NO_MEMORY; status != CELSPAN_OK; failures++) {
    if (!check_is_drawn((int)failures))
      continue;
    watch->fail_at = watch->allocations + failures + 1;
    status = celspan_frame_digest(s->context, desc, NULL, digest);
    watch->fail_at = 0;
    if (!CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY) ||
        !CHECK(watch->bytes == bytes))
      break;
    studio_check(s, celspan_frame_digest(s->context, desc, NULL, digest));
    CHECK(digest[0] == expected[0] && digest[1] == expected[1]);
  }
  CHECK(failures > 30);
  CHECK(watch->size_errors == 0);
}

/* Every row once, from top to bottom; returns the number of allocations. */
static size_t visit_rows(studio *s, const memory_watch *watch, celspan_rows *rows) {
  size_t before = watch->allocations;
  for (int32_t y = 0; y < HEIGHT; y++) {
    const celspan_span *spans;
    size_t count;
    studio_check(s, celspan_rows_get(rows, y, &spans, &count));
  }
  return watch->allocations - before;
}

static void check_settled(studio *s, const memory_watch *watch, const celspan_frame_desc *desc) {
  celspan_rows *rows = NULL;
  studio_check(s, celspan_rows_create(s->context, desc, &rows));
  if (!rows)
    return;
  CHECK(visit_rows(s, watch, rows) > 0);
  CHECK(visit_rows(s, watch, rows) == 0);
  celspan_rows_destroy(rows);
}

static void check_scene(studio *s, memory_watch *watch, double radius) {
  static const celspan_antialias_mode modes[] = {CELSPAN_ANTIALIAS_NONE, CELSPAN_ANTIALIAS_AREA};
  celspan_exposure exposures[2];
  exposures[0] = (celspan_exposure){make_scene(s, radius), 0.75};
  exposures[1] = (celspan_exposure){exposures[0].rostrum, 0.5};
  for (int m = 0; m < 2; m++) {
    celspan_frame_desc desc = frame_of(exposures, &modes[m]);
    check_failures_of(s, watch, &desc);
    check_settled(s, watch, &desc);
  }
}

int main(void) {
  memory_watch watch = {0};
  studio s = {.context = memory_watch_context(&watch)};
  if (!s.context)
    return 1;
  check_scene(&s, &watch, 0);
  check_scene(&s, &watch, 2);
  studio_finish(&s);
  celspan_context_destroy(s.context);
  CHECK(watch.blocks == 0 && watch.bytes == 0);
  return check_done();
}
