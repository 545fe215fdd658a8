/* Rows of planes: spans of the subproject become spans of rows. */
#include "celspan/plane.h"
#include "inside/description.h"
#include "inside/frames.h"
#include "inside/scene.h"
#include "inside/sinks.h"
#include "writers/plane/plane.h"
#include "writers/plane/plane_data.h"

CS_DESCRIBE(celspan_plane_view, height, )

struct cs_plane_rows {
  celspan_context *context;
  const celspan_plane *plane;
  planefile_view view;
  planefile_drawer *drawer; /* NULL: no row has been asked for */
  int32_t next;             /* the row that comes next */
  cs_row row;
};

/* ---------------------------------------------------------------- views */

static celspan_status check_view(celspan_context *context, const celspan_plane_view *view,
                                 planefile_view *out) {
  if (view->width < 1 || view->height < 1)
    return cs_fail(context, CELSPAN_LIMIT,
                   "plane: size is %d x %d; each side must be 1 to 2147483647 pixels",
                   (int)view->width, (int)view->height);
  bool is_whole = view->crop_width == 0 && view->crop_height == 0;
  int64_t width = is_whole ? view->width : view->crop_width;
  int64_t height = is_whole ? view->height : view->crop_height;
  if (view->crop_x < 0 || view->crop_y < 0 || width < 1 || height < 1 ||
      view->crop_x + width > view->width || view->crop_y + height > view->height)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "plane: crop %d,%d,%d,%d does not lie inside the frame of %d x %d pixels",
                   (int)view->crop_x, (int)view->crop_y, (int)width, (int)height, (int)view->width,
                   (int)view->height);
  if (view->antialias != CELSPAN_ANTIALIAS_AREA && view->antialias != CELSPAN_ANTIALIAS_NONE)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "plane: it is drawn with area antialiasing, or with none");
  *out =
      (planefile_view){(uint32_t)view->width,
                       (uint32_t)view->height,
                       (uint32_t)view->crop_x,
                       (uint32_t)view->crop_y,
                       (uint32_t)width,
                       (uint32_t)height,
                       view->antialias == CELSPAN_ANTIALIAS_NONE ? PLANEFILE_NONE : PLANEFILE_AREA};
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- rows */

celspan_status cs_plane_rows_create(celspan_context *context, const celspan_plane *plane,
                                    const celspan_plane_view *view, cs_plane_rows **out) {
  planefile_view drawn;
  *out = NULL;
  CS_TRY(check_view(context, view, &drawn));
  CS_TRY(CS_MAKE(context, *out, 1));
  (*out)->context = context;
  (*out)->plane = plane;
  (*out)->view = drawn;
  return CELSPAN_OK;
}

void cs_plane_rows_destroy(cs_plane_rows *rows) {
  if (!rows)
    return;
  planefile_drawer_destroy(rows->drawer);
  cs_row_finish(&rows->row, rows->context->memory);
  cs_mem_free(rows->context->memory, rows, sizeof *rows);
}

/* Begins to draw at a row. */
static celspan_status seek(cs_plane_rows *rows, int32_t y) {
  planefile_view view = rows->view;
  view.y += (uint32_t)y;
  view.rows -= (uint32_t)y;
  planefile_drawer_destroy(rows->drawer);
  rows->next = y;
  return cs_plane_report(rows->context,
                         planefile_drawer_create(rows->plane->plane, &view, &rows->drawer));
}

static celspan_status copy_row(celspan_context *context, const planefile_span *spans, size_t count,
                               cs_row *out) {
  int32_t x = 0;
  out->count = 0;
  for (size_t i = 0; i < count; x = (int32_t)spans[i++].end) {
    cs_v4 colour;
    for (int c = 0; c < 4; c++)
      colour[c] = (float)spans[i].colour.colour[c] / PLANEFILE_WHITE;
    CS_TRY(cs_row_single(context, out, x, (int32_t)spans[i].end, colour));
  }
  return CELSPAN_OK;
}

celspan_status cs_plane_rows_get(cs_plane_rows *rows, int32_t y, const celspan_span **spans,
                                 size_t *count) {
  const planefile_span *drawn;
  size_t drawn_count;
  if (!rows->drawer || y != rows->next)
    CS_TRY(seek(rows, y));
  CS_TRY(cs_plane_report(rows->context, planefile_drawer_row(rows->drawer, &drawn, &drawn_count)));
  rows->next = y + 1;
  CS_TRY(copy_row(rows->context, drawn, drawn_count, &rows->row));
  *spans = rows->row.spans;
  *count = rows->row.count;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- sinks */

static celspan_status send_rows(celspan_context *context, cs_plane_rows *rows,
                                const celspan_sink *sink) {
  for (int32_t y = 0; y < (int32_t)rows->view.rows; y++) {
    const celspan_span *spans;
    size_t count;
    CS_TRY(cs_plane_rows_get(rows, y, &spans, &count));
    if (sink->row)
      CS_TRY(sink->row(sink->user, context, y, spans, count));
  }
  return CELSPAN_OK;
}

/* *ended: the sink's end was called. */
static celspan_status feed(celspan_context *context, cs_plane_rows *rows, const celspan_sink *sink,
                           bool *ended) {
  if (sink->begin)
    CS_TRY(sink->begin(sink->user, context, (int32_t)rows->view.columns, (int32_t)rows->view.rows));
  celspan_status status = send_rows(context, rows, sink);
  *ended = sink->end != NULL;
  celspan_status last = sink->end ? sink->end(sink->user, context, status) : CELSPAN_OK;
  return status == CELSPAN_OK ? last : status;
}

celspan_status celspan_plane_render(celspan_context *context, const celspan_plane *plane,
                                    const celspan_plane_view *view, const celspan_sink *sink) {
  cs_plane_rows *rows;
  bool ended;
  CS_READ(context, "plane", celspan_plane_view, view);
  CS_READ(context, "plane: sink", celspan_sink, sink);
  CS_TRY(cs_plane_rows_create(context, plane, view, &rows));
  celspan_status status = feed(context, rows, sink, &ended);
  cs_plane_rows_destroy(rows);
  return status;
}

celspan_status celspan_plane_pixels(celspan_context *context, const celspan_plane *plane,
                                    const celspan_plane_view *view, const celspan_coding *coding,
                                    void *pixels, size_t stride) {
  cs_plane_rows *rows;
  celspan_sink sink;
  bool ended = false;
  CS_READ(context, "plane", celspan_plane_view, view);
  celspan_coding whole;
  CS_TRY(cs_pixels_read(context, &coding, &whole));
  celspan_coding resolved = cs_pixels_resolve(coding, CELSPAN_DEPTH_8);
  resolved.space = CELSPAN_SPACE_LINEAR;
  CS_TRY(cs_plane_rows_create(context, plane, view, &rows));
  celspan_status status = cs_sink_memory(context, &resolved, pixels, stride, &sink);
  if (status == CELSPAN_OK) {
    status = feed(context, rows, &sink, &ended);
    if (!ended)
      cs_sink_discard(context, &sink);
  }
  cs_plane_rows_destroy(rows);
  return status;
}
