/* Commands of ffmpeg, argument by argument. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "common/utf8.h"
#include "process/child.h"
#include "video/format.h"

#define FROM_RGB                                                                                   \
  "scale=out_color_matrix=bt709:out_range=tv:flags=area+accurate_rnd+full_chroma_int,"
#define MOST_NAME 2000           /* bytes of a title */
#define MOST_DENOMINATOR 1001000 /* of frames per second: NTSC rates such as 24000/1001 are exact */

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

/* Whatever bytes it gets, ffmpeg opens no other file because of them. */
static void add_pipe(cs_video_command *command, int number) {
  add(command, "-protocol_whitelist");
  add(command, "pipe");
  add(command, "-i");
  add_text(command, "pipe:%d", number);
}

/* ---------------------------------------------------------------- frames */

/* Adds the nearest fraction, found by continued fractions: 23.976023976... is 24000/1001. */
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

/* Without alpha the fourth byte is declared unused, because frames over black still have alpha in
 * it. */
static const char *frame_pixels(const cs_video_options *options) {
  if (cs_video_layout_of(options) != CS_VIDEO_RGBA)
    return cs_video_pixels(options);
  if (cs_video_coding(options).depth == CELSPAN_DEPTH_16)
    return "rgba64le";
  return cs_video_has_alpha(options) ? "rgba" : "rgb0";
}

static void add_format(cs_video_command *command, const char *name) {
  add(command, "-f");
  add(command, name);
}

static void add_raw(cs_video_command *command, const char *pixels, int32_t width, int32_t height) {
  add_format(command, "rawvideo");
  add(command, "-pixel_format");
  add(command, pixels);
  add(command, "-video_size");
  add_text(command, "%dx%d", (int)width, (int)height);
}

static void add_frames(cs_video_command *command, const cs_video_options *options,
                       const cs_video_frames *frames) {
  add_raw(command, frame_pixels(options), frames->width, frames->height);
  add(command, "-framerate");
  add_rate(command, frames->frames_second);
  add_pipe(command, 0);
}

/* ---------------------------------------------------------------- pictures */

int cs_video_quality(const cs_video_options *options) {
  const cs_video_codec *codec = options->codec;
  if (options->has_crf)
    return (int)options->crf;
  return (int)lround(codec->worst + (codec->best - codec->worst) * options->quality / 100);
}

/* By default ffmpeg assumes BT.601 for pictures of any size, and writes no colour tags. Rounding is
 * exact, and 2 x 2 pixels that share a colour get their mean, so that flat colours are unchanged.
 * Planes are passed on unchanged. */
static void add_yuv(cs_video_command *command, const cs_video_options *options, bool is_coded) {
  bool is_rec709 = options->coding.transfer == CELSPAN_TRANSFER_REC709;
  int curve = is_rec709 ? CS_VIDEO_BT709 : CS_VIDEO_SRGB;
  int transfer = options->transfer ? options->transfer : curve;
  int primaries = options->primaries ? options->primaries : CS_VIDEO_BT709;
  bool is_made = is_coded || cs_video_layout_of(options) != CS_VIDEO_RGBA;
  static const char *const tags[] = {"-color_range", "tv", "-colorspace", "bt709", NULL};
  add(command, "-vf");
  add_text(command,
           "%sformat=%s,setparams=range=tv:colorspace=bt709:color_primaries=%d:color_trc=%d",
           is_made ? "" : FROM_RGB, cs_video_pixels(options), primaries, transfer);
  add_all(command, tags);
  add(command, "-color_primaries");
  add_text(command, "%d", primaries);
  add(command, "-color_trc");
  add_text(command, "%d", transfer);
}

static void add_pixels(cs_video_command *command, const char *pixels) {
  add(command, "-pix_fmt");
  add(command, pixels);
}

/* is_coded: the frames have the pixels of the encoder already. */
static void add_pictures(cs_video_command *command, const cs_video_options *options,
                         bool is_coded) {
  const cs_video_codec *codec = options->codec;
  if (!codec->is_rgb)
    add_yuv(command, options, is_coded);
  add_all(command, codec->encoder);
  if (codec->quality) {
    add(command, codec->quality);
    add_text(command, "%g", cs_video_quality(options) - options->crf_less);
  }
  if (codec->is_rgb)
    add_pixels(command, cs_video_pixels(options));
}

/* How often the file is played; a GIF stores how often it is repeated, and -1 for never. */
static void add_plays(cs_video_command *command, const cs_video_format *format, int32_t plays) {
  bool is_counted = format->counts_repeats && plays > 0;
  add(command, format->plays);
  add_text(command, "%d", is_counted && plays == 1 ? -1 : (int)plays - is_counted);
}

/* ---------------------------------------------------------------- sound and chapters */

static void add_samples(cs_video_command *command, const cs_sound_stream *samples) {
  add_format(command, "f32le");
  add(command, "-ar");
  add_text(command, "%d", (int)samples->rate);
  add(command, "-ac");
  add_text(command, "%d", (int)samples->channels);
  add_pipe(command, CS_CHILD_SAMPLES);
}

static void add_map(cs_video_command *command, int input, char kind) {
  add(command, "-map");
  add_text(command, "%d:%c", input, kind);
}

static void add_sound(cs_video_command *command, const char *const *codec, int input) {
  add_map(command, input, 'a');
  add_all(command, codec);
}

/* The address contains the text itself, so that ffmpeg reads no file. */
static void add_chapters(cs_video_command *command, const char *address) {
  add(command, "-protocol_whitelist");
  add(command, "data");
  add_format(command, "ffmetadata");
  add(command, "-i");
  add(command, address);
}

static void add_input(cs_video_command *command, const char *name) {
  add(command, "-protocol_whitelist");
  add(command, "file");
  add(command, "-i");
  add_text(command, "file:%s", name);
}

static void add_file(cs_video_command *command, const char *format, const char *name) {
  add_format(command, format);
  add_input(command, name);
}

/* Adds the files of the captions and of the poster, each if there is one. */
static void add_extras(cs_video_command *command, const cs_video_format *format,
                       const cs_video_extras *extras) {
  if (extras->captions)
    add_file(command, format->captions_form, extras->captions);
  if (!extras->poster)
    return;
  add_raw(command, "rgba", extras->width, extras->height);
  add_input(command, extras->poster);
}

/* Adds the streams of these files. input: the number of the first of them. */
static void add_extra_streams(cs_video_command *command, const cs_video_format *format, int input,
                              const cs_video_extras *extras) {
  static const char *const poster[] = {
      "-c:v:1",           "png",          "-filter:v:1", "null", "-pix_fmt:v:1", "rgba",
      "-disposition:v:1", "attached_pic", NULL};
  if (extras->captions) {
    add_map(command, input++, 's');
    add(command, "-c:s");
    add(command, format->captions);
  }
  if (!extras->poster)
    return;
  add_map(command, input, 'v');
  add_all(command, poster);
}

/* ---------------------------------------------------------------- commands */

/* The frames, the sound and the chapters, each if there are any. */
static void add_inputs(cs_video_command *command, const cs_video_options *options,
                       const cs_video_frames *frames, const cs_sound_stream *sound,
                       const char *chapters) {
  add_frames(command, options, frames);
  if (sound->user)
    add_samples(command, sound);
  if (chapters)
    add_chapters(command, chapters);
}

static void add_name(cs_video_command *command, const char *key, const char *name) {
  if (!name)
    return;
  add(command, "-metadata");
  add_text(command, "%s=%.*s", key, (int)cs_utf8_cut(name, MOST_NAME), name);
}

/* Formats name the program in fields of different names, and each takes those that it has. */
static void add_names(cs_video_command *command, const cs_video_extras *extras) {
  add_name(command, "title", extras->title);
  add_name(command, "encoding_tool", extras->maker);
  add_name(command, "comment", extras->maker);
}

/* Everything after the encoders. */
static void add_output(cs_video_command *command, const cs_video_format *format,
                       const cs_video_options *options, const char *file) {
  if (format->flags)
    add_all(command, format->flags);
  if (format->plays)
    add_plays(command, format, options->plays);
  add_format(command, format->muxer);
  add_text(command, "file:%s", file);
}

/* What the format has a place for. */
static cs_video_extras taken(const cs_video_format *format, const cs_video_extras *extras) {
  cs_video_extras own = *extras;
  own.chapters = format->has_chapters ? extras->chapters : NULL;
  own.captions = format->captions ? extras->captions : NULL;
  own.poster = format->poster == CS_POSTER_ATTACHED ? extras->poster : NULL;
  return own;
}

void cs_video_command_encode(cs_video_command *command, const cs_video_format *format,
                             const cs_video_options *options, const cs_video_frames *frames,
                             const cs_sound_stream *sound, const cs_video_extras *extras,
                             const char *file) {
  const cs_video_extras own = taken(format, extras);
  bool has_sound = sound->user != NULL;
  begin(command);
  add_inputs(command, options, frames, sound, own.chapters);
  add_extras(command, format, &own);
  add_pictures(command, options, false);
  add_map(command, 0, 'v');
  if (has_sound)
    add_sound(command, format->sound, 1);
  add_extra_streams(command, format, 1 + has_sound + (own.chapters != NULL), &own);
  add_names(command, &own);
  add_output(command, format, options, file);
}

void cs_video_command_master(cs_video_command *command, const cs_video_options *options,
                             const cs_video_frames *frames, const cs_sound_stream *sound,
                             const char *chapters, const char *file) {
  static const char *const pictures[] = {"-map", "0:v", "-c:v", "ffv1", "-level", "3", NULL};
  static const char *const samples[] = {"-c:a", "pcm_f32le", NULL};
  begin(command);
  add_inputs(command, options, frames, sound, chapters);
  if (options->codec->is_indexed)
    add_pixels(command, cs_video_has_alpha(options) ? "bgra" : "bgr0");
  else
    add_yuv(command, options, false);
  add_all(command, pictures);
  if (sound->user)
    add_sound(command, samples, 1);
  add_format(command, "nut");
  add_text(command, "file:%s", file);
}

void cs_video_command_repeat(cs_video_command *command, const cs_video_format *format,
                             const cs_video_options *options, bool has_sound, const char *master,
                             const cs_video_extras *extras, const char *file) {
  const cs_video_extras own = taken(format, extras);
  begin(command);
  add_file(command, "nut", master);
  add_extras(command, format, &own);
  add_pictures(command, options, true);
  add_map(command, 0, 'v');
  if (has_sound)
    add_sound(command, format->sound, 0);
  add_extra_streams(command, format, 1, &own);
  add_names(command, &own);
  add_output(command, format, options, file);
}

/* ---------------------------------------------------------------- indexed films */

void cs_video_command_swatches(cs_video_command *command, const cs_video_options *options,
                               const char *master, const char *palette) {
  begin(command);
  add_file(command, "nut", master);
  add(command, "-vf");
  add_text(command, "palettegen=stats_mode=full:max_colors=%d:reserve_transparent=%d",
           cs_video_quality(options), cs_video_has_alpha(options));
  add_pixels(command, "rgba");
  add_format(command, "rawvideo");
  add_text(command, "file:%s", palette);
}

/* Dithering looks better than bands, and makes the file larger. */
void cs_video_command_index(cs_video_command *command, const cs_video_format *format,
                            const cs_video_options *options, const char *master,
                            const char *palette, const char *file) {
  begin(command);
  add_file(command, "nut", master);
  add_raw(command, "rgba", CS_VIDEO_SWATCHES, CS_VIDEO_SWATCHES);
  add_input(command, palette);
  add(command, "-filter_complex");
  add_text(command, "[0:v][1:v]paletteuse=dither=%s",
           options->quality < 50 ? "none" : "sierra2_4a");
  add_all(command, options->codec->encoder);
  add_output(command, format, options, file);
}
