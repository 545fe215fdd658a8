#include "program/refusals.h"

#include <string.h>

#include "frames/plane/plane.h"
#include "program/drawing_target.h"
#include "program/layers_target.h"
#include "program/progress.h"
#include "program/target.h"
#include "program/video_target.h"
#include "program/view.h"

static cs_exit refuse_video_options(const cs_request *request) {
  for (const char *const *option = cs_video_target_options; *option; option++)
    if (cs_request_has(request, *option))
      return cs_report_usage("%s is only for videos, such as film.mp4", *option);
  return CS_EXIT_OK;
}

static cs_exit refuse_stream(const cs_request *request) {
  const char *format = cs_request_text(request, "--format");
  cs_progress_style style = CS_PROGRESS_AUTO;
  cs_request_read(request, "--progress", &style);
  CS_TRY_EXIT(refuse_video_options(request));
  if (cs_request_has(request, "--hash"))
    return cs_report_usage("--hash prints to standard output, where -o - puts the frames: give one "
                           "of them");
  if (style == CS_PROGRESS_OPENJD)
    return cs_report_usage("--progress openjd prints to standard output, where -o - puts the "
                           "frames: give one of them");
  if (format)
    return cs_report_usage("--format %s goes into files: with -o - frames are raw RGBA rows",
                           format);
  return CS_EXIT_OK;
}

/* A shared file in messages: "a plane file", "a PDF file". */
static const char *name_of(const char *shared) {
  return strcmp(shared, "pdf") == 0 ? "PDF" : shared;
}

static cs_exit refuse_resume(const cs_request *request, const char *output) {
  bool resumes = cs_request_has(request, "--resume");
  if (cs_request_has(request, "--force") && !resumes)
    return cs_report_usage("--force needs --resume");
  const char *shared = cs_target_shared(request);
  if (cs_request_has(request, "--keep-going") && shared)
    return cs_report_usage("%s: a %s file is made whole: leave --keep-going out, or render "
                           "shot.####.%s",
                           output, name_of(shared), shared);
  if (resumes && (!output || cs_target_is_stream(output)))
    return cs_report_usage("--resume looks for the frames of an earlier run: give -o "
                           "shot.####.png");
  return CS_EXIT_OK;
}

cs_exit cs_refusals_of_output(celspan_context *context, const cs_request *request,
                              size_t frame_count) {
  if (cs_video_target_is_wanted(request, frame_count))
    return cs_request_has(request, "--strict") && cs_video_target_runs_ffmpeg(request)
               ? cs_report_usage("--strict starts no programs, and ffmpeg makes videos: render "
                                 "frames, and make the video of them")
               : cs_video_target_refuse(request, frame_count);
  CS_TRY_EXIT(refuse_video_options(request));
  const char *output = cs_request_text(request, "-o");
  return output ? cs_target_refuse(context, output, request) : CS_EXIT_OK;
}

static cs_exit refuse_dither(const cs_request *request) {
  celspan_depth depth = CELSPAN_DEPTH_8;
  cs_request_read(request, "--depth", &depth);
  if (cs_request_has(request, "--dither") && cs_request_has(request, "--no-dither"))
    return cs_report_usage("--dither and --no-dither exclude each other: give one of them");
  return cs_request_has(request, "--dither") && depth != CELSPAN_DEPTH_8
             ? cs_report_usage("--dither makes 8 bits: leave --depth out, or give --depth 8")
             : CS_EXIT_OK;
}

/* Refuses strips and tasks together with outputs that cannot be divided. */
static cs_exit refuse_division(const cs_request *request, const char *output) {
  const char *option = cs_request_has(request, "--strip")  ? "--strip"
                       : cs_request_has(request, "--task") ? "--task"
                                                           : NULL;
  if (!option)
    return CS_EXIT_OK;
  if (output && cs_target_is_stream(output))
    return cs_report_usage("%s makes files: give -o shot.####.png", option);
  if (cs_video_target_is_wanted(request, 0))
    return cs_report_usage("%s: a video is made of all its frames in one run; render frames, and "
                           "make the video of them",
                           option);
  const char *shared = cs_target_shared(request);
  if (shared)
    return cs_report_usage(
        "%s: a %s file of several frames is made in one run; render shot.####.%s", option,
        name_of(shared), shared);
  return CS_EXIT_OK;
}

cs_exit cs_refusals_early(celspan_context *context, const cs_request *request) {
  const char *output = cs_request_text(request, "-o");
  if (!output && !cs_request_has(request, "--hash"))
    return cs_report_usage("-o is missing: give -o shot.####.png (or --hash for digests only)");
  CS_TRY_EXIT(refuse_resume(request, output));
  CS_TRY_EXIT(refuse_dither(request));
  CS_TRY_EXIT(refuse_division(request, output));
  CS_TRY_EXIT(cs_layers_target_refuse(request));
  if (!cs_drawing_target_is_output(request))
    CS_TRY_EXIT(cs_drawing_target_refuse_own(output ? output : "--hash", request));
  if (output && cs_target_is_stream(output))
    return refuse_stream(request);
  return cs_refusals_of_output(context, request, 0);
}

cs_exit cs_refusals_of_film(const cs_script *script, const cs_request *request) {
  const cs_film_info *film = &script->film;
  celspan_frame_desc frame;
  CS_TRY_EXIT(cs_view_frame(request, film->width, film->height, &frame));
  return cs_video_target_is_wanted(request, (size_t)film->count)
             ? cs_video_target_refuse_frames(script, request, &frame)
             : CS_EXIT_OK;
}
