/* output/png/png_sink.c: whatever rows of spans it is given, libpng reads the pixels that
 * output/sinks/pixels.c makes of them.
 */
#include <png.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "output/sinks/pixels.h"
#include "output/sinks/sink.h"
#include "tests/support/check.h"
#include "tests/support/span_frames.h"

/* ---------------------------------------------------------------- reading back */

static void check_file(frame *made, const char *path, const celspan_coding *coding,
                       const char *title) {
  png_image_free(&(png_image){.version = PNG_IMAGE_VERSION});
  FILE *stream = fopen(path, "rb");
  if (!CHECK(stream != NULL))
    return;
  png_structp reader = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
  png_infop info = png_create_info_struct(reader);
  size_t pixel_size = celspan_coding_pixel_size(coding), size = (size_t)made->width * pixel_size;
  unsigned char *expected = malloc(size), *found = malloc(size);
  volatile int wrong_rows = -1;
  if (setjmp(png_jmpbuf(reader)) == 0) {
    png_set_user_limits(reader, 0x7fffffff, 0x7fffffff);
    png_init_io(reader, stream);
    png_read_info(reader, info);
    CHECK((int32_t)png_get_image_width(reader, info) == made->width);
    CHECK((int32_t)png_get_image_height(reader, info) == made->height);
    CHECK(png_get_color_type(reader, info) ==
          (made->is_opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA));
    CHECK(png_get_bit_depth(reader, info) == (pixel_size == 8 ? 16 : 8));
    CHECK(!!png_get_valid(reader, info, PNG_INFO_sRGB) ==
          (coding->transfer == CELSPAN_TRANSFER_SRGB));
    CHECK(!!png_get_valid(reader, info, PNG_INFO_gAMA) ==
          (coding->transfer != CELSPAN_TRANSFER_REC709));
    if (pixel_size == 8)
      png_set_swap(reader);
    if (made->is_opaque)
      png_set_add_alpha(reader, 0xffff, PNG_FILLER_AFTER);
    int differing = 0;
    for (int32_t y = 0; y < made->height; y++) {
      png_read_row(reader, found, NULL);
      size_t count = row_of(made, y);
      cs_pixels_row(coding, made->spans, count, expected);
      differing += memcmp(expected, found, size) != 0;
    }
    png_read_end(reader, info);
    wrong_rows = differing;
    png_textp texts;
    int text_count = 0;
    png_get_text(reader, info, &texts, &text_count);
    CHECK(text_count == (title ? 2 : 1));
    CHECK_TEXT(texts[0].text, "celspan");
    if (title && text_count == 2)
      CHECK_TEXT(texts[1].text, title);
  }
  CHECK(wrong_rows == 0);
  png_destroy_read_struct(&reader, &info, NULL);
  fclose(stream);
  free(expected);
  free(found);
}

static bool same_files(const char *path, const char *other) {
  FILE *first = fopen(path, "rb"), *second = fopen(other, "rb");
  int a = first ? getc(first) : -2, b = second ? getc(second) : -3;
  while (a == b && a != EOF) {
    a = getc(first);
    b = getc(second);
  }
  if (first)
    fclose(first);
  if (second)
    fclose(second);
  return a == EOF && b == EOF;
}

/* Writes a frame with 1, 2 and 5 threads: the same bytes, and libpng reads the pixels. */
static void check_frame(celspan_context *context, int32_t width, int32_t height, int style,
                        celspan_coding asked, const char *title) {
  static const int workers[] = {1, 2, 5};
  frame made = {
      .width = width, .height = height, .style = style, .is_opaque = random_below(&numbers, 2)};
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coded = CELSPAN_CODING;
  file.coding = &coded;
  file.format = "png";
  char paths[3][40];
  made.arrays = calloc((size_t)width, 4 * sizeof(float));
  made.spans = calloc((size_t)width, sizeof *made.spans);
  coded = asked;
  file.title = title;
  file.is_opaque = made.is_opaque;
  for (int i = 0; i < 3; i++) {
    strcpy(paths[i], "/tmp/celspan-test-png-XXXXXX");
    close(mkstemp(paths[i]));
    file.workers = workers[i];
    celspan_status status = write_frame(context, &made, paths[i], &file);
    if (!CHECK(status == CELSPAN_OK))
      fprintf(stderr, "%s\n", celspan_context_error(context));
  }
  celspan_coding coding = cs_pixels_resolve(&asked, CELSPAN_DEPTH_8);
  check_file(&made, paths[0], &coding, title);
  CHECK(same_files(paths[0], paths[1]) && same_files(paths[0], paths[2]));
  for (int i = 0; i < 3; i++)
    unlink(paths[i]);
  free(made.arrays);
  free(made.spans);
}

/* Pixels that were declared opaque and are not. */
static void check_clear_refused(celspan_context *context, int style, int workers) {
  frame made = {.width = 300, .height = 2000, .style = style};
  celspan_file_desc file = CELSPAN_FILE_DESC;
  file.format = "png";
  made.arrays = calloc(300, 4 * sizeof(float));
  made.spans = calloc(300, sizeof *made.spans);
  file.is_opaque = true;
  file.workers = workers;
  CHECK(write_frame(context, &made, "/tmp/celspan-test-clear.png", &file) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(context),
             "PNG: a row has pixels that are not opaque, in a picture that was begun as opaque");
  CHECK(access("/tmp/celspan-test-clear.png", F_OK) != 0);
  free(made.arrays);
  free(made.spans);
}

static void check_refusals(celspan_context *context) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coded = CELSPAN_CODING;
  file.coding = &coded;
  file.format = "png";
  celspan_sink sink;
  coded.depth = CELSPAN_DEPTH_HALF;
  CHECK(cs_sink_png(context, "x.png", &file, &sink) == CELSPAN_BAD_ARGUMENT);
  coded =
      (celspan_coding){.struct_size = sizeof(celspan_coding), .alpha = CELSPAN_ALPHA_PREMULTIPLIED};
  CHECK(cs_sink_png(context, "x.png", &file, &sink) == CELSPAN_BAD_ARGUMENT);
  coded = (celspan_coding){.struct_size = sizeof(celspan_coding)};
  CHECK(cs_sink_png(context, "/dev/null/x.png", &file, &sink) == CELSPAN_OK);
  CHECK(sink.begin(sink.user, context, 1, 1) == CELSPAN_OUTPUT);
  cs_sink_discard(context, &sink);
  CHECK(cs_sink_png(context, "x.png", &file, &sink) == CELSPAN_OK);
  cs_sink_discard(context, &sink);
}

/* ---------------------------------------------------------------- no memory */

static atomic_int allocations_left;

static void *failing_resize(void *user, void *block, size_t old_size, size_t new_size) {
  (void)user, (void)old_size;
  if (new_size == 0) {
    free(block);
    return NULL;
  }
  return --allocations_left == 0 ? NULL : realloc(block, new_size);
}

/* With the n-th allocation failing, for every n: the status says so, nothing leaks, and no file is
 * left. */
static void check_without_memory(int style, int workers, int32_t height) {
  static float arrays[4 * 500];
  static celspan_span spans[500];
  celspan_file_desc file = CELSPAN_FILE_DESC;
  file.format = "png";
  frame made = {.width = 500, .height = height, .style = style, .arrays = arrays, .spans = spans};
  file.workers = workers;
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = failing_resize;
  celspan_context *context;
  char path[] = "/tmp/celspan-test-png-XXXXXX";
  allocations_left = 0;
  close(mkstemp(path));
  CHECK(celspan_context_create(&desc, &context) == CELSPAN_OK);
  celspan_status status = CELSPAN_NO_MEMORY;
  const int step = check_is_for_threads() ? 5 : 1;
  for (int n = 1; n < 1000 && status != CELSPAN_OK; n += step) {
    if (!check_is_drawn(n / step))
      continue;
    size_t before, after, peak;
    uint64_t allocations;
    unlink(path);
    celspan_context_memory(context, &before, &peak, &allocations);
    allocations_left = n;
    status = write_frame(context, &made, path, &file);
    CHECK(status == (allocations_left > 0 ? CELSPAN_OK : CELSPAN_NO_MEMORY));
    CHECK((access(path, F_OK) == 0) == (status == CELSPAN_OK));
    celspan_context_memory(context, &after, &peak, &allocations);
    CHECK(after == before && (status != CELSPAN_OK || n > 4));
  }
  CHECK(status == CELSPAN_OK);
  unlink(path);
  celspan_context_destroy(context);
}

/* ---------------------------------------------------------------- no room */

/* Files may not grow beyond `limit` bytes: no file appears under the name unless it fits. */
static void check_full(celspan_context *context, frame *made, rlim_t limit, off_t whole) {
  struct rlimit before, least;
  struct stat there;
  celspan_file_desc file = CELSPAN_FILE_DESC;
  char folder[] = "/tmp/celspan-test-png-XXXXXX", path[64];
  CHECK(mkdtemp(folder) != NULL);
  snprintf(path, sizeof path, "%s/full.png", folder);
  file.workers = 2;
  getrlimit(RLIMIT_FSIZE, &before);
  least = before;
  least.rlim_cur = limit;
  setrlimit(RLIMIT_FSIZE, &least);
  celspan_status status = write_frame(context, made, path, &file);
  setrlimit(RLIMIT_FSIZE, &before);
  bool fits = (rlim_t)whole <= limit;
  CHECK(status == (fits ? CELSPAN_OK : CELSPAN_OUTPUT));
  CHECK((stat(path, &there) == 0) == fits);
  unlink(path);
  CHECK(rmdir(folder) == 0); /* no temporary file either */
}

static void check_no_room(celspan_context *context) {
  frame made = {.width = 500, .height = 1500, .style = 0};
  celspan_file_desc file = CELSPAN_FILE_DESC;
  struct stat there;
  made.arrays = calloc(500, 4 * sizeof(float));
  made.spans = calloc(500, sizeof *made.spans);
  signal(SIGXFSZ, SIG_IGN);
  CHECK(write_frame(context, &made, "/tmp/celspan-test-whole.png", &file) == CELSPAN_OK);
  CHECK(stat("/tmp/celspan-test-whole.png", &there) == 0);
  unlink("/tmp/celspan-test-whole.png");
  int number = 0;
  for (off_t left = there.st_size; left > 0; left = left * 2 / 3) {
    if (check_is_drawn(number++))
      check_full(context, &made, (rlim_t)(there.st_size - left), there.st_size);
    if (check_is_drawn(number++))
      check_full(context, &made, (rlim_t)left, there.st_size);
  }
  check_full(context, &made, (rlim_t)there.st_size - 1, there.st_size);
  free(made.arrays);
  free(made.spans);
}

static void try_frame(celspan_context *context, int32_t width, int32_t height, int style,
                      int coding, const char *title) {
  static const celspan_coding codings[] = {
      {.struct_size = sizeof *codings},
      {.struct_size = sizeof *codings, .depth = CELSPAN_DEPTH_16},
      {.struct_size = sizeof *codings, .transfer = CELSPAN_TRANSFER_LINEAR},
      {.struct_size = sizeof *codings,
       .depth = CELSPAN_DEPTH_16,
       .transfer = CELSPAN_TRANSFER_REC709,
       .alpha = CELSPAN_ALPHA_STRAIGHT}};
  static int number;
  bool is_large = (int64_t)width * height > 1 << 18;
  if (check_is_drawn(number++) && !(is_large && check_is_for_threads()))
    check_frame(context, width, height, style, codings[coding], title);
}

static void try_frames(celspan_context *context) {
  for (int style = 0; style < 4; style++)
    for (int i = 0; i < 4; i++) {
      try_frame(context, 1, 1, style, i, NULL);
      try_frame(context, 1, 300, style, i, "a title");
      try_frame(context, 300, 1, style, i, "Titel mit \xc3\xa4");
      try_frame(context, 2, 2, style, i, NULL);
      try_frame(context, 333, 200, style, i, NULL);
      if ((i + style) % 2 == 0)
        try_frame(context, 3001, 120, style, i, NULL);
      else
        try_frame(context, 700, 1300, style, i, NULL);
    }
  for (int i = 0; i < 2; i++) {
    try_frame(context, 1000000, 12, 1, i, NULL);
    try_frame(context, 1000000, 6, 3, i, NULL);
    try_frame(context, 1000000, 1, 0, i, NULL);
    try_frame(context, 1, 1000000, 0, i, NULL);
  }
  for (int32_t width = 1; width < 300; width += 1 + width / 20)
    try_frame(context, width, 9, width % 4, width % 2, NULL);
}

int main(void) {
  celspan_context *context;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK)
    return 1;
  size_t before, after, peak;
  uint64_t allocations;
  celspan_context_memory(context, &before, &peak, &allocations);
  try_frames(context);
  if (!check_is_for_threads()) {
    check_refusals(context);
    check_no_room(context);
    check_clear_refused(context, 0, 1);
    check_clear_refused(context, 2, 3);
    check_without_memory(0, 1, 20);
    check_without_memory(0, 3, 1500);
  }
  check_without_memory(2, 2, 1100);
  celspan_context_memory(context, &after, &peak, &allocations);
  CHECK(after == before);
  celspan_context_destroy(context);
  return check_done();
}
