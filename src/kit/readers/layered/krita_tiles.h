/* The pixels of a layer of a Krita document: tiles of 64 x 64 pixels, where there are any.
 *
 *   VERSION 2            x, y of a tile: pixels from the layer's own corner, maybe below 0
 *   TILEWIDTH 64         size: of the bytes that follow the line
 *   TILEHEIGHT 64        first of them: 1 packed by LZF, 0 as they are
 *   PIXELSIZE 4          packed: all first bytes of the pixels, then all second bytes, ...
 *   DATA 2               pixels are B G R A, or grey and A, alpha straight, little-endian
 *   -64,0,LZF,1203
 *   ...
 *   0,0,LZF,411
 *
 *   +------+------+          the rectangle of the rows: all tiles; and the painting too, where what
 *   | tile |      |          lies beyond the tiles is not clear
 *   +------+------+
 *   |      | tile |   a row of tiles is unpacked at a time
 *   +------+------+
 */
#pragma once

#include "readers/layered/rows.h"
#include "readers/layered/zip.h"

#define CS_KRITA_TILES_BYTES ((size_t)1 << 30) /* the most packed bytes of a layer's tiles */
#define CS_KRITA_TILES_SIDE 131072             /* of the area that the tiles of a layer cover */

typedef struct cs_krita_tiles_form {
  /* In: the rectangle of the painting in the layer's units; out: the rectangle of the rows. */
  int32_t x, y, width, height;
  bool is_grey;
  int bits;                /* the bits of a channel: 8 or 16 */
  int pixel_size;          /* bytes */
  unsigned char beyond[8]; /* the pixel for places without a tile */
  int64_t scanned;         /* out: the bytes of the tiles */
} cs_krita_tiles_form;

/* Sets the form of a colour space; false if its pixels cannot be read. */
bool cs_krita_tiles_form_of(const char *space, cs_krita_tiles_form *form);
/* Finds the places of the tiles. *out does not change if there are no tiles and the area outside is
 * clear. Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_krita_tiles_create(celspan_context *context,
                                                     const cs_input *input,
                                                     const cs_zip_member *member,
                                                     cs_krita_tiles_form *form,
                                                     cs_rows_source **out);
