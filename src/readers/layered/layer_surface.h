/* The pixels of a layer as a picture: a surface that reads them from the file when they are seen.
 *
 *   store of pictures --fill rows y..--> begin, or continue --rows--> pixels, or floats by a table
 *
 * The store asks for rows from top to bottom and keeps them within its budget, so a layer is
 * unpacked once. Where it asks for earlier rows, the layer is begun again.
 */
#pragma once

#include "readers/layered/profile_table.h"
#include "readers/layered/rows.h"

/* Owns the source from now on, also on failure. input: as it was while the painting was read;
 * copied. index: of the layer, which distinguishes the surfaces of a file. table: converts the
 * codes, a reference is taken; NULL: codes are not converted. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_layer_surface_create(celspan_context *context,
                                                       const cs_input *input, size_t index,
                                                       cs_rows_source *source,
                                                       cs_profile_table *table,
                                                       celspan_surface **out);
