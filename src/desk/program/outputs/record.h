/* The record of finished frames, in a file beside them: --resume relies on it. A film that is one
 * file has a line, too (program/outputs/whole.h).
 *
 *   .shot.####.png.frames
 *     celspan frames 1
 *     by VERSION (COMMIT)                         of the program that adds the lines which follow
 *     frame NUMBER KEY BYTES CONTENTS PIXELS      hashes as 32 hexadecimal digits; PIXELS may be -
 *
 * KEY is the hash of everything that decides how a frame comes out: the scene, the picture files as
 * they were on the disk, the view, the coding, the version. CONTENTS is the hash of the file as it
 * was written, taken before it got its name.
 *
 * INVARIANT  A line is added when the file of its frame is complete under its name. Lines are only
 * added, each in one write, so that several runs may share a record; a line that was cut off is
 * ignored. A record with another head, of another version, is replaced.
 */
#pragma once

#include "inside/films.h"
#include "program/film/script.h"

typedef struct cs_record_line {
  int64_t number;
  cs_hash key, contents, pixels; /* pixels 0 0: not known */
  uint64_t bytes;
  size_t order; /* the position in the file: of two lines about a frame, the later one counts */
} cs_record_line;

typedef struct cs_record {
  celspan_context *context;
  char path[CS_SHOOT_PATH + 16];
  cs_hash options; /* the hash of everything that is the same for every frame of the run */
  bool is_forced, needs_pixels;
  int descriptor;        /* -1: not open for more lines yet */
  cs_record_line *lines; /* sorted by number, then order; owned */
  size_t count, capacity;
} cs_record;

/* Reads the record of the request's output, if it exists. frame: the view. Errors: OUTPUT,
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_record_open(cs_record *record, const cs_script *script,
                                              const cs_request *request,
                                              const celspan_frame_desc *frame);
/* Whether the record has a line of the frame of this number. */
bool cs_record_knows(const cs_record *record, int64_t number);
/* Whether the file of the frame equals the one that would be written now. With --keep: whether it
 * is complete; then `is_named` is set to false if the file may show something else. */
bool cs_record_has(const cs_record *record, cs_shoot_frame *frame);
/* Adds the line of a frame that was made or copied. */
CELSPAN_CHECKED celspan_status cs_record_add(cs_record *record, const cs_shoot_frame *frame);
void cs_record_close(cs_record *record);
