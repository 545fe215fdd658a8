#include "video/format.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "inside/pictures.h"
#include "inside/sinks.h"

static const char *const AAC[] = {"-c:a", "aac", "-b:a", "192k", NULL};
static const char *const FLAC[] = {"-c:a", "flac", NULL};
static const char *const PCM[] = {"-c:a", "pcm_s24le", NULL};
static const char *const OPUS[] = {"-c:a", "libopus", "-b:a", "160k", NULL};

#define SUBRIP "srt"
#define ENDLESS 1e6
/* The index comes first; colour tags are written. */
static const char *const ISO_FLAGS[] = {"-movflags", "+faststart+write_colr", NULL};
/* Identifiers are not random. */
static const char *const EBML_FLAGS[] = {"-fflags", "+bitexact", NULL};
#define EBML "\x1a\x45\xdf\xa3"

static const cs_video_format FORMATS[] = {
    {.name = "mp4",
     .muxer = "mp4",
     .codecs = {&cs_codec_h264, &cs_codec_h265, &cs_codec_av1},
     .most_frames_second = ENDLESS,
     .sound = AAC,
     .has_chapters = true,
     .poster = CS_POSTER_ATTACHED,
     .captions = "mov_text",
     .captions_form = SUBRIP,
     .flags = ISO_FLAGS,
     .mark = {4, "ftyp"}},
    {.name = "mkv",
     .muxer = "matroska",
     .codecs = {&cs_codec_h264_444, &cs_codec_h265_444, &cs_codec_av1_444, &cs_codec_vp9,
                &cs_codec_ffv1},
     .most_frames_second = 1000,
     .sound = FLAC,
     .has_chapters = true,
     .poster = CS_POSTER_BESIDE,
     .captions = "srt",
     .captions_form = SUBRIP,
     .flags = EBML_FLAGS,
     .mark = {0, EBML}},
    {.name = "mov",
     .muxer = "mov",
     .codecs = {&cs_codec_prores, &cs_codec_prores422, &cs_codec_prores422hq, &cs_codec_dnxhr,
                &cs_codec_h264, &cs_codec_h265},
     .most_frames_second = ENDLESS,
     .sound = PCM,
     .has_chapters = true,
     .poster = CS_POSTER_BESIDE,
     .captions = "mov_text",
     .captions_form = SUBRIP,
     .flags = ISO_FLAGS,
     .mark = {4, "ftyp"}},
    {.name = "webm",
     .muxer = "webm",
     .codecs = {&cs_codec_vp9, &cs_codec_av1},
     .most_frames_second = 1000,
     .sound = OPUS,
     .has_chapters = true,
     .poster = CS_POSTER_BESIDE,
     .captions = "copy", /* the encoder writes no entities */
     .captions_form = "webvtt",
     .flags = EBML_FLAGS,
     .mark = {0, EBML}},
    {.name = "gif",
     .muxer = "gif",
     .codecs = {&cs_codec_gif},
     .is_picture = true,
     .most_frames_second = 100,
     .plays = "-loop",
     .counts_repeats = true,
     .mark = {0, "GIF8"}},
    {.name = "webp",
     .codecs = {&cs_codec_webp},
     .is_picture = true,
     .most_frames_second = 1000,
     .plays = "", /* set by the module */
     .mark = {8, "WEBP"}},
    {.name = "apng",
     .muxer = "apng",
     .codecs = {&cs_codec_apng},
     .most_frames_second = 1000,
     .plays = "-plays",
     .mark = {0, "\x89PNG"}},
    {.name = CS_PICTURE_AVIF,
     .codecs = {&cs_codec_avif},
     .is_picture = true,
     .codes_stills = true,
     .most_frames_second = 1000,
     .plays = "", /* set by the module */
     .mark = {4, "ftyp"}},
};

const cs_video_format *cs_video_format_named(const char *name) {
  for (size_t i = 0; i < sizeof FORMATS / sizeof *FORMATS; i++)
    if (strcasecmp(name, FORMATS[i].name) == 0)
      return &FORMATS[i];
  return NULL;
}

const cs_video_codec *cs_video_codec_named(const cs_video_format *format, const char *name) {
  for (size_t i = 0; i < CS_VIDEO_CODECS && format->codecs[i]; i++)
    if (!name || strcasecmp(name, format->codecs[i]->name) == 0)
      return format->codecs[i];
  return NULL;
}

void cs_video_codec_list(const cs_video_format *format, char *out, size_t size) {
  size_t length = 0;
  for (size_t i = 0; i < CS_VIDEO_CODECS && format->codecs[i] && length < size; i++)
    length += (size_t)snprintf(out + length, size - length, "%s%s", length ? ", " : "",
                               format->codecs[i]->name);
}

/* Whether the encoder gets frames of 16 bits. */
static bool is_deep(const cs_video_options *options) {
  if (options->coding.depth == CELSPAN_DEPTH_DEFAULT)
    return options->codec->is_deep;
  return options->coding.depth == CELSPAN_DEPTH_16;
}

bool cs_video_has_alpha(const cs_video_options *options) {
  return options->codec->alpha_pixels && !options->is_opaque;
}

const char *cs_video_pixels(const cs_video_options *options) {
  const cs_video_codec *codec = options->codec;
  if (cs_video_has_alpha(options))
    return is_deep(options) ? codec->deep_alpha_pixels : codec->alpha_pixels;
  return is_deep(options) ? codec->deep_pixels : codec->pixels;
}

cs_video_layout cs_video_layout_of(const cs_video_options *options) {
  const char *pixels = cs_video_pixels(options);
  return strcmp(pixels, "yuv420p") == 0   ? CS_VIDEO_420
         : strcmp(pixels, "yuv444p") == 0 ? CS_VIDEO_444
                                          : CS_VIDEO_RGBA;
}

celspan_coding cs_video_coding(const cs_video_options *options) {
  celspan_coding coding = options->coding;
  coding.depth = is_deep(options)   ? CELSPAN_DEPTH_16
                 : options->dithers ? CELSPAN_DEPTH_8_DITHER
                                    : CELSPAN_DEPTH_8;
  if (coding.transfer == CELSPAN_TRANSFER_DEFAULT)
    coding.transfer = CELSPAN_TRANSFER_SRGB;
  if (!cs_video_has_alpha(options))
    coding.alpha = coding.convert ? CS_ALPHA_BLACK : CELSPAN_ALPHA_PREMULTIPLIED;
  return coding;
}
