#include "cli/video/command.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#define USUAL_QUALITY 75
#define FROM_RGB                                                                                   \
  "scale=out_color_matrix=bt709:out_range=tv:flags=area+accurate_rnd+full_chroma_int,"
#define MOST_DENOMINATOR 1001000 /* of frames a second: 24000/1001 and the like are exact */

/* ---------------------------------------------------------------- arguments */

static void add(cs_video_command *command, const char *argument) {
  if (command->count + 1 < CS_VIDEO_ARGUMENTS)
    command->arguments[command->count++] = argument;
}

__attribute__((format(printf, 2, 3))) static void add_text(cs_video_command *command,
                                                           const char *format, ...) {
  char *text = command->text + command->text_size;
  size_t room = sizeof command->text - command->text_size;
  va_list values;
  va_start(values, format);
  int size = vsnprintf(text, room, format, values);
  va_end(values);
  if (size < 0 || (size_t)size >= room)
    return;
  command->text_size += (size_t)size + 1;
  add(command, text);
}

static void add_all(cs_video_command *command, const char *const *arguments) {
  for (; *arguments; arguments++)
    add(command, *arguments);
}

static void begin(cs_video_command *command) {
  static const char *const first[] = {"ffmpeg", "-nostdin", "-hide_banner", "-loglevel",
                                      "error",  "-xerror",  "-y",           NULL};
  *command = (cs_video_command){0};
  add_all(command, first);
}

/* ---------------------------------------------------------------- frames */

/* The nearest fraction, by continued fractions: 23.976023976... is 24000/1001. */
static void add_rate(cs_video_command *command, double rate) {
  double numerator[2] = {1, floor(rate)}, denominator[2] = {0, 1}, rest = rate - floor(rate);
  while (rest > 1e-9 && fabs(numerator[1] / denominator[1] - rate) > rate * 1e-12) {
    double whole = floor(1 / rest), next_numerator = whole * numerator[1] + numerator[0],
           next_denominator = whole * denominator[1] + denominator[0];
    if (next_denominator > MOST_DENOMINATOR)
      break;
    rest = 1 / rest - whole;
    numerator[0] = numerator[1];
    numerator[1] = next_numerator;
    denominator[0] = denominator[1];
    denominator[1] = next_denominator;
  }
  add_text(command, "%.0f/%.0f", numerator[1], denominator[1]);
}

/* Bytes that hold no alpha are called so: a frame over black has its alpha in them. */
static const char *frame_pixels(const cs_video_format *format, const cs_request *request) {
  if (cs_video_layout_of(format, request) != CS_VIDEO_RGBA)
    return cs_video_pixels(format, request);
  if (cs_video_is_deep(format, request))
    return "rgba64le";
  return cs_video_has_alpha(format, request) ? "rgba" : "rgb0";
}

static void add_frames(cs_video_command *command, const cs_video_format *format,
                       const cs_request *request, const cs_video_frames *frames) {
  add(command, "-f");
  add(command, "rawvideo");
  add(command, "-pixel_format");
  add(command, frame_pixels(format, request));
  add(command, "-video_size");
  add_text(command, "%dx%d", (int)frames->width, (int)frames->height);
  add(command, "-framerate");
  add_rate(command, frames->frames_second);
  add(command, "-i");
  add(command, "pipe:0");
}

/* ---------------------------------------------------------------- pictures */

static int32_t quality_of(const cs_request *request) {
  return request->quality.is_given ? request->quality.value : USUAL_QUALITY;
}

/* A table of colours for each frame, so that the frames need not be kept until the last one is
 * there. Dots between two colours look better than bands, and make the file larger. */
static void add_indexed(cs_video_command *command, const cs_video_format *format,
                        const cs_request *request) {
  int32_t quality = quality_of(request);
  add(command, "-filter_complex");
  add_text(command,
           "[0:v]split[a][b];[a]palettegen=stats_mode=single:max_colors=%d:reserve_transparent=%d"
           "[p];[b][p]paletteuse=new=1:dither=%s",
           cs_video_quality(format, quality), cs_video_has_alpha(format, request),
           quality < 50 ? "none" : "sierra2_4a");
}

/* ffmpeg takes pictures of any size for BT.601 unless it is told otherwise, and tells the file
 * nothing unless it is told to. Rounding is exact, and where 2 x 2 pixels share a colour it is their
 * mean: flat colours stay what they are. Planes that were made here are left as they are. */
static void add_yuv(cs_video_command *command, const cs_video_format *format,
                    const cs_request *request) {
  bool is_rec709 = request->coding.transfer == CELSPAN_TRANSFER_REC709;
  const char *transfer = is_rec709 ? "bt709" : "iec61966-2-1";
  bool is_made = cs_video_layout_of(format, request) != CS_VIDEO_RGBA;
  const char *const tags[] = {
      "-color_range", "tv",         "-colorspace", "bt709", "-color_primaries",
      "bt709",        "-color_trc", transfer,      NULL};
  add(command, "-vf");
  add_text(command,
           "%sformat=%s,setparams=range=tv:colorspace=bt709:color_primaries=bt709:color_trc=%s",
           is_made ? "" : FROM_RGB, cs_video_pixels(format, request), transfer);
  add_all(command, tags);
}

static void add_pictures(cs_video_command *command, const cs_video_format *format,
                         const cs_request *request) {
  if (!format->quality)
    add_indexed(command, format, request);
  else if (!format->is_rgb)
    add_yuv(command, format, request);
  add_all(command, format->encoder);
  if (format->quality) {
    add(command, format->quality);
    add_text(command, "%d", cs_video_quality(format, quality_of(request)));
  }
  if (format->is_rgb && format->quality) {
    add(command, "-pix_fmt");
    add(command, cs_video_pixels(format, request));
  }
}

/* ---------------------------------------------------------------- sound */

/* Samples are moved, not the times that a player may heed or not: silence before the sound, or its
 * beginning cut off; then silence up to the last frame, or a cut there. */
static void add_sound(cs_video_command *command, const cs_video_format *format,
                      const cs_video_sound *sound) {
  add(command, "-filter_complex");
  if (sound->start >= 0)
    add_text(command, "[1:a:0]asetpts=N/SR/TB,adelay=delays=%.6f:all=1,apad,atrim=end=%.9f[s]",
             sound->start * 1000, sound->length);
  else
    add_text(command,
             "[1:a:0]asetpts=N/SR/TB,apad,atrim=start=%.9f:end=%.9f,asetpts=PTS-STARTPTS[s]",
             -sound->start, sound->length - sound->start);
  add(command, "-map");
  add(command, "0:v");
  add(command, "-map");
  add(command, "[s]");
  add_all(command, format->sound);
}

void cs_video_command_encode(cs_video_command *command, const cs_video_format *format,
                             const cs_request *request, const cs_video_frames *frames,
                             const cs_video_sound *sound, const char *file) {
  begin(command);
  add_frames(command, format, request, frames);
  if (sound->path) {
    add(command, "-i");
    add_text(command, "file:%s", sound->path);
  }
  add_pictures(command, format, request);
  if (sound->path)
    add_sound(command, format, sound);
  if (format->flags) {
    add(command, "-movflags");
    add(command, format->flags);
  }
  add(command, "-f");
  add(command, format->muxer);
  add_text(command, "file:%s", file);
}

void cs_video_command_listen(cs_video_command *command, const char *sound) {
  static const char *const rest[] = {"-map", "0:a:0", "-t", "0.1", "-f", "null", "-", NULL};
  begin(command);
  add(command, "-i");
  add_text(command, "file:%s", sound);
  add_all(command, rest);
}
