/* Random frames of spans of every kind, the same for the same numbers. */
#pragma once

#include <math.h>
#include <stdint.h>

#include "output/sinks/sink.h"
#include "tests/support/random.h"

static test_random numbers = {1};

/* 0, 1 and the thousandths between them: two numbers are often equal. */
static float random_thousandths(void) { return (float)random_below(&numbers, 1001) / 1000; }

typedef struct frame {
  int32_t width, height;
  int style; /* 0 any mixture, 1 long and flat, 2 pictures, 3 a single colour */
  bool is_opaque;
  float *arrays; /* width pixels */
  celspan_span *spans;
} frame;

static void random_colour(const frame *made, float colour[4]) {
  static const float palette[6] = {0, 1, 0.5f, 0.25f, 0.1f, 0.9f};
  bool clear = random_below(&numbers, 8) == 0, flat = random_below(&numbers, 2) == 0;
  for (int c = 0; c < 4; c++)
    colour[c] = clear ? 0 : flat ? palette[random_below(&numbers, 6)] : random_thousandths();
  if (random_below(&numbers, 2) || made->is_opaque)
    colour[3] = 1;
}

static void fill_array(frame *made, celspan_span *span, int32_t y) {
  float *array = made->arrays + 4 * (size_t)span->x0;
  bool noise = random_below(&numbers, 3) == 0;
  for (int32_t x = span->x0; x < span->x1; x++)
    for (int c = 0; c < 4; c++)
      array[4 * (x - span->x0) + c] = c == 3 && made->is_opaque ? 1
                                      : noise                   ? random_thousandths()
                                              : 0.5f + 0.4f * sinf((float)(x * (c + 1) + y) / 40);
  span->array = array;
}

static int32_t span_length(const frame *made) {
  if (made->style == 3)
    return made->width;
  if (made->style == 1)
    return 1 + random_below(&numbers, random_below(&numbers, 3) ? 3000 : 100000);
  return 1 + random_below(&numbers, random_below(&numbers, 4) ? 12 : 400);
}

static int span_kind(const frame *made) {
  if (made->style == 2)
    return random_below(&numbers, 8) ? CELSPAN_SPAN_ARRAY : CELSPAN_SPAN_GRADIENT;
  return made->style != 0 || random_below(&numbers, 3)
             ? CELSPAN_SPAN_SINGLE
             : CELSPAN_SPAN_GRADIENT + random_below(&numbers, 2);
}

/* A row that depends only on its seed, so that it can be made again. */
static size_t make_row(frame *made, int32_t y) {
  size_t count = 0;
  numbers.state = 1000003u * (uint64_t)(random_below(&numbers, 2) ? y : y / 7) + 12345;
  for (int32_t x = 0; x < made->width; count++) {
    celspan_span *span = &made->spans[count];
    *span = (celspan_span){.x0 = x, .origin = x - random_below(&numbers, 10)};
    int32_t length = span_length(made);
    span->x1 = length < made->width - x ? x + length : made->width;
    span->kind = (celspan_span_kind)span_kind(made);
    random_colour(made, span->colour);
    for (int c = 0; c < 4; c++)
      span->slope[c] = c == 3 && made->is_opaque ? 0 : (random_thousandths() - 0.5f) / 50;
    if (span->kind == CELSPAN_SPAN_ARRAY)
      fill_array(made, span, y);
    x = span->x1;
  }
  return count;
}

/* Some rows repeat the row above: at most seven share a seed. No seed depends on earlier rows. */
static size_t row_of(frame *made, int32_t y) {
  numbers.state = 77 * (uint64_t)y;
  return make_row(made, y);
}

/* Writes the frame to the file of a sink of output/. */
static celspan_status write_frame(celspan_context *context, frame *made, const char *path,
                                  const celspan_file_desc *file) {
  celspan_sink sink;
  celspan_status status = cs_sink_file(context, path, file, &sink);
  if (status != CELSPAN_OK)
    return status;
  status = sink.begin(sink.user, context, made->width, made->height);
  if (status != CELSPAN_OK) {
    cs_sink_discard(context, &sink);
    return status;
  }
  for (int32_t y = 0; y < made->height && status == CELSPAN_OK; y++) {
    size_t count = row_of(made, y);
    status = sink.row(sink.user, context, y, made->spans, count);
  }
  return sink.end(sink.user, context, status);
}
