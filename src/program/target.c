#include "program/target.h"

#include <inttypes.h>
#include <string.h>
#include <strings.h>

#include "frames/plane/plane.h"
#include "output/sinks/file.h"
#include "output/sinks/sink.h"
#include "program/drawing_target.h"
#include "program/layers_target.h"
#include "program/spaces.h"
#include "program/video_target.h"

celspan_coding cs_target_coding(const cs_request *request) {
  celspan_coding coding = {.struct_size = sizeof coding};
  cs_request_read(request, "--depth", &coding.depth);
  cs_spaces_set(request, &coding);
  cs_request_read(request, "--alpha", &coding.alpha);
  if (cs_request_has(request, "--dither"))
    coding.depth = CELSPAN_DEPTH_8_DITHER;
  return coding;
}

celspan_file_desc cs_target_file(const cs_request *request, celspan_coding *coding) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  file.format = cs_request_text(request, "--format");
  *coding = cs_target_coding(request);
  file.coding = coding;
  int32_t strip[2];
  if (cs_request_strip(request, strip))
    /* a strip has at least this many rows; the view gives the exact number */
    file.strip_height = strip[1];
  return file;
}

/* The message names all formats, because an unknown ending does not show which format was meant. */
static cs_exit refuse_format(const char *path, const char *name) {
  char pictures[CS_SINK_LIST], videos[CS_SINK_LIST];
  cs_sink_file_list(pictures, sizeof pictures);
  cs_video_format_list(videos, sizeof videos);
  return cs_report_usage(
      "%s: the format \"%s\" cannot be written; pictures can be %s; videos, "
      "which 'celspan render' makes, %s; planes plane; drawings, which 'celspan render' and "
      "'celspan convert' make, svg and pdf; Lottie animations, which 'celspan render' makes of a "
      "name such "
      "as film.json or film.lottie, without --format; sounds, which 'celspan sound' makes, wav",
      path, name, pictures, videos);
}

/* Makes a sink and discards it: a sink opens no file before its first row. */
static cs_exit refuse_file(celspan_context *context, const char *path, const cs_request *request) {
  celspan_coding coding;
  celspan_file_desc file = cs_target_file(request, &coding);
  celspan_sink sink = CELSPAN_SINK;
  const char *name = file.format ? file.format : cs_file_ending(path);
  if (name[0] && !cs_sink_file_knows(path, &file))
    return refuse_format(path, name);
  celspan_status status = celspan_file_sink_create(context, path, &file, &sink);
  if (status == CELSPAN_BAD_ARGUMENT)
    return cs_report_usage("%s", celspan_context_error(context));
  if (status == CELSPAN_OK)
    cs_sink_discard(context, &sink);
  return cs_report_failure(context, status, NULL);
}

/* Refuses options about pixels, which a plane does not have. */
static cs_exit refuse_plane(const char *path, const cs_request *request) {
  static const char *const options[] = {
      "--size", "--scale", "--crop",      "--strip",     "--colour",  "--alpha", "--dither",
      "--hash", "--draft", "--antialias", "--no-dither", "--display", "--view"};
  celspan_depth depth = CELSPAN_DEPTH_DEFAULT;
  for (size_t i = 0; i < sizeof options / sizeof *options; i++)
    if (cs_request_has(request, options[i]))
      return cs_report_usage("%s: a plane has no pixels: give %s where it is drawn, such as "
                             "'celspan convert x.plane x.png'",
                             path, options[i]);
  cs_request_read(request, "--depth", &depth);
  if (depth == CELSPAN_DEPTH_HALF || depth == CELSPAN_DEPTH_FLOAT)
    return cs_report_usage("%s: a plane takes --depth 8 or 16", path);
  return CS_EXIT_OK;
}

bool cs_target_is_lottie(const cs_request *request) {
  const char *output = cs_request_text(request, "-o");
  const char *ending = output && !cs_request_has(request, "--format") ? cs_file_ending(output) : "";
  return strcasecmp(ending, "json") == 0 || strcasecmp(ending, "lottie") == 0;
}

cs_exit cs_target_refuse(celspan_context *context, const char *path, const cs_request *request) {
  const char *format = cs_request_text(request, "--format");
  CS_TRY_EXIT(cs_layers_target_refuse(request));
  CS_TRY_EXIT(cs_drawing_target_refuse(path, request));
  if (cs_drawing_target_is_wanted(path, request))
    return CS_EXIT_OK;
  if (cs_layers_target_is_painting(request))
    return CS_EXIT_OK;
  if (cs_plane_is_wanted(path, format))
    return refuse_plane(path, request);
  const cs_video_format *video = cs_video_format_named(format ? format : cs_file_ending(path));
  if (video && !video->is_picture)
    return cs_report_usage("%s: %s is a video, which 'celspan render' makes of a film; write a "
                           "picture such as shot.png",
                           path, video->name);
  return refuse_file(context, path, request);
}

bool cs_target_is_plane_film(const cs_request *request) {
  const char *output = cs_request_text(request, "-o");
  return output && !cs_target_is_stream(output) && !cs_sequence_has_number(output) &&
         cs_plane_is_wanted(output, cs_request_text(request, "--format"));
}

const char *cs_target_shared(const cs_request *request) {
  return cs_target_is_plane_film(request)     ? "plane"
         : cs_drawing_target_is_film(request) ? "pdf"
                                              : NULL;
}

bool cs_target_is_stream(const char *path) { return strcmp(path, "-") == 0; }

static celspan_status list_frames(const cs_script *script, const cs_request *request,
                                  cs_sequence *out) {
  const cs_film_info *film = &script->film;
  const char *list = cs_request_text(request, "--frames");
  if (!list)
    return cs_sequence_count(script->context, film->first, film->count, out);
  celspan_status status = cs_sequence_parse(script->context, list, film, out);
  if (status == CELSPAN_OK)
    status = cs_sequence_within(script->context, out, film->first, film->count);
  return status;
}

/* Keeps only the frames of the request's task. The numbers of frames of two tasks differ by at most
 * one. */
static void take_task(const cs_request *request, cs_sequence *frames) {
  int32_t task[2];
  if (!cs_request_read(request, "--task", task))
    return;
  size_t count = frames->count, of = (size_t)task[1];
  size_t begin = count * ((size_t)task[0] - 1) / of, end = count * (size_t)task[0] / of;
  memmove(frames->frames, frames->frames + begin, (end - begin) * sizeof *frames->frames);
  frames->count = end - begin;
}

cs_exit cs_target_frames(const cs_script *script, const cs_request *request, const char *output,
                         cs_sequence *out) {
  celspan_status status = list_frames(script, request, out);
  if (status == CELSPAN_BAD_ARGUMENT)
    return cs_report_usage("%s", celspan_context_error(script->context));
  if (status != CELSPAN_OK)
    return cs_report_failure(script->context, status, NULL);
  bool is_one_file = output && !cs_target_is_stream(output) && !cs_sequence_has_number(output) &&
                     !cs_video_target_is_wanted(request, 0) && !cs_target_shared(request);
  if (is_one_file && out->count > 1)
    return cs_report_usage("%s: several frames (%zu) need a number in the name, such as "
                           "shot.####.png; for one, name it: --frames %" PRId64,
                           output, out->count, out->frames[0]);
  take_task(request, out);
  return CS_EXIT_OK;
}
