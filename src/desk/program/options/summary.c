#include "program/options/summary.h"

#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "inside/clock.h"
#include "inside/context.h"
#include "inside/sinks.h"
#include "process/child.h"
#include "process/interrupt.h"
#include "program/commit.h"
#include "program/report/log.h"

#define ANSWER_SECONDS 5.0 /* for ffmpeg to say its version */

void cs_summary_add(cs_summary *summary, const cs_shoot_frame *frame) {
  size_t at = summary->count;
  while (at > 0 && summary->slowest[at - 1].seconds < frame->seconds)
    at--;
  if (at == CS_SUMMARY_SLOWEST)
    return;
  size_t kept = summary->count < CS_SUMMARY_SLOWEST ? summary->count : CS_SUMMARY_SLOWEST - 1;
  memmove(&summary->slowest[at + 1], &summary->slowest[at],
          (kept - at) * sizeof summary->slowest[0]);
  summary->slowest[at].number = frame->number;
  summary->slowest[at].seconds = frame->seconds;
  summary->count = kept + 1;
}

/* The version that ffmpeg prints; "": there is none, or it does not answer in time. */
static void ask_ffmpeg(char out[80]) {
  static const char *const question[] = {"sh", "-c", "ffmpeg -version | head -n 1 >&2", NULL};
  cs_child child;
  out[0] = '\0';
  if (cs_child_start(&child, question, false) != 0)
    return;
  close(child.input);
  cs_child_end(&child, ANSWER_SECONDS);
  sscanf(child.words.text, "ffmpeg version %79s", out);
}

static void put_versions(cs_json *json, bool has_video) {
  char ffmpeg[80] = "";
  cs_json_text(json, "celspan", celspan_version());
  cs_json_text(json, "commit", CS_COMMIT);
  if (CELSPAN_OPENIMAGEIO[0])
    cs_json_text(json, "openimageio", CELSPAN_OPENIMAGEIO);
  if (CELSPAN_LIBAVIF[0])
    cs_json_text(json, "libavif", CELSPAN_LIBAVIF);
  if (has_video)
    ask_ffmpeg(ffmpeg);
  if (ffmpeg[0])
    cs_json_text(json, "ffmpeg", ffmpeg);
}

/* Linux counts kilobytes. */
static int64_t peak_of(int who) {
  struct rusage used = {0};
  getrusage(who, &used);
  return (int64_t)used.ru_maxrss * 1024;
}

static void put_memory(cs_json *json, const celspan_context *context) {
  cs_json_open(json, "memory", '{');
  cs_json_integer(json, "process", peak_of(RUSAGE_SELF));
  cs_json_integer(json, "children", peak_of(RUSAGE_CHILDREN));
  cs_json_integer(json, "celspan", (int64_t)atomic_load(&context->memory->peak));
  cs_json_close(json, '}');
}

static void put_frames(cs_json *json, const cs_progress *progress, cs_progress_failures failed) {
  size_t made = progress->frames_done - progress->copied - progress->kept;
  cs_json_integer(json, "frames", (int64_t)progress->frame_count);
  cs_json_integer(json, "made", (int64_t)made);
  cs_json_integer(json, "copied", (int64_t)progress->copied);
  cs_json_integer(json, "kept", (int64_t)progress->kept);
  cs_json_integer(json, "failures", (int64_t)failed.count);
}

static void put_slowest(cs_json *json, const cs_summary *summary) {
  cs_json_open(json, "slowest", '[');
  for (size_t i = 0; i < summary->count; i++) {
    cs_json_open(json, NULL, '{');
    cs_json_integer(json, "frame", summary->slowest[i].number);
    cs_json_number(json, "seconds", summary->slowest[i].seconds);
    cs_json_close(json, '}');
  }
  cs_json_close(json, ']');
}

static const char *make(cs_json *json, const cs_summary *summary, const celspan_context *context,
                        const cs_summary_run *run) {
  char now[CS_LOG_TIME];
  int stopped_by = cs_interrupt_signal();
  const char *output = cs_request_text(run->request, "-o");
  cs_log_time(now);
  cs_json_begin(json);
  put_versions(json, run->has_video);
  cs_json_text(json, "host", cs_log_host());
  cs_json_text(json, "ended", now);
  cs_json_number(json, "seconds", cs_clock_seconds() - run->progress->started);
  cs_json_integer(json, "exit", stopped_by ? CS_EXIT_SIGNAL + stopped_by : (int)run->outcome);
  put_memory(json, context);
  put_frames(json, run->progress, run->failed);
  put_slowest(json, summary);
  cs_json_text(json, "script", run->request->operands[0]);
  if (output)
    cs_json_text(json, "output", output);
  cs_json_integers(json, "failed", run->failed.frames, run->failed.count);
  return cs_json_end(json);
}

static celspan_status write_file(celspan_context *context, const char *path, const char *text) {
  cs_file *file;
  CS_TRY(cs_file_create(context, NULL, path, &file));
  celspan_status status = cs_file_write(file, context, text, strlen(text));
  if (status == CELSPAN_OK)
    return cs_file_commit(file, context);
  cs_file_discard(file, context);
  return status;
}

cs_exit cs_summary_write(const cs_summary *summary, celspan_context *context,
                         const cs_summary_run *run) {
  const char *path = cs_request_text(run->request, "--report");
  cs_json json;
  if (!path)
    return CS_EXIT_OK;
  return cs_report_failure(context, write_file(context, path, make(&json, summary, context, run)),
                           NULL);
}
