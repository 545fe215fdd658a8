#include "cli/target.h"

#include <string.h>

#include "cli/video/video.h"
#include "output/ending.h"
#include "output/sink.h"

celspan_coding cs_target_coding(const cs_request *request) {
  celspan_coding coding = request->coding;
  if (request->dithers)
    coding.depth = CELSPAN_DEPTH_8_DITHER;
  return coding;
}

celspan_file_desc cs_target_file(const cs_request *request) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  file.format = request->format;
  file.coding = cs_target_coding(request);
  file.strip_height = request->strip[1]; /* rows at least, until the view is known */
  return file;
}

/* Makes a sink and discards it: a sink opens no file before its first row. */
static cs_exit refuse_file(celspan_context *context, const char *path, const cs_request *request) {
  celspan_file_desc file = cs_target_file(request);
  celspan_sink sink;
  celspan_status status = celspan_file_sink_create(context, path, &file, &sink);
  if (status == CELSPAN_BAD_ARGUMENT)
    return cs_report_usage("%s", celspan_context_error(context));
  if (status == CELSPAN_OK)
    cs_sink_discard(context, &sink);
  return cs_report_failure(context, status, NULL);
}

cs_exit cs_target_refuse(celspan_context *context, const char *path, const cs_request *request) {
  const char *wanted = request->format ? request->format : cs_ending_of(path);
  const cs_video_format *video = cs_video_format_named(wanted);
  if (video && !video->is_picture)
    return cs_report_usage("%s: %s is a video, which 'celspan render' makes of a film; write a "
                           "picture such as shot.png",
                           path, video->name);
  return refuse_file(context, path, request);
}

bool cs_target_is_stream(const char *path) { return strcmp(path, "-") == 0; }

static celspan_status list_frames(const cs_script *script, const cs_request *request,
                                  cs_sequence *out) {
  const cs_film_info *film = &script->film;
  if (!request->frames)
    return cs_sequence_count(script->context, film->first, film->count, out);
  celspan_status status = cs_sequence_parse(script->context, request->frames, out);
  if (status == CELSPAN_OK)
    status = cs_sequence_within(script->context, out, film->first, film->count);
  return status;
}

/* Leaves the frames of the request's task, as many as in any other or one less. */
static void take_task(const cs_request *request, cs_sequence *frames) {
  const int32_t *task = request->task;
  if (!task[1])
    return;
  size_t count = frames->count, of = (size_t)task[1];
  size_t begin = count * ((size_t)task[0] - 1) / of, end = count * (size_t)task[0] / of;
  memmove(frames->frames, frames->frames + begin, (end - begin) * sizeof *frames->frames);
  frames->count = end - begin;
}

cs_exit cs_target_frames(const cs_script *script, const cs_request *request, cs_sequence *out) {
  celspan_status status = list_frames(script, request, out);
  if (status == CELSPAN_BAD_ARGUMENT)
    return cs_report_usage("%s", celspan_context_error(script->context));
  if (status != CELSPAN_OK)
    return cs_report_failure(script->context, status, NULL);
  bool is_one_file = request->output && !cs_target_is_stream(request->output) &&
                     !cs_sequence_has_number(request->output) && !cs_video_is_wanted(request, 0);
  if (is_one_file && out->count > 1)
    return cs_report_usage("%s: several frames (%zu) need a number in the name, such as "
                           "shot.####.png",
                           request->output, out->count);
  take_task(request, out);
  return CS_EXIT_OK;
}
