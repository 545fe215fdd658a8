/* Layers of a painting in a frame: the pixels of the file, whatever the budget of pictures and the
 * number of workers, in a memory that does not grow with the layer; and failures with the status and
 * the sentence of the reader. */
#include <stdlib.h>
#include <unistd.h>

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

/* A Photoshop document of one raw layer, of which `missing` bytes at the end are left out. */
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

/* The frame that shows the layer, as coded pixels. */
static celspan_status shoot(celspan_context *context, celspan_surface *surface, int workers,
                            unsigned char *pixels) {
  studio s = {.context = context};
  celspan_picture_desc picture = {.surface = surface};
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
  const celspan_coding coding = {CELSPAN_DEPTH_8, CELSPAN_TRANSFER_SRGB, CELSPAN_ALPHA_STRAIGHT};
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  frame.exposures = &exposure;
  frame.exposure_count = 1;
  frame.film_width = frame.width = WIDTH;
  frame.film_height = frame.height = HEIGHT;
  frame.workers = workers;
  celspan_status status =
      celspan_frame_pixels(context, &frame, &coding, pixels, (size_t)WIDTH * 4, NULL);
  celspan_rostrum_unref(rostrum);
  celspan_cel_unref(cel);
  celspan_texture_unref(texture);
  studio_finish(&s);
  return status;
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
  celspan_painting_layer layer = {0};
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

/* The sentence says where the file ends, and the status is that of files. */
static void check_failure(const char *path) {
  celspan_context *context = NULL;
  celspan_painting *painting = NULL;
  celspan_painting_layer layer = {0};
  unsigned char *pixels = malloc((size_t)WIDTH * HEIGHT * 4);
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  CHECK(celspan_painting_read(context, path, &painting) == CELSPAN_OK);
  CHECK(celspan_painting_layer_at(painting, 0, &layer) && layer.surface);
  write_document(path, 5000);
  CHECK(shoot(context, layer.surface, 1, pixels) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(context), "changed while it was in use"));
  celspan_painting_unref(painting);
  CHECK(celspan_painting_read(context, path, &painting) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(context), " tells of "));
  celspan_context_destroy(context);
  free(pixels);
}

int main(void) {
  char path[] = "/tmp/celspan-painting-XXXXXX";
  int descriptor = mkstemp(path);
  CHECK(descriptor >= 0);
  close(descriptor);
  write_document(path, 0);
  check_frame(path, 0, 1);
  check_frame(path, 0, 4);
  check_frame(path, 1 << 20, 1);
  check_frame(path, 1 << 20, 3);
  check_failure(path);
  unlink(path);
  return check_done();
}
