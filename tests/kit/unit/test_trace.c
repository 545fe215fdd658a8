/* Random pictures of few colours, from noise to blocks, traced: every place inside is covered by a
 * shape; on the sides of the pixels it is the right one; any allocation may fail. CELSPAN_TRACES=n
 * tries n pictures. */
#include <stdio.h>
#include <stdlib.h>

#include "celspan/trace.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"
#include "tests/support/random.h"

enum { MOST_SIDE = 40, COLOURS = 5, POINTS = 60 };

static const unsigned char codes[3 * COLOURS] = {255, 255, 255, 20, 20, 30, 200, 60,
                                                 40,  40,  120, 70, 60, 90, 180};

/* A picture and the colours of its pixels; COLOURS: clear. */
typedef struct drawing {
  int width, height;
  unsigned char labels[MOST_SIDE * MOST_SIDE];
  unsigned char pixels[4 * MOST_SIDE * MOST_SIDE];
} drawing;

/* Independent pixels, or blocks, or diagonals, in a few of the colours. */
static void make_drawing(test_random *random, drawing *out) {
  int kind = random_below(random, 3), colours = 1 + random_below(random, COLOURS);
  int block = 1 + random_below(random, 7), clear = random_below(random, 3);
  out->width = 1 + random_below(random, MOST_SIDE);
  out->height = random_below(random, 5) == 0 ? 1 : 1 + random_below(random, MOST_SIDE);
  for (int y = 0; y < out->height; y++)
    for (int x = 0; x < out->width; x++) {
      int at = y * out->width + x;
      int label = random_below(random, colours);
      if (kind == 1 && (x % block || y % block))
        label = out->labels[(y - y % block) * out->width + x - x % block];
      else if (kind == 2)
        label = (x + (block % 2 ? y : out->height - y)) / block % colours;
      else if (clear == 0 && random_below(random, 9) == 0)
        label = COLOURS;
      out->labels[at] = (unsigned char)label;
      for (int c = 0; c < 3; c++)
        out->pixels[4 * at + c] = label == COLOURS ? 0 : codes[3 * label + c];
      out->pixels[4 * at + 3] = label == COLOURS ? 0 : 255;
    }
}

static celspan_status trace(celspan_context *context, const drawing *from, celspan_trace_desc desc,
                            celspan_trace **out) {
  celspan_surface_desc surface = CELSPAN_SURFACE_DESC;
  surface.width = from->width;
  surface.height = from->height;
  surface.pixels = from->pixels;
  celspan_picture_desc picture = CELSPAN_PICTURE_DESC;
  celspan_status status = celspan_surface_create(context, &surface, &picture.surface);
  desc.picture = &picture;
  if (status != CELSPAN_OK)
    return status;
  desc.codes = codes;
  desc.colours = COLOURS;
  status = celspan_trace_create(context, &desc, out);
  celspan_surface_unref(picture.surface);
  return status;
}

/* How many shapes contain a point, and the colour of one of them. */
static int shapes_at(const celspan_trace *traced, celspan_point point, unsigned char colour[3]) {
  celspan_trace_shape shape = CELSPAN_TRACE_SHAPE;
  int count = 0;
  for (size_t i = 0; celspan_trace_shape_at(traced, i, &shape); i++) {
    if (!celspan_object_contains(shape.object, point))
      continue;
    memcpy(colour, shape.colour, 3);
    count++;
  }
  return count;
}

static bool has_clear(const drawing *d) {
  for (int i = 0; i < d->width * d->height; i++)
    if (d->labels[i] == COLOURS)
      return true;
  return false;
}

/* If shapes follow the sides of the pixels, every pixel is in one shape, of its colour. */
static void pixels_come_back(celspan_context *context, const drawing *d) {
  celspan_trace_desc desc = CELSPAN_TRACE_DESC;
  celspan_trace *traced;
  desc.smooth = desc.speckle = 0;
  if (!CHECK(trace(context, d, desc, &traced) == CELSPAN_OK))
    return;
  for (int i = 0; i < d->width * d->height; i++) {
    unsigned char colour[3];
    celspan_point middle = {i % d->width + 0.5, (double)(i / d->width) + 0.5};
    int count = shapes_at(traced, middle, colour);
    bool is_clear = d->labels[i] == COLOURS;
    CHECK(count == !is_clear);
    CHECK(is_clear || memcmp(colour, codes + 3 * d->labels[i], 3) == 0);
  }
  celspan_trace_unref(traced);
}

/* With any curves, every place is covered. */
static void all_is_covered(celspan_context *context, test_random *random, const drawing *d) {
  celspan_trace_desc desc = CELSPAN_TRACE_DESC;
  celspan_trace *traced;
  desc.smooth = random_between(random, 0.1, 6);
  desc.speckle = random_below(random, 6);
  if (!CHECK(trace(context, d, desc, &traced) == CELSPAN_OK))
    return;
  for (int i = 0; i < POINTS && !has_clear(d); i++) {
    unsigned char colour[3];
    CHECK(shapes_at(traced, random_point(random, 0, d->width, 0, d->height), colour) > 0);
  }
  celspan_trace_unref(traced);
}

static void lines_are_sound(celspan_context *context, const drawing *d) {
  celspan_trace_desc desc = CELSPAN_TRACE_DESC;
  celspan_trace *traced;
  celspan_trace_shape shape = CELSPAN_TRACE_SHAPE;
  desc.lines = true;
  if (!CHECK(trace(context, d, desc, &traced) == CELSPAN_OK))
    return;
  for (size_t i = 0; celspan_trace_shape_at(traced, i, &shape); i++) {
    CHECK(!shape.data && shape.point_count > 0);
    for (size_t k = 0; k < shape.point_count; k++)
      CHECK(shape.widths[k] >= 0 && shape.points[k].x > -MOST_SIDE &&
            shape.points[k].x < 2 * MOST_SIDE);
  }
  celspan_trace_unref(traced);
}

/* Puts a square of a colour into a drawing. */
static void put_square(drawing *d, int x0, int y0, int side, unsigned char label) {
  for (int i = 0; i < side * side; i++) {
    int at = (y0 + i / side) * d->width + x0 + i % side;
    d->labels[at] = label;
    memcpy(d->pixels + 4 * at, codes + 3 * label, 3);
    d->pixels[4 * at + 3] = 255;
  }
}

/* A speckle that borders on other speckles alone goes with them. */
static void speckles_within_speckles_are_dropped(celspan_context *context) {
  celspan_trace_desc desc = CELSPAN_TRACE_DESC;
  drawing d = {.width = 12, .height = 12};
  celspan_trace *traced;
  celspan_trace_shape shape = CELSPAN_TRACE_SHAPE;
  put_square(&d, 0, 0, 12, 0);
  put_square(&d, 4, 4, 3, 1);
  put_square(&d, 5, 5, 1, 2);
  desc.speckle = 8;
  if (!CHECK(trace(context, &d, desc, &traced) == CELSPAN_OK))
    return;
  CHECK(celspan_trace_shape_at(traced, 0, &shape) && memcmp(shape.colour, codes, 3) == 0);
  CHECK(!celspan_trace_shape_at(traced, 0, &(celspan_trace_shape){.struct_size = 9}));
  CHECK(!celspan_trace_shape_at(traced, 1, &shape));
  celspan_trace_unref(traced);
}

/* A speckle goes to the colour that it borders on most, also where that is a line beside it. */
static void speckles_join_their_neighbours(celspan_context *context) {
  celspan_trace_desc desc = CELSPAN_TRACE_DESC;
  for (int side = 0; side < 2; side++) {
    drawing d = {.width = 20, .height = 20};
    celspan_trace *traced;
    unsigned char colour[3];
    put_square(&d, 0, 0, 20, 0);
    for (int y = 2; y < 18; y++) {
      put_square(&d, side ? 11 : 9, y, 1, 1);
      put_square(&d, 10, y, 1, y < 8 || y > 10 ? 1 : 2);
    }
    desc.speckle = 8;
    desc.smooth = 0;
    if (!CHECK(trace(context, &d, desc, &traced) == CELSPAN_OK))
      return;
    CHECK(shapes_at(traced, (celspan_point){10.5, 9.5}, colour) == 1);
    CHECK(memcmp(colour, codes + 3, 3) == 0);
    celspan_trace_unref(traced);
  }
}

static void random_pictures(celspan_context *context) {
  const char *wanted = getenv("CELSPAN_TRACES");
  int count = wanted ? atoi(wanted) : 150;
  for (int i = 0; i < count; i++) {
    test_random random = {(uint64_t)i + 1};
    drawing d;
    make_drawing(&random, &d);
    int failures = check_failures;
    pixels_come_back(context, &d);
    all_is_covered(context, &random, &d);
    lines_are_sound(context, &d);
    if (check_failures != failures)
      printf("picture %d, %d x %d\n", i, d.width, d.height);
  }
}

/* The allocation of number n fails, for every n up to the last. */
static void memory_may_fail_anywhere(bool lines) {
  memory_watch watch = {0};
  celspan_context *context = memory_watch_context(&watch);
  test_random random = {77};
  drawing d;
  celspan_trace *traced = NULL;
  celspan_trace_desc desc = CELSPAN_TRACE_DESC;
  make_drawing(&random, &d);
  desc.lines = lines;
  celspan_status status = trace(context, &d, desc, &traced); /* fills the context's caches */
  if (!CHECK(status == CELSPAN_OK))
    return;
  celspan_trace_unref(traced);
  size_t blocks = watch.blocks, fail_at = 0;
  do {
    watch.fail_at = watch.allocations + ++fail_at;
    status = trace(context, &d, desc, &traced);
    watch.fail_at = 0;
    if (status == CELSPAN_OK)
      celspan_trace_unref(traced);
    if (!CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY) ||
        !CHECK(watch.blocks <= blocks + 4))
      break;
  } while (status != CELSPAN_OK && fail_at < 100000);
  CHECK(fail_at > 20 && watch.size_errors == 0);
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0);
}

static void descriptions_are_checked(celspan_context *context) {
  celspan_trace *traced;
  test_random random = {3};
  drawing d;
  make_drawing(&random, &d);
  celspan_trace_desc desc = CELSPAN_TRACE_DESC;
  desc.smooth = 17;
  CHECK(trace(context, &d, desc, &traced) == CELSPAN_BAD_ARGUMENT);
  desc.smooth = 1;
  desc.speckle = -1;
  CHECK(trace(context, &d, desc, &traced) == CELSPAN_BAD_ARGUMENT);
  desc.speckle = 2;
  desc.struct_size--;
  CHECK(trace(context, &d, desc, &traced) == CELSPAN_BAD_ARGUMENT);
  desc.struct_size++;
  if (CHECK(trace(context, &d, desc, &traced) == CELSPAN_OK)) {
    CHECK(celspan_trace_write(context, traced, "/tmp/art.eps") == CELSPAN_BAD_ARGUMENT);
    CHECK(celspan_trace_write(context, traced, "/proc/none/art.svg") == CELSPAN_OUTPUT);
    celspan_trace_unref(celspan_trace_ref(traced));
    celspan_trace_unref(traced);
  }
}

int main(void) {
  celspan_context *context;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  random_pictures(context);
  speckles_within_speckles_are_dropped(context);
  speckles_join_their_neighbours(context);
  descriptions_are_checked(context);
  celspan_context_destroy(context);
  memory_may_fail_anywhere(false);
  memory_may_fail_anywhere(true);
  return check_done();
}
