/* celspan compare A B: whether two pictures, or two films as numbered pictures, show the same, row by
 * row, span by span.
 *
 * Coded values are compared: sRGB, straight, at 16 bits when both pictures hold integers and as
 * floats when one of them does not.
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/context.h"
#include "cli/interrupt.h"
#include "cli/still.h"
#include "cli/target.h"
#include "cli/verbs.h"
#include "colour/transfer.h"
#include "output/difference.h"
#include "output/pixels.h"

typedef struct comparison {
  celspan_coding coding;
  int32_t width, height;
  double tolerance;
  double largest;
  int32_t x, y; /* where the largest difference is */
  int channel;
  uint64_t differing; /* pixels */
  uint8_t *picture;   /* with -o: a row of the picture of differences; borrowed */
  float *linear;      /* with -o: the same row for its sink; borrowed */
} comparison;

static double value(const comparison *c, const void *row, size_t i) {
  return c->coding.depth == CELSPAN_DEPTH_16 ? ((const uint16_t *)row)[i] / 65535.0
                                             : (double)((const float *)row)[i];
}

static double difference(double a, double b) {
  if (isnan(a) || isnan(b))
    return isnan(a) && isnan(b) ? 0 : (double)INFINITY;
  return a == b ? 0 : fabs(a - b); /* equal infinities are equal */
}

/* Compares coded pixels from column x0 on. Each pixel counts for `times` columns. */
static void compare_pixels(comparison *c, int32_t x0, int32_t y, int32_t count, int32_t times,
                           const void *pixels_a, const void *pixels_b) {
  for (int32_t x = 0; x < count; x++) {
    bool differs = false;
    double most = 0;
    for (int channel = 0; channel < 4; channel++) {
      size_t i = 4 * (size_t)x + (size_t)channel;
      double d = difference(value(c, pixels_a, i), value(c, pixels_b, i));
      differs |= d > c->tolerance;
      most = d > most ? d : most;
      if (d > c->largest) {
        c->largest = d;
        c->x = x0 + x;
        c->y = y;
        c->channel = channel;
      }
    }
    c->differing += differs ? (uint64_t)times : 0;
    if (differs && c->picture)
      cs_difference_mark(most, c->picture + 4 * (size_t)(x0 + x), (size_t)times);
  }
}

/* Codes `count` columns of a span, from column x on. */
static void code_columns(const comparison *c, const celspan_span *span, int32_t x, int32_t count,
                         void *pixels) {
  celspan_span columns = *span;
  columns.x0 = 0;
  columns.x1 = count;
  columns.origin = span->origin - x;
  if (span->kind == CELSPAN_SPAN_ARRAY)
    columns.array = span->array + 4 * (size_t)(x - span->x0);
  cs_pixels_row(&c->coding, &columns, 1, pixels);
}

/* Compares columns [x0, x1), which are in one span of each picture. Where both spans have a single
 * colour, one pixel is enough. */
static void compare_columns(comparison *c, int32_t y, const celspan_span *a, const celspan_span *b,
                            int32_t x0, int32_t x1) {
  enum { CHUNK = 1024 };
  float pixels_a[4 * CHUNK], pixels_b[4 * CHUNK];
  bool is_even = a->kind == CELSPAN_SPAN_SINGLE && b->kind == CELSPAN_SPAN_SINGLE;
  if (is_even && memcmp(a->colour, b->colour, sizeof a->colour) == 0)
    return;
  for (int32_t x = x0, next; x < x1; x = next) {
    next = is_even || x1 - x < CHUNK ? x1 : x + CHUNK;
    int32_t count = is_even ? 1 : next - x;
    code_columns(c, a, x, count, pixels_a);
    code_columns(c, b, x, count, pixels_b);
    compare_pixels(c, x, y, count, is_even ? next - x : 1, pixels_a, pixels_b);
  }
}

/* The row of the picture of differences before anything is marked. */
static void begin_row(const comparison *c, const celspan_span *spans, size_t count) {
  static const celspan_coding coding = {CELSPAN_DEPTH_8, CELSPAN_TRANSFER_SRGB,
                                        CELSPAN_ALPHA_STRAIGHT};
  cs_pixels_row(&coding, spans, count, c->picture);
  cs_difference_pale(c->picture, (size_t)c->width);
}

static celspan_status compare_row(comparison *c, int32_t y, cs_still_rows *rows_a,
                                  cs_still_rows *rows_b) {
  const celspan_span *a = NULL, *b = NULL;
  size_t count_a = 0, count_b = 0;
  celspan_status status = cs_still_rows_get(rows_a, y, &a, &count_a);
  if (status == CELSPAN_OK && c->picture)
    begin_row(c, a, count_a);
  if (status == CELSPAN_OK)
    status = cs_still_rows_get(rows_b, y, &b, &count_b);
  for (int32_t x = 0, next; x < c->width && status == CELSPAN_OK; x = next) {
    next = a->x1 < b->x1 ? a->x1 : b->x1;
    compare_columns(c, y, a, b, x, next);
    a += a->x1 == next;
    b += b->x1 == next;
  }
  return status;
}

/* Gives the row of the picture of differences to its sink, as codes that it takes as they are. */
static celspan_status put_row(celspan_context *context, const comparison *c,
                              const celspan_sink *sink, int32_t y) {
  float *pixels = c->linear;
  for (size_t i = 0; i < 4 * (size_t)c->width; i++)
    pixels[i] = i % 4 == 3 ? 1 : cs_transfer_decode(CELSPAN_TRANSFER_SRGB, c->picture[i] / 255.0f);
  const celspan_span span = {.x1 = c->width, .kind = CELSPAN_SPAN_ARRAY, .array = pixels};
  return sink->row(sink->user, context, y, &span, 1);
}

/* sink: NULL without -o. */
static celspan_status compare_all(celspan_context *context, comparison *c, cs_still_rows *a,
                                  cs_still_rows *b, const celspan_sink *sink) {
  celspan_status status = sink ? sink->begin(sink->user, context, c->width, c->height) : CELSPAN_OK;
  for (int32_t y = 0; y < c->height && status == CELSPAN_OK; y++) {
    status = cs_interrupt_signal() ? CELSPAN_CANCELLED : compare_row(c, y, a, b);
    if (status == CELSPAN_OK && sink)
      status = put_row(context, c, sink, y);
  }
  return sink ? sink->end(sink->user, context, status) : status;
}

/* The sink, NULL without -o, is ended whatever happens. */
static celspan_status compare_stills(celspan_context *context, comparison *c,
                                     const celspan_sink *sink, const cs_still *still_a,
                                     const celspan_frame_desc *frame_a, const cs_still *still_b,
                                     const celspan_frame_desc *frame_b) {
  cs_still_rows a = {NULL, NULL}, b = a;
  celspan_status status = cs_still_rows_create(context, still_a, frame_a, &a);
  if (status == CELSPAN_OK)
    status = cs_still_rows_create(context, still_b, frame_b, &b);
  if (status == CELSPAN_OK)
    status = compare_all(context, c, &a, &b, sink);
  else if (sink)
    status = sink->end(sink->user, context, status);
  cs_still_rows_destroy(&a);
  cs_still_rows_destroy(&b);
  return status;
}

/* With the rows and the sink that -o needs, or without. */
static celspan_status compare_into(celspan_context *context, comparison *c, const char *output,
                                   const cs_still *still_a, const celspan_frame_desc *frame_a,
                                   const cs_still *still_b, const celspan_frame_desc *frame_b) {
  if (!output)
    return compare_stills(context, c, NULL, still_a, frame_a, still_b, frame_b);
  size_t channels = 4 * (size_t)c->width;
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_sink sink;
  file.is_opaque = true;
  c->picture = cs_mem_array(context->memory, channels, sizeof *c->picture);
  c->linear = cs_mem_array(context->memory, channels, sizeof *c->linear);
  celspan_status status = c->picture && c->linear
                              ? celspan_file_sink_create(context, output, &file, &sink)
                              : cs_fail_memory(context);
  if (status == CELSPAN_OK)
    status = compare_stills(context, c, &sink, still_a, frame_a, still_b, frame_b);
  cs_mem_free(context->memory, c->picture, channels * sizeof *c->picture);
  cs_mem_free(context->memory, c->linear, channels * sizeof *c->linear);
  return status;
}

static cs_exit answer(const comparison *c) {
  printf("largest_difference %.9g", c->largest);
  if (c->largest > 0)
    printf(" x %d y %d channel %c", c->x, c->y, "rgba"[c->channel]);
  printf(" pixels_differing %" PRIu64 " pixels %" PRIu64 "\n", c->differing,
         (uint64_t)c->width * (uint64_t)c->height);
  return c->differing ? CS_EXIT_DIFFERENT : CS_EXIT_OK;
}

static cs_exit compare(celspan_context *context, const cs_request *request, const char *output,
                       const cs_still *a, const cs_still *b) {
  if (a->info.width != b->info.width || a->info.height != b->info.height) {
    printf("sizes_differ %dx%d %dx%d\n", a->info.width, a->info.height, b->info.width,
           b->info.height);
    return CS_EXIT_DIFFERENT;
  }
  bool is_float = a->info.is_float || b->info.is_float;
  celspan_coding coding = {is_float ? CELSPAN_DEPTH_FLOAT : CELSPAN_DEPTH_16, CELSPAN_TRANSFER_SRGB,
                           CELSPAN_ALPHA_STRAIGHT};
  comparison c = {.coding = coding,
                  .width = a->info.width,
                  .height = a->info.height,
                  .tolerance = request->tolerance};
  celspan_frame_desc frame_a, frame_b;
  cs_exit outcome = cs_still_frame(a, request, &frame_a);
  if (outcome == CS_EXIT_OK)
    outcome = cs_still_frame(b, request, &frame_b);
  if (outcome != CS_EXIT_OK)
    return outcome;
  celspan_status status = compare_into(context, &c, output, a, &frame_a, b, &frame_b);
  if (status != CELSPAN_OK)
    return cs_report_failure(context, status, NULL);
  return answer(&c);
}

/* ---------------------------------------------------------------- files */

/* Two files. output: NULL without -o. */
static cs_exit compare_files(celspan_context *context, const cs_request *request,
                             const char *path_a, const char *path_b, const char *output) {
  cs_still a = {.exposure.rostrum = NULL}, b = a;
  cs_exit outcome = cs_still_open(context, path_a, &a);
  if (outcome == CS_EXIT_OK)
    outcome = cs_still_open(context, path_b, &b);
  if (outcome == CS_EXIT_OK)
    outcome = compare(context, request, output, &a, &b);
  cs_still_close(&a);
  cs_still_close(&b);
  return outcome;
}

enum { PATH_SIZE = 4096 };

/* A frame of two films. */
static cs_exit compare_frame(celspan_context *context, const cs_request *request, int64_t number) {
  char paths[3][PATH_SIZE];
  const char *patterns[] = {request->operands[0], request->operands[1], request->output};
  for (size_t i = 0; i < 3 && patterns[i]; i++) {
    celspan_status status = cs_sequence_name(context, patterns[i], number, paths[i], PATH_SIZE);
    if (status != CELSPAN_OK)
      return cs_report_failure(context, status, NULL);
  }
  printf("frame %" PRId64 " ", number);
  return compare_files(context, request, paths[0], paths[1], request->output ? paths[2] : NULL);
}

static bool has_frame(const cs_sequence *frames, int64_t number) {
  for (size_t i = 0; i < frames->count; i++)
    if (frames->frames[i] == number)
      return true;
  return false;
}

/* Tells the frames that only one of the films has. */
static cs_exit tell_missing(const cs_sequence *frames, const cs_sequence *others,
                            const char *pattern) {
  cs_exit outcome = CS_EXIT_OK;
  for (size_t i = 0; i < frames->count; i++) {
    if (has_frame(others, frames->frames[i]))
      continue;
    printf("frame %" PRId64 " only_in %s\n", frames->frames[i], pattern);
    outcome = CS_EXIT_DIFFERENT;
  }
  return outcome;
}

/* All frames that both have, and then those that one of them lacks. An error ends the comparison. */
static cs_exit compare_films(celspan_context *context, const cs_request *request,
                             const cs_sequence *a, const cs_sequence *b) {
  bool differs = false;
  for (size_t i = 0; i < a->count; i++) {
    if (!has_frame(b, a->frames[i]))
      continue;
    cs_exit outcome = compare_frame(context, request, a->frames[i]);
    if (outcome != CS_EXIT_OK && outcome != CS_EXIT_DIFFERENT)
      return outcome;
    differs |= outcome == CS_EXIT_DIFFERENT;
  }
  differs |= tell_missing(a, b, request->operands[0]) != CS_EXIT_OK;
  differs |= tell_missing(b, a, request->operands[1]) != CS_EXIT_OK;
  return differs ? CS_EXIT_DIFFERENT : CS_EXIT_OK;
}

static cs_exit list_films(celspan_context *context, const cs_request *request,
                          cs_sequence films[2]) {
  for (size_t i = 0; i < 2; i++) {
    celspan_status status = cs_sequence_list(context, request->operands[i], &films[i]);
    if (status != CELSPAN_OK)
      return cs_report_failure(context, status, NULL);
    if (films[i].count == 0) {
      cs_report_error("%s: there is no file of that pattern", request->operands[i]);
      return CS_EXIT_INPUT;
    }
  }
  return CS_EXIT_OK;
}

static cs_exit compare_patterns(celspan_context *context, const cs_request *request) {
  cs_sequence films[2] = {{0}, {0}};
  cs_exit outcome = CS_EXIT_OK;
  if (request->output && !cs_sequence_has_number(request->output))
    return cs_report_usage(
        "%s: the differences of several frames need a number in the name, such as "
        "difference.####.png",
        request->output);
  outcome = list_films(context, request, films);
  if (outcome == CS_EXIT_OK)
    outcome = compare_films(context, request, &films[0], &films[1]);
  cs_sequence_finish(&films[0]);
  cs_sequence_finish(&films[1]);
  return outcome;
}

cs_exit cs_verb_compare(celspan_context *context, const cs_request *request) {
  const char *a = request->operands[0], *b = request->operands[1];
  cs_exit outcome =
      request->output ? cs_target_refuse(context, request->output, request) : CS_EXIT_OK;
  if (outcome != CS_EXIT_OK)
    return outcome;
  if (cs_sequence_has_number(a) && cs_sequence_has_number(b))
    return compare_patterns(context, request);
  return compare_files(context, request, a, b, request->output);
}
