/* The images of one drawing that were read, by their elements: one that `use` shows a thousand times
 * is decoded once. */
#ifndef CS_SVG_IMAGE_KEPT_H
#define CS_SVG_IMAGE_KEPT_H

#include "base/hash_table.h"

typedef struct cs_svg_kept_image {
  celspan_object *object; /* from (0, 0) to its size, owned; NULL: nothing is shown */
  double width, height;
} cs_svg_kept_image;

/* All zero is an empty list. */
typedef struct cs_svg_kept_images {
  cs_hash_table places; /* by element */
  cs_svg_kept_image *items;
  size_t count, capacity;
} cs_svg_kept_images;

/* False: the element's image was not read yet. out: borrowed from the list. */
bool cs_svg_kept_image_find(const cs_svg_kept_images *list, const void *element,
                            cs_svg_kept_image *out);
/* Takes the object over, also after a failure. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_kept_image_add(cs_svg_kept_images *list,
                                                     celspan_context *context, const void *element,
                                                     cs_svg_kept_image image);
void cs_svg_kept_images_finish(cs_svg_kept_images *list, celspan_context *context);

#endif
