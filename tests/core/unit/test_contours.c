/* Contours as numbers: paths and strokes of them are those of the same path data, and hosts may
 * draw them point by point.
 */
#include "base/context.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"

#define SET(desc, list)                                                                            \
  ((desc).contours = (list), (desc).contour_count = sizeof(list) / sizeof *(list))

static celspan_context *context;

/* A cubic and two lines, a point, and a line that is not closed, as data and as contours. */
static const char data[] = "M0 0C10 0 20 10 20 20L0 20L0 0ZM5 5ZM30 0L40 0C50 0 60 10 60 20";
static const celspan_point closed[] = {{0, 0},  {10, 0}, {20, 10}, {20, 20}, {20, 20},
                                       {0, 20}, {0, 20}, {0, 20},  {0, 0},   {0, 0}};
static const celspan_point dot[] = {{5, 5}};
static const celspan_point open[] = {{30, 0}, {30, 0},  {40, 0}, {40, 0},
                                     {50, 0}, {60, 10}, {60, 20}};
static const celspan_contour contours[] = {{closed, 10, true}, {dot, 1, true}, {open, 7, false}};

/* Whether two objects are drawn alike. They are released. */
static bool is_same(celspan_object *a, celspan_object *b) {
  uint64_t one[2], other[2], place[2];
  bool is_good = celspan_object_hash(a, one, place) && celspan_object_hash(b, other, place);
  celspan_object_unref(a);
  celspan_object_unref(b);
  return is_good && one[0] == other[0] && one[1] == other[1];
}

static celspan_object *path_of(celspan_path_desc desc) {
  celspan_object *object = NULL;
  CHECK(celspan_object_create_path(context, &desc, &object) == CELSPAN_OK);
  return object;
}

static celspan_object *stroke_of(celspan_stroke_desc desc) {
  celspan_object *object = NULL;
  CHECK(celspan_object_create_stroke(context, &desc, &object) == CELSPAN_OK);
  return object;
}

static void paths_are_those_of_data(void) {
  celspan_path_desc text = CELSPAN_PATH_DESC, numbers = CELSPAN_PATH_DESC;
  text.data = data;
  SET(numbers, contours);
  CHECK(is_same(path_of(text), path_of(numbers)));
  numbers.contour_count = 1;
  CHECK(!is_same(path_of(text), path_of(numbers)));
  text.data = "M0 0C10 0 20 10 20 20L0 20L0 0";
  CHECK(is_same(path_of(text), path_of(numbers)));
  numbers.contour_count = 0;
  text.data = "";
  CHECK(is_same(path_of(text), path_of(numbers)));
}

static void strokes_are_those_of_data(void) {
  celspan_stroke_desc text = CELSPAN_STROKE_DESC, numbers;
  text.width = 3;
  text.cap = CELSPAN_STROKE_CAP_ROUND;
  numbers = text;
  text.data = data;
  SET(numbers, contours);
  CHECK(is_same(stroke_of(text), stroke_of(numbers)));
  const celspan_contour back[] = {{open, 7, true}, {dot, 1, false}};
  SET(numbers, back);
  text.data = "M30 0L40 0C50 0 60 10 60 20L30 0Z";
  CHECK(is_same(stroke_of(text), stroke_of(numbers)));
  text.data = "M30 0L40 0C50 0 60 10 60 20L30 0";
  CHECK(!is_same(stroke_of(text), stroke_of(numbers)));
}

/* Draws the contours above. */
static void draw(celspan_contours *c) {
  celspan_contours_move_to(c, 0, 0);
  celspan_contours_cubic_to(c, 10, 0, 20, 10, 20, 20);
  celspan_contours_line_to(c, 0, 20);
  celspan_contours_line_to(c, 0, 0);
  celspan_contours_close(c);
  celspan_contours_move_to(c, 5, 5);
  celspan_contours_close(c);
  celspan_contours_close(c);
  celspan_contours_move_to(c, 30, 0);
  celspan_contours_line_to(c, 40, 0);
  celspan_contours_cubic_to(c, 50, 0, 60, 10, 60, 20);
}

static celspan_stroke_desc drawn(celspan_contours *c) {
  celspan_stroke_desc desc = CELSPAN_STROKE_DESC;
  CHECK(celspan_contours_get(c, &desc.contours, &desc.contour_count) == CELSPAN_OK);
  return desc;
}

static void they_are_drawn_point_by_point(void) {
  celspan_contours *c = NULL;
  celspan_stroke_desc text = CELSPAN_STROKE_DESC;
  CHECK(celspan_contours_create(context, &c) == CELSPAN_OK);
  CHECK(drawn(c).contour_count == 0 && drawn(c).contours != NULL);
  celspan_contours_close(c);
  draw(c);
  text.data = data;
  CHECK(is_same(stroke_of(text), stroke_of(drawn(c))));
  celspan_contours_close(c); /* what follows begins where this contour began */
  celspan_contours_line_to(c, 33, 44);
  text.data = "M0 0C10 0 20 10 20 20L0 20L0 0ZM5 5ZM30 0L40 0C50 0 60 10 60 20ZL33 44";
  CHECK(is_same(stroke_of(text), stroke_of(drawn(c))));
  celspan_contours_destroy(c);
  celspan_contours_destroy(NULL);
}

static void without_a_beginning_they_begin_at_the_first_point(void) {
  celspan_contours *line = NULL, *cubic = NULL;
  celspan_stroke_desc text = CELSPAN_STROKE_DESC;
  CHECK(celspan_contours_create(context, &line) == CELSPAN_OK);
  CHECK(celspan_contours_create(context, &cubic) == CELSPAN_OK);
  celspan_contours_line_to(line, 3, 4);
  celspan_contours_line_to(line, 5, 4);
  text.data = "M3 4L3 4L5 4";
  CHECK(is_same(stroke_of(text), stroke_of(drawn(line))));
  celspan_contours_cubic_to(cubic, 1, 2, 3, 4, 5, 6);
  text.data = "M1 2C1 2 3 4 5 6";
  CHECK(is_same(stroke_of(text), stroke_of(drawn(cubic))));
  celspan_contours_destroy(line);
  celspan_contours_destroy(cubic);
}

static void check_refused(celspan_path_desc desc, celspan_status status, const char *sentence) {
  celspan_object *out = NULL;
  CHECK(celspan_object_create_path(context, &desc, &out) == status && !out);
  CHECK_TEXT(celspan_context_error(context), sentence);
}

static void mistakes_are_named(void) {
  celspan_path_desc desc = CELSPAN_PATH_DESC;
  celspan_point points[] = {{0, 0}, {1, 1}, {NAN, 2}, {3, 3}};
  celspan_contour list[] = {{dot, 1, false}, {points, 4, true}};
  check_refused(desc, CELSPAN_BAD_ARGUMENT, "path: one of d and contours must be given");
  SET(desc, list);
  check_refused(desc, CELSPAN_BAD_ARGUMENT,
                "path: contours[2][5] must be a finite number, got nan");
  points[2].x = 2;
  points[3].y = -2e12;
  check_refused(desc, CELSPAN_BAD_ARGUMENT,
                "path: contours[2][8] is -2e12; it must be between -1e12 and 1e12");
  list[0].point_count = 3;
  check_refused(
      desc, CELSPAN_BAD_ARGUMENT,
      "path: contours[1] has 6 numbers; it must have 2, and 6 more for each piece, at most "
      "20000000 in all");
  list[0].point_count = 10000003;
  check_refused(
      desc, CELSPAN_LIMIT,
      "path: contours[1] has 20000006 numbers; it must have 2, and 6 more for each piece, "
      "at most 20000000 in all");
  list[0].points = NULL;
  check_refused(
      desc, CELSPAN_BAD_ARGUMENT,
      "path: contours[1] has 0 numbers; it must have 2, and 6 more for each piece, at most "
      "20000000 in all");
  desc.contour_count = 10000001;
  check_refused(desc, CELSPAN_LIMIT, "path: 10000001 contours; at most 10000000 are allowed");
  desc.data = data;
  check_refused(desc, CELSPAN_BAD_ARGUMENT, "path: only one of d and contours must be given");
}

/* The status of everything, where the allocation of this number fails. */
static celspan_status draw_all(celspan_context *within) {
  celspan_contours *c = NULL;
  celspan_object *object = NULL;
  CS_TRY(celspan_contours_create(within, &c));
  for (int i = 0; i < 3; i++)
    draw(c);
  celspan_path_desc desc = CELSPAN_PATH_DESC;
  celspan_status status = celspan_contours_get(c, &desc.contours, &desc.contour_count);
  if (status == CELSPAN_OK)
    status = celspan_object_create_path(within, &desc, &object);
  celspan_object_unref(object);
  celspan_contours_destroy(c);
  return status;
}

static void a_lack_of_memory_is_told(void) {
  celspan_status status = CELSPAN_NO_MEMORY;
  for (size_t n = 1; status != CELSPAN_OK && n < 100; n++) {
    memory_watch watch = {0};
    celspan_context *within = memory_watch_context(&watch);
    size_t before = watch.blocks;
    watch.fail_at = watch.allocations + n;
    status = draw_all(within);
    CHECK((status == CELSPAN_OK) == (watch.allocations < watch.fail_at));
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    CHECK(watch.blocks == before && watch.size_errors == 0);
    celspan_context_destroy(within);
  }
  CHECK(status == CELSPAN_OK);
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  paths_are_those_of_data();
  strokes_are_those_of_data();
  they_are_drawn_point_by_point();
  without_a_beginning_they_begin_at_the_first_point();
  mistakes_are_named();
  celspan_context_destroy(context);
  a_lack_of_memory_is_told();
  return check_done();
}
