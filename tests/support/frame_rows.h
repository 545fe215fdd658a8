/* The rows of a frame, in any order, for tests of the code that makes them:
 *
 *   frame_rows rows;
 *   frame_rows_open(&rows, s, &desc);
 *   const cs_row *row = worker_row(&rows.worker, y);
 *   frame_rows_close(&rows);
 */
#pragma once

#include <stdlib.h>

#include "frames/render/row_worker.h"
#include "tests/support/scene.h"

typedef struct frame_rows {
  celspan_context *context;
  cs_frame frame;
  cs_row_worker worker;
} frame_rows;

/* The caller must keep the objects of the desc until the rows are closed. */
static inline void frame_rows_open(frame_rows *rows, studio *s, const celspan_frame_desc *desc) {
  *rows = (frame_rows){.context = s->context};
  studio_check(s, cs_frame_create(s->context, desc, &rows->frame));
  studio_check(s, cs_row_worker_init(&rows->worker, s->context, &rows->frame));
}

/* Valid until the next call; without spans if a check has failed. */
static inline const cs_row *worker_row(cs_row_worker *worker, int32_t y) {
  static const cs_row none = {0};
  const cs_row *row = &none;
  if (!CHECK(cs_row_worker_row(worker, y, &row) == CELSPAN_OK))
    fprintf(stderr, "  %s\n", celspan_context_error(&worker->context));
  return row;
}

static inline void frame_rows_close(frame_rows *rows) {
  cs_row_worker_finish(&rows->worker);
  cs_frame_free(&rows->frame, rows->context->memory);
}

/* The colour of every column that has a span. */
static inline void row_colours(const cs_row *row, float (*out)[4]) {
  for (size_t i = 0; i < row->count; i++)
    for (int32_t x = row->spans[i].x0; x < row->spans[i].x1; x++)
      celspan_span_colour(&row->spans[i], x, out[x]);
}

/* All colours of a frame, row by row, and the number of its spans of each kind. */
typedef struct image {
  int32_t width, height;
  float (*rgba)[4]; /* allocated; the test must free it */
  uint64_t kinds[3];
} image;

/* Makes the rows 0, step, 2 step .., then 1, 1 + step ..: a row must not depend on the order. */
static inline image make_image(studio *s, const celspan_frame_desc *desc, int32_t step) {
  int32_t width = desc->crop_width ? desc->crop_width : desc->width;
  int32_t height = desc->crop_height ? desc->crop_height : desc->height;
  image out = {width, height, calloc((size_t)width * (size_t)height, sizeof *out.rgba), {0}};
  frame_rows rows;
  frame_rows_open(&rows, s, desc);
  for (int32_t first = 0; first < step; first++)
    for (int32_t y = first; y < height; y += step) {
      const cs_row *row = worker_row(&rows.worker, y);
      row_colours(row, out.rgba + (size_t)y * (size_t)width);
      for (size_t i = 0; i < row->count; i++)
        out.kinds[row->spans[i].kind]++;
    }
  frame_rows_close(&rows);
  return out;
}
