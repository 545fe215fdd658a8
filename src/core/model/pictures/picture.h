/* A picture: a file or a surface that a texture shows, and how to read it; or a part of one.
 *
 * A cs_picture is an immutable value like the rest of the scene. The decoded picture is kept in the
 * context's store (model/pictures/store.h), found by the picture's hash and shared by all workers.
 * A part is a picture of its own there, with edges and levels of its own, made of the blocks of the
 * whole. So is a picture whose alpha is made smooth (model/pictures/smooth.h), and one in tiles
 * (model/pictures/tiled.h) is made of the pictures of its tiles.
 */
#pragma once

#include "base/context.h"
#include "base/hash.h"

typedef struct cs_picture {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash;
  celspan_surface *surface; /* a reference; NULL: a file */
  char *file;               /* "" where there is a surface; the folder of tiles */
  char *colour, *layer;     /* may be NULL */
  char *tried;              /* where the file was searched for before; may be NULL; not hashed */
  int subimage;
  /* the picture of which this is a part, a reference; NULL: this is no part */
  struct cs_picture *whole;
  int32_t x, y, width, height; /* a part, in pixels of the whole; width 0: all of the whole */
  bool is_smooth;              /* the alpha of the picture is made smooth */
  bool is_tile;                /* one of many: nothing is kept of it but its blocks */
  celspan_picture_tiles tiles; /* size 0: it is not in tiles */
} cs_picture;

/* desc's box, sampling, use and wrap are not part of a picture. Errors: NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_picture_create(celspan_context *context,
                                                 const celspan_picture_desc *desc,
                                                 cs_picture **out);
cs_picture *cs_picture_ref(cs_picture *picture);
void cs_picture_unref(cs_picture *picture);
cs_hash cs_picture_hash(const cs_picture *picture);
/* For messages: the name of the file, or a description of a picture without a file. */
const char *cs_picture_name(const cs_picture *picture);
