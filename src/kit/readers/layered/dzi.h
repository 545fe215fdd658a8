/* Deep Zoom: the XML file that describes a picture in tiles.
 *
 *   <Image Format="png" Overlap="1" TileSize="254"> <Size Width="40000" Height="30000"/> </Image>
 */
#pragma once

#include "inside/context.h"

/* Whether a name ends in .dzi, in any case. */
bool cs_dzi_is(const char *name);
/* A number that is missing or invalid is -1, and such a format "": the picture that is made of them
 * refuses these. Errors: INPUT for a file that cannot be read, or has more than 64 KiB, and those
 * of XML. */
CELSPAN_CHECKED celspan_status cs_dzi_read(celspan_context *context, const char *path,
                                           celspan_picture_tiles *out);
