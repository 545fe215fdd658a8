/* Files that a drawing names: those below its own folder.
 *
 *   "art/hero.svg" names "hand.png"      ->  "art/hand.png"
 *                        "parts/arm.svg" ->  "art/parts/arm.svg"
 *                        "../arm.svg", "/tmp/arm.svg", "http://..." -> nothing
 */
#ifndef CS_SVG_IMAGE_FILE_H
#define CS_SVG_IMAGE_FILE_H

#include "base/context.h"

#define CS_SVG_PATH 4096 /* bytes of a file's name, its zero included */

/* What a file begins with, and which one it is. */
typedef struct cs_svg_image_file {
  char path[CS_SVG_PATH];
  unsigned char head[64];
  size_t head_size;
  uint64_t size;
  uint64_t device, number;
} cs_svg_image_file;

/* Finds the file that `href` names for the drawing in `file`, NULL for one without a file. *reason:
 * NULL, or why there is none. Errors: INPUT where the system failed, which another time may not. */
CELSPAN_CHECKED celspan_status cs_svg_image_file_find(celspan_context *context, const char *file,
                                                      const char *href, cs_svg_image_file *out,
                                                      const char **reason);
/* All bytes of the file, in *out of new memory, size bytes; NULL when it is no more what was found.
 * Errors: INPUT where the system failed; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_image_file_load(celspan_context *context,
                                                      const cs_svg_image_file *file, char **out);

#endif
