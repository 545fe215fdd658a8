/* Smooth alpha, compared with means that are added up pixel by pixel, and in parts and under small
 * budgets. */
#include "model/pictures/smooth.h"

#include "model/pictures/surface.h"
#include "tests/support/memory.h"
#include "tests/support/picture.h"

#define WIDTH 211
#define HEIGHT 150

static celspan_context *context;

/* ---------------------------------------------------------------- a glow */

/* Alpha falls slowly from a place near the right edge; a bar is opaque, and a corner is clear. */
static int glow_at(int x, int y) {
  double distance = hypot(x - 170, y - 60);
  if (x > 20 && x < 30)
    return 255;
  return x < 15 && y > 120 ? 0 : (int)lround(fmax(0, 14 - distance / 13));
}

/* other: at one pixel alpha lies between two steps of 8 bits. */
static cs_picture *make_glow(celspan_context *own, celspan_surface_format format, bool other) {
  uint16_t *pixels = malloc(sizeof(uint16_t[4]) * WIDTH * HEIGHT);
  unsigned char *narrow = (unsigned char *)pixels;
  for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
    for (size_t c = 0; c < 4; c++) {
      int code = c < 3 ? (int)(200 - 40 * c) : glow_at((int)(i % WIDTH), (int)(i / WIDTH));
      if (format == CELSPAN_SURFACE_RGBA8)
        narrow[4 * i + c] = (unsigned char)code;
      else
        pixels[4 * i + c] =
            (uint16_t)(257 * code + (other && c == 3 && i == 60 * WIDTH + 100 ? 1 : 0));
    }
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  desc.width = WIDTH;
  desc.height = HEIGHT;
  desc.format = format;
  desc.pixels = pixels;
  celspan_surface *surface = NULL;
  cs_picture *picture = NULL;
  celspan_status status = celspan_surface_create(own, &desc, &surface);
  if (status == CELSPAN_OK)
    status = cs_picture_create(own,
                               &(celspan_picture_desc){.struct_size = sizeof(celspan_picture_desc),
                                                       .surface = surface,
                                                       .smooth = true},
                               &picture);
  CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
  celspan_surface_unref(surface);
  free(pixels);
  return picture;
}

/* The mean of the steps around a pixel, equally far to all sides, within half a step of its own. */
static double expected(int x, int y) {
  int step = glow_at(x, y), count = 0;
  int across = (int)fmin(CS_SMOOTH_RADIUS, fmin(x, WIDTH - 1 - x));
  int down = (int)fmin(CS_SMOOTH_RADIUS, fmin(y, HEIGHT - 1 - y));
  double sum = 0;
  for (int v = y - down; v <= y + down; v++)
    for (int u = x - across; u <= x + across; u++, count++)
      sum += glow_at(u, v);
  return step == 0 || step == 255 ? step : fmin(fmax(sum / count, step - 0.5), step + 0.5);
}

static void test_means(void) {
  cs_picture *glow = make_glow(context, CELSPAN_SURFACE_RGBA8, false);
  int moved = 0;
  for (int y = 0; y < HEIGHT; y += 3)
    for (int x = 0; x < WIDTH; x++) {
      float rgba[4], plain[4];
      CHECK(picture_texel(context, glow, 0, x, y, rgba) == CELSPAN_OK);
      CHECK(picture_texel(context, glow->whole, 0, x, y, plain) == CELSPAN_OK);
      double alpha = expected(x, y) / 255;
      CHECK_NEAR(rgba[3], alpha, 1e-7);
      for (int c = 0; c < 3 && plain[3] > 0; c++)
        CHECK_NEAR(rgba[c], (double)plain[c] / (double)plain[3] * alpha, 1e-7);
      moved += rgba[3] != plain[3];
    }
  CHECK(moved > 5000);
  cs_picture_unref(glow);
}

/* What is stored in more bits is not changed near the place where that can be seen. */
static void test_more_bits(void) {
  cs_picture *glow = make_glow(context, CELSPAN_SURFACE_RGBA16, true);
  for (int y = 33; y < 117; y++)
    for (int x = 50; x < 178; x++) {
      float rgba[4], plain[4];
      CHECK(picture_texel(context, glow, 0, x, y, rgba) == CELSPAN_OK);
      CHECK(picture_texel(context, glow->whole, 0, x, y, plain) == CELSPAN_OK);
      bool is_near = abs(x - 100) <= CS_SMOOTH_RADIUS && abs(y - 60) <= CS_SMOOTH_RADIUS;
      if (is_near)
        CHECK(memcmp(rgba, plain, sizeof rgba) == 0);
      else if (glow_at(x, y) > 0)
        CHECK_NEAR(rgba[3], expected(x, y) / 255, 1e-7);
    }
  cs_picture_unref(glow);
}

/* ---------------------------------------------------------------- parts, budgets, memory */

static celspan_context *small_context(memory_watch *watch) {
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = memory_watch_resize;
  desc.resize_user = watch;
  desc.picture_bytes = 1;
  celspan_context *own = NULL;
  return celspan_context_create(&desc, &own) == CELSPAN_OK ? own : NULL;
}

/* The same bits from the bottom up, with room for a few blocks alone, and in a part of it. */
static void test_same_bits(void) {
  memory_watch watch = {0};
  celspan_context *own = small_context(&watch);
  cs_picture *a = make_glow(context, CELSPAN_SURFACE_RGBA8, false);
  cs_picture *b = make_glow(own, CELSPAN_SURFACE_RGBA8, false), *part = NULL;
  const celspan_picture_desc desc = {.struct_size = sizeof desc,
                                     .surface = a->surface,
                                     .smooth = true,
                                     .has_source = true,
                                     .source = {100, 30, WIDTH - 100, HEIGHT - 30}};
  CHECK(cs_picture_create(context, &desc, &part) == CELSPAN_OK);
  for (int y = HEIGHT - 1; y >= 0; y -= 7)
    for (int x = WIDTH - 1; x >= 0; x -= 3) {
      float first[4], second[4];
      CHECK(picture_texel(context, a, 0, x, y, first) == CELSPAN_OK);
      CHECK(picture_texel(own, b, 0, x, y, second) == CELSPAN_OK);
      CHECK(memcmp(first, second, sizeof first) == 0);
      if (x < 100 || y < 30)
        continue;
      CHECK(picture_texel(context, part, 0, x - 100, y - 30, second) == CELSPAN_OK);
      CHECK(memcmp(first, second, sizeof first) == 0);
    }
  cs_picture_unref(part);
  cs_picture_unref(a);
  cs_picture_unref(b);
  celspan_context_destroy(own);
  CHECK(watch.blocks == 0 && watch.bytes == 0);
}

/* Every allocation fails once: nothing leaks. */
static void test_memory(void) {
  bool is_done = false;
  for (size_t n = 1; !is_done && n < 1000; n++) {
    memory_watch watch = {0};
    celspan_context *own = memory_watch_context(&watch);
    watch.fail_at = watch.allocations + n;
    cs_picture *glow = make_glow(own, CELSPAN_SURFACE_RGBA8, false);
    float rgba[4];
    celspan_status status = glow ? picture_texel(own, glow, 1, 40, 40, rgba) : CELSPAN_NO_MEMORY;
    CHECK(status == CELSPAN_OK || status == CELSPAN_NO_MEMORY);
    is_done = status == CELSPAN_OK;
    cs_picture_unref(glow);
    celspan_context_destroy(own);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  CHECK(is_done);
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  test_means();
  test_more_bits();
  test_same_bits();
  test_memory();
  celspan_context_destroy(context);
  return check_done();
}
