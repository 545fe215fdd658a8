#include "program/outputs/video_target.h"

#include <string.h>

#include "inside/context.h"
#include "inside/sinks.h"
#include "lua/bind/put.h"
#include "program/film/change.h"
#include "program/film/soundtrack.h"
#include "program/film/spaces.h"
#include "program/outputs/video_colours.h"

enum {
  MOST_SIDE = 16384, /* the limit of H.264 and VP9 */
  QUALITY = 75,      /* the default */
  PIXEL = 4          /* bytes of a poster */
};

static const cs_video_format *format_of(const cs_request *request) {
  const char *format = cs_request_text(request, "--format");
  return cs_video_format_named(format ? format : cs_file_ending(cs_request_text(request, "-o")));
}

/* NULL: the format cannot contain the codec of --codec. */
static const cs_video_codec *codec_of(const cs_request *request) {
  return cs_video_codec_named(format_of(request), cs_request_text(request, "--codec"));
}

/* Frames of 8 bits are dithered unless that is not wanted; ffmpeg dithers frames of few colours. */
static bool is_dithered(const cs_request *request, const cs_video_codec *codec) {
  bool is_default = !cs_request_has(request, "--no-dither") && !codec->is_indexed;
  return cs_request_has(request, "--dither") || is_default;
}

static cs_video_options options_of(const cs_request *request, const cs_video_codec *codec) {
  bool has_8 = cs_request_has(request, "--dither");
  cs_video_options options = {.codec = codec,
                              .coding = CELSPAN_CODING,
                              .dithers = is_dithered(request, codec),
                              .is_opaque = cs_request_has(request, "--background"),
                              .quality = QUALITY};
  if (has_8)
    options.coding.depth = CELSPAN_DEPTH_8;
  options.has_crf = cs_request_read(request, "--crf", &options.crf);
  cs_request_read(request, "--depth", &options.coding.depth);
  cs_spaces_set(request, &options.coding);
  cs_request_read(request, "--alpha", &options.coding.alpha);
  cs_request_read(request, "--quality", &options.quality);
  cs_request_read(request, "--loop", &options.plays);
  return options;
}

/* ---------------------------------------------------------------- refusals */

static bool is_limited(const cs_video_codec *codec) {
  return codec->most_crf > 0 && !codec->module;
}

static bool runs_ffmpeg(const cs_request *request) {
  return !format_of(request)->codecs[0]->module;
}

/* Whether a codec of the format has a quality that --max-size can choose. */
static bool contains_limited(const cs_video_format *format) {
  for (size_t i = 0; i < CS_VIDEO_CODECS && format->codecs[i]; i++)
    if (is_limited(format->codecs[i]))
      return true;
  return false;
}

/* Refuses --max-size where the quality cannot be changed, or is given. */
static cs_exit refuse_limit(const cs_request *request, const cs_video_codec *codec) {
  static const char *const options[] = {"--quality", "--crf"};
  for (size_t i = 0; i < sizeof options / sizeof *options; i++)
    if (cs_request_has(request, options[i]))
      return cs_report_usage("--max-size chooses the quality: leave %s out", options[i]);
  if (is_limited(codec))
    return CS_EXIT_OK;
  return cs_report_usage("%s: --max-size is for h264, h265, av1 and vp9, whose quality can be "
                         "chosen finely enough: leave it out, or %s",
                         cs_request_text(request, "-o"),
                         contains_limited(format_of(request)) ? "give another --codec"
                                                              : "write .mp4, .webm or .mkv");
}

static cs_exit refuse_codec(const cs_request *request, const cs_video_format *format) {
  const char *output = cs_request_text(request, "-o"), *name = cs_request_text(request, "--codec");
  const cs_video_codec *codec = codec_of(request);
  int32_t crf = 0;
  if (!codec) {
    char names[128];
    cs_video_codec_list(format, names, sizeof names);
    return cs_report_usage("%s: --codec %s: %s contains %s", output, name, format->name, names);
  }
  if (cs_request_has(request, "--max-size"))
    return refuse_limit(request, codec);
  if (!cs_request_read(request, "--crf", &crf))
    return CS_EXIT_OK;
  if (cs_request_has(request, "--quality"))
    return cs_report_usage("--crf and --quality exclude each other: give one of them");
  if (codec->most_crf == 0)
    return cs_report_usage("%s: %s has no --crf: leave it out%s", output, codec->name,
                           codec->quality ? ", or give --quality" : "");
  if (crf > codec->most_crf)
    return cs_report_usage("%s: --crf of %s is a whole number from 0 to %d", output, codec->name,
                           (int)codec->most_crf);
  return CS_EXIT_OK;
}

cs_exit cs_video_target_refuse(celspan_context *context, const cs_request *request,
                               const char *path) {
  (void)context;
  if (cs_request_has(request, "--strict") && runs_ffmpeg(request))
    return cs_report_usage("--strict starts no programs, and ffmpeg makes videos: render frames, "
                           "and make the video of them");
  CS_TRY_EXIT(refuse_codec(request, format_of(request)));
  cs_video_options options = options_of(request, codec_of(request));
  if (options.codec->module && options.coding.alpha == CELSPAN_ALPHA_PREMULTIPLIED)
    return cs_report_usage("%s: films in %s hold straight alpha: leave --alpha out, or render "
                           "shot.####.avif",
                           path, options.codec->title);
  if (!cs_video_pixels(&options))
    return cs_report_usage(
        "%s: %s holds 8 bits%s: leave --depth 16 out, or write .mov", path, options.codec->name,
        options.codec->deep_pixels ? " where it has alpha (--background takes it away)" : "");
  return cs_video_colours_set(request, &options);
}

/* 4:2:0 gives one colour to 2 x 2 pixels, and most encoders do not support half of such a square at
 * the edge. */
static cs_exit refuse_size(const cs_video_desc *video) {
  const char *output = video->path;
  const cs_video_codec *codec = video->options.codec;
  int32_t width = video->frames.width, height = video->frames.height;
  int32_t even_width = width > 1 ? width & ~1 : 2, even_height = height > 1 ? height & ~1 : 2;
  int32_t side = codec->most_side ? codec->most_side : MOST_SIDE;
  if (width > side || height > side)
    return cs_report_usage("%s: %d x %d pixels: %s has at most %d a side", output, (int)width,
                           (int)height, codec->title ? codec->title : "a video", (int)side);
  if (codec->module && (int64_t)width * height > CS_AVIF_PIXELS)
    return cs_report_usage("%s: %d x %d pixels: %s has at most %lld together, because programs "
                           "refuse to read more",
                           output, (int)width, (int)height, codec->title,
                           (long long)CS_AVIF_PIXELS);
  if (width < codec->least_width || height < codec->least_height)
    return cs_report_usage("%s: %d x %d pixels: %s needs at least %d x %d: give a larger --size, "
                           "or another --codec",
                           output, (int)width, (int)height, codec->name, (int)codec->least_width,
                           (int)codec->least_height);
  if (codec->is_halved && (even_width != width || even_height != height))
    return cs_report_usage("%s: %d x %d pixels: %s needs an even width and height in %s: give "
                           "--size %dx%d, or write .webm or .mkv",
                           output, (int)width, (int)height, codec->name, video->format->name,
                           (int)even_width, (int)even_height);
  return CS_EXIT_OK;
}

static cs_exit refuse_rate(const cs_video_desc *video) {
  double frames_second = video->frames.frames_second;
  if (frames_second <= video->format->most_frames_second)
    return CS_EXIT_OK;
  return cs_report_usage("%s: %g frames per second: %s holds at most %g", video->path,
                         frames_second, video->format->name, video->format->most_frames_second);
}

/* The value of --max-size; 0: none. */
static uint64_t most_bytes_of(const cs_request *request) {
  double bytes = 0;
  return cs_request_read(request, "--max-size", &bytes) ? (uint64_t)bytes : 0;
}

/* ---------------------------------------------------------------- sound */

/* The sound of the film for these frames. */
static cs_exit set_sound(cs_video_desc *video, cs_script *script, const cs_request *request,
                         const cs_sequence *frames) {
  int64_t moments;
  if (!script->film.has_sound)
    return cs_request_has(request, "--loudness")
               ? cs_report_usage("%s: the film has no sound: leave --loudness out",
                                 request->operands[0])
               : CS_EXIT_OK;
  if (video->format->sound)
    return cs_soundtrack_open(script, request, frames, NULL, &video->sound, &moments);
  cs_report_note("%s: %s holds no sound: it is left out", video->path, video->format->name);
  return CS_EXIT_OK;
}

/* ---------------------------------------------------------------- the poster */

/* Builds the frame and adds it to the view. */
static cs_exit build_poster(cs_script *script, const cs_request *request,
                            celspan_frame_desc *frame) {
  const cs_frame_change change = cs_change_read(request);
  CS_TRY_EXIT(cs_script_build(script, script->film.poster));
  celspan_status status = cs_change_frame(script->context, &change, &script->frame);
  cs_film_expose(&script->film, &script->frame, frame);
  return cs_script_failure(script, status);
}

/* 8 bits and straight alpha, which every program shows. */
static celspan_coding poster_coding(const cs_request *request) {
  celspan_coding coding = CELSPAN_CODING;
  coding.depth = CELSPAN_DEPTH_8;
  coding.alpha = CELSPAN_ALPHA_STRAIGHT;
  cs_spaces_set(request, &coding);
  return coding;
}

/* The pixels for an attached picture: RGBA of 8 bits, of the frame's size; NULL: the file has none.
 * frame: the view. */
static cs_exit make_poster(cs_script *script, const cs_request *request,
                           const cs_video_format *format, const celspan_frame_desc *frame,
                           unsigned char **out, size_t *size) {
  celspan_frame_desc desc = *frame;
  celspan_coding coding = poster_coding(request);
  *out = NULL;
  if (!script->film.has_poster || format->poster != CS_POSTER_ATTACHED)
    return CS_EXIT_OK;
  CS_TRY_EXIT(build_poster(script, request, &desc));
  bool is_part = desc.crop_width > 0;
  size_t stride = PIXEL * (size_t)(is_part ? desc.crop_width : desc.width);
  *size = stride * (size_t)(is_part ? desc.crop_height : desc.height);
  *out = cs_mem_resize(script->context->memory, NULL, 0, *size);
  celspan_status status =
      *out ? celspan_frame_pixels(script->context, &desc, &coding, *out, stride, NULL)
           : cs_fail_memory(script->context);
  if (status != CELSPAN_OK) {
    cs_mem_free(script->context->memory, *out, *size);
    *out = NULL;
  }
  return cs_script_failure(script, status);
}

cs_exit cs_video_target_write_poster(cs_script *script, const cs_request *request,
                                     const celspan_frame_desc *frame, const char *path) {
  celspan_frame_desc desc = *frame;
  celspan_coding coding = poster_coding(request);
  celspan_file_desc file = CELSPAN_FILE_DESC;
  file.format = "png";
  file.coding = &coding;
  CS_TRY_EXIT(build_poster(script, request, &desc));
  return cs_script_failure(script, celspan_frame_write(script->context, &desc, path, &file, NULL));
}

/* ---------------------------------------------------------------- opening */

static cs_video_desc describe(const cs_script *script, const cs_request *request,
                              const celspan_frame_desc *frame) {
  bool is_part = frame->crop_width > 0;
  int32_t memory = 1;
  bool has_memory = cs_request_read(request, "--memory", &memory);
  cs_video_desc desc = {.path = cs_request_text(request, "-o"),
                        .format = format_of(request),
                        .title = script->film.title,
                        .options = options_of(request, codec_of(request)),
                        .frames = {.width = is_part ? frame->crop_width : frame->width,
                                   .height = is_part ? frame->crop_height : frame->height,
                                   .frames_second = script->film.frames_second},
                        .most_bytes = most_bytes_of(request),
                        .has_digests = cs_request_has(request, "--hash"),
                        .workers = frame->workers,
                        .keeps_nothing = has_memory && memory == 0};
  cs_request_read(request, "--fps", &desc.frames.frames_second);
  return desc;
}

cs_exit cs_video_target_refuse_frames(const cs_script *script, const cs_request *request,
                                      const celspan_frame_desc *frame) {
  const cs_video_desc desc = describe(script, request, frame);
  CS_TRY_EXIT(refuse_size(&desc));
  return refuse_rate(&desc);
}

/* The sound belongs to the video as soon as it is opened. */
static cs_exit open_with_sound(cs_video *out, cs_script *script, const cs_request *request,
                               cs_video_desc *desc, const cs_sequence *played) {
  CS_TRY_EXIT(set_sound(desc, script, request, played));
  return cs_report_failure(script->context, cs_video_open(out, script->context, desc), NULL);
}

cs_exit cs_video_target_open(cs_video *out, cs_script *script, const cs_request *request,
                             const celspan_frame_desc *frame, const cs_sequence *played,
                             const char *chapters, const char *captions) {
  unsigned char *pixels;
  size_t size = 0;
  cs_video_desc desc = describe(script, request, frame);
  desc.chapters = chapters;
  desc.captions = captions;
  CS_TRY_EXIT(cs_video_colours_set(request, &desc.options));
  CS_TRY_EXIT(make_poster(script, request, desc.format, frame, &pixels, &size));
  desc.poster = pixels;
  cs_exit outcome = open_with_sound(out, script, request, &desc, played);
  cs_mem_free(script->context->memory, pixels, size);
  return outcome;
}

void cs_video_target_put(lua_State *L, const cs_request *request) {
  static const char *const posters[] = {
      [CS_POSTER_NONE] = NULL, [CS_POSTER_ATTACHED] = "attached", [CS_POSTER_BESIDE] = "beside"};
  const cs_video_format *format = format_of(request);
  cs_put_text(L, "format", format->name);
  cs_put_text(L, "captions_form", format->captions ? format->captions_form : NULL);
  cs_put_text(L, "poster", posters[format->poster]);
  cs_put_flag(L, "runs_ffmpeg", runs_ffmpeg(request));
}
