/* What a Photoshop document makes its reader do wrong.
 *
 * When it is opened, the reader takes some bytes for each row of each channel of each layer, by the
 * rectangles that the records tell, before it looks for the rows; and it decodes the thumbnail, a
 * JPEG file among the resources, whatever its size. It reads the channels of the mode's colours, and
 * where the number of layers is below 0 one of transparency, without asking how many there are. Of the
 * colour table and of each resource it takes as much memory as its length tells, before it reads it.
 *
 * INVARIANT: of a document that is opened no part before the layers is longer than the file, and the
 * layers have at most as many rows as the file has bytes. A row that is stored has a byte or more, so
 * none that is whole is refused. Thumbnails, which nobody asks for, are hidden from the reader, and so
 * is the sign of that number where the document has no channel but those of its colours, which it has.
 */
#ifndef CS_OIIO_PSD_CHECK_H
#define CS_OIIO_PSD_CHECK_H

#include "oiio/source.h"

/* Hides what is to be hidden, and throws Failure for a document that tells of more rows or bytes, or
 * has too few channels. One that is cut off is left to the reader, which reads the records first. */
void check_psd(Source &source);

#endif
