/* Pictures: a file named by a texture, read when it is first seen.
 *
 * A cs_picture is an immutable value like the rest of the scene: the name and how to read it. What
 * was read of it lives in the context's store, keyed by the picture's hash, shared by all workers
 * under a memory budget. Reading goes through the picture module (OpenImageIO), a shared object
 * loaded on first use, whose face is the table cs_picture_module below: everything C++ stays behind
 * it, and nothing of it is touched by a film without pictures.
 */
#ifndef CS_PICTURES_PICTURE_H
#define CS_PICTURES_PICTURE_H

#include "base/context.h"
#include "base/hash.h"
#include "colour/srgb8.h"

typedef struct cs_picture cs_picture;

/* desc's box, sampling, use and wrap are not part of a picture. Errors: NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_picture_create(celspan_context *context,
                                                 const celspan_picture_desc *desc,
                                                 cs_picture **out);
cs_picture *cs_picture_ref(cs_picture *picture);
void cs_picture_unref(cs_picture *picture);
cs_hash cs_picture_hash(const cs_picture *picture);

/* The header, read once a context. Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_picture_info(celspan_context *context, const cs_picture *picture,
                                               celspan_picture_info *out);

/* One texel block: premultiplied linear RGBA floats, row-major, `size` x `size` texels at mip
 * `level` (texel = 2^level picture pixels, the mean in linear light), block (column, row). Texels
 * beyond the picture are clear. Pinned until released. Errors: INPUT, LIMIT, NO_MEMORY. */
#define CS_PICTURE_BLOCK 64
/* Codes of a row of a block: its own, and that of the texel right of it. */
#define CS_PICTURE_CODES_ROW (CS_PICTURE_BLOCK + 1)
/* What a block takes: its texels and their codes. */
#define CS_PICTURE_BLOCK_BYTES                                                                     \
  ((size_t)CS_PICTURE_BLOCK * (16 * CS_PICTURE_BLOCK + 4 * CS_PICTURE_CODES_ROW))

typedef struct cs_picture_block cs_picture_block;
CELSPAN_CHECKED celspan_status cs_picture_acquire(celspan_context *context,
                                                  const cs_picture *picture, int level,
                                                  int32_t column, int32_t row,
                                                  cs_picture_block **out);
const float *cs_picture_texels(const cs_picture_block *block);
/* What texels of a block have in common, those beyond the picture left out. */
typedef enum cs_picture_opacity {
  CS_PICTURE_MIXED,
  CS_PICTURE_OPAQUE, /* alpha is 1 */
  CS_PICTURE_CLEAR   /* all is 0 */
} cs_picture_opacity;
cs_picture_opacity cs_picture_block_opacity(const cs_picture_block *block);
/* Of level 0: its texels as 8-bit pixels, sRGB and straight, as cs_srgb8_pixel makes them, in rows
 * of CS_PICTURE_CODES_ROW. */
const unsigned char *cs_picture_codes(const cs_picture_block *block);
/* Whether the codes tell all: cs_srgb8_colour makes the very texels of them, and those right of the
 * block unless the picture ends there. */
bool cs_picture_is_coded(const cs_picture_block *block);
/* The light of all codes. */
const cs_srgb8_curve *cs_picture_curve(const cs_picture_block *block);
void cs_picture_release(celspan_context *context, cs_picture_block *block);

#endif
