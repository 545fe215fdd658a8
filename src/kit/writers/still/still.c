#include "writers/still/still.h"

#include <stdio.h>
#include <string.h>

static celspan_status make_cel(celspan_context *context, celspan_object *object,
                               celspan_cel **out) {
  celspan_cel_desc desc = CELSPAN_CEL_DESC;
  desc.objects = &object;
  desc.object_count = 1;
  return celspan_cel_create(context, &desc, out);
}

/* The background of a picture without alpha is opaque black. The picture hides it everywhere, but
 * it makes the frame opaque, so that files omit the alpha that the picture does not have. */
static celspan_status make_rostrum(celspan_context *context, celspan_cel *cel, bool has_alpha,
                                   celspan_rostrum **out) {
  celspan_rostrum_desc desc = CELSPAN_ROSTRUM_DESC;
  desc.cels = &cel;
  desc.cel_count = 1;
  desc.antialias = CELSPAN_ANTIALIAS_NONE;
  desc.back.a = has_alpha ? 0 : 1;
  return celspan_rostrum_create(context, &desc, out);
}

static celspan_status make_scene(celspan_context *context, const celspan_picture_desc *picture,
                                 const celspan_picture_info *info, celspan_rostrum **out) {
  celspan_image_desc desc = {
      .struct_size = sizeof desc, .picture = picture, .width = info->width, .height = info->height};
  celspan_object *object = NULL;
  celspan_cel *cel = NULL;
  celspan_status status = celspan_object_create_image(context, &desc, &object);
  if (status == CELSPAN_OK)
    status = make_cel(context, object, &cel);
  if (status == CELSPAN_OK)
    status = make_rostrum(context, cel, info->has_alpha, out);
  celspan_cel_unref(cel);
  celspan_object_unref(object);
  return status;
}

static celspan_status open_spans(celspan_context *context, const char *path, cs_still *still) {
  CS_TRY(cs_span_reader_open(context, path, &still->spans));
  spanfile_info info = cs_span_reader_info(still->spans);
  still->info = (celspan_picture_info){.width = (int32_t)info.width,
                                       .height = (int32_t)info.height,
                                       .channels = 4,
                                       .has_alpha = true,
                                       .is_float = info.format == SPANFILE_HALF,
                                       .format = "span"};
  snprintf(still->info.colour, sizeof still->info.colour, "%s",
           still->info.is_float ? "linear" : "srgb");
  return CELSPAN_OK;
}

/* A side in pixels, one for each unit. */
static int32_t pixels(double units) {
  double side = units + 0.5;
  return side < 1 ? 1 : side < INT32_MAX ? (int32_t)side : INT32_MAX;
}

static celspan_status open_plane(celspan_context *context, const char *path, cs_still *still) {
  double width, height;
  CS_TRY(celspan_plane_read(context, path, &still->plane));
  celspan_plane_size(still->plane, &width, &height);
  still->info = (celspan_picture_info){.width = pixels(width),
                                       .height = pixels(height),
                                       .channels = 4,
                                       .has_alpha = !celspan_plane_is_opaque(still->plane),
                                       .is_float = true,
                                       .format = "plane",
                                       .colour = "linear"};
  return CELSPAN_OK;
}

static celspan_status open_picture(celspan_context *context, const char *path, cs_still *still) {
  celspan_picture_desc picture = CELSPAN_PICTURE_DESC;
  picture.file = path;
  still->info = CELSPAN_PICTURE_INFO;
  celspan_status status = celspan_picture_inspect(context, &picture, &still->info);
  if (status == CELSPAN_OK)
    status = make_scene(context, &picture, &still->info, &still->exposure.rostrum);
  return status;
}

/* Chooses the frame of that number, if the file has it. */
static celspan_status choose(celspan_context *context, const char *path, int32_t frame,
                             cs_still *still) {
  double rate;
  int32_t count = still->plane ? celspan_plane_frames(still->plane, &rate) : 1;
  celspan_plane *chosen;
  if (frame < 1 || frame > count)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: there is no frame %d: it has %s %d", path,
                   (int)frame, count > 1 ? "frames 1 to" : "only frame", (int)count);
  if (!still->plane)
    return CELSPAN_OK;
  CS_TRY(cs_plane_choose(context, path, still->plane, frame - 1, &chosen));
  celspan_plane_unref(still->plane);
  still->plane = chosen;
  still->info.has_alpha = !celspan_plane_is_opaque(chosen);
  return CELSPAN_OK;
}

celspan_status cs_still_open(celspan_context *context, const char *path, int32_t frame,
                             cs_still *out) {
  cs_still still = {.exposure.weight = 1};
  celspan_status status = cs_span_reader_accepts(path) ? open_spans(context, path, &still)
                          : cs_plane_accepts(path)     ? open_plane(context, path, &still)
                                                       : open_picture(context, path, &still);
  if (status == CELSPAN_OK && frame != 0)
    status = choose(context, path, frame, &still);
  if (status == CELSPAN_OK)
    *out = still;
  else
    cs_still_close(&still);
  return status;
}

void cs_still_close(cs_still *still) {
  celspan_rostrum_unref(still->exposure.rostrum);
  still->exposure.rostrum = NULL;
  cs_span_reader_close(still->spans);
  still->spans = NULL;
  celspan_plane_unref(still->plane);
  still->plane = NULL;
}

void cs_still_expose(const cs_still *still, celspan_frame_desc *frame) {
  frame->exposures = &still->exposure;
  frame->exposure_count = still->exposure.rostrum ? 1 : 0;
  frame->space = still->space;
}

/* ---------------------------------------------------------------- rows */

static celspan_status create_drawn(celspan_context *context, const cs_still *still,
                                   const celspan_frame_desc *frame, cs_plane_rows **out) {
  celspan_plane_view view = CELSPAN_PLANE_VIEW;
  view.width = frame->width;
  view.height = frame->height;
  view.crop_x = frame->crop_x;
  view.crop_y = frame->crop_y;
  view.crop_width = frame->crop_width;
  view.crop_height = frame->crop_height;
  view.antialias = frame->has_antialias ? frame->antialias : CELSPAN_ANTIALIAS_AREA;
  return cs_plane_rows_create(context, still->plane, &view, out);
}

celspan_status cs_still_rows_create(celspan_context *context, const cs_still *still,
                                    const celspan_frame_desc *frame, cs_still_rows *out) {
  cs_still_rows rows = {NULL, NULL, NULL};
  celspan_status status = still->spans
                              ? cs_span_view_create(context, still->spans, frame, &rows.view)
                          : still->plane ? create_drawn(context, still, frame, &rows.drawn)
                                         : celspan_rows_create(context, frame, &rows.rendered);
  if (status == CELSPAN_OK)
    *out = rows;
  return status;
}

void cs_still_rows_destroy(cs_still_rows *rows) {
  celspan_rows_destroy(rows->rendered);
  cs_span_view_destroy(rows->view);
  cs_plane_rows_destroy(rows->drawn);
  *rows = (cs_still_rows){NULL, NULL, NULL};
}

celspan_status cs_still_rows_get(cs_still_rows *rows, int32_t y, const celspan_span **spans,
                                 size_t *span_count) {
  if (rows->drawn)
    return cs_plane_rows_get(rows->drawn, y, spans, span_count);
  return rows->view ? cs_span_view_row(rows->view, y, spans, span_count)
                    : celspan_rows_get(rows->rendered, y, spans, span_count);
}

/* ---------------------------------------------------------------- sinks and files */

/* Rows between two progress calls. */
enum { PROGRESS_ROWS = 64 };

static celspan_status put_rows(celspan_context *context, cs_still_rows *rows,
                               const celspan_frame_desc *frame, const celspan_sink *sink) {
  int32_t height = frame->crop_height ? frame->crop_height : frame->height;
  for (int32_t y = 0; y < height; y++) {
    const celspan_span *spans;
    size_t count;
    CS_TRY(cs_still_rows_get(rows, y, &spans, &count));
    CS_TRY(sink->row(sink->user, context, y, spans, count));
    if (y % PROGRESS_ROWS == 0 && frame->progress &&
        !frame->progress(frame->progress_user, y, height))
      return CELSPAN_CANCELLED;
  }
  return CELSPAN_OK;
}

/* *is_begun: the sink was begun, and its `end` has been called. */
static celspan_status put_view(celspan_context *context, const cs_still *still,
                               const celspan_frame_desc *frame, const celspan_sink *sink,
                               bool *is_begun) {
  cs_still_rows rows = {NULL, NULL, NULL};
  celspan_status status = cs_still_rows_create(context, still, frame, &rows);
  if (status == CELSPAN_OK && sink->begin)
    status = sink->begin(sink->user, context, frame->crop_width ? frame->crop_width : frame->width,
                         frame->crop_height ? frame->crop_height : frame->height);
  *is_begun = status == CELSPAN_OK;
  if (status == CELSPAN_OK)
    status = put_rows(context, &rows, frame, sink);
  if (*is_begun && sink->end)
    status = sink->end(sink->user, context, status);
  cs_still_rows_destroy(&rows);
  return status;
}

celspan_status cs_still_render(celspan_context *context, const cs_still *still,
                               const celspan_frame_desc *frame, const celspan_sink *sink) {
  bool is_begun;
  return still->exposure.rostrum ? celspan_frame_render(context, frame, sink, NULL)
                                 : put_view(context, still, frame, sink, &is_begun);
}

celspan_status cs_still_write(celspan_context *context, const cs_still *still,
                              const celspan_frame_desc *frame, const char *path,
                              const celspan_file_desc *file) {
  if (still->exposure.rostrum)
    return celspan_frame_write(context, frame, path, file, NULL);
  celspan_sink sink = CELSPAN_SINK;
  bool is_begun = false;
  celspan_status status = celspan_file_sink_create(context, path, file, &sink);
  if (status == CELSPAN_OK) {
    status = put_view(context, still, frame, &sink, &is_begun);
    if (!is_begun)
      status = sink.end(sink.user, context, status);
  }
  return status;
}
