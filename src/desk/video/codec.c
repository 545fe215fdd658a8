/* The video codecs: the encoder of ffmpeg for each, its pixels, and the sizes it accepts.
 *
 *   name        encoder        pixels                            alpha    quality 75
 *   h264        libx264        4:2:0 (mkv 4:4:4), 8 or 10 bits   none     -crf 18
 *   h265        libx265        4:2:0 (mkv 4:4:4), 8 or 10 bits   none     -crf 19
 *   av1         libaom-av1     4:2:0 (mkv 4:4:4), 8 or 10 bits   none     -crf 24
 *   vp9         libvpx-vp9     4:2:0, 8 bits (10 without alpha)  8 bits   -crf 24
 *   prores      prores_ks      4:4:4, 10 bits                    16 bits  -q:v 12
 *   prores422   prores_ks      4:2:2, 10 bits                    none     -q:v 12
 *   prores422hq prores_ks      4:2:2, 10 bits                    none     -q:v 12
 *   dnxhr       dnxhd (HQX)    4:2:2, 10 bits                    none     a fixed rate
 *   ffv1        ffv1           RGB, 8 or 16 bits                 as deep  without loss
 *   webp        the module's   4:2:0 or RGB, 8 bits              8 bits   90
 *   avif        the module's   4:4:4, 8 or 12 bits               as deep  -crf 24
 *   gif, webp, apng, avif: the only codecs of the formats of these names
 *
 * INVARIANT: a file has one of the codecs that its format lists; the first of them is the default.
 */
#include "inside/sinks.h"
#include "video/format.h"

/* Drawings are flat between sharp edges: -tune animation uses bits for edges, not for grain. */
static const char *const H264[] = {"-c:v",  "libx264",   "-preset", "medium",
                                   "-tune", "animation", NULL};
/* Players of Apple need the tag hvc1; otherwise the encoder prints notes to standard error. */
static const char *const H265[] = {"-c:v",         "libx265",         "-preset",  "medium",
                                   "-tune",        "animation",       "-tag:v:0", "hvc1",
                                   "-x265-params", "log-level=error", NULL};
static const char *const AV1[] = {"-c:v",      "libaom-av1", "-b:v",    "0", "-usage", "good",
                                  "-cpu-used", "6",          "-row-mt", "1", NULL};
static const char *const VP9[] = {"-c:v",      "libvpx-vp9", "-b:v",    "0", "-deadline", "good",
                                  "-cpu-used", "3",          "-row-mt", "1", NULL};
static const char *const PRORES[] = {"-c:v", "prores_ks",   "-profile:v", "4444", "-vendor",
                                     "apl0", "-alpha_bits", "16",         NULL};
static const char *const PRORES_422[] = {"-c:v",    "prores_ks", "-profile:v", "standard",
                                         "-vendor", "apl0",      NULL};
static const char *const PRORES_422HQ[] = {"-c:v",    "prores_ks", "-profile:v", "hq",
                                           "-vendor", "apl0",      NULL};
static const char *const DNXHR[] = {"-c:v", "dnxhd", "-profile:v", "dnxhr_hqx", NULL};
static const char *const FFV1[] = {"-c:v", "ffv1", "-level", "3", "-g", "1", NULL};
static const char *const GIF[] = {"-c:v", "gif", NULL};
static const char *const APNG[] = {"-c:v", "apng", "-pred", "mixed", NULL};

#define HALVED .is_halved = true, .pixels = "yuv420p", .deep_pixels = "yuv420p10le"
#define WHOLE .pixels = "yuv444p", .deep_pixels = "yuv444p10le"

/* For H.264, quality 75 is the constant rate factor 18, at which most people see no difference. The
 * values of the other encoders give about the same error at 75 and below. */
#define H264_QUALITY                                                                               \
  .encoder = H264, .quality = "-crf", .best = 8, .worst = 48, .most_crf = 51, .has_fine_crf = true
#define H265_QUALITY                                                                               \
  .encoder = H265, .quality = "-crf", .best = 9, .worst = 49, .most_crf = 51,                      \
  .has_fine_crf = true, .least_width = 16, .least_height = 16
#define AV1_QUALITY .encoder = AV1, .quality = "-crf", .best = 11, .worst = 63, .most_crf = 63

const cs_video_codec cs_codec_h264 = {.name = "h264", HALVED, H264_QUALITY};
const cs_video_codec cs_codec_h264_444 = {.name = "h264", WHOLE, H264_QUALITY};
const cs_video_codec cs_codec_h265 = {.name = "h265", HALVED, H265_QUALITY};
const cs_video_codec cs_codec_h265_444 = {.name = "h265", WHOLE, H265_QUALITY};
const cs_video_codec cs_codec_av1 = {
    .name = "av1", .pixels = "yuv420p", .deep_pixels = "yuv420p10le", AV1_QUALITY};
const cs_video_codec cs_codec_av1_444 = {.name = "av1", WHOLE, AV1_QUALITY};

const cs_video_codec cs_codec_vp9 = {.name = "vp9",
                                     .encoder = VP9,
                                     .pixels = "yuv420p",
                                     .deep_pixels = "yuv420p10le",
                                     .alpha_pixels = "yuva420p",
                                     .quality = "-crf",
                                     .best = 11,
                                     .worst = 63,
                                     .most_crf = 63};

/* ---------------------------------------------------------------- editing */

#define PRORES_QUALITY .is_deep = true, .quality = "-q:v", .best = 5, .worst = 33

const cs_video_codec cs_codec_prores = {.name = "prores",
                                        .encoder = PRORES,
                                        .pixels = "yuv444p10le",
                                        .deep_pixels = "yuv444p10le",
                                        .alpha_pixels = "yuva444p10le",
                                        .deep_alpha_pixels = "yuva444p10le",
                                        PRORES_QUALITY};

#define PIXELS_422 .pixels = "yuv422p10le", .deep_pixels = "yuv422p10le"

const cs_video_codec cs_codec_prores422 = {
    .name = "prores422", .encoder = PRORES_422, PIXELS_422, PRORES_QUALITY};
const cs_video_codec cs_codec_prores422hq = {
    .name = "prores422hq", .encoder = PRORES_422HQ, PIXELS_422, PRORES_QUALITY};
const cs_video_codec cs_codec_dnxhr = {.name = "dnxhr",
                                       .encoder = DNXHR,
                                       .is_deep = true,
                                       PIXELS_422,
                                       .least_width = 256,
                                       .least_height = 120};

const cs_video_codec cs_codec_ffv1 = {.name = "ffv1",
                                      .encoder = FFV1,
                                      .is_rgb = true,
                                      .pixels = "bgr0",
                                      .deep_pixels = "gbrp16le",
                                      .alpha_pixels = "bgra",
                                      .deep_alpha_pixels = "gbrap16le"};

/* ---------------------------------------------------------------- loops */

const cs_video_codec cs_codec_gif = {.name = "gif",
                                     .encoder = GIF,
                                     .is_rgb = true,
                                     .is_indexed = true,
                                     .pixels = "pal8",
                                     .alpha_pixels = "pal8",
                                     .best = 256, /* colours of a frame's palette */
                                     .worst = 8};
const cs_video_codec cs_codec_webp = {.name = "webp",
                                      .module = CS_PICTURE_WEBP,
                                      .title = "WebP",
                                      .most_side = CS_WEBP_SIDE,
                                      .pixel_bytes = 40,
                                      .pixels = "rgba",
                                      .alpha_pixels = "rgba",
                                      .quality = "", /* set by the module */
                                      .best = 110,   /* nothing is lost */
                                      .worst = 30};
const cs_video_codec cs_codec_apng = {.name = "apng",
                                      .encoder = APNG,
                                      .is_rgb = true,
                                      .pixels = "rgb24",
                                      .deep_pixels = "rgb48be",
                                      .alpha_pixels = "rgba",
                                      .deep_alpha_pixels = "rgba64be"};
/* The quality is AV1's. Numbered pictures, which have no quality, get 75. */
enum { AVIF_BEST = 11, AVIF_WORST = 63 };
_Static_assert(AVIF_WORST + (AVIF_BEST - AVIF_WORST) * 75 / 100 == CS_AVIF_CRF, "quality 75");
const cs_video_codec cs_codec_avif = {.name = CS_PICTURE_AVIF,
                                      .module = CS_PICTURE_AVIF,
                                      .title = "AVIF",
                                      .most_side = CS_AVIF_SIDE,
                                      .pixels = "rgba",
                                      .deep_pixels = "rgba64le",
                                      .alpha_pixels = "rgba",
                                      .deep_alpha_pixels = "rgba64le",
                                      .quality = "-crf",
                                      .best = AVIF_BEST,
                                      .worst = AVIF_WORST,
                                      .most_crf = 63};
