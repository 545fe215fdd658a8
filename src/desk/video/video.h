/* A film as one file with its sound, made by ffmpeg.
 *
 *   frames --> slots --> encoder.h --> ffmpeg --> .film.mp4.1a2b.part --finish--> film.mp4
 *   samples -------------------------^
 *
 *   with a limit of bytes:
 *   frames, samples --> ffmpeg --> master --ffmpeg, several times--> .film.mp4.1a2b.part
 *
 *   with few colours:
 *   frames --> ffmpeg --> master --ffmpeg--> palette; both --ffmpeg--> .film.gif.1a2b.part
 *
 *   AVIF, WebP: frames --> slots --> picture_file.h --> film.avif
 *
 * INVARIANT: the file appears under its name when cs_video_finish returns OK, not before. After
 * cs_video_finish and cs_video_discard there is no temporary file and no process.
 */
#pragma once

#include "inside/films.h"
#include "inside/sinks.h"
#include "video/encoder.h"
#include "video/format.h"

typedef struct cs_video_desc {
  const char *path;
  const cs_video_format *format;
  cs_video_options options; /* which the format supports */
  cs_video_frames frames;
  cs_sound_stream sound;       /* as long as the frames; none: there is no sound */
  const char *title;           /* the title of the film, or NULL; borrowed until the video ends */
  const char *chapters;        /* as in cs_video_extras; NULL: none */
  const char *captions;        /* a text in the captions_form of the format; NULL: none */
  const unsigned char *poster; /* RGBA of 8 bits, of the frames' size; NULL: none */
  uint64_t most_bytes;         /* the file gets the highest quality that fits; 0: any size */
  bool has_digests;            /* hashes the RGBA pixels of each frame */
  int workers;                 /* threads that make frames, if there is memory for it */
  bool keeps_nothing;          /* makes one frame at a time */
} cs_video_desc;

typedef struct cs_video {
  celspan_context *context; /* borrowed */
  const char *path;         /* borrowed */
  const cs_video_format *format;
  celspan_coding coding;
  cs_video_layout layout;
  size_t stride;              /* the stride of RGBA */
  cs_file *file;              /* owned */
  cs_file *captions, *poster; /* which ffmpeg reads; owned; NULL: none */
  cs_video_extras extras;     /* without the chapters; its title and maker are borrowed */
  /* where the file has a limit or a palette: */
  cs_file *master; /* the frames without loss; owned; NULL: there is no limit and no palette */
  cs_video_options options;
  uint64_t most_bytes;
  bool has_sound;
  cs_encoder encoder;
  /* where the picture module codes, instead of the encoder and the files: */
  cs_picture_file picture;
  unsigned char *pixels; /* the pixels of the frame given last; owned */
  size_t beside;         /* bytes that the module may hold, counted in the context */
  bool has_digests;
  cs_slots slots; /* the slots of the frames that are made; owned */
} cs_video;

/* Starts the encoder. The samples of the sound are the video's, whatever it returns. out: must not
 * move until it is finished or discarded. Errors: OUTPUT, NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_video_open(cs_video *out, celspan_context *context,
                                             const cs_video_desc *desc);
/* Makes a frame in a slot, with its digest if there are digests. Any thread, with its context. */
CELSPAN_CHECKED celspan_status cs_video_put(const cs_video *video, celspan_context *context,
                                            const celspan_frame_desc *desc, size_t slot,
                                            uint64_t digest[2]);
/* Gives the frame in a slot to the encoder, after all frames before it. */
CELSPAN_CHECKED celspan_status cs_video_give(cs_video *video, size_t slot);
/* Gives it the frame again that was given last. */
CELSPAN_CHECKED celspan_status cs_video_repeat(cs_video *video);
/* Both end the video, whatever they return. */
CELSPAN_CHECKED celspan_status cs_video_finish(cs_video *video);
void cs_video_discard(cs_video *video);

/* ---- limit.c */

/* Makes the video of its master as the file `name`, with the highest quality that fits into its
 * limit. Errors: OUTPUT, also if the lowest quality does not fit; CANCELLED; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_video_limit(const cs_video *video, const char *master,
                                              const char *name);
