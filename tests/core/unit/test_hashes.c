/* The two halves by which objects and cels are compared: equal content has equal hashes however it
 * was made, each field changes one half and not the other, and names and script lines change
 * neither.
 */
#include "celspan/celspan.h"

#include "tests/support/memory.h"
#include "tests/support/scene.h"

static const celspan_paint red = {{1, 0, 0}, {1, 1, 1}, 1}, blue = {{0, 0, 1}, {1, 1, 1}, 1};

typedef struct halves {
  uint64_t drawing[2], placement[2];
  bool is_known;
} halves;

static halves of_object(const celspan_object *object) {
  halves h;
  h.is_known = celspan_object_hash(object, h.drawing, h.placement);
  return h;
}

static halves of_cel(const celspan_cel *cel) {
  halves h;
  h.is_known = celspan_cel_hash(cel, h.drawing, h.placement);
  return h;
}

static bool same(const uint64_t a[2], const uint64_t b[2]) { return a[0] == b[0] && a[1] == b[1]; }

/* Both halves of both numbers differ: hashes are mixed to the end. */
static bool other(const uint64_t a[2], const uint64_t b[2]) { return a[0] != b[0] && a[1] != b[1]; }

static void check_equal(halves a, halves b) {
  CHECK(a.is_known && b.is_known);
  CHECK(same(a.drawing, b.drawing));
  CHECK(same(a.placement, b.placement));
}

static void check_redrawn(halves a, halves b) {
  CHECK(other(a.drawing, b.drawing));
  CHECK(same(a.placement, b.placement));
}

static void check_moved(halves a, halves b) {
  CHECK(same(a.drawing, b.drawing));
  CHECK(other(a.placement, b.placement));
}

static celspan_matrix moved(double x, double y) {
  celspan_matrix matrix = celspan_matrix_identity();
  matrix.m[2] = x;
  matrix.m[5] = y;
  return matrix;
}

/* Takes the new value of a call into the studio and returns it. */
#define TAKE(s, list, count, type, call)                                                           \
  type *made = NULL;                                                                               \
  studio_check(s, call);                                                                           \
  if (made)                                                                                        \
    s->list[s->count++] = made;                                                                    \
  return made

static celspan_object *renamed(studio *s, celspan_object *object, const char *name) {
  TAKE(s, objects, object_count, celspan_object,
       celspan_object_named(s->context, object, name, &made));
}

static celspan_cel *renamed_cel(studio *s, celspan_cel *cel, const char *name) {
  TAKE(s, cels, cel_count, celspan_cel, celspan_cel_named(s->context, cel, name, &made));
}

static celspan_cel *moved_cel(studio *s, celspan_cel *cel, double x) {
  celspan_matrix matrix = moved(x, 0);
  TAKE(s, cels, cel_count, celspan_cel, celspan_cel_transform(s->context, cel, &matrix, &made));
}

static celspan_object *nested(studio *s, celspan_rostrum *rostrum) {
  TAKE(s, objects, object_count, celspan_object,
       celspan_object_create_rostrum(s->context, rostrum, &made));
}

/* ---------------------------------------------------------------- objects */

static void test_equal_objects(studio *s) {
  celspan_object *one = studio_rect(s, 0, 0, 10, 20, studio_paint(s, red));
  halves h = of_object(one);
  check_equal(h, of_object(one));
  check_equal(h, of_object(studio_rect(s, 0, 0, 10, 20, studio_paint(s, red))));
  check_equal(h, of_object(studio_rect(s, -0.0, 0, 10, 20, studio_paint(s, red))));
  check_equal(h,
              of_object(studio_transform(s, studio_transform(s, one, moved(5, 3)), moved(-5, -3))));
  check_equal(of_object(studio_fade(s, studio_fade(s, one, 0.5), 0.5)),
              of_object(studio_fade(s, one, 0.25)));
  celspan_object *two = studio_circle(s, 1, 2, 3, NULL);
  celspan_object *const list[] = {one, two, one};
  celspan_object *pair = studio_pair(s, CELSPAN_OPERATOR_UNION, one, two), *extended = NULL;
  studio_check(s, celspan_object_extend_boolean(s->context, pair, &one, 1, &extended));
  check_equal(of_object(studio_boolean(s, CELSPAN_OPERATOR_UNION, list, 3)), of_object(extended));
  celspan_object_unref(extended);
}

static void test_names_and_lines(studio *s) {
  celspan_context_set_origin(s->context, "a.lua", 3);
  celspan_object *one = studio_rect(s, 0, 0, 10, 20, NULL);
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, &one, 1);
  celspan_context_set_origin(s->context, "b.lua", 9);
  celspan_object *two = studio_rect(s, 0, 0, 10, 20, NULL), *hand = renamed(s, two, "hand");
  check_equal(of_object(one), of_object(two));
  check_equal(of_object(one), of_object(hand));
  check_equal(of_cel(cel), of_cel(studio_cel(s, CELSPAN_CEL_DESC, &hand, 1)));
  check_equal(of_cel(cel), of_cel(renamed_cel(s, cel, "glove")));
  celspan_context_set_origin(s->context, NULL, 0);
}

static void test_fields_of_objects(studio *s) {
  celspan_texture *paint = studio_paint(s, red);
  celspan_object *one = studio_rect(s, 0, 0, 10, 20, paint);
  halves h = of_object(one);
  check_redrawn(h, of_object(studio_rect(s, 1, 0, 10, 20, paint)));
  check_redrawn(h, of_object(studio_rect(s, 0, 1, 10, 20, paint)));
  check_redrawn(h, of_object(studio_rect(s, 0, 0, 11, 20, paint)));
  check_redrawn(h, of_object(studio_rect(s, 0, 0, 10, 21, paint)));
  check_redrawn(h, of_object(studio_rect(s, 0, 0, 10, 20, studio_paint(s, blue))));
  check_redrawn(h, of_object(studio_circle(s, 0, 0, 10, paint)));
  check_moved(h, of_object(studio_transform(s, one, moved(1, 0))));
  check_moved(h, of_object(studio_transform(s, one, moved(0, 1e-9))));
  check_moved(h, of_object(studio_fade(s, one, 0.5)));
  check_moved(of_object(studio_fade(s, one, 0.5)),
              of_object(studio_transform(s, one, moved(0.5, 0))));
}

static void test_outlines(studio *s) {
  const celspan_point star[] = {{0, 0}, {10, 8}, {0, 8}, {10, 0}, {5, 12}};
  halves h = of_object(studio_polygon(s, star, 5, CELSPAN_RULE_NONZERO, NULL));
  check_redrawn(h, of_object(studio_polygon(s, star, 5, CELSPAN_RULE_EVENODD, NULL)));
  check_redrawn(h, of_object(studio_polygon(s, star, 4, CELSPAN_RULE_NONZERO, NULL)));
  /* the same line, given as path data */
  check_equal(of_object(studio_path(s, "M0 0 L10 8 L0 8 Z", NULL)),
              of_object(studio_path(s, "M 0,0 10,8 l -10 0 z", NULL)));
}

static void test_booleans(studio *s) {
  celspan_object *a = studio_rect(s, 0, 0, 10, 20, NULL), *b = studio_circle(s, 5, 5, 5, NULL);
  halves h = of_object(studio_pair(s, CELSPAN_OPERATOR_UNION, a, b));
  check_redrawn(h, of_object(studio_pair(s, CELSPAN_OPERATOR_UNION, b, a)));
  check_redrawn(h, of_object(studio_pair(s, CELSPAN_OPERATOR_INTERSECTION, a, b)));
  check_redrawn(h, of_object(studio_pair(s, CELSPAN_OPERATOR_DIFFERENCE, a, b)));
  check_redrawn(h, of_object(studio_pair(s, CELSPAN_OPERATOR_XOR, a, b)));
  /* the place of its contents inside it changes the drawing */
  check_redrawn(
      h, of_object(studio_pair(s, CELSPAN_OPERATOR_UNION, a, studio_transform(s, b, moved(1, 0)))));
  check_redrawn(h, of_object(studio_pair(s, CELSPAN_OPERATOR_UNION, a, studio_fade(s, b, 0.5))));
  check_equal(h, of_object(studio_pair(s, CELSPAN_OPERATOR_UNION, a, renamed(s, b, "hole"))));
}

/* ---------------------------------------------------------------- cels */

static void test_fields_of_cels(studio *s) {
  celspan_object *one = studio_rect(s, 0, 0, 10, 20, NULL), *two = studio_circle(s, 1, 2, 3, NULL);
  celspan_object *const both[] = {one, two}, *const turned[] = {two, one};
  celspan_cel *plain = studio_cel(s, CELSPAN_CEL_DESC, both, 2);
  halves h = of_cel(plain);
  check_equal(h, of_cel(studio_cel(s, CELSPAN_CEL_DESC, both, 2)));
  check_redrawn(h, of_cel(studio_cel(s, CELSPAN_CEL_DESC, both, 1)));
  check_redrawn(h, of_cel(studio_cel(s, CELSPAN_CEL_DESC, turned, 2)));
  celspan_object *const shifted[] = {one, studio_transform(s, two, moved(1, 0))};
  check_redrawn(h, of_cel(studio_cel(s, CELSPAN_CEL_DESC, shifted, 2)));
  check_moved(h, of_cel(moved_cel(s, plain, 1)));
  check_equal(h, of_cel(moved_cel(s, moved_cel(s, plain, 1), -1)));
}

/* A cel with one field changed, each in turn; returns false after the last one. */
static bool change_field(celspan_cel_desc *desc, int field, celspan_texture *texture) {
  switch (field) {
  case 0:
    desc->opacity = 0.5;
    return true;
  case 1:
    desc->has_front = true;
    desc->front = (celspan_light){1, 1, 0.5f, 0};
    return true;
  case 2:
    desc->back = (celspan_light){0.5f, 0, 0, 0};
    return true;
  case 3:
    desc->back = (celspan_light){0, 0, 0, 1};
    return true;
  case 4:
    desc->has_viewport = true;
    desc->viewport = (celspan_box){0, 0, 50, 50};
    return true;
  case 5:
    desc->has_viewport = true;
    desc->viewport = (celspan_box){1, 0, 50, 50};
    return true;
  case 6:
    desc->defocus_radius = 2;
    return true;
  case 7:
    desc->defocus_radius = 3;
    return true;
  case 8:
    desc->defocus_radius = 2;
    desc->defocus_kernel = CELSPAN_DEFOCUS_DISC;
    return true;
  case 9:
    desc->front_texture.texture = texture;
    return true;
  case 10:
    desc->front_texture.texture = texture;
    desc->front_texture.gain = 2;
    return true;
  case 11:
    desc->front_texture.texture = texture;
    desc->front_texture.on = CELSPAN_LIGHT_ON_CEL;
    return true;
  case 12:
    desc->back_texture.texture = texture;
    return true;
  case 13:
    desc->back_texture.texture = texture;
    desc->back_texture.matte = 0;
    return true;
  default:
    return false;
  }
}

static void test_placement_of_cels(studio *s) {
  enum { MOST = 32 };
  celspan_object *one = studio_rect(s, 0, 0, 10, 20, NULL);
  const celspan_stop stops[] = {{0, red},
                                {1, blue}}; /* with a single colour, its place would not matter */
  celspan_texture *lamp = studio_radial(s, (celspan_point){5, 5}, 5, stops, 2);
  halves known[MOST] = {of_cel(studio_cel(s, CELSPAN_CEL_DESC, &one, 1))};
  int count = 1;
  for (int field = 0;; field++) {
    celspan_cel_desc desc = CELSPAN_CEL_DESC;
    if (!change_field(&desc, field, lamp))
      break;
    known[count] = of_cel(studio_cel(s, desc, &one, 1));
    check_equal(known[count], of_cel(studio_cel(s, desc, &one, 1)));
    for (int i = 0; i < count; i++)
      check_moved(known[i], known[count]);
    count++;
  }
  CHECK(count == 15);
}

/* ---------------------------------------------------------------- procedures and compositions */

static celspan_status no_spans(void *user, celspan_context *context, double y,
                               const celspan_scanline_row *row, celspan_scanline_output *output) {
  (void)user, (void)context, (void)y, (void)row, (void)output;
  return CELSPAN_OK;
}

static void test_procedures(studio *s) {
  const celspan_scanline_desc desc = {
      .struct_size = sizeof desc, .bounds = {0, 0, 9, 9}, .spans = no_spans};
  celspan_object *fire = studio_scanline(s, &desc), *rect = studio_rect(s, 0, 0, 9, 9, NULL);
  halves h = of_object(fire), again = of_object(studio_scanline(s, &desc));
  CHECK(!h.is_known && !again.is_known);
  CHECK(other(h.drawing, again.drawing));
  CHECK(same(h.drawing, of_object(fire).drawing));
  celspan_object *mixed = studio_pair(s, CELSPAN_OPERATOR_UNION, rect, fire);
  CHECK(!of_object(mixed).is_known);
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, &mixed, 1);
  CHECK(!of_cel(cel).is_known);
  celspan_rostrum_desc bench = CELSPAN_ROSTRUM_DESC;
  bench.has_size = true;
  bench.width = bench.height = 20;
  celspan_object *inner = nested(s, studio_rostrum(s, bench, &cel, 1));
  CHECK(!of_object(inner).is_known);
  CHECK(!of_cel(studio_cel(s, CELSPAN_CEL_DESC, &inner, 1)).is_known);
}

static void test_compositions(studio *s) {
  celspan_object *rect = studio_rect(s, 0, 0, 9, 9, NULL);
  celspan_cel *cel = studio_cel(s, CELSPAN_CEL_DESC, &rect, 1), *moving = moved_cel(s, cel, 1);
  celspan_rostrum_desc bench = CELSPAN_ROSTRUM_DESC;
  bench.has_size = true;
  bench.width = bench.height = 20;
  halves h = of_object(nested(s, studio_rostrum(s, bench, &cel, 1)));
  check_equal(h, of_object(nested(s, studio_rostrum(s, bench, &cel, 1))));
  check_redrawn(h, of_object(nested(s, studio_rostrum(s, bench, &moving, 1))));
  bench.brightness = 2;
  check_redrawn(h, of_object(nested(s, studio_rostrum(s, bench, &cel, 1))));
}

int main(void) {
  void (*const tests[])(studio *) = {
      test_equal_objects,     test_names_and_lines, test_fields_of_objects,
      test_outlines,          test_booleans,        test_fields_of_cels,
      test_placement_of_cels, test_procedures,      test_compositions,
  };
  for (size_t i = 0; i < sizeof tests / sizeof *tests; i++) {
    memory_watch watch = {0};
    studio s = {.context = memory_watch_context(&watch)};
    if (!CHECK(s.context != NULL))
      break;
    tests[i](&s);
    studio_finish(&s);
    celspan_context_destroy(s.context);
    CHECK(watch.blocks == 0 && watch.bytes == 0);
  }
  return check_done();
}
