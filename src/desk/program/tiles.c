/* celspan tiles SCRIPT|FILE -o DIR: a frame or a picture as a pyramid of tiles.
 *
 *   subject (a frame of a film, or a picture) + pyramid, plan (which tiles)
 *     --> record of an earlier run?
 *     --> render (the tiles that are missing) --> page (description and index.html)
 */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "inside/scene.h"
#include "inside/sinks.h"
#include "program/film/confine.h"
#include "program/film/script.h"
#include "program/film/shown.h"
#include "program/options/progress.h"
#include "program/options/verbs.h"
#include "writers/tiles/page.h"
#include "writers/tiles/tile_render.h"

enum { TILE_LEAST = 16, TILE_MOST = 8192, TILES_MOST = 200000, NAME_SIZE = 128 };

typedef struct tiles_job {
  celspan_context *context;
  const cs_request *request;
  const char *output;
  bool skips_empty;
  bool is_film;
  cs_script script;         /* open if is_film */
  cs_still still;           /* open if it is not a film */
  celspan_frame_desc frame; /* the whole frame, under the options */
  char name[NAME_SIZE];
  const char *title;
  cs_pyramid pyramid;
  cs_tile_plan plan;
  cs_tile_log log;
  cs_tile_render render;
  cs_progress progress;
} tiles_job;

/* ---------------------------------------------------------------- the subject */

static bool is_film(const cs_request *request) {
  const char *path = request->operands[0];
  size_t length = strlen(path);
  return request->script || cs_shown_is_film(path) ||
         (length > 4 && strcasecmp(path + length - 4, ".lua") == 0);
}

/* "shots/night.lua" -> "night" */
static void set_name(const char *path, char name[NAME_SIZE]) {
  const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
  const char *dot = strrchr(base, '.');
  int length = (int)(dot && dot > base ? (size_t)(dot - base) : strlen(base));
  snprintf(name, NAME_SIZE, "%.*s", length, base);
}

static cs_exit open_still(tiles_job *job) {
  CS_TRY_EXIT(cs_confine_refuse(job->request));
  CS_TRY_EXIT(
      cs_shown_open(job->context, job->request, job->request->operands[0], true, &job->still));
  return cs_shown_frame(job->request, &job->still, &job->frame);
}

static cs_exit open_script(tiles_job *job) {
  CS_TRY_EXIT(cs_script_open(job->context, job->request, job->request->operands[0], &job->script));
  CS_TRY_EXIT(cs_script_frame(&job->script, job->request, &job->frame));
  if (job->script.film.title)
    job->title = job->script.film.title;
  return CS_EXIT_OK;
}

static cs_exit open_subject(tiles_job *job) {
  const char *path = job->request->operands[0];
  job->is_film = is_film(job->request);
  job->title = job->name;
  set_name(path, job->name);
  return job->is_film ? open_script(job) : open_still(job);
}

static void close_subject(tiles_job *job) {
  if (job->is_film)
    cs_script_close(&job->script);
  else
    cs_still_close(&job->still);
}

/* The back light of a rostrum, premultiplied, in the space of the film. */
static void find_back(const celspan_rostrum *rostrum, celspan_space film, float out[4]) {
  celspan_space space = cs_space_inside(rostrum->space, film);
  const cs_light scaled = cs_scene_back(rostrum, &rostrum->back);
  celspan_light back = cs_light_in(&scaled, space);
  const float light[4] = {back.r, back.g, back.b, back.a};
  memcpy(out, light, sizeof light);
  for (int c = 0; c < 3 && space != film; c++)
    out[c] = cs_space_channel(film, out[c], out[3]);
}

/* The background, premultiplied, in the space of the film; transparent for a picture. */
static void set_background(const tiles_job *job, float out[4]) {
  celspan_space film = cs_space_inside(job->frame.space, CELSPAN_SPACE_LINEAR);
  size_t count = job->is_film ? job->frame.exposure_count : 0;
  bool is_plain = count == 1 && job->frame.exposures[0].weight == 1;
  memset(out, 0, 4 * sizeof *out);
  for (size_t i = 0; i < count; i++) {
    float back[4];
    find_back(job->frame.exposures[i].rostrum, film, back);
    if (!is_plain)
      cs_space_decode(film, back);
    for (int c = 0; c < 4; c++)
      out[c] += (float)job->frame.exposures[i].weight * back[c];
  }
  if (out[3] > 1)
    out[3] = 1;
  if (!is_plain)
    cs_space_encode(film, out);
}

static celspan_status draw(void *user, const celspan_frame_desc *frame, const celspan_sink *sink) {
  const tiles_job *job = user;
  return job->is_film ? celspan_frame_render(job->context, frame, sink, NULL)
                      : cs_still_render(job->context, &job->still, frame, sink);
}

/* ---------------------------------------------------------------- the pyramid */

static cs_exit choose_picture(const cs_request *request, const char **ending) {
  const char *given = cs_request_text(request, "--picture"), *picture = given ? given : "png";
  bool is_jpeg = strcasecmp(picture, "jpg") == 0 || strcasecmp(picture, "jpeg") == 0;
  *ending = is_jpeg ? "jpg" : "png";
  return is_jpeg || strcasecmp(picture, "png") == 0
             ? CS_EXIT_OK
             : cs_report_usage("--picture: '%s' is not png or jpg", picture);
}

static cs_exit set_pyramid(tiles_job *job) {
  const cs_request *request = job->request;
  cs_pyramid_layout layout = CS_PYRAMID_DZI;
  cs_request_read(request, "--format", &layout);
  bool is_dzi = layout == CS_PYRAMID_DZI;
  cs_pyramid *pyramid = &job->pyramid;
  *pyramid = (cs_pyramid){.layout = layout,
                          .width = job->frame.width,
                          .height = job->frame.height,
                          .tile = is_dzi ? 254 : 512,
                          .overlap = is_dzi ? 1 : 0,
                          .folder = job->output,
                          .name = job->name};
  cs_request_read(request, "--tile", &pyramid->tile);
  cs_request_read(request, "--overlap", &pyramid->overlap);
  if (pyramid->tile < TILE_LEAST || pyramid->tile > TILE_MOST)
    return cs_report_usage("--tile %d: a tile has %d to %d pixels a side", pyramid->tile,
                           TILE_LEAST, TILE_MOST);
  if (!is_dzi && pyramid->overlap > 0)
    return cs_report_usage("--overlap is only for --format dzi: the tiles of IIIF share no "
                           "pixels");
  if (pyramid->overlap > pyramid->tile / 2)
    return cs_report_usage("--overlap %d: it can be half of a tile's %d pixels at most",
                           pyramid->overlap, pyramid->tile);
  return choose_picture(request, &pyramid->ending);
}

/* ---------------------------------------------------------------- the plan */

static cs_exit choose_levels(const cs_request *request, const cs_pyramid *pyramid,
                             int32_t levels[2]) {
  int32_t top = cs_pyramid_top(pyramid);
  levels[0] = pyramid->layout == CS_PYRAMID_IIIF ? cs_pyramid_single(pyramid) : 0;
  levels[1] = top;
  cs_request_read(request, "--levels", levels);
  return levels[1] <= top
             ? CS_EXIT_OK
             : cs_report_usage("--levels %d-%d: a frame of %d x %d pixels has levels "
                               "0 to %d",
                               levels[0], levels[1], pyramid->width, pyramid->height, top);
}

static cs_exit check_limit(const tiles_job *job, const cs_tile_plan_desc *desc) {
  int32_t limit = TILES_MOST;
  cs_request_read(job->request, "--tiles-limit", &limit);
  int64_t count = cs_tile_plan_count(&job->plan), fitting;
  if (count <= limit)
    return CS_EXIT_OK;
  int32_t last = cs_tile_plan_last_within(desc, limit, &fitting);
  char advice[96] = "";
  if (last >= 0)
    snprintf(advice, sizeof advice, "give --levels %d-%d for %" PRId64 " of them, or ",
             desc->levels[0], last, fitting);
  cs_report_error("levels %d to %d have %" PRId64
                  " tiles, and the limit is %d: %sraise --tiles-limit",
                  desc->levels[0], job->plan.jobs[job->plan.count - 1].level, count, limit, advice);
  return CS_EXIT_LIMIT;
}

static cs_exit make_plan(tiles_job *job) {
  cs_tile_plan_desc desc = {.pyramid = &job->pyramid,
                            .frame = &job->frame,
                            .places = cs_request_text(job->request, "--places")};
  CS_TRY_EXIT(choose_levels(job->request, &job->pyramid, desc.levels));
  celspan_status status = cs_tile_plan_make(job->context, &desc, &job->plan);
  if (status == CELSPAN_BAD_ARGUMENT)
    return cs_report_usage("%s", celspan_context_error(job->context));
  CS_TRY_EXIT(cs_report_failure(job->context, status, NULL));
  return check_limit(job, &desc);
}

/* ---------------------------------------------------------------- an earlier run */

static cs_exit refuse_state(const tiles_job *job, cs_tile_log_state state) {
  const char *folder = job->output;
  if (state == CS_TILE_LOG_FOREIGN)
    return cs_report_usage("%s already holds a %s%s that was not made by celspan tiles: give "
                           "another folder",
                           folder, job->name,
                           job->pyramid.layout == CS_PYRAMID_DZI ? "_files" : "");
  return cs_report_usage("%s holds tiles of another scene or of other options: give --fresh to "
                         "remove them, or another folder",
                         folder);
}

static cs_exit open_log(tiles_job *job) {
  const cs_request *request = job->request;
  const cs_tile_inputs inputs = {.frame = &job->frame,
                                 .file = request->operands[0],
                                 .is_script = job->is_film,
                                 .given = job->script.given,
                                 .skips_empty = job->skips_empty};
  cs_tile_log_state state = CS_TILE_LOG_NEW;
  celspan_status status = cs_tile_log_find(job->context, &job->pyramid, &inputs, &job->log, &state);
  bool is_known = state == CS_TILE_LOG_SAME || state == CS_TILE_LOG_OTHER;
  if (status == CELSPAN_OK && cs_request_has(request, "--fresh") && is_known)
    status = cs_tile_log_clear(job->context, &job->pyramid, &job->log);
  else if (status == CELSPAN_OK && (state == CS_TILE_LOG_OTHER || state == CS_TILE_LOG_FOREIGN))
    return refuse_state(job, state);
  if (status == CELSPAN_OK)
    status = cs_tile_log_open(job->context, &job->pyramid, &job->log);
  return cs_report_failure(job->context, status, NULL);
}

/* ---------------------------------------------------------------- the page */

static void code_background(const tiles_job *job, char out[8]) {
  unsigned char pixel[4];
  const celspan_coding coding = {.struct_size = sizeof coding,
                                 .depth = CELSPAN_DEPTH_8,
                                 .transfer = CELSPAN_TRANSFER_SRGB,
                                 .alpha = CELSPAN_ALPHA_STRAIGHT,
                                 .space = job->frame.space};
  cs_pixels_code(&coding, job->render.background, pixel);
  if (job->render.background[3] <= 0)
    snprintf(out, 8, "#14151a");
  else
    snprintf(out, 8, "#%02x%02x%02x", pixel[0], pixel[1], pixel[2]);
}

static celspan_status write_page(const tiles_job *job) {
  cs_tile_page page = {.pyramid = &job->pyramid,
                       .log = &job->log,
                       .plan = &job->plan,
                       .frame = &job->frame,
                       .title = job->title};
  code_background(job, page.background);
  const char *viewer = cs_request_text(job->request, "--viewer");
  if (viewer)
    CS_TRY(cs_tile_page_copy_viewer(job->context, &job->pyramid, viewer));
  return cs_tile_page_write(job->context, &page);
}

/* ---------------------------------------------------------------- the run */

static void finished(void *user, cs_tile_row row) {
  tiles_job *job = user;
  char what[32];
  snprintf(what, sizeof what, "level %d", row.level);
  cs_progress_frame(&job->progress, row.row, what, "made");
}

/* The progress counts only finished rows of tiles. */
static bool tick(void *user) {
  tiles_job *job = user;
  return cs_progress_tick(&job->progress, 0);
}

static void summarise(const tiles_job *job) {
  const cs_tile_output *output = &job->render.output;
  if (job->progress.style == CS_PROGRESS_NONE)
    return;
  cs_report_note("%" PRIu64 " tiles written, %" PRIu64 " linked to equal ones, %" PRIu64
                 " left out",
                 (uint64_t)output->written, (uint64_t)output->linked, (uint64_t)output->skipped);
}

static cs_exit make_pyramid(tiles_job *job) {
  job->render = (cs_tile_render){.context = job->context,
                                 .frame = &job->frame,
                                 .pyramid = &job->pyramid,
                                 .plan = &job->plan,
                                 .log = &job->log,
                                 .skips_empty = job->skips_empty,
                                 .draw = draw,
                                 .finished = finished,
                                 .tick = tick,
                                 .user = job};
  set_background(job, job->render.background);
  cs_request_read(job->request, "--workers", &job->render.workers);
  cs_progress_start(&job->progress, job->request, CS_PROGRESS_AUTO,
                    cs_tile_render_row_count(&job->render));
  job->progress.noun = "tile row";
  celspan_status status = cs_tile_render_run(&job->render);
  if (status == CELSPAN_OK)
    status = write_page(job);
  if (status == CELSPAN_OK)
    summarise(job);
  cs_exit outcome = cs_report_failure(job->context, status, NULL);
  cs_progress_end(&job->progress, (cs_progress_failures){NULL, 0}, (int)outcome);
  return outcome;
}

/* Checks inputs that are only used at the end of the run. */
static cs_exit find_inputs(const tiles_job *job) {
  const char *viewer = cs_request_text(job->request, "--viewer");
  celspan_status status = viewer ? cs_tile_page_find_viewer(job->context, viewer) : CELSPAN_OK;
  return cs_report_failure(job->context, status, NULL);
}

static cs_exit run(tiles_job *job) {
  CS_TRY_EXIT(find_inputs(job));
  CS_TRY_EXIT(open_subject(job));
  CS_TRY_EXIT(set_pyramid(job));
  CS_TRY_EXIT(make_plan(job));
  CS_TRY_EXIT(open_log(job));
  return make_pyramid(job);
}

cs_exit cs_verb_tiles(celspan_context *context, const cs_request *request) {
  tiles_job job = {.context = context,
                   .request = request,
                   .output = cs_request_text(request, "-o"),
                   .skips_empty = cs_request_has(request, "--skip-empty"),
                   .log.descriptor = -1};
  if (!job.output)
    return cs_report_usage("-o is missing: give -o DIR, the folder for the tiles and their page");
  cs_exit outcome = run(&job);
  cs_tile_log_close(context, &job.log);
  cs_tile_plan_free(context, &job.plan);
  close_subject(&job);
  return outcome;
}
