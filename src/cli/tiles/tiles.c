/* celspan tiles SCRIPT|FILE -o DIR: a frame or a picture as a pyramid of tiles.
 *
 *   scene --one pass of rows a level--> rows of spans --cut--> tiles --equal ones linked--> files
 *
 * A level is rendered whole, or in as few passes as the tiles that are wanted of it allow: what a
 * pass costs lies in compiling the scene and in sweeping whole rows, and both are paid once for all
 * tiles of a row, where a tile rendered alone would pay them again.
 */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "base/context.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/script.h"
#include "cli/still.h"
#include "cli/tiles/digest.h"
#include "cli/tiles/page.h"
#include "cli/tiles/small.h"
#include "cli/verbs.h"
#include "output/pixels.h"
#include "scene/scene.h"

enum { TILE_LEAST = 16, TILE_MOST = 8192, WORKERS_MOST = 64, NAME_SIZE = 128 };

typedef struct tiles_job {
  celspan_context *context;
  const cs_request *request;
  cs_script script;
  cs_still still;
  bool is_script;
  const char *title;
  char name[NAME_SIZE];
  celspan_frame_desc frame;
  float background[4]; /* linear, premultiplied */
  cs_pyramid pyramid;
  cs_tile_plan plan;
  cs_tile_log log;
  cs_tile_file files;
  cs_tile_small small;
  cs_progress progress;
  int workers;
} tiles_job;

/* ---------------------------------------------------------------- what is shown */

static bool is_script(const char *path) {
  size_t length = strlen(path);
  return length > 4 && strcasecmp(path + length - 4, ".lua") == 0;
}

/* "shots/night.lua" -> "night" */
static void take_name(const char *path, char name[NAME_SIZE]) {
  const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
  const char *dot = strrchr(base, '.');
  int length = (int)(dot && dot > base ? (size_t)(dot - base) : strlen(base));
  snprintf(name, NAME_SIZE, "%.*s", length, base);
}

static cs_exit open_source(tiles_job *job) {
  const char *path = job->request->operands[0];
  take_name(path, job->name);
  job->title = job->name;
  job->is_script = is_script(path);
  if (!job->is_script) {
    cs_exit outcome = cs_still_open(job->context, path, &job->still);
    return outcome == CS_EXIT_OK ? cs_still_frame(&job->still, job->request, &job->frame) : outcome;
  }
  cs_exit outcome = cs_script_open(job->context, job->request, &job->script);
  if (outcome == CS_EXIT_OK)
    outcome = cs_script_frame(&job->script, job->request, &job->frame);
  if (outcome == CS_EXIT_OK && job->script.film.title)
    job->title = job->script.film.title;
  return outcome;
}

static void close_source(tiles_job *job) {
  if (job->is_script)
    cs_script_close(&job->script);
  else
    cs_still_close(&job->still);
}

/* The light behind everything. */
static void take_background(tiles_job *job) {
  for (size_t i = 0; i < job->frame.exposure_count; i++) {
    const celspan_exposure *exposure = &job->frame.exposures[i];
    celspan_light back = cs_scene_back(exposure->rostrum, exposure->rostrum->back);
    const float light[4] = {back.r, back.g, back.b, back.a};
    for (int c = 0; c < 4; c++)
      job->background[c] += (float)exposure->weight * light[c];
  }
  if (job->background[3] > 1)
    job->background[3] = 1;
}

/* ---------------------------------------------------------------- the pyramid */

static cs_exit choose_picture(const cs_request *request, const char **ending) {
  const char *picture = request->picture ? request->picture : "png";
  bool is_jpeg = strcasecmp(picture, "jpg") == 0 || strcasecmp(picture, "jpeg") == 0;
  *ending = is_jpeg ? "jpg" : "png";
  return is_jpeg || strcasecmp(picture, "png") == 0
             ? CS_EXIT_OK
             : cs_report_usage("--picture: '%s' is not png or jpg", picture);
}

static cs_exit set_pyramid(tiles_job *job) {
  const cs_request *request = job->request;
  bool is_dzi = request->layout == CS_PYRAMID_DZI;
  cs_pyramid *pyramid = &job->pyramid;
  *pyramid = (cs_pyramid){.layout = request->layout,
                          .width = job->frame.width,
                          .height = job->frame.height,
                          .tile = is_dzi ? 254 : 512,
                          .overlap = is_dzi ? 1 : 0,
                          .folder = request->output,
                          .name = job->name};
  if (request->tile.is_given)
    pyramid->tile = request->tile.value;
  if (request->overlap.is_given)
    pyramid->overlap = request->overlap.value;
  if (pyramid->tile < TILE_LEAST || pyramid->tile > TILE_MOST)
    return cs_report_usage("--tile %d: a tile has %d to %d pixels a side", pyramid->tile,
                           TILE_LEAST, TILE_MOST);
  if (!is_dzi && pyramid->overlap > 0)
    return cs_report_usage("--overlap goes with --format dzi: the tiles of IIIF share no pixels");
  if (pyramid->overlap > pyramid->tile / 2)
    return cs_report_usage("--overlap %d: it can be half of a tile's %d pixels at most",
                           pyramid->overlap, pyramid->tile);
  return choose_picture(request, &pyramid->ending);
}

/* ---------------------------------------------------------------- an earlier run */

static cs_exit refuse_state(const tiles_job *job, cs_tile_log_state state) {
  const char *folder = job->request->output, *name = job->name;
  if (state == CS_TILE_LOG_FOREIGN)
    return cs_report_usage("%s already holds a %s%s that was not made by celspan tiles: give "
                           "another folder",
                           folder, name, job->pyramid.layout == CS_PYRAMID_DZI ? "_files" : "");
  return cs_report_usage("%s holds tiles of another scene or of other options: give --fresh to "
                         "remove them, or another folder",
                         folder);
}

static cs_exit open_log(tiles_job *job) {
  celspan_context *context = job->context;
  cs_hash digest = cs_tile_digest(job->request, &job->pyramid, &job->frame, job->is_script);
  cs_tile_log_state state = CS_TILE_LOG_NEW;
  celspan_status status = cs_tile_log_read(context, &job->pyramid, digest, &job->log, &state);
  bool is_known = state == CS_TILE_LOG_SAME || state == CS_TILE_LOG_OTHER;
  if (status == CELSPAN_OK && job->request->is_fresh && is_known)
    status = cs_tile_log_clear(context, &job->pyramid, &job->log);
  else if (status == CELSPAN_OK && (state == CS_TILE_LOG_OTHER || state == CS_TILE_LOG_FOREIGN))
    return refuse_state(job, state);
  if (status == CELSPAN_OK)
    status = cs_tile_log_open(context, &job->log);
  return cs_report_failure(context, status, NULL);
}

/* ---------------------------------------------------------------- rendering */

static bool is_done(const tiles_job *job, const cs_tile_job *part, int32_t row) {
  return cs_tile_log_has(&job->log,
                         (cs_tile_row){part->level, row, part->tiles.x0, part->tiles.x1});
}

/* Rows of tiles from `row` on that are all to be made. */
static int32_t end_of_run(const tiles_job *job, const cs_tile_job *part, int32_t row) {
  while (row < part->tiles.y1 && !is_done(job, part, row))
    row++;
  return row;
}

static celspan_status finished(void *user, celspan_context *context, cs_tile_row row) {
  tiles_job *job = user;
  char what[32];
  CS_TRY(cs_tile_log_add(context, &job->log, row));
  snprintf(what, sizeof what, "level %d", row.level);
  cs_progress_frame(&job->progress, row.row, what, "made");
  return CELSPAN_OK;
}

/* Between strips of rows the bar shows what is finished; a row of tiles is the smallest part. */
static bool go_on(void *user, int32_t rows_done, int32_t rows_total) {
  tiles_job *job = user;
  (void)rows_done, (void)rows_total;
  return cs_progress_tick(&job->progress, 0);
}

/* The whole of a level, to be cut to what is wanted. */
static celspan_frame_desc level_frame(tiles_job *job, int32_t level) {
  celspan_frame_desc frame = job->frame;
  cs_pyramid_size(&job->pyramid, level, &frame.width, &frame.height);
  frame.crop_x = frame.crop_y = frame.crop_width = frame.crop_height = 0;
  frame.progress = go_on;
  frame.progress_user = job;
  return frame;
}

static celspan_status render_frame(tiles_job *job, const celspan_frame_desc *frame,
                                   const celspan_sink *sink) {
  return job->is_script ? celspan_frame_render(job->context, frame, sink, NULL)
                        : cs_still_render(job->context, &job->still, frame, sink);
}

/* A small frame is its own base: it is rendered as it is. */
static bool is_mean(const cs_pyramid *pyramid, int32_t level) {
  return level <= cs_pyramid_within(pyramid, CS_TILE_SMALL_SIDE) &&
         level < cs_pyramid_within(pyramid, CS_TILE_SMALL_BASE);
}

static celspan_status render_base(tiles_job *job) {
  celspan_frame_desc base = level_frame(job, cs_pyramid_within(&job->pyramid, CS_TILE_SMALL_BASE));
  celspan_sink sink;
  CS_TRY(cs_tile_small_begin(job->context, base.width, base.height, &job->small, &sink));
  celspan_status status = render_frame(job, &base, &sink);
  if (status != CELSPAN_OK)
    cs_tile_small_free(job->context, &job->small);
  return status;
}

static celspan_status render_run(tiles_job *job, int32_t level, cs_area tiles) {
  celspan_frame_desc frame = level_frame(job, level);
  cs_area pixels = cs_pyramid_pixels(&job->pyramid, level, &tiles);
  bool is_small = is_mean(&job->pyramid, level);
  if (is_small && !job->small.pixels)
    CS_TRY(render_base(job));
  cs_tile_rows rows = {.files = &job->files,
                       .level = level,
                       .tiles = tiles,
                       .pixels = pixels,
                       .next = tiles.y0,
                       .workers = job->workers,
                       .finished = finished,
                       .user = job};
  celspan_sink sink = cs_tile_rows_sink(&rows);
  if (is_small)
    return cs_tile_small_render(job->context, &job->small, frame.width, frame.height, &sink);
  frame.crop_x = pixels.x0;
  frame.crop_y = pixels.y0;
  frame.crop_width = pixels.x1 - pixels.x0;
  frame.crop_height = pixels.y1 - pixels.y0;
  return render_frame(job, &frame, &sink);
}

static celspan_status render_part(tiles_job *job, const cs_tile_job *part) {
  celspan_status status = CELSPAN_OK;
  for (int32_t row = part->tiles.y0; row < part->tiles.y1 && status == CELSPAN_OK;) {
    int32_t end = end_of_run(job, part, row);
    if (end > row)
      status = render_run(job, part->level, (cs_area){part->tiles.x0, row, part->tiles.x1, end});
    row = end > row ? end : row + 1;
  }
  return status;
}

static size_t count_rows(const tiles_job *job) {
  size_t count = 0;
  for (size_t i = 0; i < job->plan.count; i++) {
    const cs_tile_job *part = &job->plan.jobs[i];
    for (int32_t row = part->tiles.y0; row < part->tiles.y1; row++)
      count += !is_done(job, part, row);
  }
  return count;
}

static int processors(void) {
  long count = sysconf(_SC_NPROCESSORS_ONLN);
  return count < 1 ? 1 : count > WORKERS_MOST ? WORKERS_MOST : (int)count;
}

/* The module that writes JPEG is given one picture at a time. */
static int choose_workers(const tiles_job *job) {
  int asked = job->request->workers;
  if (strcmp(job->pyramid.ending, "png") != 0)
    return 1;
  return asked == 0 ? processors() : asked < WORKERS_MOST ? asked : WORKERS_MOST;
}

/* What is finished stays finished, and the first failure is the one that is told. */
static celspan_status keep_finished(tiles_job *job, celspan_status status) {
  if (status == CELSPAN_OK)
    return cs_tile_log_flush(job->context, &job->log);
  if (status == CELSPAN_CANCELLED && cs_tile_log_flush(job->context, &job->log) != CELSPAN_OK)
    return CELSPAN_OUTPUT;
  return status;
}

static celspan_status render_all(tiles_job *job) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  file.format = job->pyramid.ending;
  cs_tile_file_init(&job->files, job->context, &job->pyramid, &file);
  if (job->request->skips_empty)
    cs_tile_file_skip(&job->files, job->background);
  job->workers = choose_workers(job);
  cs_progress_start(&job->progress, job->request->progress, count_rows(job));
  job->progress.noun = "tile row";
  celspan_status status = CELSPAN_OK;
  for (size_t i = 0; i < job->plan.count && status == CELSPAN_OK; i++)
    status = render_part(job, &job->plan.jobs[i]);
  cs_progress_end(&job->progress, NULL, 0);
  cs_tile_file_finish(&job->files);
  cs_tile_small_free(job->context, &job->small);
  return keep_finished(job, status);
}

/* ---------------------------------------------------------------- the page */

static void code_background(const tiles_job *job, char out[8]) {
  unsigned char pixel[4];
  const celspan_coding coding = {CELSPAN_DEPTH_8, CELSPAN_TRANSFER_SRGB, CELSPAN_ALPHA_STRAIGHT};
  cs_pixels_code(&coding, job->background, pixel);
  if (job->background[3] <= 0)
    snprintf(out, 8, "#14151a");
  else
    snprintf(out, 8, "#%02x%02x%02x", pixel[0], pixel[1], pixel[2]);
}

static celspan_status write_page(tiles_job *job) {
  cs_tile_page page = {.pyramid = &job->pyramid,
                       .log = &job->log,
                       .plan = &job->plan,
                       .frame = &job->frame,
                       .title = job->title};
  code_background(job, page.background);
  CS_TRY(cs_tile_page_write(job->context, &page));
  return job->request->viewer
             ? cs_tile_page_copy_viewer(job->context, &job->pyramid, job->request->viewer)
             : CELSPAN_OK;
}

static void summarise(const tiles_job *job) {
  const cs_tile_file_counts *counts = &job->files.counts;
  if (job->request->progress == CS_PROGRESS_NONE)
    return;
  cs_report_note("%" PRIu64 " tiles written, %" PRIu64 " linked to equal ones, %" PRIu64
                 " left out",
                 counts->written, counts->linked, counts->skipped);
}

static cs_exit make_pyramid(tiles_job *job) {
  celspan_status status = render_all(job);
  if (status == CELSPAN_OK)
    status = write_page(job);
  if (status == CELSPAN_OK)
    summarise(job);
  return cs_report_failure(job->context, status, NULL);
}

static cs_exit run(tiles_job *job) {
  cs_exit outcome = open_source(job);
  if (outcome == CS_EXIT_OK)
    outcome = set_pyramid(job);
  if (outcome == CS_EXIT_OK)
    outcome = cs_tile_plan_make(job->context, job->request, &job->pyramid, &job->frame, &job->plan);
  if (outcome != CS_EXIT_OK)
    return outcome;
  if (job->is_script)
    take_background(job);
  outcome = open_log(job);
  return outcome == CS_EXIT_OK ? make_pyramid(job) : outcome;
}

cs_exit cs_verb_tiles(celspan_context *context, const cs_request *request) {
  tiles_job job = {.context = context, .request = request, .log.descriptor = -1};
  if (!request->output)
    return cs_report_usage("where to? give -o DIR, the folder for the tiles and their page");
  cs_exit outcome = run(&job);
  cs_tile_log_close(context, &job.log);
  cs_tile_plan_free(context, &job.plan);
  close_source(&job);
  return outcome;
}
