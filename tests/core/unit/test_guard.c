/* output/sinks/file_sink.c: every sink that writes a file, in every format, called out of order,
 * with hostile sizes and with spans that do not cover their rows. No call reads past an array, each
 * refusal has a sentence, and no file is left. */
#include <limits.h>
#include <string.h>

#include "output/sinks/strip.h"
#include "tests/support/memory.h"
#include "tests/support/picture.h"

enum { WIDTH = 64, HEIGHT = 64 };

static celspan_context *context;
static const char *const formats[] = {"png", "tga", "span",
#ifdef TEST_KIT /* what its picture modules write */
                                      "exr", "tif", "dpx",  "jpg", "bmp", "hdr",
                                      "ppm", "gif", "webp", "jp2", "avif"
#endif
};
static const float colours[4][4] = {{1, 1, 1, 1}, {0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
static const celspan_span whole = {.x1 = WIDTH, .colour = {1, 1, 1, 1}};

static celspan_sink make(const char *path, bool dithers) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coded = CELSPAN_CODING;
  file.coding = &coded;
  celspan_sink sink = {.struct_size = sizeof sink};
  coded.depth = dithers ? CELSPAN_DEPTH_8_DITHER : CELSPAN_DEPTH_DEFAULT;
  CHECK(celspan_file_sink_create(context, path, &file, &sink) == CELSPAN_OK);
  return sink;
}

static celspan_status begin(const celspan_sink *sink, int32_t width, int32_t height) {
  return sink->begin(sink->user, context, width, height);
}

static celspan_status row(const celspan_sink *sink, int32_t y) {
  return sink->row(sink->user, context, y, &whole, 1);
}

static celspan_status end(const celspan_sink *sink) {
  return sink->end(sink->user, context, CELSPAN_OK);
}

/* The call is refused with a sentence that names the file. */
static void check_refused(celspan_status status, const char *path) {
  if (!CHECK(status == CELSPAN_BAD_ARGUMENT))
    fprintf(stderr, "%s: %s\n", path, celspan_status_name(status));
  if (!CHECK(strstr(celspan_context_error(context), path)))
    fprintf(stderr, "%s\n", celspan_context_error(context));
}

/* Ends a sink that was used wrongly: it leaves no file. */
static void check_nothing(const celspan_sink *sink, const char *path) {
  check_refused(end(sink), path);
  CHECK(access(path, F_OK) != 0);
}

static void check_order(const char *path, bool dithers) {
  celspan_sink sink = make(path, dithers);
  check_nothing(&sink, path); /* no begin */
  sink = make(path, dithers);
  check_refused(row(&sink, 0), path);
  check_refused(begin(&sink, WIDTH, HEIGHT), path); /* after a failure */
  check_nothing(&sink, path);
  sink = make(path, dithers);
  CHECK(begin(&sink, WIDTH, HEIGHT) == CELSPAN_OK);
  check_refused(begin(&sink, WIDTH, HEIGHT), path);
  check_refused(row(&sink, 0), path);
  check_nothing(&sink, path);
  for (int rows = 0; rows < HEIGHT; rows = 2 * rows + 1) { /* too few */
    sink = make(path, dithers);
    CHECK(begin(&sink, WIDTH, HEIGHT) == CELSPAN_OK);
    for (int32_t y = 0; y < rows; y++)
      CHECK(row(&sink, y) == CELSPAN_OK);
    check_nothing(&sink, path);
  }
}

static void check_row_numbers(const char *path, bool dithers) {
  static const int32_t wrong[] = {0, 2, -1, HEIGHT, INT32_MAX, INT32_MIN};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    celspan_sink sink = make(path, dithers);
    CHECK(begin(&sink, WIDTH, HEIGHT) == CELSPAN_OK);
    CHECK(row(&sink, 0) == CELSPAN_OK);
    check_refused(row(&sink, wrong[i]), path);
    check_nothing(&sink, path);
  }
  celspan_sink sink = make(path, dithers);
  CHECK(begin(&sink, WIDTH, HEIGHT) == CELSPAN_OK);
  for (int32_t y = 0; y < HEIGHT; y++)
    CHECK(row(&sink, y) == CELSPAN_OK);
  check_refused(row(&sink, HEIGHT), path); /* too many */
  check_nothing(&sink, path);
}

static void check_sizes(const char *path, bool dithers) {
  static const int32_t sides[] = {0, -1, -8, INT32_MIN, 1048577, INT32_MAX};
  for (size_t i = 0; i < sizeof sides / sizeof *sides; i++)
    for (int turned = 0; turned < 2; turned++) {
      celspan_sink sink = make(path, dithers);
      check_refused(begin(&sink, turned ? 4 : sides[i], turned ? sides[i] : 4), path);
      check_refused(row(&sink, 0), path);
      check_nothing(&sink, path);
    }
}

static void check_spans(const char *path, bool dithers) {
  const float *array = colours[0];
  const celspan_span gap[] = {{.x1 = 2}, {.x0 = 3, .x1 = WIDTH}};
  const celspan_span overlap[] = {{.x1 = 3}, {.x0 = 2, .x1 = WIDTH}};
  const celspan_span wide = {.x1 = WIDTH + 1}, narrow = {.x1 = WIDTH - 1},
                     left = {.x0 = -1, .x1 = WIDTH};
  const celspan_span far = {.x1 = INT32_MAX}, turned = {.x0 = WIDTH, .x1 = 0}, empty = {0};
  const celspan_span none = {.x1 = WIDTH, .kind = CELSPAN_SPAN_ARRAY};
  const celspan_span odd = {.x1 = WIDTH, .kind = (celspan_span_kind)77, .array = array};
  const struct {
    const celspan_span *spans;
    size_t count;
  } rows[] = {{gap, 2},           {overlap, 2}, {&wide, 1},   {&narrow, 1}, {&left, 1},
              {&far, 1},          {&odd, 1},    {&turned, 1}, {&empty, 1},  {&none, 1},
              {&whole, SIZE_MAX}, {NULL, 1},    {&whole, 0},  {NULL, 0},    {NULL, SIZE_MAX}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    celspan_sink sink = make(path, dithers);
    CHECK(begin(&sink, WIDTH, HEIGHT) == CELSPAN_OK);
    check_refused(sink.row(sink.user, context, 0, rows[i].spans, rows[i].count), path);
    check_nothing(&sink, path);
  }
}

/* And correct calls still work. */
static void check_whole(const char *path, bool dithers) {
  celspan_sink sink = make(path, dithers);
  celspan_status status = begin(&sink, WIDTH, HEIGHT);
  for (int32_t y = 0; y < HEIGHT && status == CELSPAN_OK; y++)
    status = row(&sink, y);
  status = sink.end(sink.user, context, status);
  if (!CHECK(status == CELSPAN_OK))
    fprintf(stderr, "%s\n", celspan_context_error(context));
  CHECK(access(path, F_OK) == 0);
  unlink(path);
}

/* Strips begin and end at multiples of some rows, or at the end of their picture. */
static void check_strips(const char *path) {
  enum { UNIT = CS_STRIP_ROWS };
  static const struct {
    int32_t row, whole, rows;
    bool is_strip;
  } strips[] = {{0, 2 * UNIT, UNIT, true},
                {UNIT, 2 * UNIT, UNIT, true},
                {UNIT, 2 * UNIT - 3, UNIT - 3, true},
                {0, 9, 9, true},
                {-UNIT, 2 * UNIT, UNIT, false},
                {UNIT / 2, 2 * UNIT, UNIT / 2, false},
                {0, 2 * UNIT, UNIT - 1, false},
                {UNIT, 2 * UNIT - 3, UNIT, false},
                {UNIT, 2 * UNIT, UNIT - 3, false},
                {2 * UNIT, 2 * UNIT, UNIT, false},
                {UNIT, -1, UNIT, false},
                {INT32_MIN, 2 * UNIT, UNIT, false},
                {INT32_MAX / UNIT * UNIT, 2 * UNIT, UNIT, false}};
  for (size_t i = 0; i < sizeof strips / sizeof *strips; i++) {
    celspan_file_desc file = CELSPAN_FILE_DESC;
    celspan_sink sink = CELSPAN_SINK;
    file.strip_row = strips[i].row;
    file.strip_height = strips[i].whole;
    CHECK(celspan_file_sink_create(context, path, &file, &sink) == CELSPAN_OK);
    celspan_status status = begin(&sink, WIDTH, strips[i].rows);
    if (strips[i].is_strip)
      CHECK(status == CELSPAN_OK);
    else
      check_refused(status, path);
    CHECK(sink.end(sink.user, context, CELSPAN_CANCELLED) != CELSPAN_OK);
    CHECK(access(path, F_OK) != 0);
  }
}

static void check_format(const char *format, bool dithers) {
  char path[512];
  snprintf(path, sizeof path, "%s.%s", picture_path("guard"), format);
  check_order(path, dithers);
  check_row_numbers(path, dithers);
  check_sizes(path, dithers);
  check_spans(path, dithers);
  check_whole(path, dithers);
}

static void check_names(void) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coded = CELSPAN_CODING;
  file.coding = &coded;
  celspan_sink sink = CELSPAN_SINK;
  CHECK(celspan_file_sink_create(context, NULL, &file, &sink) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_file_sink_create(context, "", &file, &sink) == CELSPAN_BAD_ARGUMENT);
  coded.depth = (celspan_depth)99;
  CHECK(celspan_file_sink_create(context, "x.exr", &file, &sink) == CELSPAN_BAD_ARGUMENT);
  coded.depth = CELSPAN_DEPTH_8;
  coded.transfer = (celspan_transfer)-1;
  CHECK(celspan_file_sink_create(context, "x.png", &file, &sink) == CELSPAN_BAD_ARGUMENT);
}

int main(void) {
  memory_watch watch = {0};
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = memory_watch_resize;
  desc.resize_user = &watch;
  if (celspan_context_create(&desc, &context) != CELSPAN_OK)
    return 1;
  for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
    check_format(formats[i], false);
  for (int i = 0; i < 3; i++) {
    char path[512];
    snprintf(path, sizeof path, "%s.%s", picture_path("strip"), formats[i]); /* those with strips */
    check_strips(path);
  }
  check_format("png", true);
  check_format("tga", true);
  check_names();
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
  return check_done();
}
