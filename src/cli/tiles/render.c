#include "cli/tiles/render.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/context.h"

enum { WORKERS_MOST = 64 };

static bool is_done(const cs_tile_render *render, const cs_tile_job *job, int32_t row) {
  return cs_tile_log_has(render->log, (cs_tile_row){job->level, row, job->tiles.x0, job->tiles.x1});
}

/* The end of the run of rows of tiles, from `row` on, that all have to be made. */
static int32_t end_of_run(const cs_tile_render *render, const cs_tile_job *job, int32_t row) {
  while (row < job->tiles.y1 && !is_done(render, job, row))
    row++;
  return row;
}

static celspan_status finished(void *user, celspan_context *context, cs_tile_row row) {
  cs_tile_render *render = user;
  char what[32];
  CS_TRY(cs_tile_log_add(context, render->log, row));
  snprintf(what, sizeof what, "level %d", row.level);
  cs_progress_frame(&render->progress, row.row, what, "made");
  return CELSPAN_OK;
}

/* Draws the bar between strips of rows. Its progress counts finished rows of tiles only. */
static bool go_on(void *user, int32_t rows_done, int32_t rows_total) {
  cs_tile_render *render = user;
  (void)rows_done, (void)rows_total;
  return cs_progress_tick(&render->progress, 0);
}

/* The whole of a level; the caller sets the crop. */
static celspan_frame_desc level_frame(cs_tile_render *render, int32_t level) {
  celspan_frame_desc frame = render->subject->frame;
  cs_pyramid_size(render->pyramid, level, &frame.width, &frame.height);
  frame.crop_x = frame.crop_y = frame.crop_width = frame.crop_height = 0;
  frame.progress = go_on;
  frame.progress_user = render;
  return frame;
}

/* Whether the level is a mean of the base; the base itself, which may be small too, is rendered. */
static bool is_mean(const cs_pyramid *pyramid, int32_t level) {
  return level <= cs_pyramid_within(pyramid, CS_TILE_MEANS_SIDE) &&
         level < cs_pyramid_within(pyramid, CS_TILE_MEANS_BASE);
}

static celspan_status render_base(cs_tile_render *render) {
  celspan_frame_desc base =
      level_frame(render, cs_pyramid_within(render->pyramid, CS_TILE_MEANS_BASE));
  celspan_sink sink;
  CS_TRY(cs_tile_means_begin(render->context, base.width, base.height, &render->means, &sink));
  celspan_status status = cs_tile_subject_render(render->subject, &base, &sink);
  if (status != CELSPAN_OK)
    cs_tile_means_free(render->context, &render->means);
  return status;
}

static celspan_status render_run(cs_tile_render *render, int32_t level, cs_pyramid_box tiles) {
  celspan_frame_desc frame = level_frame(render, level);
  cs_pyramid_box pixels = cs_pyramid_pixels(render->pyramid, level, &tiles);
  bool is_mean_level = is_mean(render->pyramid, level);
  if (is_mean_level && !render->means.pixels)
    CS_TRY(render_base(render));
  cs_tile_rows rows = {.output = &render->output,
                       .level = level,
                       .tiles = tiles,
                       .pixels = pixels,
                       .next = tiles.y0,
                       .workers = render->workers,
                       .finished = finished,
                       .user = render};
  celspan_sink sink = cs_tile_rows_sink(&rows);
  if (is_mean_level)
    return cs_tile_means_render(render->context, &render->means, frame.width, frame.height, &sink);
  frame.crop_x = pixels.x0;
  frame.crop_y = pixels.y0;
  frame.crop_width = pixels.x1 - pixels.x0;
  frame.crop_height = pixels.y1 - pixels.y0;
  return cs_tile_subject_render(render->subject, &frame, &sink);
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

static size_t count_rows(const cs_tile_render *render) {
  size_t count = 0;
  for (size_t i = 0; i < render->plan->count; i++) {
    const cs_tile_job *job = &render->plan->jobs[i];
    for (int32_t row = job->tiles.y0; row < job->tiles.y1; row++)
      count += !is_done(render, job, row);
  }
  return count;
}

static int processors(void) {
  long count = sysconf(_SC_NPROCESSORS_ONLN);
  return count < 1 ? 1 : count > WORKERS_MOST ? WORKERS_MOST : (int)count;
}

/* The module that writes JPEG is given one picture at a time. */
static int choose_workers(const cs_tile_render *render) {
  int asked = render->request->workers;
  if (strcmp(render->pyramid->ending, "png") != 0)
    return 1;
  return asked == 0 ? processors() : asked < WORKERS_MOST ? asked : WORKERS_MOST;
}

/* Records what was finished, and keeps the first failure. */
static celspan_status keep_finished(cs_tile_render *render, celspan_status status) {
  if (status == CELSPAN_OK)
    return cs_tile_log_flush(render->context, render->log);
  if (status == CELSPAN_CANCELLED && cs_tile_log_flush(render->context, render->log) != CELSPAN_OK)
    return CELSPAN_OUTPUT;
  return status;
}

celspan_status cs_tile_render_run(cs_tile_render *render) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  file.format = render->pyramid->ending;
  cs_tile_output_init(&render->output, render->context, render->pyramid, &file);
  if (render->request->skips_empty)
    cs_tile_output_skip(&render->output, render->background);
  render->workers = choose_workers(render);
  cs_progress_start(&render->progress, render->request->progress, count_rows(render));
  render->progress.noun = "tile row";
  celspan_status status = CELSPAN_OK;
  for (size_t i = 0; i < render->plan->count && status == CELSPAN_OK; i++)
    status = render_job(render, &render->plan->jobs[i]);
  cs_tile_output_finish(&render->output);
  cs_tile_means_free(render->context, &render->means);
  return keep_finished(render, status);
}
