/* Photoshop documents (PSD, and PSB for large ones): their layers, or the merged picture of
 * documents without layers.
 *
 *   header | colour table | resources | layers and masks | merged picture
 *                                        |
 *                                        records, rearmost first | channels of all layers
 *
 * RGB and grey of 8 and 16 bits per channel are read. Layers of 16 bits are in a tagged block,
 * behind the place of 8-bit layers. Effects that Photoshop computes when it paints (adjustments,
 * fills, effects, conditional blending) are noted, not drawn.
 */
#pragma once

#include "celspan/layers.h"
#include "readers/layered/contents.h"

/* Whether the first bytes are the beginning of such a document. */
bool cs_psd_is(const unsigned char start[4]);
/* Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_psd_read(celspan_context *context, const cs_input *input,
                                           celspan_painting *painting);
