/* celspan tiles SCRIPT|FILE -o DIR: a frame or a picture as a pyramid of tiles.
 *
 *   subject (what is shown) + pyramid, plan (which tiles) --> record of an earlier run?
 *     --> render (the tiles that are missing) --> page (description and index.html)
 */
#include <inttypes.h>
#include <stdio.h>
#include <strings.h>

#include "cli/tiles/digest.h"
#include "cli/tiles/page.h"
#include "cli/tiles/render.h"
#include "cli/verbs.h"
#include "output/pixels.h"

enum { TILE_LEAST = 16, TILE_MOST = 8192 };

typedef struct tiles_job {
  celspan_context *context;
  const cs_request *request;
  cs_tile_subject subject;
  cs_pyramid pyramid;
  cs_tile_plan plan;
  cs_tile_log log;
  cs_tile_render render;
} tiles_job;

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
                          .width = job->subject.frame.width,
                          .height = job->subject.frame.height,
                          .tile = is_dzi ? 254 : 512,
                          .overlap = is_dzi ? 1 : 0,
                          .folder = request->output,
                          .name = job->subject.name};
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
  const char *folder = job->request->output, *name = job->subject.name;
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
  cs_hash digest =
      cs_tile_digest(job->request, &job->pyramid, &job->subject.frame, job->subject.is_script);
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

/* ---------------------------------------------------------------- the page */

static void code_background(const tiles_job *job, char out[8]) {
  unsigned char pixel[4];
  const celspan_coding coding = {CELSPAN_DEPTH_8, CELSPAN_TRANSFER_SRGB, CELSPAN_ALPHA_STRAIGHT};
  cs_pixels_code(&coding, job->render.background, pixel);
  if (job->render.background[3] <= 0)
    snprintf(out, 8, "#14151a");
  else
    snprintf(out, 8, "#%02x%02x%02x", pixel[0], pixel[1], pixel[2]);
}

static celspan_status write_page(tiles_job *job) {
  cs_tile_page page = {.pyramid = &job->pyramid,
                       .log = &job->log,
                       .plan = &job->plan,
                       .frame = &job->subject.frame,
                       .title = job->subject.title};
  code_background(job, page.background);
  if (job->request->viewer)
    CS_TRY(cs_tile_page_copy_viewer(job->context, &job->pyramid, job->request->viewer));
  return cs_tile_page_write(job->context, &page);
}

static void summarise(const tiles_job *job) {
  const cs_tile_output *output = &job->render.output;
  if (job->request->progress == CS_PROGRESS_NONE)
    return;
  cs_report_note("%" PRIu64 " tiles written, %" PRIu64 " linked to equal ones, %" PRIu64
                 " left out",
                 (uint64_t)output->written, (uint64_t)output->linked, (uint64_t)output->skipped);
}

static cs_exit make_pyramid(tiles_job *job) {
  job->render = (cs_tile_render){.context = job->context,
                                 .request = job->request,
                                 .subject = &job->subject,
                                 .pyramid = &job->pyramid,
                                 .plan = &job->plan,
                                 .log = &job->log};
  cs_tile_subject_background(&job->subject, job->render.background);
  celspan_status status = cs_tile_render_run(&job->render);
  if (status == CELSPAN_OK)
    status = write_page(job);
  if (status == CELSPAN_OK)
    summarise(job);
  cs_exit outcome = cs_report_failure(job->context, status, NULL);
  cs_progress_end(&job->render.progress, (cs_progress_failures){NULL, 0}, (int)outcome);
  return outcome;
}

/* What the end of the run needs, before its beginning. */
static cs_exit find_inputs(tiles_job *job) {
  celspan_status status = job->request->viewer
                              ? cs_tile_page_find_viewer(job->context, job->request->viewer)
                              : CELSPAN_OK;
  return cs_report_failure(job->context, status, NULL);
}

static cs_exit run(tiles_job *job) {
  cs_exit outcome = find_inputs(job);
  if (outcome == CS_EXIT_OK)
    outcome = cs_tile_subject_open(job->context, job->request, &job->subject);
  if (outcome == CS_EXIT_OK)
    outcome = set_pyramid(job);
  if (outcome == CS_EXIT_OK)
    outcome = cs_tile_plan_make(job->context, job->request, &job->pyramid, &job->subject.frame,
                                &job->plan);
  if (outcome != CS_EXIT_OK)
    return outcome;
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
  cs_tile_subject_close(&job.subject);
  return outcome;
}
