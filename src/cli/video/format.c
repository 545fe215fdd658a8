#include "cli/video/format.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/* Drawings are flat between sharp edges: -tune animation spends bits on edges, not on grain. */
static const char *const H264[] = {"-c:v",  "libx264",   "-preset", "medium",
                                   "-tune", "animation", NULL};
static const char *const PRORES[] = {"-c:v", "prores_ks",   "-profile:v", "4444", "-vendor",
                                     "apl0", "-alpha_bits", "16",         NULL};
static const char *const VP9[] = {"-c:v",      "libvpx-vp9", "-b:v",    "0", "-deadline", "good",
                                  "-cpu-used", "3",          "-row-mt", "1", NULL};
static const char *const GIF[] = {"-c:v", "gif", "-loop", "0", NULL};
static const char *const WEBP[] = {"-c:v", "libwebp_anim", "-loop", "0", NULL};

static const char *const AAC[] = {"-c:a", "aac", "-b:a", "192k", NULL};
static const char *const FLAC[] = {"-c:a", "flac", NULL};
static const char *const PCM[] = {"-c:a", "pcm_s24le", NULL};
static const char *const OPUS[] = {"-c:a", "libopus", "-b:a", "160k", NULL};

#define ENDLESS 1e6
#define ISO_FLAGS "+faststart+write_colr" /* the index comes first; colours are told */
#define EBML "\x1a\x45\xdf\xa3"

/* The quality of H.264 at 75 is the constant rate factor 18, at which most people tell no
 * difference; those of the others give about the same error there and below. */
static const cs_video_format FORMATS[] = {
    {.name = "mp4",
     .muxer = "mp4",
     .is_halved = true,
     .most_frames_second = ENDLESS,
     .pixels = "yuv420p",
     .deep_pixels = "yuv420p10le",
     .encoder = H264,
     .quality = "-crf",
     .best = 8,
     .worst = 48,
     .sound = AAC,
     .flags = ISO_FLAGS,
     .mark = {4, "ftyp"}},
    {.name = "mkv",
     .muxer = "matroska",
     .most_frames_second = 1000,
     .pixels = "yuv444p",
     .deep_pixels = "yuv444p10le",
     .encoder = H264,
     .quality = "-crf",
     .best = 8,
     .worst = 48,
     .sound = FLAC,
     .mark = {0, EBML}},
    {.name = "mov",
     .muxer = "mov",
     .is_deep = true,
     .has_alpha = true,
     .most_frames_second = ENDLESS,
     .pixels = "yuv444p10le",
     .deep_pixels = "yuv444p10le",
     .alpha_pixels = "yuva444p10le",
     .deep_alpha_pixels = "yuva444p10le",
     .encoder = PRORES,
     .quality = "-q:v",
     .best = 5,
     .worst = 33,
     .sound = PCM,
     .flags = ISO_FLAGS,
     .mark = {4, "ftyp"}},
    {.name = "webm",
     .muxer = "webm",
     .has_alpha = true,
     .most_frames_second = 1000,
     .pixels = "yuv420p",
     .deep_pixels = "yuv420p10le",
     .alpha_pixels = "yuva420p",
     .encoder = VP9,
     .quality = "-crf",
     .best = 11,
     .worst = 63,
     .sound = OPUS,
     .mark = {0, EBML}},
    {.name = "gif",
     .muxer = "gif",
     .is_picture = true,
     .is_rgb = true,
     .has_alpha = true,
     .most_frames_second = 100,
     .pixels = "pal8",
     .alpha_pixels = "pal8",
     .encoder = GIF,
     .best = 256, /* colours of a frame's palette */
     .worst = 8,
     .mark = {0, "GIF8"}},
    {.name = "webp",
     .muxer = "webp",
     .is_picture = true,
     .is_rgb = true,
     .has_alpha = true,
     .most_frames_second = 1000,
     .pixels = "bgra",
     .alpha_pixels = "bgra",
     .encoder = WEBP,
     .quality = "-quality",
     .best = 100,
     .worst = 0,
     .mark = {8, "WEBP"}},
};

const cs_video_format *cs_video_format_named(const char *name) {
  for (size_t i = 0; i < sizeof FORMATS / sizeof *FORMATS; i++)
    if (strcasecmp(name, FORMATS[i].name) == 0)
      return &FORMATS[i];
  return NULL;
}

bool cs_video_is_deep(const cs_video_format *format, const cs_request *request) {
  if (request->coding.depth == CELSPAN_DEPTH_DEFAULT && !request->dithers)
    return format->is_deep;
  return request->coding.depth == CELSPAN_DEPTH_16;
}

bool cs_video_has_alpha(const cs_video_format *format, const cs_request *request) {
  return format->has_alpha && !request->background.is_given;
}

const char *cs_video_pixels(const cs_video_format *format, const cs_request *request) {
  if (cs_video_has_alpha(format, request))
    return cs_video_is_deep(format, request) ? format->deep_alpha_pixels : format->alpha_pixels;
  return cs_video_is_deep(format, request) ? format->deep_pixels : format->pixels;
}

cs_video_layout cs_video_layout_of(const cs_video_format *format, const cs_request *request) {
  const char *pixels = cs_video_pixels(format, request);
  return strcmp(pixels, "yuv420p") == 0   ? CS_VIDEO_420
         : strcmp(pixels, "yuv444p") == 0 ? CS_VIDEO_444
                                          : CS_VIDEO_RGBA;
}

celspan_coding cs_video_coding(const cs_video_format *format, const cs_request *request) {
  celspan_coding coding = request->coding;
  coding.depth = request->dithers                    ? CELSPAN_DEPTH_8_DITHER
                 : cs_video_is_deep(format, request) ? CELSPAN_DEPTH_16
                                                     : CELSPAN_DEPTH_8;
  if (coding.transfer == CELSPAN_TRANSFER_DEFAULT)
    coding.transfer = CELSPAN_TRANSFER_SRGB;
  if (!cs_video_has_alpha(format, request))
    coding.alpha = CELSPAN_ALPHA_PREMULTIPLIED;
  return coding;
}

int cs_video_quality(const cs_video_format *format, int32_t quality) {
  return (int)lround(format->worst + (format->best - format->worst) * quality / 100);
}
