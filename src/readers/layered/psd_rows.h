/* The rows of a layer of a Photoshop file: its channels, each packed in a way of its own, put
 * together.
 *
 *   red     raw       | row | row | row |
 *   green   PackBits  | sizes of the rows | packed row | packed row | ...
 *   blue    ZIP       | one zlib stream; with prediction each value is a difference to its left |
 *   alpha   ...
 *   mask    ...         a rectangle of its own, which alpha is multiplied by
 *
 * A channel that is missing is full. Grey has one colour channel.
 */
#pragma once

#include "readers/layered/rows.h"

typedef enum cs_psd_packing {
  CS_PSD_RAW = 0, /* the numbers of the file */
  CS_PSD_PACK_BITS = 1,
  CS_PSD_ZIP = 2,
  CS_PSD_ZIP_PREDICTED = 3
} cs_psd_packing;

/* In the order of cs_psd_layer's channels; of grey the first is the only colour. */
enum { CS_PSD_RED, CS_PSD_GREEN, CS_PSD_BLUE, CS_PSD_ALPHA, CS_PSD_MASK, CS_PSD_CHANNELS };

typedef struct cs_psd_channel {
  bool is_there;
  cs_psd_packing packing;
  int64_t at, end;       /* of the packed rows */
  int64_t sizes;         /* PACK_BITS: of the table of their sizes */
  int32_t width, height; /* pixels */
} cs_psd_channel;

typedef struct cs_psd_mask {
  int32_t x, y;          /* of its rectangle, from the layer's corner */
  unsigned char beyond;  /* its value outside the rectangle */
  unsigned char density; /* how much it counts, 255: wholly */
  bool is_inverted;
} cs_psd_mask;

typedef struct cs_psd_layer {
  cs_rows_source base;
  bool is_grey;
  int size_bytes; /* of an entry in a table of row sizes: 2, or 4 in large documents */
  cs_psd_channel channels[CS_PSD_CHANNELS];
  cs_psd_mask mask;
} cs_psd_layer;

/* A source of the layer's rows. layer: copied. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_psd_rows_create(celspan_context *context,
                                                  const cs_psd_layer *layer, cs_rows_source **out);
