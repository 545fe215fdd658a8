/* The command that makes a video of raw frames: the arguments of ffmpeg.
 *
 *   frames on standard input [--> matrix and range of BT.709] --> encoder --> muxer --> file
 *   sound, moved and cut to the frames ------------------> encoder --^
 *
 * INVARIANT: no argument is read by a shell, and names of files begin with "file:", so that none of
 * them is taken for an option or an address.
 */
#ifndef CS_CLI_VIDEO_COMMAND_H
#define CS_CLI_VIDEO_COMMAND_H

#include "cli/video/format.h"

enum { CS_VIDEO_ARGUMENTS = 72, CS_VIDEO_TEXT = 16384 };

typedef struct cs_video_frames {
  int32_t width, height; /* pixels */
  double frames_second;
} cs_video_frames;

typedef struct cs_video_sound {
  const char *path; /* NULL: none */
  double start;  /* seconds from the first frame to its beginning; below 0 its beginning is cut */
  double length; /* seconds of all frames */
} cs_video_sound;

typedef struct cs_video_command {
  const char *arguments[CS_VIDEO_ARGUMENTS]; /* NULL at the end */
  size_t count;
  char text[CS_VIDEO_TEXT]; /* of arguments that are made here */
  size_t text_size;
} cs_video_command;

/* file: the name of the file to be written. */
void cs_video_command_encode(cs_video_command *command, const cs_video_format *format,
                             const cs_request *request, const cs_video_frames *frames,
                             const cs_video_sound *sound, const char *file);
/* A command that ends with 0 if ffmpeg can read the sound. */
void cs_video_command_listen(cs_video_command *command, const char *sound);

#endif
