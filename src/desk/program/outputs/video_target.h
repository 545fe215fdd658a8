/* A film as a video: the options of the command line, and what is refused.
 *
 * Everything that can be refused is refused before the first frame: options and sizes that the
 * format does not have, a missing ffmpeg, a missing sound.
 */
#pragma once

#include "program/film/script.h"
#include "video/video.h"

/* Refuses what the codec does not have. OK, or reported. path: the path of -o. */
cs_exit cs_video_target_refuse(celspan_context *context, const cs_request *request,
                               const char *path);
/* Refuses frames of a size, or a rate, that the codec does not have. OK, or reported. */
cs_exit cs_video_target_refuse_frames(const cs_script *script, const cs_request *request,
                                      const celspan_frame_desc *frame);
/* Starts the encoder, with the film's sound while the frames `played` are played. chapters: as in
 * cs_video_extras; captions: in the form of the format; NULL: none. OK, or reported. */
cs_exit cs_video_target_open(cs_video *out, cs_script *script, const cs_request *request,
                             const celspan_frame_desc *frame, const cs_sequence *played,
                             const char *chapters, const char *captions);
/* Sets fields of the table on top of the stack: what the format holds, and whether ffmpeg makes
 * it. */
void cs_video_target_put(lua_State *L, const cs_request *request);
/* Writes the frame that stands for the film as a picture of its own. It has the size of the frames,
 * and is changed by the same options. OK, or reported. */
cs_exit cs_video_target_write_poster(cs_script *script, const cs_request *request,
                                     const celspan_frame_desc *frame, const char *path);
