/* A film as one file with its sound, made by ffmpeg: celspan render SCRIPT -o film.mp4.
 *
 *   frames --> encoder.h --> ffmpeg --> .film.mp4.1a2b.part --finish--> film.mp4
 *   sound  ----------------^
 *
 * What can be refused is refused before the first frame: options and sizes that the format lacks, a
 * missing ffmpeg, a missing sound.
 *
 * INVARIANT: until cs_video_finish has answered OK, nothing has appeared under the name, and
 * afterwards, as after cs_video_discard, no temporary file and no process is left.
 */
#ifndef CS_CLI_VIDEO_VIDEO_H
#define CS_CLI_VIDEO_VIDEO_H

#include "cli/script.h"
#include "cli/video/encoder.h"
#include "cli/video/format.h"
#include "film/shoot.h"
#include "output/file.h"

typedef struct cs_video {
  celspan_context *context; /* borrowed */
  const cs_request *request;
  const cs_video_format *format;
  celspan_coding coding;
  cs_video_layout layout;
  size_t stride; /* of RGBA */
  cs_file *file; /* owned */
  cs_encoder encoder;
  bool has_last; /* the frame given last can be compared with the next one */
  cs_hash last;
  uint64_t digest[2]; /* of its pixels, where digests are asked for */
} cs_video;

/* Whether OUT is a video; frame_count 0: not known yet, and what may be a picture is not refused. */
bool cs_video_is_wanted(const cs_request *request, size_t frame_count);
/* Refuses options that videos do not have. OK, or reported. frame_count: as above. */
cs_exit cs_video_refuse(const cs_request *request, size_t frame_count);

/* Starts the encoder for these frames. out: stays where it is until it is finished or discarded. OK,
 * or reported. */
cs_exit cs_video_open(cs_video *out, cs_script *script, const cs_request *request,
                      const celspan_frame_desc *frame, const cs_sequence *frames);
/* Makes a frame, or repeats the one before where it shows the same. */
CELSPAN_CHECKED celspan_status cs_video_put(cs_video *video, const celspan_frame_desc *desc,
                                            cs_shoot_frame *frame);
/* Both end the video, whatever they return. */
CELSPAN_CHECKED celspan_status cs_video_finish(cs_video *video);
void cs_video_discard(cs_video *video);

#endif
