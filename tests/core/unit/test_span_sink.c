/* Span files contain exactly the pixels that other sinks get, whatever the spans.
 */
#include <fcntl.h>
#include <spanfile.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "output/sinks/pixels.h"
#include "output/sinks/sink.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define WIDTH_MOST 9000
#define SPANS_MOST 64

static char path[] = "/tmp/celspan-test-span-XXXXXX";

/* ---------------------------------------------------------------- rows of spans */

typedef struct frame_row {
  celspan_span spans[SPANS_MOST];
  size_t count;
  float *colours; /* of arrays: 4 a pixel of the row */
} frame_row;

static void random_colour(test_random *random, float colour[4]) {
  static const float alphas[] = {0, 1, 1, 1, 0.25f, 0.5f};
  float alpha = alphas[random_below(random, 6)];
  for (int c = 0; c < 3; c++)
    colour[c] = alpha * (float)random_between(random, 0, 1);
  colour[3] = alpha;
}

static void random_span(test_random *random, celspan_span *span, int32_t x0, int32_t x1,
                        float *colours) {
  *span = (celspan_span){.x0 = x0, .x1 = x1, .origin = x0};
  span->kind = (celspan_span_kind)(random_below(random, 3));
  random_colour(random, span->colour);
  for (int c = 0; c < 4 && span->kind == CELSPAN_SPAN_GRADIENT; c++) {
    float end[4];
    random_colour(random, end);
    span->slope[c] = (end[c] - span->colour[c]) / (float)(x1 - x0);
  }
  if (span->kind != CELSPAN_SPAN_ARRAY)
    return;
  span->array = colours + 4 * (size_t)x0;
  bool is_even = random_below(random, 2);
  for (int32_t x = x0; x < x1; x++)
    if (is_even && x > x0 && x % 9 != 0)
      memcpy(colours + 4 * (size_t)x, colours + 4 * (size_t)(x - 1), 4 * sizeof *colours);
    else
      random_colour(random, colours + 4 * (size_t)x);
}

static void random_row(test_random *random, frame_row *row, int32_t width) {
  int32_t x = 0, longest = 1 + random_below(random, random_below(random, 2) ? 6 : width);
  for (row->count = 0; x < width; row->count++) {
    int32_t end = x + 1 + random_below(random, longest);
    end = end > width || row->count == SPANS_MOST - 1 ? width : end;
    random_span(random, &row->spans[row->count], x, end, row->colours);
    x = end;
  }
}

/* Moves the ends of single spans by a pixel or so, as in rows of a picture. */
static void move_row(test_random *random, frame_row *row) {
  for (size_t i = 0; i + 1 < row->count; i++) {
    celspan_span *span = &row->spans[i], *next = span + 1;
    int32_t end = span->x1 + random_below(random, 3) - 1;
    bool is_free = span->kind != CELSPAN_SPAN_ARRAY && next->kind != CELSPAN_SPAN_ARRAY;
    if (is_free && end > span->x0 && end < next->x1)
      span->x1 = next->x0 = end;
  }
}

/* ---------------------------------------------------------------- the file read back */

typedef struct opened_file {
  int descriptor;
  spanfile_reader *reader;
} opened_file;

static bool read_bytes(void *user, uint64_t offset, void *bytes, size_t size) {
  const opened_file *file = user;
  return pread(file->descriptor, bytes, size, (off_t)offset) == (ssize_t)size;
}

static bool open_written(opened_file *file) {
  struct stat there;
  *file = (opened_file){.descriptor = open(path, O_RDONLY)};
  if (!CHECK(file->descriptor >= 0 && fstat(file->descriptor, &there) == 0))
    return false;
  spanfile_source source = {.read = read_bytes, .user = file, .size = (uint64_t)there.st_size};
  return CHECK(spanfile_reader_create(&source, &file->reader, NULL) == SPANFILE_OK);
}

static void close_written(opened_file *file) {
  spanfile_reader_destroy(file->reader);
  close(file->descriptor);
}

static bool has_pixels(const opened_file *file, int32_t width, int32_t height,
                       const unsigned char *pixels) {
  spanfile_info info = spanfile_reader_info(file->reader);
  size_t row_size = (size_t)width * spanfile_pixel_size(info.format);
  unsigned char *read = malloc(row_size);
  bool is_same = info.width == (uint32_t)width && info.height == (uint32_t)height;
  for (int32_t y = 0; y < height && is_same; y++) {
    spanfile_row row;
    is_same = spanfile_reader_row(file->reader, (uint32_t)y, &row, NULL) == SPANFILE_OK;
    if (is_same)
      spanfile_row_pixels(info.format, &row, 0, (uint32_t)width, read);
    is_same = is_same && memcmp(read, pixels + (size_t)y * row_size, row_size) == 0;
  }
  free(read);
  return is_same;
}

/* ---------------------------------------------------------------- cases */

static void put_row(celspan_context *context, const celspan_sink *sinks, int32_t y,
                    const frame_row *row) {
  for (int i = 0; i < 2; i++)
    CHECK(sinks[i].row(sinks[i].user, context, y, row->spans, row->count) == CELSPAN_OK);
}

static void check_case(celspan_context *context, uint64_t seed) {
  test_random random = {seed};
  int32_t width = 1 + random_below(&random, seed % 20 ? 300 : WIDTH_MOST), height = 12;
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coded = CELSPAN_CODING;
  file.coding = &coded;
  file.format = "span";
  coded.depth = seed % 2 ? CELSPAN_DEPTH_8 : CELSPAN_DEPTH_HALF;
  size_t row_size = (size_t)width * celspan_coding_pixel_size(&coded);
  unsigned char *pixels = calloc((size_t)height, row_size);
  frame_row row = {.colours = calloc((size_t)width, 4 * sizeof(float))};
  celspan_sink sinks[2] = {CELSPAN_SINK, CELSPAN_SINK};
  CHECK(celspan_file_sink_create(context, path, &file, &sinks[0]) == CELSPAN_OK);
  CHECK(cs_sink_memory(context, &coded, pixels, row_size, &sinks[1]) == CELSPAN_OK);
  for (int i = 0; i < 2; i++)
    CHECK(sinks[i].begin(sinks[i].user, context, width, height) == CELSPAN_OK);
  for (int32_t y = 0; y < height; y++) {
    if (y % 4 == 0)
      random_row(&random, &row, width);
    else if (y % 4 < 3)
      move_row(&random, &row);
    put_row(context, sinks, y, &row);
  }
  for (int i = 0; i < 2; i++)
    CHECK(sinks[i].end(sinks[i].user, context, CELSPAN_OK) == CELSPAN_OK);
  opened_file written;
  if (open_written(&written)) {
    CHECK(has_pixels(&written, width, height, pixels));
    close_written(&written);
  }
  free(row.colours);
  free(pixels);
}

static void test_codings(celspan_context *context) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coded = CELSPAN_CODING;
  file.coding = &coded;
  celspan_sink sink = CELSPAN_SINK;
  coded.depth = CELSPAN_DEPTH_16;
  CHECK(celspan_file_sink_create(context, "a.span", &file, &sink) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "a.span: span files hold depth 8"));
  coded =
      (celspan_coding){.struct_size = sizeof(celspan_coding), .transfer = CELSPAN_TRANSFER_LINEAR};
  CHECK(celspan_file_sink_create(context, "a.span", &file, &sink) == CELSPAN_BAD_ARGUMENT);
  coded = (celspan_coding){.struct_size = sizeof(celspan_coding),
                           .depth = CELSPAN_DEPTH_HALF,
                           .transfer = CELSPAN_TRANSFER_DEFAULT,
                           .alpha = CELSPAN_ALPHA_STRAIGHT};
  CHECK(celspan_file_sink_create(context, "a.span", &file, &sink) == CELSPAN_BAD_ARGUMENT);
}

/* If rows are missing, or the outcome is not OK, no file appears under the name. */
static void test_unfinished(celspan_context *context) {
  char name[sizeof path + 16];
  snprintf(name, sizeof name, "%s-none.span", path);
  celspan_sink sink = CELSPAN_SINK;
  const celspan_span span = {.x1 = 4};
  CHECK(celspan_file_sink_create(context, name, NULL, &sink) == CELSPAN_OK);
  CHECK(sink.begin(sink.user, context, 4, 2) == CELSPAN_OK);
  CHECK(sink.row(sink.user, context, 0, &span, 1) == CELSPAN_OK);
  CHECK(sink.end(sink.user, context, CELSPAN_OK) == CELSPAN_BAD_ARGUMENT);
  CHECK(access(name, F_OK) != 0);
  CHECK(celspan_file_sink_create(context, name, NULL, &sink) == CELSPAN_OK);
  CHECK(sink.begin(sink.user, context, 4, 1) == CELSPAN_OK);
  CHECK(sink.row(sink.user, context, 0, &span, 1) == CELSPAN_OK);
  CHECK(sink.end(sink.user, context, CELSPAN_CANCELLED) == CELSPAN_CANCELLED);
  CHECK(access(name, F_OK) != 0);
  CHECK(celspan_file_sink_create(context, name, NULL, &sink) == CELSPAN_OK);
  CHECK(sink.end(sink.user, context, CELSPAN_CANCELLED) == CELSPAN_CANCELLED); /* never begun */
}

int main(void) {
  celspan_context *context;
  int descriptor = mkstemp(path);
  if (!CHECK(descriptor >= 0) || !CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK))
    return check_done();
  close(descriptor);
  size_t before, after, peak;
  uint64_t allocations;
  celspan_context_memory(context, &before, &peak, &allocations);
  for (uint64_t seed = 0; seed < 500; seed++)
    check_case(context, seed);
  test_codings(context);
  test_unfinished(context);
  celspan_context_memory(context, &after, &peak, &allocations);
  CHECK(after == before);
  celspan_context_destroy(context);
  unlink(path);
  return check_done();
}
