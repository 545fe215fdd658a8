/* A film as a video: the options of the command line, and what is refused.
 *
 * Everything that can be refused is refused before the first frame: options and sizes that the
 * format does not have, a missing ffmpeg, a missing sound.
 */
#pragma once

#include "program/film/script.h"
#include "video/video.h"

/* Whether ffmpeg makes such a video. */
bool cs_video_target_runs_ffmpeg(const cs_request *request);
/* Refuses what the codec does not have. OK, or reported. path: that of -o. */
cs_exit cs_video_target_refuse(celspan_context *context, const cs_request *request,
                               const char *path);
/* Refuses frames of a size, or a rate, that the codec does not have. OK, or reported. */
cs_exit cs_video_target_refuse_frames(const cs_script *script, const cs_request *request,
                                      const celspan_frame_desc *frame);
/* Starts the encoder, with the film's sound while these frames are played. OK, or reported. */
cs_exit cs_video_target_open(cs_video *out, cs_script *script, const cs_request *request,
                             const celspan_frame_desc *frame, const cs_sequence *played);
/* Writes the film's poster beside the complete video, if there is one. OK, or reported. */
cs_exit cs_video_target_add_poster(cs_script *script, const cs_request *request,
                                   const celspan_frame_desc *frame);
/* Whether that file is there, or none is wanted. */
bool cs_video_target_has_poster(const cs_script *script, const cs_request *request);

/* ---- chapters.c */

/* The marks of the film as chapters of a video of these frames: the address of a text for ffmpeg;
 * NULL: there are none, or the frames are not a run. Those for which there is no room are left
 * out. *out: for cs_chapters_free. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_chapters_make(const cs_script *script, const cs_sequence *played,
                                                char **out);
void cs_chapters_free(const cs_script *script, char *chapters);
