/* What the href of an image holds in itself: data: URIs.
 *
 *   data:image/png;base64,iVBORw0KGgo...     bytes by base64
 *   data:image/svg+xml,%3Csvg xmlns=...      bytes as they are, and by per cents
 *
 * What the bytes are is told by themselves: the type before the comma is often wrong.
 */
#ifndef CS_SVG_IMAGE_DATA_H
#define CS_SVG_IMAGE_DATA_H

#include "base/context.h"

typedef struct cs_svg_image_data {
  unsigned char *bytes;
  size_t size, capacity;
} cs_svg_image_data;

bool cs_svg_image_is_data(const char *href);
/* The bytes of a data: URI. *is_broken: it has no comma, or is no base64 where it should be. *out is
 * to be finished even after a failure. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_image_data_read(celspan_context *context, const char *href,
                                                      cs_svg_image_data *out, bool *is_broken);
void cs_svg_image_data_finish(cs_svg_image_data *data, celspan_context *context);
/* The byte that "%41" and the like stand for; -1 where text does not begin with one. */
int cs_svg_image_unescape(const char *text);

/* Whether bytes begin as SVG does. */
bool cs_svg_image_is_drawing(const unsigned char *bytes, size_t size);

#endif
