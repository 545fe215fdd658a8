/* The video formats: the codecs and the sound for each file ending, and the command of ffmpeg.
 *
 *   planes of Y'CbCr, or RGBA --standard input--> [matrix and range of BT.709] --> encoder --> file
 *   sound of as many seconds --second pipe--> encoder -------------------------------^
 *   captions, poster --files--------------------------------------------------------^
 *
 *   ending  codecs, the default first                        sound
 *   mp4     h264, h265, av1                                  AAC
 *   mkv     h264, h265, av1 (all three 4:4:4), vp9, ffv1     FLAC
 *   mov     prores, prores422, prores422hq, dnxhr, h264, h265  PCM
 *   webm    vp9, av1                                         Opus
 *   gif, webp, apng, avif: of their own                      none
 *
 * INVARIANT: a film with a background is opaque, and its file has no alpha. In all other films,
 * alpha is kept if the format has it. No shell reads the arguments. ffmpeg opens no file to read
 * but those that celspan has just written beside the output, and the names of files begin with
 * "file:", so that they cannot be options or addresses.
 */
#pragma once

#include "common/sound_stream.h"
#include "process/arguments.h"

/* An encoder of ffmpeg with its pixels: see codec.c. */
typedef struct cs_video_codec {
  const char *name;
  const char *const *encoder;       /* options of ffmpeg, NULL at the end */
  const char *pixels, *deep_pixels; /* without alpha; NULL: not available */
  const char *alpha_pixels, *deep_alpha_pixels;
  bool is_halved;                    /* the encoder accepts even sides only */
  bool is_rgb;                       /* the encoder accepts RGB; the file has no colour tags */
  bool is_indexed;                   /* few colours for the whole film, for which ffmpeg dithers */
  bool is_deep;                      /* frames have 16 bits unless options request fewer */
  int32_t least_width, least_height; /* pixels */
  int32_t most_side;                 /* 0: the limit of all videos */
  const char *module; /* the picture module codes this format of its own: RGBA; NULL: ffmpeg does */
  const char *title;  /* the title of these formats, in sentences */
  size_t pixel_bytes; /* that the module holds for each pixel of a frame; 0: it is not counted */
  const char *quality; /* the option for the quality; NULL: a palette's size, or it has none */
  double best, worst;  /* values of the option at quality 100 and 0 */
  int32_t most_crf;    /* the greatest value of -crf; 0: the encoder has no such option */
  bool has_fine_crf;   /* which may have a fraction */
} cs_video_codec;

enum { CS_VIDEO_CODECS = 6 }; /* codecs of a format, at most */

/* Where the picture of a film's poster is. */
typedef enum cs_video_poster {
  CS_POSTER_NONE,
  CS_POSTER_ATTACHED, /* in the file */
  CS_POSTER_BESIDE
} cs_video_poster;

typedef struct cs_video_format {
  const char *name;                              /* the ending */
  const char *muxer;                             /* the name of the format in ffmpeg */
  const cs_video_codec *codecs[CS_VIDEO_CODECS]; /* the default first; NULL after the last */
  bool is_picture;                               /* one frame is a picture; several are a video */
  bool codes_stills;         /* one frame is coded as several are, with the options of a video */
  double most_frames_second; /* the resolution of its clock */
  const char *const *flags;  /* options of the muxer, or NULL */
  const char *plays;   /* the muxer's option for how often it is played; NULL: players decide */
  bool counts_repeats; /* that option counts what follows the first time */
  const char *const *sound; /* options of ffmpeg; NULL: the format has no sound */
  bool has_chapters;
  cs_video_poster poster;
  const char *captions;      /* the encoder of captions; NULL: the format has none */
  const char *captions_form; /* form of the file with the subtitles: "srt" or "webvtt" */
  struct {                   /* bytes in every file of the format */
    size_t offset;
    const char *bytes;
  } mark;
} cs_video_format;

/* The layout of the frames for the encoder. */
typedef enum cs_video_layout {
  CS_VIDEO_RGBA, /* 8 or 16 bits; ffmpeg converts them */
  CS_VIDEO_444,  /* planes of 8 bits, made by video.c */
  CS_VIDEO_420
} cs_video_layout;

/* Numbers of ITU-T H.273 for primaries (BT.709, BT.2020, P3) and curves (BT.709, sRGB, a power). */
enum {
  CS_VIDEO_BT709 = 1,
  CS_VIDEO_POWER_22 = 4,
  CS_VIDEO_BT2020 = 9,
  CS_VIDEO_P3 = 12,
  CS_VIDEO_SRGB = 13
};

/* The requested properties of a video. */
typedef struct cs_video_options {
  const cs_video_codec *codec; /* the codec of the format */
  celspan_coding coding;       /* depth and transfer of the pixels */
  bool dithers;                /* where it has 8 bits */
  bool is_opaque;              /* each frame has a background */
  int32_t quality;             /* 0 to 100; the same quality looks alike with every codec */
  bool has_crf;                /* crf is the value of -crf, whatever the quality is */
  int32_t crf;
  double crf_less; /* below 1: taken away from it, where the encoder has such factors */
  /* What the tags say of a coding that converts; 0: the values of its curve. */
  int32_t primaries, transfer;
  int32_t plays; /* how often it is played; 0: for ever */
} cs_video_options;

typedef struct cs_video_frames {
  int32_t width, height; /* pixels */
  double frames_second;
} cs_video_frames;

/* Texts and a picture that a video has in addition; NULL: none. */
typedef struct cs_video_extras {
  const char *title;     /* the title of the film */
  const char *maker;     /* the program, with its version and commit */
  const char *chapters;  /* the address of a text in the format ffmetadata */
  const char *captions;  /* the name of a file in the captions_form of the format */
  const char *poster;    /* the name of a file of pixels: RGBA of 8 bits */
  int32_t width, height; /* the width and height of the poster */
} cs_video_extras;

enum { CS_VIDEO_SWATCHES = 16 }; /* pixels a side */

/* The format of that name, or else NULL. */
const cs_video_format *cs_video_format_named(const char *name);
/* The codec of that name, or the default for NULL; NULL: the format cannot contain it. */
const cs_video_codec *cs_video_codec_named(const cs_video_format *format, const char *name);
/* The names of the format's codecs, "h264, h265, ...": for messages; cut if there is no place for
 * all. */
void cs_video_codec_list(const cs_video_format *format, char *out, size_t size);
/* Whether the encoder gets alpha under the options. */
bool cs_video_has_alpha(const cs_video_options *options);
/* The pixels of the encoder under the options; NULL: not available. */
const char *cs_video_pixels(const cs_video_options *options);
/* Planes where the encoder accepts 8 bits without alpha. */
cs_video_layout cs_video_layout_of(const cs_video_options *options);
/* The coding of the frames for the encoder; over black where there is no alpha. */
celspan_coding cs_video_coding(const cs_video_options *options);

/* ---- command.c */

/* The value of the encoder's quality option. */
int cs_video_quality(const cs_video_options *options);
/* The command that makes a video of raw frames, as above. sound: as long as the frames, or none.
 * extras: borrowed by the command; left out where the format has no place for them. file: the name
 * of the output. */
void cs_video_command_encode(cs_arguments *command, const cs_video_format *format,
                             const cs_video_options *options, const cs_video_frames *frames,
                             const cs_sound_stream *sound, const cs_video_extras *extras,
                             const char *file);
/* The commands that find the colours of an indexed film in its master file, as a file of
 * CS_VIDEO_SWATCHES x CS_VIDEO_SWATCHES pixels, and make the video with them. */
void cs_video_command_swatches(cs_arguments *command, const cs_video_options *options,
                               const char *master, const char *palette);
void cs_video_command_index(cs_arguments *command, const cs_video_format *format,
                            const cs_video_options *options, const char *master,
                            const char *palette, const char *file);
/* The command that keeps the pixels of the encoder, the samples and the chapters without loss in a
 * master file, of which videos are made by the other command, with all extras but the chapters, or
 * by the two for indexed films. Not for other codecs of RGB. */
void cs_video_command_master(cs_arguments *command, const cs_video_options *options,
                             const cs_video_frames *frames, const cs_sound_stream *sound,
                             const char *chapters, const char *file);
void cs_video_command_repeat(cs_arguments *command, const cs_video_format *format,
                             const cs_video_options *options, bool has_sound, const char *master,
                             const cs_video_extras *extras, const char *file);

/* ---- codec.c */

extern const cs_video_codec cs_codec_h264, cs_codec_h264_444, cs_codec_h265, cs_codec_h265_444,
    cs_codec_av1, cs_codec_av1_444, cs_codec_vp9, cs_codec_prores, cs_codec_prores422,
    cs_codec_prores422hq, cs_codec_dnxhr, cs_codec_ffv1, cs_codec_gif, cs_codec_webp, cs_codec_apng,
    cs_codec_avif;
