/* Commands of ffmpeg, argument by argument. */
#include <math.h>

#include "common/utf8.h"
#include "process/child.h"
#include "video/format.h"

#define FROM_RGB                                                                                   \
  "scale=out_color_matrix=bt709:out_range=tv:flags=area+accurate_rnd+full_chroma_int,"
#define MOST_NAME 2000           /* bytes of a title */
#define MOST_DENOMINATOR 1001000 /* NTSC's rates, such as 24000/1001, are exact */

/* ---------------------------------------------------------------- arguments */

/* arguments: NULL at the end. */
static void add_all(cs_arguments *command, const char *const *arguments) {
  for (; *arguments; arguments++)
    CS_ARGUMENTS(command, *arguments);
}

static void begin(cs_arguments *command) {
  *command = (cs_arguments){.count = 0};
  CS_ARGUMENTS(command, "ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-xerror",
               "-y");
}

/* Whatever bytes it gets, ffmpeg opens no other file because of them. */
static void add_pipe(cs_arguments *command, int number) {
  CS_ARGUMENTS(command, "-protocol_whitelist", "pipe");
  cs_arguments_value(command, "-i", "pipe:%d", number);
}

/* ---------------------------------------------------------------- frames */

/* Adds the nearest fraction, found by continued fractions: 23.976023976... is 24000/1001. */
static void add_rate(cs_arguments *command, double rate) {
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
  cs_arguments_value(command, NULL, "%.0f/%.0f", numerator[1], denominator[1]);
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

static void add_format(cs_arguments *command, const char *name) {
  CS_ARGUMENTS(command, "-f", name);
}

static void add_raw(cs_arguments *command, const char *pixels, int32_t width, int32_t height) {
  add_format(command, "rawvideo");
  CS_ARGUMENTS(command, "-pixel_format", pixels);
  cs_arguments_value(command, "-video_size", "%dx%d", (int)width, (int)height);
}

static void add_frames(cs_arguments *command, const cs_video_options *options,
                       const cs_video_frames *frames) {
  add_raw(command, frame_pixels(options), frames->width, frames->height);
  CS_ARGUMENTS(command, "-framerate");
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
static void add_yuv(cs_arguments *command, const cs_video_options *options, bool is_coded) {
  bool is_rec709 = options->coding.transfer == CELSPAN_TRANSFER_REC709;
  int curve = is_rec709 ? CS_VIDEO_BT709 : CS_VIDEO_SRGB;
  int transfer = options->transfer ? options->transfer : curve;
  int primaries = options->primaries ? options->primaries : CS_VIDEO_BT709;
  bool is_made = is_coded || cs_video_layout_of(options) != CS_VIDEO_RGBA;
  cs_arguments_value(
      command, "-vf",
      "%sformat=%s,setparams=range=tv:colorspace=bt709:color_primaries=%d:color_trc=%d",
      is_made ? "" : FROM_RGB, cs_video_pixels(options), primaries, transfer);
  CS_ARGUMENTS(command, "-color_range", "tv", "-colorspace", "bt709");
  cs_arguments_value(command, "-color_primaries", "%d", primaries);
  cs_arguments_value(command, "-color_trc", "%d", transfer);
}

static void add_pixels(cs_arguments *command, const char *pixels) {
  CS_ARGUMENTS(command, "-pix_fmt", pixels);
}

/* is_coded: the frames have the pixels of the encoder already. */
static void add_pictures(cs_arguments *command, const cs_video_options *options, bool is_coded) {
  const cs_video_codec *codec = options->codec;
  if (!codec->is_rgb)
    add_yuv(command, options, is_coded);
  add_all(command, codec->encoder);
  if (codec->quality)
    cs_arguments_value(command, codec->quality, "%g",
                       cs_video_quality(options) - options->crf_less);
  if (codec->is_rgb)
    add_pixels(command, cs_video_pixels(options));
}

/* How often the file is played; a GIF stores how often it is repeated, and -1 for never. */
static void add_plays(cs_arguments *command, const cs_video_format *format, int32_t plays) {
  bool is_counted = format->counts_repeats && plays > 0;
  cs_arguments_value(command, format->plays, "%d",
                     is_counted && plays == 1 ? -1 : (int)plays - is_counted);
}

/* ---------------------------------------------------------------- sound and chapters */

static void add_samples(cs_arguments *command, const cs_sound_stream *samples) {
  add_format(command, "f32le");
  cs_arguments_value(command, "-ar", "%d", (int)samples->rate);
  cs_arguments_value(command, "-ac", "%d", (int)samples->channels);
  add_pipe(command, CS_CHILD_SAMPLES);
}

static void add_map(cs_arguments *command, int input, char kind) {
  cs_arguments_value(command, "-map", "%d:%c", input, kind);
}

static void add_sound(cs_arguments *command, const char *const *codec, int input) {
  add_map(command, input, 'a');
  add_all(command, codec);
}

/* The address contains the text itself, so that ffmpeg reads no file. */
static void add_chapters(cs_arguments *command, const char *address) {
  CS_ARGUMENTS(command, "-protocol_whitelist", "data", "-f", "ffmetadata", "-i", address);
}

static void add_input(cs_arguments *command, const char *name) {
  CS_ARGUMENTS(command, "-protocol_whitelist", "file");
  cs_arguments_value(command, "-i", "file:%s", name);
}

static void add_file(cs_arguments *command, const char *format, const char *name) {
  add_format(command, format);
  add_input(command, name);
}

/* Adds the files of the captions and of the poster, each if there is one. */
static void add_extras(cs_arguments *command, const cs_video_format *format,
                       const cs_video_extras *extras) {
  if (extras->captions)
    add_file(command, format->captions_form, extras->captions);
  if (!extras->poster)
    return;
  add_raw(command, "rgba", extras->width, extras->height);
  add_input(command, extras->poster);
}

/* Adds the streams of these files. input: the number of the first of them. */
static void add_extra_streams(cs_arguments *command, const cs_video_format *format, int input,
                              const cs_video_extras *extras) {
  if (extras->captions) {
    add_map(command, input++, 's');
    CS_ARGUMENTS(command, "-c:s", format->captions);
  }
  if (!extras->poster)
    return;
  add_map(command, input, 'v');
  CS_ARGUMENTS(command, "-c:v:1", "png", "-filter:v:1", "null", "-pix_fmt:v:1", "rgba",
               "-disposition:v:1", "attached_pic");
}

/* ---------------------------------------------------------------- commands */

/* The frames, the sound and the chapters, each if there are any. */
static void add_inputs(cs_arguments *command, const cs_video_options *options,
                       const cs_video_frames *frames, const cs_sound_stream *sound,
                       const char *chapters) {
  add_frames(command, options, frames);
  if (sound->user)
    add_samples(command, sound);
  if (chapters)
    add_chapters(command, chapters);
}

static void add_name(cs_arguments *command, const char *key, const char *name) {
  if (!name)
    return;
  cs_arguments_value(command, "-metadata", "%s=%.*s", key, (int)cs_utf8_cut(name, MOST_NAME), name);
}

/* Formats name the program in fields of different names, and each takes those that it has. */
static void add_names(cs_arguments *command, const cs_video_extras *extras) {
  add_name(command, "title", extras->title);
  add_name(command, "encoding_tool", extras->maker);
  add_name(command, "comment", extras->maker);
}

/* Everything after the encoders. */
static void add_output(cs_arguments *command, const cs_video_format *format,
                       const cs_video_options *options, const char *file) {
  if (format->flags)
    add_all(command, format->flags);
  if (format->plays)
    add_plays(command, format, options->plays);
  add_format(command, format->muxer);
  cs_arguments_value(command, NULL, "file:%s", file);
}

/* What the format has a place for. */
static cs_video_extras taken(const cs_video_format *format, const cs_video_extras *extras) {
  cs_video_extras own = *extras;
  own.chapters = format->has_chapters ? extras->chapters : NULL;
  own.captions = format->captions ? extras->captions : NULL;
  own.poster = format->poster == CS_POSTER_ATTACHED ? extras->poster : NULL;
  return own;
}

void cs_video_command_encode(cs_arguments *command, const cs_video_format *format,
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

void cs_video_command_master(cs_arguments *command, const cs_video_options *options,
                             const cs_video_frames *frames, const cs_sound_stream *sound,
                             const char *chapters, const char *file) {
  static const char *const samples[] = {"-c:a", "pcm_f32le", NULL};
  begin(command);
  add_inputs(command, options, frames, sound, chapters);
  if (options->codec->is_indexed)
    add_pixels(command, cs_video_has_alpha(options) ? "bgra" : "bgr0");
  else
    add_yuv(command, options, false);
  CS_ARGUMENTS(command, "-map", "0:v", "-c:v", "ffv1", "-level", "3");
  if (sound->user)
    add_sound(command, samples, 1);
  add_format(command, "nut");
  cs_arguments_value(command, NULL, "file:%s", file);
}

void cs_video_command_repeat(cs_arguments *command, const cs_video_format *format,
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

void cs_video_command_swatches(cs_arguments *command, const cs_video_options *options,
                               const char *master, const char *palette) {
  begin(command);
  add_file(command, "nut", master);
  cs_arguments_value(command, "-vf",
                     "palettegen=stats_mode=full:max_colors=%d:reserve_transparent=%d",
                     cs_video_quality(options), cs_video_has_alpha(options));
  add_pixels(command, "rgba");
  add_format(command, "rawvideo");
  cs_arguments_value(command, NULL, "file:%s", palette);
}

/* Dithering looks better than bands, and makes the file larger. */
void cs_video_command_index(cs_arguments *command, const cs_video_format *format,
                            const cs_video_options *options, const char *master,
                            const char *palette, const char *file) {
  begin(command);
  add_file(command, "nut", master);
  add_raw(command, "rgba", CS_VIDEO_SWATCHES, CS_VIDEO_SWATCHES);
  add_input(command, palette);
  cs_arguments_value(command, "-filter_complex", "[0:v][1:v]paletteuse=dither=%s",
                     options->quality < 50 ? "none" : "sierra2_4a");
  add_all(command, options->codec->encoder);
  add_output(command, format, options, file);
}
