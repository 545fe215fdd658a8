#include "writers/tiles/tile_render.h"

#include <string.h>

#include "inside/context.h"
#include "inside/sinks.h"
#include "process/interrupt.h"

enum {
  WORKERS_MOST = 64,
  MEAN_BASE = 1024, /* the most pixels on a side of the base of means */
  MEAN_SIDE = 255   /* the most pixels on a side of a level of means */
};

/* ---------------------------------------------------------------- levels that are means */

static size_t pixels_size(const cs_tile_means *base) {
  return (size_t)base->width * (size_t)base->height * 4 * sizeof(float);
}

static void free_means(celspan_context *context, cs_tile_means *base) {
  if (base->pixels)
    cs_mem_free(context->memory, base->pixels, pixels_size(base));
  base->pixels = NULL;
}

/* Allocates the base, and makes the sink that fills it. */
static celspan_status begin_means(celspan_context *context, int32_t width, int32_t height,
                                  cs_tile_means *out, celspan_sink *sink) {
  const celspan_coding coding = {.struct_size = sizeof coding,
                                 .depth = CELSPAN_DEPTH_FLOAT,
                                 .transfer = CELSPAN_TRANSFER_LINEAR,
                                 .alpha = CELSPAN_ALPHA_PREMULTIPLIED};
  cs_tile_means made = {.width = width, .height = height};
  CS_TRY(cs_mem_make(context, (void **)&made.pixels, 1, pixels_size(&made)));
  celspan_status status =
      cs_sink_memory(context, &coding, made.pixels, (size_t)width * 4 * sizeof(float), sink);
  if (status == CELSPAN_OK)
    *out = made;
  else
    free_means(context, &made);
  return status;
}

/* The length of [at, at + 1) inside [from, to). */
static double overlap(int32_t at, double from, double to) {
  double left = at > from ? at : from, right = at + 1 < to ? at + 1 : to;
  return right > left ? right - left : 0;
}

/* The mean over [x0, x1) x [y0, y1). */
static void mean_over(const cs_tile_means *base, double x0, double x1, double y0, double y1,
                      float out[4]) {
  double sum[4] = {0, 0, 0, 0}, all = 0;
  for (int32_t y = (int32_t)y0; y < base->height && y < y1; y++)
    for (int32_t x = (int32_t)x0; x < base->width && x < x1; x++) {
      const float *pixel = base->pixels + 4 * ((size_t)y * (size_t)base->width + (size_t)x);
      double weight = overlap(x, x0, x1) * overlap(y, y0, y1);
      all += weight;
      for (int c = 0; c < 4; c++)
        sum[c] += weight * (double)pixel[c];
    }
  for (int c = 0; c < 4; c++)
    out[c] = (float)(sum[c] / all);
}

/* The crop of the level that the frame describes, row by row. */
static celspan_status put_rows(celspan_context *context, const cs_tile_means *base,
                               const celspan_frame_desc *frame, float *row,
                               const celspan_sink *sink) {
  double across = (double)base->width / frame->width, down = (double)base->height / frame->height;
  int32_t left = frame->crop_x, top = frame->crop_y, width = frame->crop_width;
  const celspan_span span = {.x0 = 0, .x1 = width, .kind = CELSPAN_SPAN_ARRAY, .array = row};
  CS_TRY(sink->begin(sink->user, context, width, frame->crop_height));
  for (int32_t y = top; y < top + frame->crop_height; y++) {
    if (cs_interrupt_signal())
      return CELSPAN_CANCELLED;
    for (int32_t x = left; x < left + width; x++)
      mean_over(base, x * across, (x + 1) * across, y * down, (y + 1) * down,
                row + 4 * (size_t)(x - left));
    CS_TRY(sink->row(sink->user, context, y - top, &span, 1));
  }
  return CELSPAN_OK;
}

/* Puts the crop of a level into a sink, as rendering it would. */
static celspan_status render_mean(celspan_context *context, const cs_tile_means *base,
                                  const celspan_frame_desc *frame, const celspan_sink *sink) {
  size_t size = (size_t)frame->crop_width * 4 * sizeof(float);
  float *row = cs_mem_array(context->memory, 1, size);
  celspan_status status = row ? put_rows(context, base, frame, row, sink) : cs_fail_memory(context);
  status = sink->end(sink->user, context, status);
  cs_mem_free(context->memory, row, size);
  return status;
}

/* ---------------------------------------------------------------- levels */

static bool is_done(const cs_tile_render *render, const cs_tile_job *job, int32_t row) {
  return cs_tile_log_has(render->log, (cs_tile_row){job->level, row, job->tiles.x0, job->tiles.x1});
}

/* The end of the run of rows of tiles, from `row` on, that must all be made. */
static int32_t end_of_run(const cs_tile_render *render, const cs_tile_job *job, int32_t row) {
  while (row < job->tiles.y1 && !is_done(render, job, row))
    row++;
  return row;
}

static celspan_status finished(void *user, celspan_context *context, cs_tile_row row) {
  cs_tile_render *render = user;
  CS_TRY(cs_tile_log_add(context, render->log, row));
  render->finished(render->user, row);
  return CELSPAN_OK;
}

static bool go_on(void *user, int32_t rows_done, int32_t rows_total) {
  const cs_tile_render *render = user;
  (void)rows_done, (void)rows_total;
  return render->tick(render->user);
}

static celspan_frame_desc level_frame(cs_tile_render *render, int32_t level) {
  celspan_frame_desc frame = *render->frame;
  cs_pyramid_size(render->pyramid, level, &frame.width, &frame.height);
  frame.crop_x = frame.crop_y = frame.crop_width = frame.crop_height = 0;
  frame.progress = go_on;
  frame.progress_user = render;
  return frame;
}

/* Whether the level is made of means. The base itself, which may be small too, is rendered. */
static bool is_mean(const cs_pyramid *pyramid, int32_t level) {
  return level <= cs_pyramid_within(pyramid, MEAN_SIDE) &&
         level < cs_pyramid_within(pyramid, MEAN_BASE);
}

static celspan_status render_base(cs_tile_render *render) {
  celspan_frame_desc base = level_frame(render, cs_pyramid_within(render->pyramid, MEAN_BASE));
  celspan_sink sink;
  CS_TRY(begin_means(render->context, base.width, base.height, &render->means, &sink));
  celspan_status status = render->draw(render->user, &base, &sink);
  if (status != CELSPAN_OK)
    free_means(render->context, &render->means);
  return status;
}

/* Draws the pixels of a level into a sink: as means, or from the scene. */
static celspan_status draw_level(cs_tile_render *render, int32_t level, cs_pyramid_box pixels,
                                 const celspan_sink *sink) {
  celspan_frame_desc frame = level_frame(render, level);
  frame.crop_x = pixels.x0;
  frame.crop_y = pixels.y0;
  frame.crop_width = pixels.x1 - pixels.x0;
  frame.crop_height = pixels.y1 - pixels.y0;
  return is_mean(render->pyramid, level)
             ? render_mean(render->context, &render->means, &frame, sink)
             : render->draw(render->user, &frame, sink);
}

static celspan_status render_run(cs_tile_render *render, int32_t level, cs_pyramid_box tiles) {
  cs_tile_rows rows = {.output = &render->output,
                       .level = level,
                       .tiles = tiles,
                       .pixels = cs_pyramid_pixels(render->pyramid, level, &tiles),
                       .next = tiles.y0,
                       .workers = render->threads,
                       .finished = finished,
                       .user = render};
  if (is_mean(render->pyramid, level) && !render->means.pixels)
    CS_TRY(render_base(render));
  celspan_sink sink = cs_tile_rows_sink(&rows);
  return draw_level(render, level, rows.pixels, &sink);
}

static celspan_status render_job(cs_tile_render *render, const cs_tile_job *job) {
  celspan_status status = CELSPAN_OK;
  for (int32_t row = job->tiles.y0; row < job->tiles.y1 && status == CELSPAN_OK;) {
    int32_t end = end_of_run(render, job, row);
    if (end > row)
      status =
          render_run(render, job->level, (cs_pyramid_box){job->tiles.x0, row, job->tiles.x1, end});
    row = end > row ? end : row + 1;
  }
  return status;
}

size_t cs_tile_render_row_count(const cs_tile_render *render) {
  size_t count = 0;
  for (size_t i = 0; i < render->job_count; i++) {
    const cs_tile_job *job = &render->jobs[i];
    for (int32_t row = job->tiles.y0; row < job->tiles.y1; row++)
      count += !is_done(render, job, row);
  }
  return count;
}

/* The module that writes JPEG handles one picture at a time. */
static int choose_threads(const cs_tile_render *render) {
  if (strcmp(render->pyramid->ending, "png") != 0)
    return 1;
  return cs_context_workers(render->context, render->workers, WORKERS_MOST);
}

/* Records the finished rows, and returns the first failure. */
static celspan_status keep_finished(cs_tile_render *render, celspan_status status) {
  if (status == CELSPAN_OK)
    return cs_tile_log_flush(render->context, render->log);
  if (status == CELSPAN_CANCELLED && cs_tile_log_flush(render->context, render->log) != CELSPAN_OK)
    return CELSPAN_OUTPUT;
  return status;
}

celspan_status cs_tile_render_run(cs_tile_render *render) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coding = CELSPAN_CODING;
  file.format = render->pyramid->ending;
  coding.space = render->frame->space;
  file.coding = &coding;
  cs_tile_output_init(&render->output, render->context, render->pyramid, &file);
  render->output.is_sparse = render->is_sparse;
  if (render->skips_empty)
    cs_tile_output_skip(&render->output, render->background);
  render->threads = choose_threads(render);
  celspan_status status = CELSPAN_OK;
  for (size_t i = 0; i < render->job_count && status == CELSPAN_OK; i++)
    status = render_job(render, &render->jobs[i]);
  cs_tile_output_finish(&render->output);
  free_means(render->context, &render->means);
  return keep_finished(render, status);
}
