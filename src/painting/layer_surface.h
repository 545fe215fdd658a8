/* The pixels of a layer as a picture: a surface that reads them from the file when they are seen.
 *
 *   store of pictures --fill rows y..--> begin, or go on --rows--> pixels
 *
 * The store asks for rows from top to bottom and keeps what it got within its budget, so a layer is
 * unpacked once. Where it asks for rows that are past, the layer is begun again.
 */
#ifndef CS_PAINTING_LAYER_SURFACE_H
#define CS_PAINTING_LAYER_SURFACE_H

#include "painting/rows.h"

/* Takes the source over, also on failure. input: as it was while the painting was read; copied.
 * index: of the layer, which tells the surfaces of a file apart. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_layer_surface_create(celspan_context *context,
                                                       const cs_input *input, size_t index,
                                                       cs_rows_source *source,
                                                       celspan_surface **out);

#endif
