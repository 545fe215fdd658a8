/* Images inside of drawings: pictures and other drawings, in the file itself or in files beside it.
 *
 *   href ---- data: ----> bytes --+-- PNG, JPEG, ... --> pixels in memory
 *     |                           +-- SVG -----------> a drawing of its own
 *     +------ name -----> a file below the folder of the drawing's, else nothing
 *
 * Nothing else is opened: no absolute names, no "..", no addresses, no links that lead out of the
 * folder. A drawing that shows itself, through however many files, ends there.
 */
#pragma once

#include "readers/svg/document/art.h"
#include "readers/svg/document/reading.h"

#define CS_SVG_IMAGE_DEPTH 4 /* drawings inside one another */

/* Adds the contents of an image element to `item`; *place has its style. Contents that cannot be
 * shown are noted. Errors: NO_MEMORY; LIMIT for more than CS_SVG_IMAGE_BYTES in all; INPUT for
 * unfit numbers. */
CELSPAN_CHECKED celspan_status cs_svg_image_add(cs_svg_reading *reading, const cs_svg_node *node,
                                                const cs_svg_place *place, cs_svg_item *item);
/* The box of an image element in user units; *is_there: it has a size. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_svg_image_box(cs_svg_reading *reading, const cs_svg_node *node,
                                                const cs_svg_measure *measure, celspan_box *out,
                                                bool *is_there);
/* The picture or drawing that the element names, fitted into a box in user units by its
 * preserveAspectRatio. *out: new, in user units; NULL: nothing is shown. Errors: as above. */
CELSPAN_CHECKED celspan_status cs_svg_image_in_box(cs_svg_reading *reading, const cs_svg_node *node,
                                                   const celspan_box *box, celspan_object **out);

/* ---------------------------------------------------------------- where the bytes are */

/* Where the bytes of an image are: in its href itself (common/address.h), or in a file below the
 * drawing's own folder.
 *
 *   "art/hero.svg" names "hand.png"      ->  "art/hand.png"
 *                        "parts/arm.svg" ->  "art/parts/arm.svg"
 *                        "../arm.svg", "/tmp/arm.svg", "http://..." -> nothing
 *
 * The first bytes determine the format: the type before the comma is often wrong.
 */
/* Whether bytes begin like an SVG file. */
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

/* Finds the file that `href` names for the drawing in `file`; NULL for a drawing without a file.
 * *reason: NULL, or why there is no file. Errors: INPUT if the system failed, which may be
 * temporary. */
CELSPAN_CHECKED celspan_status cs_svg_image_file_find(celspan_context *context, const char *file,
                                                      const char *href, cs_svg_image_file *out,
                                                      const char **reason);
/* All bytes of the file, in *out: new memory of `size` bytes; NULL if the file has changed since it
 * was found. Errors: INPUT if the system failed; NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_image_file_load(celspan_context *context,
                                                      const cs_svg_image_file *file, char **out);

/* ---------------------------------------------------------------- pictures */

/* Pictures in memory: from the bytes of a file to pixels.
 *
 *   PNG ------------------ readers/layered/png.h ---------------------------+--> rows --> surface
 *   JPEG, interlaced PNG, ... --a file without a name--> the picture module --'
 *
 * The library that reads the others needs a file, so it gets one that exists only in memory.
 */
/* pixels and files of all images of a drawing together */
#define CS_SVG_IMAGE_BYTES ((uint64_t)1 << 30)

/* Counts bytes of an image of `node`. Errors: LIMIT for more than CS_SVG_IMAGE_BYTES in all. */
CELSPAN_CHECKED celspan_status cs_svg_image_count(cs_svg_reading *reading, const cs_svg_node *node,
                                                  uint64_t bytes);
/* *out: new; NULL for bytes that are not a picture; this is noted. Errors: NO_MEMORY, and as
 * above. */
CELSPAN_CHECKED celspan_status cs_svg_image_picture(cs_svg_reading *reading,
                                                    const cs_svg_node *node,
                                                    const unsigned char *bytes, size_t size,
                                                    celspan_surface **out);
