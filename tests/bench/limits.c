/* What no renderer can beat: `limits DRAWING SIDE` fills a frame's bytes through one reused row, by
 * memset and by the exact runs of colour that the drawing has under point sampling.
 *
 * The runs of at most ROWS_KEPT rows, spread over the frame, are kept and represent the others.
 */
#include <stdlib.h>
#include <string.h>

#include "measure.h"
#include "scene.h"

#define ROWS_KEPT 512

typedef struct run {
  int32_t end; /* column */
  uint32_t colour;
} run;

typedef struct frame_runs {
  int side, row_count;
  run *rows[ROWS_KEPT]; /* each to the column `side` */
  uint64_t run_count;
  uint32_t *band;
} frame_runs;

static uint32_t code(const celspan_span *span) {
  static const celspan_coding coded = {.struct_size = sizeof coded,
                                       .depth = CELSPAN_DEPTH_8,
                                       .transfer = CELSPAN_TRANSFER_SRGB,
                                       .alpha = CELSPAN_ALPHA_STRAIGHT};
  celspan_span one = *span;
  uint32_t pixel;
  one.x0 = 0;
  one.x1 = 1;
  celspan_spans_code(&coded, &one, 1, &pixel);
  return pixel;
}

static void keep_row(frame_runs *frame, const celspan_span *spans, size_t span_count) {
  run *row = malloc(span_count * sizeof *row);
  for (size_t i = 0; i < span_count; i++)
    row[i] = (run){spans[i].x1, code(&spans[i])};
  frame->rows[frame->row_count++] = row;
  frame->run_count += span_count;
}

static void find_runs(celspan_context *context, celspan_rostrum *rostrum, frame_runs *frame) {
  const celspan_antialias_mode mode = CELSPAN_ANTIALIAS_NONE;
  const celspan_exposure exposure = {rostrum, 1};
  celspan_frame_desc desc = bench_frame(&exposure, frame->side, frame->side, &mode);
  celspan_rows *rows;
  const celspan_span *spans;
  size_t span_count;
  bench_check(context, celspan_rows_create(context, &desc, &rows));
  int step = frame->side > ROWS_KEPT ? (frame->side + ROWS_KEPT - 1) / ROWS_KEPT : 1;
  for (int32_t y = 0; y < frame->side; y += step) {
    bench_check(context, celspan_rows_get(rows, y, &spans, &span_count));
    keep_row(frame, spans, span_count);
  }
  celspan_rows_destroy(rows);
}

static void fill_bytes(void *user) {
  const frame_runs *frame = user;
  for (int y = 0; y < frame->side; y++) {
    memset(frame->band, y & 255, 4 * (size_t)frame->side);
    __asm__ volatile("" : : "r"(frame->band) : "memory"); /* not optimised away */
  }
}

static int fill(uint32_t *row, int x, int end, uint32_t colour) {
  for (; x < end; x++)
    row[x] = colour;
  return x;
}

static void fill_runs(void *user) {
  const frame_runs *frame = user;
  for (int y = 0; y < frame->side; y++) {
    const run *at = frame->rows[(size_t)y * (size_t)frame->row_count / (size_t)frame->side];
    for (int x = 0; x < frame->side; at++)
      x = fill(frame->band, x, at->end, at->colour);
    __asm__ volatile("" : : "r"(frame->band) : "memory");
  }
}

int main(int argc, char **argv) {
  celspan_context *context;
  if (argc != 3 || celspan_context_create(NULL, &context) != CELSPAN_OK)
    bench_stop("usage: limits DRAWING SIDE");
  bench_drawing drawing = bench_drawing_read(argv[1]);
  frame_runs frame = {.side = atoi(argv[2])};
  celspan_rostrum *rostrum = bench_scene(context, &drawing, NULL);
  find_runs(context, rostrum, &frame);
  frame.band = malloc(4 * (size_t)frame.side);
  bench_measure(fill_bytes, &frame);
  bench_line_end();
  bench_measure(fill_runs, &frame);
  bench_tell("spans", (double)frame.run_count / frame.row_count * frame.side);
  bench_line_end();
  for (int i = 0; i < frame.row_count; i++)
    free(frame.rows[i]);
  free(frame.band);
  celspan_rostrum_unref(rostrum);
  celspan_context_destroy(context);
  bench_drawing_free(&drawing);
  return 0;
}
