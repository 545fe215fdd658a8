/* The record of finished frames, beside them: what --resume goes by.
 *
 *   .shot.####.png.frames
 *     celspan frames 1
 *     frame NUMBER KEY BYTES CONTENTS PIXELS      hashes as 32 hexadecimal digits; PIXELS may be -
 *
 * KEY stands for all that decides how a frame comes out: scene, pictures as they were on the disk,
 * view, coding, version. CONTENTS is the hash of the file.
 *
 * INVARIANT  A line is added when its frame stands under its name. Lines are only added, each in
 * one write, so that several runs may share a record; one that was cut off is no line. A file whose
 * head is another, of another version, is no record: it begins anew.
 */
#ifndef CS_CLI_RECORD_H
#define CS_CLI_RECORD_H

#include "cli/script.h"
#include "film/shoot.h"

typedef struct cs_record_line {
  int64_t number;
  cs_hash key, contents, pixels; /* pixels 0 0: not known */
  uint64_t bytes;
  size_t order; /* in the file: of two lines of a frame the later one counts */
} cs_record_line;

typedef struct cs_record {
  celspan_context *context;
  char path[CS_SHOOT_PATH + 16];
  cs_hash options; /* of all that is the same for every frame of the run */
  bool is_forced, needs_pixels;
  int descriptor;        /* -1: not open for more lines yet */
  cs_record_line *lines; /* sorted by number, then order; owned */
  size_t count, capacity;
} cs_record;

/* Reads the record of the request's output where there is one, and removes what runs that were
 * killed left of its frames. frame: the view. Errors: OUTPUT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_record_open(cs_record *record, const cs_script *script,
                                              const cs_request *request,
                                              const celspan_frame_desc *frame);
/* Whether the frame stands there as it would come out now; by force, whether it stands there whole,
 * and `is_named` is then false where it may show something else. */
bool cs_record_has(const cs_record *record, cs_shoot_frame *frame);
/* Adds the line of a frame that was made or copied. */
CELSPAN_CHECKED celspan_status cs_record_add(cs_record *record, const cs_shoot_frame *frame);
void cs_record_close(cs_record *record);

#endif
