/* PNG pictures that lie in a zip archive, as OpenRaster has them.
 *
 *   member of the zip --> chunks --data of the IDATs--> inflate --> filtered rows --> RGBA rows
 *
 * All colour types and depths are read, with palettes and transparent colours. Interlaced pictures
 * are refused: their rows do not come in order. Chunks that are not needed are skipped.
 */
#pragma once

#include "readers/layered/rows.h"
#include "readers/layered/zip.h"

/* Reads the header of a member, and makes a source of its rows.
 * Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_png_create(celspan_context *context, const cs_input *input,
                                             const cs_zip_member *member, cs_rows_source **out);
