/* A span file at another size and through a crop, row by row.
 *
 *   file    |---|---|---|---|---|---|     6 columns
 *   frame   |-----|-----|-----|-----|     4 columns: each is the mean of 1.5 columns of the file
 *
 *   file    |-------|-------|-------|     3 columns
 *   frame   |---|---|---|---|---|---|     6 columns: each lies between two middles of the file's
 *
 * At the file's own size rows are returned as they are. Otherwise each axis is resampled by itself,
 * in linear light. Where the picture shrinks, a pixel is the mean over the area that it covers,
 * computed from the spans in time proportional to their number; where it grows, it is interpolated
 * linearly between the nearest two. Only the rows that the crop covers are read. Memory: a few
 * rows.
 */
#include "writers/still/span_reader.h"

#include <math.h>
#include <string.h>

#include "inside/context.h"

/* Sums below this are rounding errors of steps that cancel. */
#define NOTHING 1e-12

/* One axis: pixels of the file and of the frame, and the part of the frame that is made. */
typedef struct axis_map {
  int32_t source, target;
  int32_t first, count;
} axis_map;

/* A row of the file, resampled to the columns of the frame. */
typedef struct view_line {
  int32_t y; /* -1: none */
  CS_ARRAY(float, colours);
} view_line;

struct cs_span_view {
  celspan_context *context;
  cs_span_reader *file;
  axis_map columns, rows;
  CS_ARRAY(double, sums);   /* 4 a column, and one column more: changes from the column before */
  CS_ARRAY(float, colours); /* 4 a column: the row that is returned */
  view_line lines[2];       /* the last two rows of the file that were used */
  celspan_span span;
};

static bool is_shrunk(const axis_map *axis) { return axis->target < axis->source; }

/* ---------------------------------------------------------------- positions */

static double pixels_each(const axis_map *axis) {
  return (double)axis->source / (double)axis->target;
}

/* Where pixel i of the frame begins in the file: exact at both ends. */
static double position(const axis_map *axis, int32_t i) {
  return (double)((int64_t)i * axis->source) / (double)axis->target;
}

/* The two pixels of the file that pixel i of the frame lies between, and how near the second. */
static double between(const axis_map *axis, int32_t i, int32_t out[2]) {
  double at = (i + 0.5) * pixels_each(axis) - 0.5, low = floor(at);
  int32_t last = axis->source - 1;
  out[0] = low < 0 ? 0 : (int32_t)low;
  out[1] = low < 0 ? 0 : out[0] < last ? out[0] + 1 : last;
  return at - low;
}

/* ---------------------------------------------------------------- sums */

/* A number that is not finite would spoil the whole row, because all columns are summed. */
static double limited(float number) {
  return isnan(number) ? 0 : (double)(number > 65504 ? 65504 : number < -65504 ? -65504 : number);
}

/* The colour changes by `step` at column x of the file. The change is shared between the column of
 * the frame in which it lies and the next one; finish_sums adds all changes up from left to right.
 */
static void add_step(cs_span_view *view, int32_t x, const double step[4]) {
  const axis_map *axis = &view->columns;
  double at = (double)x / pixels_each(axis) - axis->first;
  double column = at < 0 ? 0 : floor(at), rest = at < 0 ? 1 : 1 - (at - column);
  if (column >= axis->count)
    return;
  double *sums = view->sums + 4 * (size_t)column;
  for (int c = 0; c < 4; c++) {
    sums[c] += step[c] * rest;
    sums[4 + c] += step[c] * (1 - rest);
  }
}

static void add_colour(cs_span_view *view, int32_t x, const float colour[4], double weight,
                       double before[4]) {
  double step[4];
  for (int c = 0; c < 4; c++) {
    double now = limited(colour[c]) * weight;
    step[c] = now - before[c];
    before[c] = now;
  }
  add_step(view, x, step);
}

static void add_spans(cs_span_view *view, const celspan_span *spans, size_t count, int32_t x0,
                      double weight) {
  double before[4] = {0};
  for (size_t i = 0; i < count; i++) {
    const celspan_span *span = &spans[i];
    if (span->kind == CELSPAN_SPAN_SINGLE)
      add_colour(view, x0 + span->x0, span->colour, weight, before);
    else
      for (int32_t x = span->x0; x < span->x1; x++)
        add_colour(view, x0 + x, span->array + 4 * (size_t)(x - span->x0), weight, before);
  }
}

static void finish_sums(cs_span_view *view, float *colours) {
  double sum[4] = {0};
  for (int32_t i = 0; i < view->columns.count; i++)
    for (int c = 0; c < 4; c++) {
      sum[c] += view->sums[4 * (size_t)i + (size_t)c];
      colours[4 * (size_t)i + (size_t)c] = fabs(sum[c]) < NOTHING ? 0 : (float)sum[c];
    }
  memset(view->sums, 0, 4 * ((size_t)view->columns.count + 1) * sizeof *view->sums);
}

/* ---------------------------------------------------------------- columns */

/* The columns of the file that are needed. */
static void needed_columns(const axis_map *axis, int32_t *x0, int32_t *x1) {
  int32_t last = axis->first + axis->count - 1, pair[2];
  if (is_shrunk(axis)) {
    double end = ceil(position(axis, last + 1));
    *x0 = (int32_t)position(axis, axis->first);
    *x1 = end < axis->source ? (int32_t)end : axis->source;
  } else {
    between(axis, axis->first, pair);
    *x0 = pair[0];
    between(axis, last, pair);
    *x1 = pair[1] + 1;
  }
}

/* *at: a cursor over the spans. Columns are asked for in ascending order, or at most one column
 * back. */
static void colour_at(const celspan_span *spans, size_t count, size_t *at, int32_t x,
                      float colour[4]) {
  while (*at > 0 && spans[*at].x0 > x)
    --*at;
  while (*at + 1 < count && spans[*at].x1 <= x)
    ++*at;
  celspan_span_colour(&spans[*at], x, colour);
}

static void enlarge(const axis_map *axis, const celspan_span *spans, size_t count, int32_t x0,
                    float *colours) {
  size_t at = 0;
  for (int32_t i = 0; i < axis->count; i++) {
    int32_t pair[2];
    float a[4], b[4];
    double near = between(axis, axis->first + i, pair);
    colour_at(spans, count, &at, pair[0] - x0, a);
    colour_at(spans, count, &at, pair[1] - x0, b);
    for (int c = 0; c < 4; c++)
      colours[4 * (size_t)i + (size_t)c] =
          (float)((double)a[c] + near * ((double)b[c] - (double)a[c]));
  }
}

/* Row y of the file, resampled to the columns of the frame. */
static celspan_status make_line(cs_span_view *view, int32_t y, float *colours) {
  const celspan_span *spans;
  size_t count;
  int32_t x0, x1;
  needed_columns(&view->columns, &x0, &x1);
  CS_TRY(cs_span_reader_row(view->file, y, x0, x1, &spans, &count));
  if (is_shrunk(&view->columns)) {
    add_spans(view, spans, count, x0, 1);
    finish_sums(view, colours);
  } else {
    enlarge(&view->columns, spans, count, x0, colours);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- rows */

/* The mean of all rows that row i of the frame covers, where columns are means too. */
static celspan_status shrink_both(cs_span_view *view, int32_t i) {
  const axis_map *axis = &view->rows;
  double top = position(axis, i), bottom = position(axis, i + 1);
  int32_t x0, x1;
  needed_columns(&view->columns, &x0, &x1);
  for (int32_t y = (int32_t)top; y < bottom && y < axis->source; y++) {
    double from = y > top ? y : top, to = y + 1 < bottom ? y + 1 : bottom;
    const celspan_span *spans;
    size_t count;
    CS_TRY(cs_span_reader_row(view->file, y, x0, x1, &spans, &count));
    add_spans(view, spans, count, x0, (to - from) / (bottom - top));
  }
  finish_sums(view, view->colours);
  return CELSPAN_OK;
}

static celspan_status find_line(cs_span_view *view, int32_t y, const float **out) {
  view_line *line = &view->lines[y & 1]; /* two neighbouring rows are never in one slot */
  if (line->y != y) {
    line->y = -1;
    CS_TRY(make_line(view, y, line->colours));
    line->y = y;
  }
  *out = line->colours;
  return CELSPAN_OK;
}

/* The mean of the rows that row i of the frame covers, where columns are interpolated. */
static celspan_status shrink_rows(cs_span_view *view, int32_t i) {
  const axis_map *axis = &view->rows;
  size_t numbers = 4 * (size_t)view->columns.count;
  double top = position(axis, i), bottom = position(axis, i + 1);
  memset(view->colours, 0, numbers * sizeof *view->colours);
  for (int32_t y = (int32_t)top; y < bottom && y < axis->source; y++) {
    double from = y > top ? y : top, to = y + 1 < bottom ? y + 1 : bottom;
    const float *line;
    CS_TRY(find_line(view, y, &line));
    float weight = (float)((to - from) / (bottom - top));
    for (size_t n = 0; n < numbers; n++)
      view->colours[n] += weight * line[n];
  }
  return CELSPAN_OK;
}

static celspan_status enlarge_rows(cs_span_view *view, int32_t i) {
  int32_t pair[2];
  double near = between(&view->rows, i, pair);
  const float *a, *b;
  CS_TRY(find_line(view, pair[0], &a));
  CS_TRY(find_line(view, pair[1], &b));
  for (size_t n = 0; n < 4 * (size_t)view->columns.count; n++)
    view->colours[n] = (float)((double)a[n] + near * ((double)b[n] - (double)a[n]));
  return CELSPAN_OK;
}

static celspan_status scale_row(cs_span_view *view, int32_t i) {
  if (!is_shrunk(&view->rows))
    return enlarge_rows(view, i);
  return is_shrunk(&view->columns) ? shrink_both(view, i) : shrink_rows(view, i);
}

celspan_status cs_span_view_row(cs_span_view *view, int32_t y, const celspan_span **spans,
                                size_t *span_count) {
  const axis_map *columns = &view->columns, *rows = &view->rows;
  int32_t row = rows->first + y;
  if (columns->source == columns->target && rows->source == rows->target)
    return cs_span_reader_row(view->file, row, columns->first, columns->first + columns->count,
                              spans, span_count);
  CS_TRY(scale_row(view, row));
  view->span =
      (celspan_span){.x1 = columns->count, .kind = CELSPAN_SPAN_ARRAY, .array = view->colours};
  *spans = &view->span;
  *span_count = 1;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- making and freeing */

static celspan_status make_buffers(celspan_context *context, cs_span_view *view) {
  size_t columns = (size_t)view->columns.count;
  CS_TRY(CS_ARRAY_MAKE(context, view->sums, 4 * (columns + 1)));
  CS_TRY(CS_ARRAY_MAKE(context, view->colours, 4 * columns));
  for (int i = 0; i < 2; i++) {
    view->lines[i].y = -1;
    CS_TRY(CS_ARRAY_MAKE(context, view->lines[i].colours, 4 * columns));
  }
  return CELSPAN_OK;
}

celspan_status cs_span_view_create(celspan_context *context, cs_span_reader *file,
                                   const celspan_frame_desc *frame, cs_span_view **out) {
  spanfile_info info = cs_span_reader_info(file);
  cs_span_view *view;
  CS_TRY(CS_MAKE(context, view, 1));
  view->context = context;
  view->file = file;
  bool is_whole = frame->crop_width == 0;
  view->columns = (axis_map){(int32_t)info.width, frame->width, frame->crop_x,
                             is_whole ? frame->width : frame->crop_width};
  view->rows = (axis_map){(int32_t)info.height, frame->height, frame->crop_y,
                          is_whole ? frame->height : frame->crop_height};
  celspan_status status = make_buffers(context, view);
  return CS_GIVE(status, view, cs_span_view_destroy, out);
}

void cs_span_view_destroy(cs_span_view *view) {
  if (!view)
    return;
  cs_memory *memory = view->context->memory;
  CS_ARRAYS_FREE(memory, view, sums, colours);
  for (int i = 0; i < 2; i++)
    CS_ARRAYS_FREE(memory, &view->lines[i], colours, colours);
  cs_mem_free(memory, view, sizeof *view);
}
