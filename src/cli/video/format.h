/* The video formats: what file each ending makes, by which encoder, and of what pixels.
 *
 *   film   planes of Y'CbCr, or RGBA that ffmpeg turns into them --> encoder --> file
 *
 *   ending  encoder      pixels                               alpha      sound
 *   mp4     H.264        4:2:0, 8 bits (10 under --depth 16)  none       AAC
 *   mkv     H.264        4:4:4, 8 bits (10 under --depth 16)  none       FLAC
 *   mov     ProRes 4444  4:4:4, 10 bits                       16 bits    PCM
 *   webm    VP9          4:2:0, 8 bits (10 without alpha)     8 bits     Opus
 *   gif     GIF          256 colours a frame                  1 bit      none
 *   webp    WebP         4:2:0, 8 bits                        8 bits     none
 *
 * INVARIANT: a film under --background is opaque, and its file has no alpha. In all other films the
 * alpha of a format that has it is kept.
 */
#ifndef CS_CLI_VIDEO_FORMAT_H
#define CS_CLI_VIDEO_FORMAT_H

#include "cli/request.h"

typedef struct cs_video_format {
  const char *name;  /* the ending */
  const char *muxer; /* as ffmpeg calls it */
  bool is_picture;   /* one frame is a picture; several are a video */
  bool is_halved;    /* the encoder takes even sides only */
  bool is_rgb;       /* the encoder takes RGB: the file has no colour tags */
  bool is_deep;      /* frames have 16 bits unless less is asked for */
  bool has_alpha;
  double most_frames_second;        /* its clock counts no finer */
  const char *pixels, *deep_pixels; /* without alpha; NULL: it has none of that depth */
  const char *alpha_pixels, *deep_alpha_pixels;
  const char *const *encoder; /* options of ffmpeg, NULL at the end */
  const char *flags;          /* of the muxer, or NULL */
  const char *quality;        /* the option that quality is given by; NULL: colours of a palette */
  double best, worst;         /* what it is at quality 100 and at 0 */
  const char *const *sound;   /* options of ffmpeg; NULL: the format holds no sound */
  struct {                    /* bytes that every file of the format has */
    size_t offset;
    const char *bytes;
  } mark;
} cs_video_format;

/* How frames go to the encoder. */
typedef enum cs_video_layout {
  CS_VIDEO_RGBA, /* of 8 or 16 bits; ffmpeg makes what the encoder takes of them */
  CS_VIDEO_444,  /* planes of 8 bits, made here (cli/video/planes.h) */
  CS_VIDEO_420
} cs_video_layout;

/* The format of that name, or else NULL. */
const cs_video_format *cs_video_format_named(const char *name);
/* Whether frames go to the encoder with 16 bits, and whether the file has alpha. */
bool cs_video_is_deep(const cs_video_format *format, const cs_request *request);
bool cs_video_has_alpha(const cs_video_format *format, const cs_request *request);
/* The encoder's pixels under the options; NULL: it has none such. */
const char *cs_video_pixels(const cs_video_format *format, const cs_request *request);
/* Planes are made here where the encoder takes 8 bits without alpha. */
cs_video_layout cs_video_layout_of(const cs_video_format *format, const cs_request *request);
/* The coding of the frames that the encoder is sent. Over black where there is no alpha. */
celspan_coding cs_video_coding(const cs_video_format *format, const cs_request *request);
/* What the quality option is at a quality of 0 to 100; the same quality looks alike in every
 * format. */
int cs_video_quality(const cs_video_format *format, int32_t quality);

#endif
