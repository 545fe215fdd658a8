/* celspan render SCRIPT -o OUT: the frames of a film, one after the other.
 *
 * Everything that can be refused is refused before the first frame is made. A frame that fails ends
 * the run: the frames before it are whole and stay.
 */
#include <inttypes.h>
#include <stdio.h>

#include "bind/sequence.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/rawrow.h"
#include "cli/shot.h"
#include "cli/target.h"
#include "cli/tee.h"
#include "cli/verbs.h"
#include "cli/view.h"
#include "output/sink.h"

typedef struct render_job {
  cs_shot *shot;
  const cs_request *request;
  celspan_frame_desc frame; /* its exposures change from frame to frame */
  cs_sequence frames;
  cs_progress progress;
} render_job;

static celspan_status render_raw(const render_job *job) {
  cs_rawrow raw;
  celspan_sink sink = cs_rawrow_sink(&raw, &job->request->coding, stdout);
  return celspan_frame_render(job->shot->context, &job->frame, &sink, NULL);
}

/* Writes the file and hashes its pixels in one go. */
static celspan_status render_hashed(const render_job *job, const char *path,
                                    const celspan_file_desc *file, uint64_t digest[2]) {
  celspan_context *context = job->shot->context;
  cs_tee tee;
  celspan_status status = cs_sink_file(context, path, file, &tee.sinks[0]);
  if (status != CELSPAN_OK)
    return status;
  status = cs_sink_digest(context, &file->coding, digest, &tee.sinks[1]);
  if (status != CELSPAN_OK) {
    cs_sink_discard(context, &tee.sinks[0]);
    return status;
  }
  celspan_sink sink = cs_tee_sink(&tee);
  status = celspan_frame_render(context, &job->frame, &sink, NULL);
  for (int i = 0; i < 2 && !tee.is_ended; i++)
    cs_sink_discard(context, &tee.sinks[i]);
  return status;
}

/* digest: NULL when none is asked for. */
static celspan_status render_file(const render_job *job, const char *path, uint64_t *digest) {
  celspan_file_desc file = cs_target_file(job->request);
  file.title = job->shot->film.title;
  file.frames_second = job->shot->film.frames_second;
  file.frame = (int32_t)job->shot->number;
  file.is_opaque = celspan_frame_is_opaque(&job->frame);
  if (digest)
    return render_hashed(job, path, &file, digest);
  return celspan_frame_write(job->shot->context, &job->frame, path, &file, NULL);
}

/* Puts the frame that is built where it is asked for; path: room for the file's name. */
static celspan_status put_frame(const render_job *job, char *path, size_t size, uint64_t *digest) {
  celspan_context *context = job->shot->context;
  const char *output = job->request->output;
  if (!output) {
    snprintf(path, size, "hashed");
    return celspan_frame_digest(context, &job->frame, &job->request->coding, digest);
  }
  if (cs_target_is_stream(output)) {
    snprintf(path, size, "standard output");
    return render_raw(job);
  }
  celspan_status status = cs_sequence_name(context, output, job->shot->number, path, size);
  return status == CELSPAN_OK ? render_file(job, path, digest) : status;
}

static cs_exit render_frame(render_job *job, int64_t number) {
  cs_exit outcome = cs_shot_build(job->shot, number);
  if (outcome != CS_EXIT_OK)
    return outcome;
  job->frame.exposures = job->shot->frame.exposures;
  job->frame.exposure_count = job->shot->frame.count;
  char path[4096];
  uint64_t digest[2];
  bool is_hashed = job->request->hash;
  celspan_status status = put_frame(job, path, sizeof path, is_hashed ? digest : NULL);
  if (status == CELSPAN_OK && is_hashed)
    printf("%" PRId64 " %016" PRIx64 "%016" PRIx64 "\n", number, digest[0], digest[1]);
  if (status == CELSPAN_OK)
    cs_progress_frame(&job->progress, number, path);
  return cs_shot_failure(job->shot, status);
}

static cs_exit render_all(render_job *job) {
  cs_progress_start(&job->progress, job->request->progress, job->frames.count);
  job->frame.progress = cs_progress_rows;
  job->frame.progress_user = &job->progress;
  cs_exit outcome = CS_EXIT_OK;
  for (size_t i = 0; i < job->frames.count && outcome == CS_EXIT_OK && !cs_interrupt_signal(); i++)
    outcome = render_frame(job, job->frames.frames[i]);
  cs_progress_end(&job->progress);
  if (job->progress.frames_done < job->frames.count && job->frames.count > 1)
    cs_report_note("%zu of %zu frames are finished", job->progress.frames_done, job->frames.count);
  return outcome;
}

static cs_exit refuse_stream(const cs_request *request) {
  if (request->hash)
    return cs_report_usage("--hash prints to standard output, where -o - puts the frames: give one "
                           "of them");
  if (request->format)
    return cs_report_usage("--format %s goes into files: with -o - frames are raw RGBA rows",
                           request->format);
  return CS_EXIT_OK;
}

/* What can be refused without running the script. */
static cs_exit refuse_early(celspan_context *context, const cs_request *request) {
  if (!request->output && !request->hash)
    return cs_report_usage("where to? give -o shot.####.png (or --hash for digests alone)");
  if (request->output && cs_target_is_stream(request->output))
    return refuse_stream(request);
  return request->output ? cs_target_refuse(context, request->output, request) : CS_EXIT_OK;
}

static cs_exit run(cs_shot *shot, const cs_request *request) {
  render_job job = {.shot = shot, .request = request};
  cs_exit outcome = cs_view_frame(request, shot->film.width, shot->film.height, &job.frame);
  if (outcome == CS_EXIT_OK)
    outcome = cs_target_frames(shot, request, &job.frames);
  if (outcome == CS_EXIT_OK)
    outcome = render_all(&job);
  cs_sequence_finish(&job.frames);
  return outcome;
}

cs_exit cs_render_run(celspan_context *context, const cs_request *request) {
  cs_exit outcome = refuse_early(context, request);
  if (outcome != CS_EXIT_OK)
    return outcome;
  cs_shot shot;
  outcome = cs_shot_open(context, request, &shot);
  if (outcome == CS_EXIT_OK)
    outcome = run(&shot, request);
  cs_shot_close(&shot);
  return outcome;
}
