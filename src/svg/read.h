/* Reading drawings, with a switch for comparisons: coded drawings keep colours as they are coded, so
 * that what is composed of them as light is what other renderers compose of codes.
 */
#ifndef CS_SVG_READ_H
#define CS_SVG_READ_H

#include "base/context.h"

typedef struct cs_svg_bytes {
  const char *bytes;
  size_t size;
  const char *name; /* for messages */
  bool is_coded;
} cs_svg_bytes;

/* See celspan_svg_read. */
CELSPAN_CHECKED celspan_status cs_svg_read_bytes(celspan_context *context, const cs_svg_bytes *from,
                                                 celspan_svg **out);
CELSPAN_CHECKED celspan_status cs_svg_read_file(celspan_context *context, const char *file,
                                                bool is_coded, celspan_svg **out);

#endif
