/* The poster of a video: the frame that stands for the film, if the film says which.
 *
 *   film{ poster = "2s" } --> mp4: an attached picture;  mov, mkv, webm: film.poster.png beside it
 *
 * INVARIANT: the poster has the size of the frames, and is changed by the same options.
 */
#pragma once

#include "program/film/script.h"
#include "video/format.h"

/* The pixels for an attached picture: RGBA of 8 bits, of the frame's size, owned by the caller;
 * NULL: the file has none. frame: the view. OK, or reported. */
cs_exit cs_poster_make(cs_script *script, const cs_request *request, const cs_video_format *format,
                       const celspan_frame_desc *frame, unsigned char **out, size_t *size);
/* Writes the picture beside a complete video, if there is one. OK, or reported. */
cs_exit cs_poster_write(cs_script *script, const cs_request *request, const cs_video_format *format,
                        const celspan_frame_desc *frame);
/* Whether the picture beside the video is there, or none is wanted. */
bool cs_poster_is_there(const cs_script *script, const cs_request *request,
                        const cs_video_format *format);
/* Adds the poster to a hash. Errors: those of building the frame. */
CELSPAN_CHECKED celspan_status cs_poster_hash(cs_script *script, cs_hash *hash);
