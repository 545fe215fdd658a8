/* How much memory the layers of a Photoshop document make its reader take.
 *
 * The reader takes some bytes for each row of each channel of each layer when it opens a file, by
 * the rectangles that the records tell, before it looks for the rows.
 *
 * INVARIANT: the layers of a document that is opened have at most as many rows as the file has
 * bytes. A row that is stored has a byte or more, so none that is whole is refused.
 */
#ifndef CS_OIIO_PSD_SIZE_H
#define CS_OIIO_PSD_SIZE_H

#include "oiio/source.h"

/* Throws Failure for a document that tells of more rows. One that is cut off is left to the reader,
 * which reads the records first. */
void check_psd_size(Source &source);

#endif
