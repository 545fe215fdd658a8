/* output/sinks/tga_sink.c: a plain decoder reads the pixels that output/sinks/pixels.c makes of the
 * spans. */
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "output/sinks/pixels.h"
#include "tests/support/check.h"
#include "tests/support/span_frames.h"

typedef struct contents {
  unsigned char *bytes;
  size_t size;
} contents;

static contents read_file(const char *path) {
  contents read = {0};
  FILE *stream = fopen(path, "rb");
  if (!CHECK(stream != NULL))
    return read;
  fseek(stream, 0, SEEK_END);
  read.size = (size_t)ftell(stream);
  rewind(stream);
  read.bytes = malloc(read.size + 1);
  CHECK(fread(read.bytes, 1, read.size, stream) == read.size);
  fclose(stream);
  return read;
}

static unsigned load_16(const unsigned char *at) { return at[0] | (unsigned)at[1] << 8; }

static void to_rgba(const unsigned char *at, size_t pixel_size, unsigned char rgba[4]) {
  rgba[0] = at[2];
  rgba[1] = at[1];
  rgba[2] = at[0];
  rgba[3] = pixel_size == 4 ? at[3] : 255;
}

/* One row of packets, none of which continues into the next row; 0 if one does, or the file
 * ends. */
static size_t decode_row(const contents *file, size_t at, size_t pixel_size, int32_t width,
                         unsigned char *rgba) {
  for (int32_t x = 0; x < width;) {
    if (at + 1 + pixel_size > file->size)
      return 0;
    bool is_run = file->bytes[at] & 0x80;
    int32_t count = (file->bytes[at++] & 0x7f) + 1;
    if (x + count > width || (!is_run && at + (size_t)count * pixel_size > file->size))
      return 0;
    for (int32_t i = 0; i < count; i++, x++) {
      to_rgba(file->bytes + at, pixel_size, rgba + 4 * (size_t)x);
      at += is_run ? 0 : pixel_size;
    }
    at += is_run ? pixel_size : 0;
  }
  return at;
}

static void check_ends(const contents *file, size_t at, size_t pixel_size,
                       const celspan_coding *coding, const char *title) {
  const unsigned char *extension = file->bytes + at, *footer = extension + 495;
  if (!CHECK(at > 0 && at + 495 + 26 == file->size))
    return;
  CHECK(memcmp(footer + 8, "TRUEVISION-XFILE.", 18) == 0);
  CHECK(load_16(footer) + ((size_t)load_16(footer + 2) << 16) == at && load_16(footer + 4) == 0);
  CHECK(load_16(extension) == 495);
  CHECK_TEXT((const char *)extension + 379, title);
  CHECK_TEXT((const char *)extension + 426, "celspan");
  CHECK(extension[494] == (pixel_size == 3 ? 0 : coding->alpha == CELSPAN_ALPHA_STRAIGHT ? 3 : 4));
}

static void check_file(frame *made, const char *path, const celspan_coding *coding,
                       const char *title) {
  contents file = read_file(path);
  size_t size = 4 * (size_t)made->width, pixel_size = made->is_opaque ? 3 : 4, at = 18;
  unsigned char *expected = malloc(size), *found = malloc(size);
  if (CHECK(file.size > 18)) {
    CHECK(file.bytes[0] == 0 && file.bytes[1] == 0 && file.bytes[2] == 10);
    CHECK((int32_t)load_16(file.bytes + 12) == made->width);
    CHECK((int32_t)load_16(file.bytes + 14) == made->height);
    CHECK(file.bytes[16] == 8 * pixel_size);
    CHECK(file.bytes[17] == (pixel_size == 4 ? 0x28 : 0x20));
    for (int32_t y = 0; y < made->height && at > 0; y++) {
      size_t count = row_of(made, y);
      cs_pixels_row(coding, made->spans, count, expected);
      at = decode_row(&file, at, pixel_size, made->width, found);
      if (!CHECK(at > 0 && memcmp(expected, found, size) == 0))
        at = 0;
    }
    check_ends(&file, at, pixel_size, coding, title);
  }
  free(expected);
  free(found);
  free(file.bytes);
}

static void check_frame(celspan_context *context, int32_t width, int32_t height, int style,
                        celspan_coding coding) {
  static const char long_title[] =
      "a title that extends beyond the \xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4 of 40";
  static const char cut_title[] =
      "a title that extends beyond the \xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4";
  bool is_opaque = random_below(&numbers, 2), is_long = random_below(&numbers, 2);
  frame made = {.width = width, .height = height, .style = style, .is_opaque = is_opaque};
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coded = CELSPAN_CODING;
  file.coding = &coded;
  made.arrays = calloc((size_t)width, 4 * sizeof(float));
  made.spans = calloc((size_t)width, sizeof *made.spans);
  file.format = "tga";
  coded = coding;
  file.is_opaque = made.is_opaque;
  file.title = is_long ? long_title : NULL;
  const char *path = "/tmp/celspan-test.tga";
  celspan_status status = write_frame(context, &made, path, &file);
  if (!CHECK(status == CELSPAN_OK))
    fprintf(stderr, "%s\n", celspan_context_error(context));
  coding = cs_pixels_resolve(&coding, CELSPAN_DEPTH_8);
  check_file(&made, path, &coding, is_long ? cut_title : "");
  unlink(path);
  free(made.arrays);
  free(made.spans);
}

/* A run costs a packet every 128 pixels, a change a packet's head at most. */
static void check_size(celspan_context *context) {
  celspan_span spans[3] = {{.x0 = 0, .x1 = 1280, .colour = {1, 1, 1, 1}},
                           {.x0 = 1280, .x1 = 1281, .colour = {0, 1, 1, 1}},
                           {.x0 = 1281, .x1 = 1282, .colour = {0, 0, 1, 1}}};
  const char *path = "/tmp/celspan-test-size.tga";
  celspan_sink sink;
  struct stat there;
  celspan_file_desc file = CELSPAN_FILE_DESC;
  CHECK(cs_sink_tga(context, path, &file, &sink) == CELSPAN_OK);
  CHECK(sink.begin(sink.user, context, 1282, 1) == CELSPAN_OK);
  CHECK(sink.row(sink.user, context, 0, spans, 3) == CELSPAN_OK);
  CHECK(sink.end(sink.user, context, CELSPAN_OK) == CELSPAN_OK);
  CHECK(stat(path, &there) == 0 && there.st_size == 18 + 10 * 5 + 9 + 495 + 26);
  unlink(path);
}

static void check_refusals(celspan_context *context) {
  celspan_span clear = {.x0 = 0, .x1 = 4};
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coded = CELSPAN_CODING;
  file.coding = &coded;
  celspan_sink sink;
  const char *path = "/tmp/celspan-test-refused.tga";
  coded.depth = CELSPAN_DEPTH_16;
  CHECK(cs_sink_tga(context, path, &file, &sink) == CELSPAN_BAD_ARGUMENT);
  coded.depth = CELSPAN_DEPTH_DEFAULT;
  for (int32_t side = 65535; side <= 65536; side++)
    for (int turned = 0; turned < 2; turned++) {
      CHECK(cs_sink_tga(context, path, &file, &sink) == CELSPAN_OK);
      CHECK(sink.begin(sink.user, context, turned ? 1 : side, turned ? side : 1) ==
            (side == 65535 ? CELSPAN_OK : CELSPAN_LIMIT));
      cs_sink_discard(context, &sink);
    }
  file.is_opaque = true;
  CHECK(cs_sink_tga(context, path, &file, &sink) == CELSPAN_OK);
  CHECK(sink.begin(sink.user, context, 4, 1) == CELSPAN_OK);
  CHECK(sink.row(sink.user, context, 0, &clear, 1) == CELSPAN_BAD_ARGUMENT);
  CHECK(sink.end(sink.user, context, CELSPAN_BAD_ARGUMENT) == CELSPAN_BAD_ARGUMENT);
  CHECK(cs_sink_tga(context, "/dev/null/x.tga", &file, &sink) == CELSPAN_OK);
  CHECK(sink.begin(sink.user, context, 1, 1) == CELSPAN_OUTPUT);
  cs_sink_discard(context, &sink);
  CHECK(access(path, F_OK) != 0);
}

int main(void) {
  static const celspan_coding codings[] = {{.struct_size = sizeof *codings},
                                           {.struct_size = sizeof *codings,
                                            .transfer = CELSPAN_TRANSFER_LINEAR,
                                            .alpha = CELSPAN_ALPHA_PREMULTIPLIED}};
  celspan_context *context;
  size_t before, after, peak;
  uint64_t allocations;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  celspan_context_memory(context, &before, &peak, &allocations);
  for (int i = 0; i < 2; i++)
    for (int style = 0; style < 4; style++) {
      for (int32_t width = 1; width < 300; width += 1 + width / 10)
        check_frame(context, width, 9, style, codings[i]);
      check_frame(context, 1, 65535, style, codings[i]);
      check_frame(context, 65535, 3, style, codings[i]);
    }
  check_size(context);
  check_refusals(context);
  celspan_context_memory(context, &after, &peak, &allocations);
  CHECK(after == before);
  celspan_context_destroy(context);
  return check_done();
}
