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

#include "base/context.h"
#include "frames/apart/apart.h"
#include "frames/film/shoot.h"
#include "frames/plane/plane.h"
#include "frames/video/video.h"
#include "output/sinks/temporary.h"
#include "program/change.h"
#include "program/drawing_target.h"
#include "program/layers_target.h"
#include "program/progress.h"
#include "program/raw_frame.h"
#include "program/record.h"
#include "program/refusals.h"
#include "program/summary.h"
#include "program/target.h"
#include "program/verbs.h"
#include "program/video_target.h"
#include "program/view.h"
#include "program/whole.h"

typedef struct render_job {
  celspan_coding coding; /* of its files */
  cs_script *script;
  const cs_request *request;
  const char *output; /* NULL: digests alone */
  bool has_digests, resumes, keeps_going;
  cs_apart_contents apart;
  bool has_noted; /* that layers do not add up to the frame, or that a page has a picture */
  cs_frame_change change;
  celspan_frame_desc frame;
  cs_sequence frames;
  cs_sequence played; /* the frames of the film whose sound is heard; none: those of `frames` */
  cs_progress progress;
  cs_summary summary;
  cs_record record;            /* of frames that are files */
  cs_whole whole;              /* of a film that is one file */
  bool surveys;                /* frames are built, but not rendered */
  const struct stream *stream; /* NULL: frames are files, or are only hashed */
  cs_video video;              /* of the stream `into_video`; the next two are of theirs */
  cs_plane_film *plane;
  cs_plot *pages;
  cs_slots raw;    /* of frames that go to standard output; none: they are written in rows */
  int64_t *failed; /* frames; owned */
  size_t failed_count, failed_capacity;
  cs_exit outcome; /* of the reported failure */
} render_job;

/* ---------------------------------------------------------------- streams */

/* Where frames go that are no files of their own. */
typedef struct stream {
  celspan_status (*put)(void *user, const cs_shoot_put *one);
  /* For those that are made in slots; see frames/film/shoot.h. */
  celspan_status (*give)(void *user, size_t slot);
  celspan_status (*repeat)(void *user);
  /* NULL: it is standard output, and not a file that all frames share. */
  cs_exit (*open)(render_job *job);
  celspan_status (*commit)(render_job *job);
  void (*discard)(render_job *job);
} stream;

static celspan_coding raw_coding(const render_job *job, const celspan_frame_desc *frame) {
  celspan_coding coding = cs_target_coding(job->request);
  coding.space = frame->space;
  return coding;
}

static celspan_status put_raw(void *user, const cs_shoot_put *one) {
  const render_job *job = user;
  const celspan_coding coding = raw_coding(job, one->desc);
  return job->raw.count ? cs_raw_frame_make(one->context, one->desc, &coding, &job->raw, one->slot)
                        : cs_raw_frame_print(one->context, one->desc, &coding);
}

static celspan_status give_raw(void *user, size_t slot) {
  const render_job *job = user;
  return cs_raw_frame_give(job->script->context, &job->raw, slot);
}

static const stream into_output = {.put = put_raw, .give = give_raw};

static cs_exit open_video(render_job *job) {
  const cs_sequence *played = job->played.count ? &job->played : &job->frames;
  return cs_video_target_open(&job->video, job->script, job->request, &job->frame, played);
}

static celspan_status put_video(void *user, const cs_shoot_put *one) {
  render_job *job = user;
  return cs_video_put(&job->video, one->context, one->desc, one->slot, one->frame->digest);
}

static celspan_status give_video(void *user, size_t slot) {
  return cs_video_give(&((render_job *)user)->video, slot);
}

static celspan_status repeat_video(void *user) {
  return cs_video_repeat(&((render_job *)user)->video);
}

static celspan_status commit_video(render_job *job) { return cs_video_finish(&job->video); }

static void discard_video(render_job *job) { cs_video_discard(&job->video); }

static const stream into_video = {put_video,  give_video,   repeat_video,
                                  open_video, commit_video, discard_video};

static cs_exit open_plane(render_job *job) {
  const cs_film_info *film = &job->script->film;
  celspan_depth depth = CELSPAN_DEPTH_DEFAULT;
  cs_request_read(job->request, "--depth", &depth);
  const cs_plane_film_desc desc = {.width = film->width,
                                   .height = film->height,
                                   .frames_second = film->frames_second,
                                   .depth = cs_plane_depth(depth)};
  celspan_context *context = job->script->context;
  return cs_report_failure(context, cs_plane_film_create(context, job->output, &desc, &job->plane),
                           NULL);
}

static celspan_status put_plane(void *user, const cs_shoot_put *one) {
  const cs_shoot_frame *frame = one->frame;
  return cs_plane_film_put(((render_job *)user)->plane, one->desc,
                           frame->is_named ? &frame->scene : NULL);
}

static celspan_status commit_plane(render_job *job) { return cs_plane_film_commit(job->plane); }

static void discard_plane(render_job *job) { cs_plane_film_discard(job->plane); }

static const stream into_plane = {
    .put = put_plane, .open = open_plane, .commit = commit_plane, .discard = discard_plane};

static cs_exit open_pages(render_job *job) {
  celspan_context *context = job->script->context;
  cs_plot_desc desc = cs_drawing_target_read(job->request);
  desc.title = job->script->film.title;
  return cs_report_failure(context, cs_plot_begin(context, job->output, &desc, &job->pages), NULL);
}

static celspan_status put_page(void *user, const cs_shoot_put *one) {
  render_job *job = user;
  cs_plot_facts facts;
  CS_TRY(cs_plot_add_frame(job->pages, one->desc, &facts));
  if (!job->has_noted) {
    const cs_plot_desc drawing = cs_drawing_target_read(job->request);
    cs_drawing_target_report(job->script->context, job->output, &drawing, &facts);
    job->has_noted = facts.picture_width > 0;
  }
  return CELSPAN_OK;
}

static celspan_status commit_pages(render_job *job) { return cs_plot_end(job->pages, CELSPAN_OK); }

static void discard_pages(render_job *job) { (void)!cs_plot_end(job->pages, CELSPAN_CANCELLED); }

static const stream into_pages = {
    .put = put_page, .open = open_pages, .commit = commit_pages, .discard = discard_pages};

/* Only where the frames are known, it is known whether the output is one picture, a film of planes,
 * a PDF of several pages or a video. */
static const stream *choose_stream(const render_job *job) {
  const cs_request *request = job->request;
  const bool has_several = job->frames.count > 1;
  return has_several && cs_target_is_plane_film(request)         ? &into_plane
         : has_several && cs_drawing_target_is_film(request)     ? &into_pages
         : cs_video_target_is_wanted(request, job->frames.count) ? &into_video
         : job->output && cs_target_is_stream(job->output)       ? &into_output
                                                                 : NULL;
}

static bool is_video(const render_job *job) { return job->stream == &into_video; }

static bool is_whole(const render_job *job) { return job->stream && job->stream->open; }

/* ---------------------------------------------------------------- files */

/* Whether files have more than the frame. */
static bool is_apart(const render_job *job) {
  return job->apart.has_layers || job->apart.mattes != CS_APART_MATTES_NONE;
}

static celspan_status put_layers(void *user, celspan_context *context,
                                 const celspan_frame_desc *desc, const char *path,
                                 const celspan_file_desc *file) {
  const render_job *job = user;
  return cs_layers_target_write(context, job->apart, desc, path, file);
}

static celspan_status put_drawing(void *user, celspan_context *context,
                                  const celspan_frame_desc *desc, const char *path,
                                  const celspan_file_desc *file) {
  const render_job *job = user;
  return cs_drawing_target_write_frame(context, desc, file->title, path, job->request);
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
         : job->stream   ? "standard output"
                         : frame->path;
}

/* Says once in a run that layers over each other are not the frame. */
static void tell_layers(render_job *job, int64_t number, const cs_film_frame *built) {
  char why[CS_APART_WHY];
  const celspan_coding coding = cs_target_coding(job->request);
  if (!job->apart.has_layers || job->has_noted ||
      cs_apart_sums(built->exposures, built->count, job->apart.format, &coding,
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

static void add_stream(const render_job *job, cs_shoot *shoot) {
  const stream *into = job->stream;
  shoot->put = into->put;
  shoot->slots = is_video(job) ? job->video.slots.count : job->raw.count;
  if (shoot->slots > 0) {
    shoot->give = into->give;
    shoot->repeat = into->repeat;
  }
}

static celspan_status run_shoot(render_job *job) {
  cs_shoot shoot = {.context = job->script->context,
                    .film = job->script->film,
                    .frames = &job->frames,
                    .pattern = job->stream ? NULL : job->output,
                    .frame = job->frame,
                    .file = describe_file(job),
                    .has_digests = job->has_digests,
                    .keeps_going = job->keeps_going,
                    .keeps_nothing = keeps_nothing(job),
                    .user = job,
                    .write = is_apart(job)                                            ? put_layers
                             : cs_drawing_target_is_wanted(job->output, job->request) ? put_drawing
                                                                                      : NULL,
                    .hash = is_apart(job) ? cs_apart_hash : NULL,
                    .keep = job->resumes ? keep : NULL,
                    .build = build,
                    .finished = finished,
                    .tick = tick};
  if (job->stream)
    add_stream(job, &shoot);
  return cs_shoot_run(&shoot);
}

/* Frames go to standard output from slots, if there are several and workers can make them beside
 * each other. */
static celspan_status open_raw(render_job *job) {
  const celspan_coding coding = raw_coding(job, &job->frame);
  return job->stream == &into_output && job->frames.count > 1 && !keeps_nothing(job)
             ? cs_raw_frame_slots(job->script->context, &job->frame, &coding, &job->raw)
             : CELSPAN_OK;
}

static cs_exit shoot(render_job *job) {
  celspan_status status = open_raw(job);
  if (status == CELSPAN_OK)
    status = run_shoot(job);
  cs_slots_close(&job->raw, job->script->context);
  return job->outcome != CS_EXIT_OK ? job->outcome
                                    : cs_report_failure(job->script->context, status, NULL);
}

/* Gives the file its final name, and adds it to the record. */
static celspan_status complete_whole(render_job *job) {
  celspan_context *context = job->script->context;
  context->contents = job->resumes ? &job->whole.file.contents : NULL;
  celspan_status status = job->stream->commit(job);
  context->contents = NULL;
  return status == CELSPAN_OK && job->resumes ? cs_whole_finish(&job->whole) : status;
}

/* The frames of a video are finished only when the whole file is. */
static cs_exit shoot_whole(render_job *job) {
  cs_exit outcome = shoot(job);
  if (outcome != CS_EXIT_OK) { /* it has been reported */
    job->stream->discard(job);
    return outcome;
  }
  CS_TRY_EXIT(cs_report_failure(job->script->context, complete_whole(job), NULL));
  return is_video(job) ? cs_video_target_add_poster(job->script, job->request, &job->frame)
                       : CS_EXIT_OK;
}

static void start_progress(render_job *job) {
  cs_progress_start(&job->progress, job->request, CS_PROGRESS_AUTO, job->frames.count);
}

static cs_exit render_all(render_job *job) {
  start_progress(job);
  return report_end(job, is_whole(job) ? shoot_whole(job) : shoot(job));
}

static cs_exit resume_frames(render_job *job) {
  celspan_status status = cs_record_open(&job->record, job->script, job->request, &job->frame);
  cs_exit outcome = cs_report_failure(job->script->context, status, NULL);
  if (outcome == CS_EXIT_OK)
    outcome = render_all(job);
  cs_record_close(&job->record);
  return outcome;
}

static cs_exit make_whole(render_job *job) {
  CS_TRY_EXIT(job->stream->open(job));
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
  return make_whole(job);
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

static cs_exit make_frames(render_job *job) {
  const cs_request *request = job->request;
  if (job->frames.count == 0)
    return report_no_frames(job);
  CS_TRY_EXIT(cs_change_refuse(job->script, &job->change, &job->frames));
  if (job->output)
    cs_temporary_sweep(job->output, cs_sequence_matches);
  job->stream = choose_stream(job);
  CS_TRY_EXIT(retime(job));
  if (is_whole(job))
    return job->resumes ? resume_whole(job) : make_whole(job);
  if (job->output && !job->stream)
    CS_TRY_EXIT(cs_refusals_of_output(job->script->context, request, job->frames.count));
  return job->resumes ? resume_frames(job) : render_all(job);
}

static cs_exit run(cs_script *script, const cs_request *request) {
  render_job job = {.script = script,
                    .request = request,
                    .output = cs_request_text(request, "-o"),
                    .has_digests = cs_request_has(request, "--hash"),
                    .resumes = cs_request_has(request, "--resume"),
                    .keeps_going = cs_request_has(request, "--keep-going"),
                    .apart = cs_layers_target_read(request),
                    .change = cs_change_read(request)};
  const cs_film_frame unknown = {0};
  cs_exit outcome = cs_view_frame(request, script->film.width, script->film.height, &job.frame);
  cs_film_expose(&script->film, &unknown, &job.frame);
  if (outcome == CS_EXIT_OK)
    outcome = cs_change_lay_onion(script, request, &job.frame);
  if (outcome == CS_EXIT_OK)
    outcome = cs_target_frames(script, request, job.output, &job.frames);
  if (outcome == CS_EXIT_OK)
    outcome = make_frames(&job);
  cs_mem_free(script->context->memory, job.failed, job.failed_capacity * sizeof *job.failed);
  cs_sequence_finish(&job.frames);
  cs_sequence_finish(&job.played);
  return outcome;
}

cs_exit cs_verb_render(celspan_context *context, const cs_request *request) {
  CS_TRY_EXIT(cs_refusals_early(context, request));
  return cs_script_run(context, request, run);
}
