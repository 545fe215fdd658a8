/* How much memory a Photoshop document makes its reader take when it is opened.
 *
 * The reader takes some bytes for each row of each channel of each layer, by the rectangles that the
 * records tell, before it looks for the rows; and it decodes the thumbnail, a JPEG file among the
 * resources, whatever its size.
 *
 * INVARIANT: the layers of a document that is opened have at most as many rows as the file has
 * bytes. A row that is stored has a byte or more, so none that is whole is refused. Thumbnails,
 * which nobody asks for, are hidden from the reader.
 */
#ifndef CS_OIIO_PSD_SIZE_H
#define CS_OIIO_PSD_SIZE_H

#include "oiio/source.h"

/* Hides thumbnails, and throws Failure for a document that tells of more rows. One that is cut off is
 * left to the reader, which reads the records first. */
void check_psd_size(Source &source);

#endif
