#include "cli/video/video.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/open.h"
#include "cli/video/command.h"
#include "cli/video/planes.h"
#include "cli/video/sound.h"
#include "output/dither.h"
#include "output/ending.h"
#include "output/pixels.h"
#include "output/sink.h"
#include "output/tee.h"
#include "output/temporary.h"

#define MOST_SIDE 16384 /* of H.264, VP9 and WebP alike */

/* ---------------------------------------------------------------- refusals */

static const cs_video_format *format_of(const cs_request *request) {
  return !request->output || strcmp(request->output, "-") == 0
             ? NULL
             : cs_video_format_named(request->format ? request->format
                                                     : cs_ending_of(request->output));
}

bool cs_video_is_wanted(const cs_request *request, size_t frame_count) {
  const cs_video_format *format = format_of(request);
  if (!format || !format->is_picture)
    return format != NULL;
  return frame_count != 1 && !cs_sequence_has_number(request->output);
}

static cs_exit refuse_options(const cs_request *request, const cs_video_format *format) {
  const char *output = request->output;
  if (cs_sequence_has_number(output))
    return cs_report_usage("%s: a video is one file: leave the frame's number out of its name",
                           output);
  if (request->resumes)
    return cs_report_usage("%s: --resume keeps frames that are files, and a video is made whole: "
                           "leave --resume out, or render shot.####.png",
                           output);
  if (request->keeps_going)
    return cs_report_usage("%s: --keep-going leaves frames out, and a video has them all: leave it "
                           "out, or render shot.####.png",
                           output);
  if (request->coding.transfer == CELSPAN_TRANSFER_LINEAR ||
      request->coding.transfer == CELSPAN_TRANSFER_CINEON)
    return cs_report_usage("%s: a video is coded as srgb or rec709: leave --colour out", output);
  if (request->coding.depth == CELSPAN_DEPTH_HALF || request->coding.depth == CELSPAN_DEPTH_FLOAT)
    return cs_report_usage("%s: a video takes --depth 8 or 16", output);
  if (!cs_video_pixels(format, request))
    return cs_report_usage(
        "%s: %s holds 8 bits%s: leave --depth 16 out, or write .mov", output, format->name,
        format->deep_pixels ? " where it has alpha (--background takes it away)" : "");
  return CS_EXIT_OK;
}

cs_exit cs_video_refuse(const cs_request *request, size_t frame_count) {
  const cs_video_format *format = format_of(request);
  return format->is_picture && frame_count == 0 ? CS_EXIT_OK : refuse_options(request, format);
}

/* 4:2:0 gives one colour to 2 x 2 pixels, and H.264 has no half ones at the edge. */
static cs_exit refuse_size(const cs_video *video, int32_t width, int32_t height) {
  const char *output = video->request->output;
  int32_t even_width = width > 1 ? width & ~1 : 2, even_height = height > 1 ? height & ~1 : 2;
  if (width > MOST_SIDE || height > MOST_SIDE)
    return cs_report_usage("%s: %d x %d pixels: a video has at most %d a side", output, (int)width,
                           (int)height, MOST_SIDE);
  if (video->format->is_halved && (even_width != width || even_height != height))
    return cs_report_usage("%s: %d x %d pixels: %s needs an even width and height: give --size "
                           "%dx%d, or write .mov, .webm or .mkv",
                           output, (int)width, (int)height, video->format->name, (int)even_width,
                           (int)even_height);
  return CS_EXIT_OK;
}

static cs_exit refuse_rate(const cs_video *video, double frames_second) {
  if (frames_second <= video->format->most_frames_second)
    return CS_EXIT_OK;
  return cs_report_usage("%s: %g frames a second: %s holds at most %g", video->request->output,
                         frames_second, video->format->name, video->format->most_frames_second);
}

/* ---------------------------------------------------------------- sound */

static bool is_run(const cs_sequence *frames) {
  for (size_t i = 1; i < frames->count; i++)
    if (frames->frames[i] != frames->frames[i - 1] + 1)
      return false;
  return true;
}

/* The film's sound, as it goes with these frames. Its path is left on the Lua stack, where it lives
 * as long as the script. */
static cs_exit find_sound(const cs_video *video, cs_script *script, const cs_sequence *frames,
                          cs_video_sound *out) {
  const cs_film_info *film = &script->film;
  *out = (cs_video_sound){0};
  if (!film->sound || !video->format->sound) {
    if (film->sound)
      cs_report_note("%s: %s holds no sound: it is left out", video->request->output,
                     video->format->name);
    return CS_EXIT_OK;
  }
  if (!is_run(frames))
    return cs_report_usage("--frames %s: the film has a sound, which goes with one run of frames "
                           "such as 10-20",
                           video->request->frames);
  celspan_status status = cs_sound_find(script, &out->path);
  if (status == CELSPAN_OK)
    status = cs_sound_listen(video->context, out->path);
  out->start = film->sound_offset - (double)(frames->frames[0] - film->first) / film->frames_second;
  out->length = (double)frames->count / film->frames_second;
  return cs_report_failure(video->context, status, NULL);
}

/* ---------------------------------------------------------------- opening */

static bool is_same(const char *pattern, const char *name) { return strcmp(pattern, name) == 0; }

static size_t frame_size(const cs_video *video, int32_t width, int32_t height) {
  return video->layout == CS_VIDEO_RGBA
             ? video->stride * (size_t)height
             : cs_planes_size(width, height, video->layout == CS_VIDEO_420);
}

static celspan_status start(cs_video *video, const cs_video_command *command, int32_t width,
                            int32_t height) {
  size_t size = frame_size(video, width, height);
  celspan_status status = cs_encoder_open(&video->encoder, video->context, video->request->output,
                                          command->arguments, size);
  if (status != CELSPAN_OK)
    cs_file_discard(video->file, video->context);
  return status;
}

static cs_exit open_file(cs_video *video, const char **name) {
  cs_temporary_sweep(video->request->output, is_same);
  celspan_status status =
      cs_file_create(video->context, NULL, video->request->output, &video->file);
  if (status == CELSPAN_OK)
    status = cs_file_temporary(video->file, video->context, name);
  return cs_report_failure(video->context, status, NULL);
}

static cs_exit refuse_film(const cs_video *video, const cs_video_frames *frames) {
  cs_exit outcome = cs_video_refuse(video->request, SIZE_MAX);
  if (outcome == CS_EXIT_OK)
    outcome = refuse_size(video, frames->width, frames->height);
  return outcome == CS_EXIT_OK ? refuse_rate(video, frames->frames_second) : outcome;
}

cs_exit cs_video_open(cs_video *out, cs_script *script, const cs_request *request,
                      const celspan_frame_desc *frame, const cs_sequence *frames) {
  bool is_part = frame->crop_width > 0;
  const cs_video_frames size = {.width = is_part ? frame->crop_width : frame->width,
                                .height = is_part ? frame->crop_height : frame->height,
                                .frames_second = script->film.frames_second};
  cs_video_command command;
  cs_video_sound sound;
  const char *name = NULL;
  *out = (cs_video){.context = script->context, .request = request, .format = format_of(request)};
  out->coding = cs_video_coding(out->format, request);
  out->stride = (size_t)size.width * celspan_coding_pixel_size(&out->coding);
  cs_exit outcome = refuse_film(out, &size);
  if (outcome == CS_EXIT_OK)
    outcome = find_sound(out, script, frames, &sound);
  if (outcome == CS_EXIT_OK)
    outcome = open_file(out, &name);
  if (outcome != CS_EXIT_OK)
    return outcome;
  out->layout = cs_video_layout_of(out->format, request);
  cs_video_command_encode(&command, out->format, request, &size, &sound, name);
  return cs_report_failure(script->context, start(out, &command, size.width, size.height), NULL);
}

/* ---------------------------------------------------------------- frames */

static bool is_repeated(const cs_video *video, const cs_shoot_frame *frame) {
  bool keeps_nothing = video->request->memory.is_given && video->request->memory.value == 0;
  return video->has_last && frame->is_named && !keeps_nothing && frame->scene.a == video->last.a &&
         frame->scene.b == video->last.b;
}

/* A sink of the frame's pixels, as the encoder is sent them. planes: kept by the sink. */
static celspan_status open_sink(const cs_video *video, const celspan_frame_desc *desc,
                                unsigned char *pixels, cs_planes *planes, celspan_sink *out) {
  if (video->layout != CS_VIDEO_RGBA) {
    *out = cs_planes_sink(planes, &video->coding, desc, video->layout == CS_VIDEO_420, pixels);
    return CELSPAN_OK;
  }
  celspan_coding plain = cs_pixels_resolve(&video->coding, CELSPAN_DEPTH_8);
  CS_TRY(cs_sink_memory(video->context, &plain, pixels, video->stride, out));
  return cs_dither_sink(video->context, &video->coding, &plain, desc->crop_x, desc->crop_y, out);
}

/* A sink of the hash of its RGBA pixels. */
static celspan_status open_digest(cs_video *video, const celspan_frame_desc *desc,
                                  celspan_sink *out) {
  celspan_coding plain = cs_pixels_resolve(&video->coding, CELSPAN_DEPTH_8);
  CS_TRY(cs_sink_digest(video->context, &plain, video->digest, out));
  return cs_dither_sink(video->context, &video->coding, &plain, desc->crop_x, desc->crop_y, out);
}

/* Sends and hashes the frame in one pass over its rows. */
static celspan_status make_both(cs_video *video, const celspan_frame_desc *desc,
                                unsigned char *pixels) {
  cs_planes planes;
  cs_tee tee;
  CS_TRY(open_sink(video, desc, pixels, &planes, &tee.sinks[0]));
  celspan_status status = open_digest(video, desc, &tee.sinks[1]);
  if (status != CELSPAN_OK) {
    cs_sink_discard(video->context, &tee.sinks[0]);
    return status;
  }
  celspan_sink sink = cs_tee_sink(&tee);
  status = celspan_frame_render(video->context, desc, &sink, NULL);
  for (int i = 0; i < 2 && !tee.is_ended; i++)
    cs_sink_discard(video->context, &tee.sinks[i]);
  return status;
}

static celspan_status make_one(const cs_video *video, const celspan_frame_desc *desc,
                               unsigned char *pixels) {
  cs_planes planes;
  if (video->layout == CS_VIDEO_RGBA)
    return celspan_frame_pixels(video->context, desc, &video->coding, pixels, video->stride, NULL);
  celspan_sink sink =
      cs_planes_sink(&planes, &video->coding, desc, video->layout == CS_VIDEO_420, pixels);
  return celspan_frame_render(video->context, desc, &sink, NULL);
}

static celspan_status make(cs_video *video, const celspan_frame_desc *desc) {
  int place;
  CS_TRY(cs_encoder_take(&video->encoder, &place));
  unsigned char *pixels = cs_encoder_pixels(&video->encoder, place);
  CS_TRY(video->request->hash ? make_both(video, desc, pixels) : make_one(video, desc, pixels));
  cs_encoder_give(&video->encoder, place);
  return CELSPAN_OK;
}

celspan_status cs_video_put(cs_video *video, const celspan_frame_desc *desc,
                            cs_shoot_frame *frame) {
  if (is_repeated(video, frame)) {
    frame->way = CS_SHOOT_COPIED;
    CS_TRY(cs_encoder_repeat(&video->encoder));
  } else {
    CS_TRY(make(video, desc));
  }
  video->has_last = frame->is_named;
  video->last = frame->scene;
  memcpy(frame->digest, video->digest, sizeof frame->digest);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the end */

/* What a file begins with: fewer bytes where it has no more, -1 and errno where it cannot be read. */
static ssize_t read_head(const char *name, char *bytes, size_t size) {
  int descriptor = cs_open_to_read(name);
  if (descriptor < 0)
    return -1;
  ssize_t got = cs_open_read_at(descriptor, bytes, size, 0);
  close(descriptor);
  return got;
}

/* An encoder that ends well has written a file of its format. */
static celspan_status check_mark(const cs_video *video, const char *name) {
  char bytes[16] = {0};
  ssize_t size = read_head(name, bytes, sizeof bytes);
  const char *mark = video->format->mark.bytes;
  if (size < 0)
    return cs_fail(video->context, CELSPAN_OUTPUT, "%s: cannot be read back: %s",
                   video->request->output, strerror(errno));
  if (size == sizeof bytes && memcmp(bytes + video->format->mark.offset, mark, 4) == 0)
    return CELSPAN_OK;
  return cs_fail(video->context, CELSPAN_OUTPUT, "%s: what ffmpeg wrote is no %s file",
                 video->request->output, video->format->name);
}

static celspan_status complete(cs_video *video) {
  const char *name;
  CS_TRY(cs_encoder_finish(&video->encoder));
  CS_TRY(cs_file_temporary(video->file, video->context, &name));
  CS_TRY(check_mark(video, name));
  return cs_file_adopt(video->file, video->context);
}

celspan_status cs_video_finish(cs_video *video) {
  celspan_status status = complete(video);
  if (status == CELSPAN_OK)
    return cs_file_commit(video->file, video->context);
  cs_video_discard(video);
  return status;
}

void cs_video_discard(cs_video *video) {
  cs_encoder_discard(&video->encoder);
  cs_file_discard(video->file, video->context);
}
