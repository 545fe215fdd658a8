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
 *   gif, webp, apng: the only codecs of the formats of these names
 *
 * INVARIANT: a file has one of the codecs that its format lists; the first of them is the default.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct cs_video_codec {
  const char *name;
  const char *const *encoder;       /* options of ffmpeg, NULL at the end */
  const char *pixels, *deep_pixels; /* without alpha; NULL: not available */
  const char *alpha_pixels, *deep_alpha_pixels;
  bool is_halved;                    /* the encoder accepts even sides only */
  bool is_rgb;                       /* the encoder accepts RGB; the file has no colour tags */
  bool is_indexed;                   /* few colours for each frame, for which ffmpeg dithers */
  bool is_deep;                      /* frames have 16 bits unless options request fewer */
  int32_t least_width, least_height; /* pixels */
  const char *quality; /* the option for the quality; NULL: a palette's size, or it has none */
  double best, worst;  /* its values at quality 100 and 0 */
  int32_t most_crf;    /* the greatest value of -crf; 0: the encoder has no such option */
} cs_video_codec;

extern const cs_video_codec cs_codec_h264, cs_codec_h264_444, cs_codec_h265, cs_codec_h265_444,
    cs_codec_av1, cs_codec_av1_444, cs_codec_vp9, cs_codec_prores, cs_codec_prores422,
    cs_codec_prores422hq, cs_codec_dnxhr, cs_codec_ffv1, cs_codec_gif, cs_codec_webp, cs_codec_apng;
