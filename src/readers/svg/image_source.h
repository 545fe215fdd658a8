/* Where the bytes of an image are: in its href itself, or in a file below the drawing's own folder.
 *
 *   data:image/png;base64,iVBORw0KGgo...     bytes by base64
 * data:image/svg+xml,%3Csvg xmlns=... bytes unchanged, and by per cents
 *
 *   "art/hero.svg" names "hand.png"      ->  "art/hand.png"
 *                        "parts/arm.svg" ->  "art/parts/arm.svg"
 *                        "../arm.svg", "/tmp/arm.svg", "http://..." -> nothing
 *
 * The first bytes determine the format: the type before the comma is often wrong.
 */
#pragma once

#include "base/context.h"

typedef struct cs_svg_image_data {
  unsigned char *bytes;
  size_t size, capacity;
} cs_svg_image_data;

bool cs_svg_image_is_data(const char *href);
/* The bytes of a data: URI. *is_broken: it has no comma, or invalid base64. *out must be finished
 * even after a failure. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_image_data_read(celspan_context *context, const char *href,
                                                      cs_svg_image_data *out, bool *is_broken);
void cs_svg_image_data_finish(cs_svg_image_data *data, celspan_context *context);
/* The byte that an escape such as "%41" means; -1 where text does not begin with one. */
int cs_svg_image_unescape(const char *text);

/* Whether bytes begin as SVG does. */
bool cs_svg_image_is_drawing(const unsigned char *bytes, size_t size);

#define CS_SVG_PATH 4096 /* bytes of a file's name, its zero included */

/* The first bytes of a file, and its identity. */
typedef struct cs_svg_image_file {
  char path[CS_SVG_PATH];
  unsigned char head[64];
  size_t head_size;
  uint64_t size;
  uint64_t device, number;
} cs_svg_image_file;

/* Finds the file that `href` names for the drawing in `file`, NULL for one without a file. *reason:
 * NULL, or why there is none. Errors: INPUT where the system failed, which may be temporary. */
CELSPAN_CHECKED celspan_status cs_svg_image_file_find(celspan_context *context, const char *file,
                                                      const char *href, cs_svg_image_file *out,
                                                      const char **reason);
/* All bytes of the file, in *out of new memory, size bytes; NULL when the file has changed since.
 * Errors: INPUT where the system failed; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_image_file_load(celspan_context *context,
                                                      const cs_svg_image_file *file, char **out);
