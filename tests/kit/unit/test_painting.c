/* Layers of a painting in a frame: the pixels of the file, whatever the budget of pictures and the
 * number of workers, with memory that does not grow with the layer; and failures with the status
 * and the sentence of the reader. */
#include <stdlib.h>
#include <unistd.h>

#include "celspan/layers.h"
#include "tests/support/memory.h"
#include "tests/support/scene.h"

enum { WIDTH = 900, HEIGHT = 1300 };

static unsigned char code_of(int32_t x, int32_t y, int c) {
  return (unsigned char)(x * (c + 3) + y * (5 - c) + (x ^ y));
}

static void put(FILE *file, uint32_t number, int bytes) {
  while (bytes-- > 0)
    fputc((int)(number >> 8 * bytes & 255), file);
}

/* A Photoshop document with one raw layer, of which `missing` bytes at the end are left out. */
static void write_document(const char *path, long missing) {
  const uint32_t plane = WIDTH * HEIGHT;
  const int ids[] = {0, 1, 2};
  FILE *file = fopen(path, "wb");
  fwrite("8BPS\0\1\0\0\0\0\0\0\0\3", 1, 14, file);
  put(file, HEIGHT, 4);
  put(file, WIDTH, 4);
  put(file, 8, 2);
  put(file, 3, 2);
  put(file, 0, 4);
  put(file, 0, 4);
  uint32_t record = 18 + 3 * 6 + 16 + 12, info = 2 + record + 3 * (2 + plane);
  put(file, 4 + info + 4, 4);
  put(file, info, 4);
  put(file, 1, 2);
  put(file, 0, 4);
  put(file, 0, 4);
  put(file, HEIGHT, 4);
  put(file, WIDTH, 4);
  put(file, 3, 2);
  for (int c = 0; c < 3; c++) {
    put(file, (uint32_t)ids[c], 2);
    put(file, 2 + plane, 4);
  }
  fwrite("8BIMnorm\377\0\0\0\0\0\0\14\0\0\0\0\0\0\0\0\3ink", 1, 28, file);
  for (int c = 0; c < 3; c++) {
    put(file, 0, 2);
    for (int32_t y = 0; y < HEIGHT; y++)
      for (int32_t x = 0; x < WIDTH; x++)
        fputc(code_of(x, y, c), file);
  }
  put(file, 0, 4);
  fflush(file);
  CHECK(ftruncate(fileno(file), ftell(file) - missing) == 0);
  fclose(file);
}

/* The frame that shows the layer, as coded pixels. watch: the n-th allocation for the frame fails;
 * NULL: none. */
static celspan_status shoot_with(celspan_context *context, celspan_surface *surface, int workers,
                                 memory_watch *watch, size_t n, unsigned char *pixels) {
  studio s = {.context = context};
  celspan_picture_desc picture = {.struct_size = sizeof picture, .surface = surface};
  celspan_texture *texture = NULL;
  studio_check(&s, celspan_texture_create_picture(context, &picture, &texture));
  celspan_object *object = studio_rect(&s, 0, 0, WIDTH, HEIGHT, texture);
  celspan_cel_desc cel_desc = CELSPAN_CEL_DESC;
  cel_desc.objects = &object;
  cel_desc.object_count = 1;
  celspan_cel *cel = NULL;
  studio_check(&s, celspan_cel_create(context, &cel_desc, &cel));
  celspan_rostrum_desc rostrum_desc = CELSPAN_ROSTRUM_DESC;
  rostrum_desc.cels = &cel;
  rostrum_desc.cel_count = 1;
  celspan_rostrum *rostrum = NULL;
  studio_check(&s, celspan_rostrum_create(context, &rostrum_desc, &rostrum));
  const celspan_exposure exposure = {rostrum, 1};
  const celspan_coding coding = {.struct_size = sizeof coding,
                                 .depth = CELSPAN_DEPTH_8,
                                 .transfer = CELSPAN_TRANSFER_SRGB,
                                 .alpha = CELSPAN_ALPHA_STRAIGHT};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  frame.exposures = &exposure;
  frame.exposure_count = 1;
  frame.film_width = frame.width = WIDTH;
  frame.film_height = frame.height = HEIGHT;
  frame.workers = workers;
  if (watch)
    watch->fail_at = watch->allocations + n;
  celspan_status status =
      celspan_frame_pixels(context, &frame, &coding, pixels, (size_t)WIDTH * 4, NULL);
  celspan_rostrum_unref(rostrum);
  celspan_cel_unref(cel);
  celspan_texture_unref(texture);
  studio_finish(&s);
  return status;
}

static celspan_status shoot(celspan_context *context, celspan_surface *surface, int workers,
                            unsigned char *pixels) {
  return shoot_with(context, surface, workers, NULL, 0, pixels);
}

static bool is_file(const unsigned char *pixels) {
  size_t wrong = 0;
  for (int32_t y = 0; y < HEIGHT; y++)
    for (int32_t x = 0; x < WIDTH; x++, pixels += 4)
      for (int c = 0; c < 4; c++)
        wrong += pixels[c] != (c < 3 ? code_of(x, y, c) : 255);
  return wrong == 0;
}

static void check_frame(const char *path, size_t budget, int workers) {
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  celspan_context *context = NULL;
  celspan_painting *painting = NULL;
  celspan_painting_layer layer = CELSPAN_PAINTING_LAYER;
  size_t bytes, peak;
  uint64_t allocations;
  desc.picture_bytes = budget;
  unsigned char *pixels = malloc((size_t)WIDTH * HEIGHT * 4);
  CHECK(celspan_context_create(&desc, &context) == CELSPAN_OK);
  CHECK(celspan_painting_read(context, path, &painting) == CELSPAN_OK);
  CHECK(celspan_painting_layer_at(painting, 0, &layer) && layer.surface);
  CHECK_TEXT(layer.name, "ink");
  CHECK(shoot(context, layer.surface, workers, pixels) == CELSPAN_OK);
  CHECK(is_file(pixels));
  celspan_context_memory(context, &bytes, &peak, &allocations);
  if (budget > 0)
    CHECK(peak < 16u << 20); /* the layer's texels have 26 MB */
  celspan_painting_unref(painting);
  celspan_context_destroy(context);
  free(pixels);
}

/* The sentence says where the file ends, and the status is that of file errors. */
static void check_failure(const char *path) {
  celspan_context *context = NULL;
  celspan_painting *painting = NULL;
  celspan_painting_layer layer = CELSPAN_PAINTING_LAYER;
  unsigned char *pixels = malloc((size_t)WIDTH * HEIGHT * 4);
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  CHECK(celspan_painting_read(context, path, &painting) == CELSPAN_OK);
  CHECK(celspan_painting_layer_at(painting, 0, &layer) && layer.surface);
  write_document(path, 5000);
  CHECK(shoot(context, layer.surface, 1, pixels) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(context), "changed while it was in use"));
  celspan_painting_unref(painting);
  CHECK(celspan_painting_read(context, path, &painting) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(context), " should have "));
  celspan_context_destroy(context);
  free(pixels);
}

/* ---------------------------------------------------------------- the face */

#define VALLEY TEST_ROOT "/scripts/paintings/valley.ora"

/* Without the type module there is no XML. */
static bool has_type(celspan_context *context) {
  celspan_painting *painting = NULL;
  if (celspan_painting_read(context, VALLEY, &painting) == CELSPAN_OK) {
    celspan_painting_unref(painting);
    return true;
  }
  CHECK(strstr(celspan_context_error(context), "celspan-type.so"));
  check_skip(celspan_context_error(context));
  return false;
}

static void check_refused(celspan_context *context, const char *path, celspan_status status,
                          const char *sentence) {
  celspan_painting *painting = NULL;
  CHECK(celspan_painting_read(context, path, &painting) == status && !painting);
  CHECK(strstr(celspan_context_error(context), sentence));
}

static void check_arguments(void) {
  celspan_context *context = NULL;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  check_refused(context, NULL, CELSPAN_BAD_ARGUMENT, "painting: file must name a file");
  check_refused(context, "", CELSPAN_BAD_ARGUMENT, "painting: file must name a file");
  check_refused(context, "/nowhere/a.psd", CELSPAN_INPUT, "/nowhere/a.psd: cannot be opened");
  check_refused(context, "/tmp", CELSPAN_INPUT, "/tmp: is not a file");
  check_refused(context, "/dev/zero", CELSPAN_INPUT, "/dev/zero: is not a file");
  check_refused(context, TEST_ROOT "/meson.build", CELSPAN_INPUT, "is not a layered painting");
  celspan_painting_unref(NULL);
  celspan_context_destroy(context);
}

/* Everything that the functions return about a painting stays valid as long as it is referenced. */
static void check_facts(const char *path) {
  celspan_context *context = NULL;
  celspan_painting *painting = NULL;
  celspan_painting_layer layer = CELSPAN_PAINTING_LAYER, other = {.name = "as it was"};
  int32_t width = 0, height = 0;
  size_t place = 7;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  if (!CHECK(celspan_painting_read(context, path, &painting) == CELSPAN_OK))
    return;
  CHECK(celspan_painting_ref(painting) == painting);
  celspan_painting_unref(painting);
  celspan_painting_size(painting, &width, &height);
  CHECK(width == WIDTH && height == HEIGHT && celspan_painting_layer_count(painting) == 1);
  CHECK(celspan_painting_layer_at(painting, 0, &layer) && layer.surface && !layer.is_group);
  CHECK_TEXT(layer.blend, "normal");
  CHECK_TEXT(layer.colour, "srgb");
  CHECK(layer.parent == 1 && layer.is_visible && layer.opacity == 1);
  CHECK(layer.x == 0 && layer.y == 0 && layer.width == WIDTH && layer.height == HEIGHT);
  CHECK(!celspan_painting_layer_at(painting, 1, &other) && other.name[0] == 'a');
  CHECK(!celspan_painting_layer_at(painting, SIZE_MAX, &other));
  CHECK(!celspan_painting_layer_at(painting, 0, &other) && other.name[0] == 'a'); /* no size */
  CHECK(celspan_painting_note_count(painting) == 0);
  CHECK(!celspan_painting_note_at(painting, 0, &place) && place == 7);
  celspan_painting_unref(painting);
  celspan_context_destroy(context);
}

/* A surface that is kept shows its pixels after its painting and even its context are released. */
static void check_lifetimes(const char *path) {
  celspan_context *context = NULL, *later = NULL;
  celspan_painting *painting = NULL;
  celspan_painting_layer layer = CELSPAN_PAINTING_LAYER;
  unsigned char *pixels = malloc((size_t)WIDTH * HEIGHT * 4);
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  CHECK(celspan_painting_read(context, path, &painting) == CELSPAN_OK);
  CHECK(celspan_painting_layer_at(painting, 0, &layer));
  celspan_surface *kept = celspan_surface_ref(layer.surface);
  celspan_painting_unref(painting);
  celspan_context_destroy(context);
  CHECK(celspan_context_create(NULL, &later) == CELSPAN_OK);
  CHECK(shoot(later, kept, 2, pixels) == CELSPAN_OK && is_file(pixels));
  celspan_surface_unref(kept);
  celspan_context_destroy(later);
  free(pixels);
}

/* A header and records may declare any size within the limits, here all pixels of a painting:
 * memory is allocated only for data in the file. */
static void check_claims(const char *path) {
  memory_watch watch = {0};
  celspan_context *context = memory_watch_context(&watch);
  celspan_painting *painting = NULL;
  size_t bytes, peak;
  uint64_t allocations;
  FILE *file = fopen(path, "wb");
  const uint32_t count = 32, record = 18 + 3 * 6 + 16 + 12, data = 3 * 10;
  fwrite("8BPS\0\1\0\0\0\0\0\0\0\3\0\0\x40\0\0\0\x40\0\0\10\0\3\0\0\0\0\0\0\0\0", 1, 34, file);
  put(file, 4 + 2 + count * (record + data) + 4, 4);
  put(file, 2 + count * (record + data), 4);
  put(file, count, 2);
  for (uint32_t i = 0; i < count; i++) {
    put(file, 0, 4);
    put(file, 0, 4);
    put(file, 16384, 4);
    put(file, 16384, 4);
    put(file, 3, 2);
    for (uint32_t c = 0; c < 3; c++) {
      put(file, c, 2);
      put(file, 10, 4);
    }
    fwrite("8BIMnorm\377\0\0\0\0\0\0\14\0\0\0\0\0\0\0\0\3ink", 1, 28, file);
  }
  for (uint32_t i = 0; i < 3 * count * 10; i++)
    put(file, 0, 1);
  put(file, 0, 4);
  fclose(file);
  CHECK(celspan_painting_read(context, path, &painting) == CELSPAN_OK);
  CHECK(celspan_painting_layer_count(painting) == count);
  celspan_context_memory(context, &bytes, &peak, &allocations);
  CHECK(peak < 1u << 20);
  celspan_painting_unref(painting);
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0);
}

/* ---------------------------------------------------------------- allocations */

/* Reads the painting and shows a point of every layer. */
static celspan_status use(celspan_context *context, const char *path) {
  celspan_painting *painting = NULL;
  celspan_painting_layer layer = CELSPAN_PAINTING_LAYER;
  celspan_status status = celspan_painting_read(context, path, &painting);
  CHECK(status == CELSPAN_OK || !painting);
  for (size_t i = 0; status == CELSPAN_OK && celspan_painting_layer_at(painting, i, &layer); i++) {
    celspan_picture_desc picture = {
        .struct_size = sizeof picture, .surface = layer.surface, .colour = layer.colour};
    celspan_texture *texture = NULL;
    if (layer.surface)
      status = celspan_texture_create_picture(context, &picture, &texture);
    celspan_texture_unref(texture);
  }
  celspan_painting_unref(painting);
  return status;
}

/* Whichever allocation fails, alone or with all that follow: the status says so, nothing leaks, and
 * the context stays usable. */
static void check_allocations(const char *path, bool is_for_good) {
  bool is_done = false;
  for (size_t n = 1; n < 5000 && !is_done; n++) {
    if (!check_is_drawn((int)n))
      continue;
    memory_watch watch = {0};
    celspan_context *context = memory_watch_context(&watch);
    watch.fail_at = watch.allocations + n;
    watch.is_for_good = is_for_good;
    celspan_status status = use(context, path);
    is_done = watch.allocations < watch.fail_at;
    CHECK(status == (is_done ? CELSPAN_OK : CELSPAN_NO_MEMORY));
    watch.fail_at = 0;
    CHECK(n % 16 != 1 || use(context, path) == CELSPAN_OK);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  CHECK(is_done);
}

/* The rows of a layer, as a frame requests them. */
static void check_rows(const char *path, bool is_for_good) {
  unsigned char *pixels = malloc((size_t)WIDTH * HEIGHT * 4);
  bool is_done = false;
  int number = 0;
  for (size_t n = 1; n < 3000 && !is_done; n = n < 24 ? n + 1 : n + n / 4) {
    if (n < 24 && !check_is_drawn(number++))
      continue;
    memory_watch watch = {0};
    celspan_context *context = memory_watch_context(&watch);
    celspan_painting *painting = NULL;
    celspan_painting_layer layer = CELSPAN_PAINTING_LAYER;
    CHECK(celspan_painting_read(context, path, &painting) == CELSPAN_OK);
    CHECK(celspan_painting_layer_at(painting, 0, &layer));
    watch.is_for_good = is_for_good;
    celspan_status status = shoot_with(context, layer.surface, 1, &watch, n, pixels);
    is_done = watch.allocations < watch.fail_at;
    /* Caches that only save time may be given up instead. */
    CHECK(status == CELSPAN_OK ? is_file(pixels) : status == CELSPAN_NO_MEMORY && !is_done);
    watch.fail_at = 0;
    CHECK(shoot(context, layer.surface, 1, pixels) == CELSPAN_OK && is_file(pixels));
    celspan_painting_unref(painting);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.size_errors == 0);
  }
  CHECK(is_done);
  free(pixels);
}

static void check_archives(void) {
  celspan_context *context = NULL;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  if (has_type(context)) {
    check_allocations(VALLEY, false);
    check_allocations(VALLEY, true);
  }
  celspan_context_destroy(context);
}

/* What the sanitizer of threads has nothing to find in. */
static void check_alone(const char *path) {
  check_frame(path, 0, 1);
  check_frame(path, 0, 4);
  check_frame(path, 1 << 20, 1);
  check_arguments();
  check_facts(path);
  check_lifetimes(path);
  for (int is_for_good = 0; is_for_good < 2; is_for_good++) {
    check_allocations(path, is_for_good);
    check_rows(path, is_for_good);
  }
  check_archives();
  check_failure(path);
  check_claims(path);
}

int main(void) {
  char path[] = "/tmp/celspan-painting-XXXXXX";
  int descriptor = mkstemp(path);
  CHECK(descriptor >= 0);
  close(descriptor);
  write_document(path, 0);
  check_frame(path, 1 << 20, 3);
  if (!check_is_for_threads())
    check_alone(path);
  unlink(path);
  return check_done();
}
