/* One file that holds a whole film, a video, planes or a sound, under --resume: it is kept if
 * nothing that it is made of has changed.
 *
 *   options, frames, sounds --hashed--> key --as that of a frame--> the record beside it (record.h)
 *
 * INVARIANT  The key has everything that decides the bytes of the file, except for the encoder.
 * What contains a procedure is never kept: that can be compared with nothing.
 */
#pragma once

#include "program/outputs/record.h"

typedef struct cs_whole {
  cs_record record;
  cs_shoot_frame file; /* represents the file: its key, and its contents after it is made */
} cs_whole;

/* Opens the record of the request's output. frame: the view. Errors: those of cs_record_open. */
CELSPAN_CHECKED celspan_status cs_whole_open(cs_whole *whole, const cs_script *script,
                                             const cs_request *request,
                                             const celspan_frame_desc *frame);
/* Whether the file may be kept: an earlier run has finished it, or it is kept by force. Only then
 * it is of use to know the key. */
bool cs_whole_is_known(const cs_whole *whole);
/* Begins the key: the options, the numbers of the frames and the sounds. Errors: those of
 * cs_soundtrack_read. */
CELSPAN_CHECKED celspan_status cs_whole_begin(cs_whole *whole, cs_script *script,
                                              const cs_request *request, const cs_sequence *frames);
/* Adds the contents of a frame to the key; must be called in order. */
void cs_whole_add(cs_whole *whole, const cs_shoot_frame *frame);
/* Whether the existing file is the same as the one that would be made now. */
bool cs_whole_is_kept(cs_whole *whole);
/* Adds the file to the record. */
CELSPAN_CHECKED celspan_status cs_whole_finish(cs_whole *whole);
void cs_whole_close(cs_whole *whole);
