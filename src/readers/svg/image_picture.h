/* Pictures in memory: from the bytes of a file to pixels.
 *
 *   PNG ------------------ readers/layered/png.h ---------------------------+--> rows --> surface
 *   JPEG, interlaced PNG, ... --a file without a name--> the picture module --'
 *
 * The library that reads the others needs a file, so it gets one that exists only in memory.
 */
#pragma once

#include "readers/svg/reading.h"

#define CS_SVG_IMAGE_BYTES ((uint64_t)1 << 30) /* of all images of a drawing, pixels and files */

/* Counts bytes of an image of `node`. Errors: LIMIT for more than CS_SVG_IMAGE_BYTES in all. */
CELSPAN_CHECKED celspan_status cs_svg_image_count(cs_svg_reading *reading, const cs_svg_node *node,
                                                  uint64_t bytes);
/* *out: new; NULL for bytes that are no picture, which is noted. Errors: NO_MEMORY, and as above.
 */
CELSPAN_CHECKED celspan_status cs_svg_image_picture(cs_svg_reading *reading,
                                                    const cs_svg_node *node,
                                                    const unsigned char *bytes, size_t size,
                                                    celspan_surface **out);
