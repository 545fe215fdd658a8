/* Strips: pictures that are some rows of a larger one, made apart and joined later.
 *
 *   row 0     +--------------+   a strip of 512 rows; row 0 of 1300
 *             |              |
 *   row 512   +--------------+   a strip of 512 rows; row 512 of 1300
 *             |              |
 *   row 1024  +--------------+   a strip of 276 rows; row 1024 of 1300
 *             +--------------+
 *
 * A strip is a picture like any other, which records its place in addition to its pixels:
 *
 *   PNG    a chunk `csST` before the image data: row (4), height of the whole (4), big-endian
 *   Targa  an image ID: `csST`, row (4), height of the whole (4), little-endian
 *   span   two numbers of its header and trailer (docs/spanfile.md)
 *
 * INVARIANT: a strip begins at a multiple of CS_STRIP_ROWS, and ends at such a multiple or at the
 * end of the whole. So rows of span files are stored as in the whole file; and the first row of a
 * strip in PNG is filtered without the row above, which its file does not have.
 */
#pragma once

#include "base/context.h"

enum { CS_STRIP_ROWS = 256 };

/* A place: the row of the whole that is row 0 here, and the height of the whole; height 0: no
 * strip. */
typedef struct cs_strip {
  int32_t row, height;
} cs_strip;

#define CS_STRIP_MARK                                                                              \
  "csST" /* in PNG: ancillary, private, not to be copied by programs that change pixels */

cs_strip cs_strip_of(const celspan_file_desc *file);
/* Whether a picture of `height` rows can have this place. */
bool cs_strip_fits(cs_strip strip, int32_t height);
/* The same as an error with the file's name; a picture that is no strip is valid. Errors:
 * BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_strip_check(celspan_context *context, const char *path,
                                              cs_strip strip, int32_t height);
