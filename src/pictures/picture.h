/* A picture: a file named by a texture, and how to read it.
 *
 * A cs_picture is an immutable value like the rest of the scene. The decoded picture is kept in the
 * context's store (pictures/store.h), found by the picture's hash and shared by all workers.
 */
#ifndef CS_PICTURES_PICTURE_H
#define CS_PICTURES_PICTURE_H

#include "base/context.h"
#include "base/hash.h"

typedef struct cs_picture {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash;
  char *file, *colour, *layer; /* colour, layer: may be NULL */
  int subimage;
} cs_picture;

/* desc's box, sampling, use and wrap are not part of a picture. Errors: NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_picture_create(celspan_context *context,
                                                 const celspan_picture_desc *desc,
                                                 cs_picture **out);
cs_picture *cs_picture_ref(cs_picture *picture);
void cs_picture_unref(cs_picture *picture);
cs_hash cs_picture_hash(const cs_picture *picture);

#endif
