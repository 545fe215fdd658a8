/* celspan render SCRIPT -o OUT: the frames of a film. One file, because all steps share the state
 * of one run.
 *
 *   target (where to) -> shoot (frames/film/shoot.h: build, make, copy) -> finished, frame by frame
 *
 * Everything that can be refused is refused before the first frame is made. A frame that fails ends
 * the run, except under --keep-going; the frames before it are complete and stay.
 */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "inside/context.h"
#include "inside/files.h"
#include "program/film/change.h"
#include "program/film/view.h"
#include "program/options/progress.h"
#include "program/options/summary.h"
#include "program/options/verbs.h"
#include "program/outputs/outlets.h"
#include "program/outputs/outputs.h"
#include "program/outputs/record.h"
#include "program/outputs/target.h"
#include "program/outputs/video_target.h"
#include "program/outputs/whole.h"
#include "writers/apart/apart.h"

typedef struct render_job {
  celspan_coding coding; /* the coding of its files */
  cs_script *script;
  const cs_request *request;
  const char *output; /* NULL: digests alone */
  bool has_digests, resumes, keeps_going;
  bool has_noted; /* that layers do not add up to the frame */
  cs_frame_change change;
  celspan_frame_desc frame;
  cs_sequence frames;
  cs_sequence played; /* the frames of the film whose sound is heard; none: those of `frames` */
  const cs_output *row;
  cs_progress progress;
  cs_summary summary;
  cs_record record;        /* the record of frames that are files */
  cs_whole whole;          /* of a film that is one file */
  bool surveys;            /* frames are built, but not rendered */
  const cs_outlet *outlet; /* NULL: frames are files, or are only hashed */
  cs_into into;            /* of the outlet */
  int64_t *failed;         /* frames; owned */
  size_t failed_count, failed_capacity;
  cs_exit outcome; /* the outcome of the reported failure */
} render_job;

/* ---------------------------------------------------------------- outlets */

static bool is_video(const render_job *job) { return job->outlet == &cs_outlet_video; }

static bool is_whole(const render_job *job) { return job->outlet && job->outlet->is_file; }

static celspan_status put(void *user, const cs_shoot_put *one) {
  render_job *job = user;
  return job->outlet->put(&job->into, one);
}

static celspan_status give(void *user, size_t slot) {
  render_job *job = user;
  return job->outlet->give(&job->into, slot);
}

static celspan_status repeat(void *user) {
  render_job *job = user;
  return job->outlet->repeat(&job->into);
}

static void add_outlet(const render_job *job, cs_shoot *shoot) {
  const cs_outlet *outlet = job->outlet;
  shoot->put = put;
  shoot->slots = outlet->slots ? outlet->slots(&job->into) : 0;
  if (shoot->slots > 0) {
    shoot->give = give;
    shoot->repeat = outlet->repeat ? repeat : NULL;
  }
}

/* ---------------------------------------------------------------- files */

static celspan_status write_frame(void *user, celspan_context *context,
                                  const celspan_frame_desc *desc, const char *path,
                                  const celspan_file_desc *file) {
  const render_job *job = user;
  const cs_page page = {.frame = desc, .path = path, .file = file};
  return job->row->write(context, job->request, job->row, &page);
}

static bool keep(void *user, cs_shoot_frame *frame) {
  render_job *job = user;
  if (!is_whole(job))
    return cs_record_has(&job->record, frame);
  cs_whole_add(&job->whole, frame);
  return job->surveys;
}

static bool tick(void *user, double share) {
  render_job *job = user;
  return cs_progress_tick(&job->progress, share);
}

/* ---------------------------------------------------------------- reports */

static celspan_status remember_failure(render_job *job, int64_t number) {
  CS_TRY(
      CS_RESERVE(job->script->context, job->failed, job->failed_capacity, job->failed_count + 1));
  job->failed[job->failed_count++] = number;
  return CELSPAN_OK;
}

/* Reports a frame that failed, and remembers it. Under --keep-going the run continues. */
static celspan_status report_failure(render_job *job, int64_t number, celspan_status status) {
  cs_exit outcome = cs_report_frame_failure(job->script->context, status, number);
  celspan_status remembered =
      outcome == CS_EXIT_SIGNAL ? CELSPAN_OK : remember_failure(job, number);
  if (outcome != CS_EXIT_SIGNAL && job->keeps_going)
    return remembered;
  job->outcome = outcome;
  return status;
}

static const char *destination_of(const render_job *job, const cs_shoot_frame *frame) {
  const char *output = job->output;
  return !output         ? "hashed"
         : is_whole(job) ? output
         : job->outlet   ? "standard output"
                         : frame->path;
}

/* Says once in a run that layers over each other are not the frame. */
static void tell_layers(render_job *job, int64_t number, const cs_film_frame *built) {
  char why[CS_APART_WHY];
  const celspan_coding coding = cs_target_coding(job->request);
  if (!cs_request_has(job->request, "--layers") || job->has_noted ||
      cs_apart_sums(built->exposures, built->count, job->row->layers, &coding,
                    job->script->film.space, why))
    return;
  cs_report_note("frame %" PRId64 ": its layers over each other are not the frame: %s", number,
                 why);
  job->has_noted = true;
}

static celspan_status build(void *user, int64_t number, cs_film_frame *out) {
  render_job *job = user;
  cs_film_frame built;
  CS_TRY(cs_lua_film_build(job->script->L, CS_SCRIPT_FILM, number, &built));
  celspan_status status = cs_change_frame(job->script->context, &job->change, &built);
  if (status == CELSPAN_OK)
    tell_layers(job, number, &built);
  if (status == CELSPAN_OK)
    *out = built;
  else
    cs_film_frame_finish(&built);
  return status;
}

static celspan_status finished(void *user, const cs_shoot_frame *frame, celspan_status status) {
  static const char *const ways[] = {"made", "copied", "kept"};
  render_job *job = user;
  if (job->surveys)
    return status;
  if (status == CELSPAN_OK && job->resumes && !is_whole(job))
    status = cs_record_add(&job->record, frame);
  if (status != CELSPAN_OK)
    return report_failure(job, frame->number, status);
  if (job->has_digests)
    printf("%" PRId64 " %016" PRIx64 "%016" PRIx64 "\n", frame->number, frame->digest[0],
           frame->digest[1]);
  cs_summary_add(&job->summary, frame);
  cs_progress_frame(&job->progress, frame->number, destination_of(job, frame), ways[frame->way]);
  return CELSPAN_OK;
}

/* "2, 5-6": the frames that failed, in the order of the run; "2, 5-6, ..." if there is no room for
 * all. */
static void list_failed(const render_job *job, char *out, size_t size) {
  static const char more[] = ", ...";
  const int64_t *failed = job->failed;
  size_t length = 0;
  for (size_t i = 0, end; i < job->failed_count; i = end) {
    char run[48];
    for (end = i + 1; end < job->failed_count && failed[end] == failed[end - 1] + 1;)
      end++;
    int added = snprintf(run, sizeof run, "%s%" PRId64, i ? ", " : "", failed[i]);
    if (end > i + 1)
      added += snprintf(run + added, sizeof run - (size_t)added, "-%" PRId64, failed[end - 1]);
    if (length + (size_t)added + sizeof more > size) {
      memcpy(out + length, more, sizeof more);
      return;
    }
    memcpy(out + length, run, (size_t)added + 1);
    length += (size_t)added;
  }
}

static cs_exit sum_up(const render_job *job, cs_exit outcome) {
  char list[1024];
  size_t done = job->progress.frames_done, count = job->frames.count;
  if (done < count && count > 1 && is_whole(job))
    cs_report_note("%s was not made: the run ended after %zu of %zu frames", job->output, done,
                   count);
  else if (done < count && count > 1)
    cs_report_note("%zu of %zu frames are finished", done, count);
  if (job->failed_count == 0 || !job->keeps_going)
    return outcome;
  list_failed(job, list, sizeof list);
  cs_report_error("%zu of %zu frames failed: %s", job->failed_count, count, list);
  return outcome == CS_EXIT_OK ? CS_EXIT_PARTIAL : outcome;
}

static cs_exit write_summary(const render_job *job, cs_exit outcome) {
  const cs_summary_run run = {.request = job->request,
                              .progress = &job->progress,
                              .failed = {job->failed, job->failed_count},
                              .outcome = outcome,
                              .has_video =
                                  is_video(job) && cs_video_target_runs_ffmpeg(job->request)};
  cs_exit written = cs_summary_write(&job->summary, job->script->context, &run);
  return outcome == CS_EXIT_OK ? written : outcome;
}

/* All messages come before the end is reported. */
static cs_exit report_end(render_job *job, cs_exit outcome) {
  cs_progress_failures failed = {job->failed, job->failed_count};
  outcome = cs_report_flush_output(sum_up(job, outcome));
  outcome = write_summary(job, outcome);
  cs_progress_end(&job->progress, failed, (int)outcome);
  return outcome;
}

/* ---------------------------------------------------------------- the run */

static celspan_file_desc describe_file(render_job *job) {
  celspan_file_desc file = cs_target_file(job->request, &job->coding);
  bool is_strip = cs_request_has(job->request, "--strip");
  file.strip_row = is_strip ? job->frame.crop_y : 0;
  file.strip_height = is_strip ? job->frame.height : 0;
  return file;
}

static bool keeps_nothing(const render_job *job) {
  int32_t memory = 1;
  return cs_request_read(job->request, "--memory", &memory) && memory == 0;
}

static celspan_status run_shoot(render_job *job) {
  cs_shoot shoot = {.context = job->script->context,
                    .film = job->script->film,
                    .frames = &job->frames,
                    .pattern = job->outlet ? NULL : job->output,
                    .frame = job->frame,
                    .file = describe_file(job),
                    .has_digests = job->has_digests,
                    .keeps_going = job->keeps_going,
                    .keeps_nothing = keeps_nothing(job),
                    .user = job,
                    .write = job->row->write ? write_frame : NULL,
                    .hash = job->row->layers ? cs_apart_hash : NULL,
                    .keep = job->resumes ? keep : NULL,
                    .build = build,
                    .finished = finished,
                    .tick = tick};
  if (job->outlet)
    add_outlet(job, &shoot);
  return cs_shoot_run(&shoot);
}

static cs_exit shoot(render_job *job) {
  celspan_status status = run_shoot(job);
  return job->outcome != CS_EXIT_OK ? job->outcome
                                    : cs_report_failure(job->script->context, status, NULL);
}

/* Gives the file its final name, and adds it to the record. */
static celspan_status complete(render_job *job) {
  celspan_context *context = job->script->context;
  context->contents = job->resumes ? &job->whole.file.contents : NULL;
  celspan_status status = job->outlet->commit(&job->into);
  context->contents = NULL;
  return status == CELSPAN_OK && job->resumes ? cs_whole_finish(&job->whole) : status;
}

/* The frames of a video are finished only when the whole file is. */
static cs_exit shoot_into(render_job *job) {
  cs_exit outcome = shoot(job);
  if (outcome != CS_EXIT_OK) { /* it has been reported */
    job->outlet->discard(&job->into);
    return outcome;
  }
  CS_TRY_EXIT(cs_report_failure(job->script->context, complete(job), NULL));
  return is_video(job) ? cs_video_target_add_poster(job->script, job->request, &job->frame)
                       : CS_EXIT_OK;
}

static void start_progress(render_job *job) {
  cs_progress_start(&job->progress, job->request, CS_PROGRESS_AUTO, job->frames.count);
}

static cs_exit render_all(render_job *job) {
  start_progress(job);
  return report_end(job, job->outlet ? shoot_into(job) : shoot(job));
}

static cs_exit resume_frames(render_job *job) {
  celspan_status status = cs_record_open(&job->record, job->script, job->request, &job->frame);
  cs_exit outcome = cs_report_failure(job->script->context, status, NULL);
  if (outcome == CS_EXIT_OK)
    outcome = render_all(job);
  cs_record_close(&job->record);
  return outcome;
}

static cs_exit make_into(render_job *job) {
  job->into = (cs_into){.script = job->script,
                        .request = job->request,
                        .path = job->output,
                        .frame = &job->frame,
                        .frames = &job->frames,
                        .played = job->played.count ? &job->played : &job->frames,
                        .keeps_nothing = keeps_nothing(job)};
  CS_TRY_EXIT(job->outlet->open(&job->into));
  return render_all(job);
}

static cs_exit begin_whole(render_job *job) {
  celspan_status status = cs_whole_begin(&job->whole, job->script, job->request, &job->frames);
  return cs_report_failure(job->script->context, status, NULL);
}

/* Builds the frames to find out whether the existing file would be the same. A frame that fails is
 * not reported here, but when the file is made: after the start of the run, and before its end. */
static bool is_unchanged(render_job *job) {
  job->surveys = true;
  celspan_status status = run_shoot(job);
  job->surveys = false;
  bool is_all = !is_video(job) || cs_video_target_has_poster(job->script, job->request);
  return status == CELSPAN_OK && is_all && cs_whole_is_kept(&job->whole);
}

static cs_exit report_kept(render_job *job) {
  start_progress(job);
  for (size_t i = 0; i < job->frames.count; i++)
    cs_progress_frame(&job->progress, job->frames.frames[i], job->output, "kept");
  return report_end(job, CS_EXIT_OK);
}

static cs_exit keep_or_make_whole(render_job *job) {
  if (cs_whole_is_known(&job->whole)) {
    CS_TRY_EXIT(begin_whole(job));
    if (is_unchanged(job))
      return report_kept(job);
  }
  CS_TRY_EXIT(begin_whole(job));
  return make_into(job);
}

static cs_exit resume_whole(render_job *job) {
  celspan_status status = cs_whole_open(&job->whole, job->script, job->request, &job->frame);
  cs_exit outcome = cs_report_failure(job->script->context, status, NULL);
  if (outcome == CS_EXIT_OK)
    outcome = keep_or_make_whole(job);
  cs_whole_close(&job->whole);
  return outcome;
}

/* A film may have become shorter since it was divided into tasks. */
static cs_exit report_no_frames(const render_job *job) {
  int32_t task[2] = {0, 0};
  cs_request_read(job->request, "--task", task);
  cs_report_note("task %d of %d has no frames", task[0], task[1]);
  return CS_EXIT_OK;
}

/* With --fps, the frames of a video are those that are seen at its own rate. */
static cs_exit retime(render_job *job) {
  double rate;
  celspan_context *context = job->script->context;
  if (!is_video(job) || !cs_request_read(job->request, "--fps", &rate))
    return CS_EXIT_OK;
  job->played = job->frames;
  celspan_status status = cs_sequence_retime(context, &job->played,
                                             rate / job->script->film.frames_second, &job->frames);
  return cs_report_failure(context, status, "--fps");
}

/* Only where the frames are known, it is known whether the output is one picture, a film of planes,
 * a PDF of several pages or a video. */
static cs_exit choose_output(render_job *job) {
  const size_t count = job->frames.count;
  CS_TRY_EXIT(cs_output_refuse(job->script->context, job->request, job->output, count));
  job->row = cs_output_of(job->request, job->output, count);
  bool is_file = job->row->holds == CS_HOLDS_EITHER &&
                 (count == 1 || !cs_output_is_whole(job->row, job->output));
  job->outlet = is_file ? NULL : job->row->outlet;
  return CS_EXIT_OK;
}

static cs_exit make_frames(render_job *job) {
  if (job->frames.count == 0)
    return report_no_frames(job);
  CS_TRY_EXIT(cs_change_refuse(job->script, &job->change, &job->frames));
  if (job->output)
    cs_temporary_sweep(job->output, cs_sequence_matches);
  CS_TRY_EXIT(choose_output(job));
  CS_TRY_EXIT(retime(job));
  if (job->outlet)
    return job->resumes ? resume_whole(job) : make_into(job);
  return job->resumes ? resume_frames(job) : render_all(job);
}

static cs_exit run(cs_script *script, const cs_request *request) {
  render_job job = {.script = script,
                    .request = request,
                    .output = cs_request_text(request, "-o"),
                    .has_digests = cs_request_has(request, "--hash"),
                    .resumes = cs_request_has(request, "--resume"),
                    .keeps_going = cs_request_has(request, "--keep-going"),
                    .change = cs_change_read(request)};
  const cs_film_frame unknown = {0};
  cs_exit outcome = cs_view_frame(request, script->film.width, script->film.height, &job.frame);
  cs_film_expose(&script->film, &unknown, &job.frame);
  if (outcome == CS_EXIT_OK)
    outcome = cs_change_lay_onion(script, request, &job.frame);
  if (outcome == CS_EXIT_OK)
    outcome = cs_output_frames(script, request, job.output, &job.frames);
  if (outcome == CS_EXIT_OK)
    outcome = make_frames(&job);
  cs_mem_free(script->context->memory, job.failed, job.failed_capacity * sizeof *job.failed);
  cs_sequence_finish(&job.frames);
  cs_sequence_finish(&job.played);
  return outcome;
}

cs_exit cs_verb_render(celspan_context *context, const cs_request *request) {
  CS_TRY_EXIT(cs_output_refuse_early(context, request));
  return cs_script_run(context, request, run);
}
