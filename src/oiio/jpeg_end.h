/* Whether a JPEG file holds its whole picture.
 *
 * INVARIANT: only the end marker of the picture itself counts. Those of thumbnails lie inside
 * segments, which are passed over by their lengths; those of further pictures, as phones append
 * them, lie behind it.
 */
#ifndef CS_OIIO_JPEG_END_H
#define CS_OIIO_JPEG_END_H

#include "oiio/source.h"

/* Throws Failure for a file that ends before its picture does: JPEG's library would fill what is
 * missing with grey and report success. */
void check_jpeg_end(Source &source);

#endif
