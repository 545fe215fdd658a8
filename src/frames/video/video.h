/* A film as one file with its sound, made by ffmpeg.
 *
 *   frames --> encoder.h --> ffmpeg --> .film.mp4.1a2b.part --finish--> film.mp4
 *   samples ---------------^
 *
 * INVARIANT: the file appears under its name when cs_video_finish returns OK, not before. After
 * cs_video_finish and cs_video_discard there is no temporary file and no process.
 */
#pragma once

#include "frames/film/shoot.h"
#include "frames/video/encoder.h"
#include "frames/video/format.h"
#include "output/sinks/file.h"

typedef struct cs_video_desc {
  const char *path;
  const cs_video_format *format;
  cs_video_options options; /* which the format supports */
  cs_video_frames frames;
  cs_sound_stream sound; /* as long as the frames; none: there is no sound */
  bool has_digests;      /* hashes the RGBA pixels of each frame */
  bool keeps_nothing;    /* makes a frame again that equals the previous one */
} cs_video_desc;

typedef struct cs_video {
  celspan_context *context; /* borrowed */
  const char *path;         /* borrowed */
  const cs_video_format *format;
  celspan_coding coding;
  cs_video_layout layout;
  size_t stride; /* of RGBA */
  cs_file *file; /* owned */
  cs_encoder encoder;
  bool has_digests, keeps_nothing;
  bool has_last; /* the previous frame can be compared with the next one */
  cs_hash last;
  uint64_t digest[2]; /* of its pixels, if has_digests */
} cs_video;

/* Starts the encoder. The samples of the sound are the video's, whatever it returns. out: must not
 * move until it is finished or discarded. Errors: OUTPUT, NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_video_open(cs_video *out, celspan_context *context,
                                             const cs_video_desc *desc);
/* Makes a frame, or repeats the previous one if it is equal. */
CELSPAN_CHECKED celspan_status cs_video_put(cs_video *video, const celspan_frame_desc *desc,
                                            cs_shoot_frame *frame);
/* Both end the video, whatever they return. */
CELSPAN_CHECKED celspan_status cs_video_finish(cs_video *video);
void cs_video_discard(cs_video *video);
