/* Photoshop documents (PSD, and PSB for large ones): their layers, or the merged picture of
 * documents without layers.
 *
 *   header | colour table | resources | layers and masks | merged picture
 *                                        |
 *                                        records, rearmost first | channels of all layers
 *
 * RGB and grey of 8 and 16 bits per channel are read. Layers of 16 bits are in a tagged block,
 * behind the place of 8-bit layers. Effects that Photoshop computes when it paints (adjustments,
 * fills, effects, conditional blending) are noted, not drawn.
 */
#pragma once

#include "celspan/layers.h"
#include "readers/layered/contents.h"
#include "readers/layered/input.h"
#include "readers/layered/rows.h"

/* Whether the first bytes are the beginning of a Photoshop document. */
bool cs_psd_is(const unsigned char start[4]);
/* Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_psd_read(celspan_context *context, const cs_input *input,
                                           celspan_painting *painting);

/* ---------------------------------------------------------------- the record of a layer */

/* The record of a layer in a Photoshop file: everything except its pixels.
 *
 * Photoshop writes a group as two records, in the order of painting:
 *
 *   hidden divider    CS_PSD_GROUP_START     the layers of the group begin here
 *   ...
 *   the group         CS_PSD_GROUP           its name, opacity and blend mode
 */
typedef enum cs_psd_role { CS_PSD_LAYER = 0, CS_PSD_GROUP, CS_PSD_GROUP_START } cs_psd_role;

#define CS_PSD_MOST_CHANNELS 56 /* the format's own limit */

typedef struct cs_psd_record {
  cs_psd_role role;
  int32_t left, top, right, bottom;
  int channel_count;
  /* 0..2 colour, -1 alpha, -2 mask, -3 mask before a vector mask. */
  int16_t ids[CS_PSD_MOST_CHANNELS];
  uint64_t sizes[CS_PSD_MOST_CHANNELS];
  char blend[5], group_blend[5]; /* keys of four letters; "": not in the file */
  unsigned char opacity, fill;
  bool is_hidden, is_clipped;
  bool has_mask, mask_is_off, mask_is_inverted, mask_is_altered;
  int32_t mask_left, mask_top, mask_right, mask_bottom;
  unsigned char mask_beyond, mask_density;
  bool has_vector_mask, has_effects, has_conditions;
  char adjustment[5], fill_content[5]; /* the key of the adjustment or fill that makes its pixels;
                                          "": painted */
  char name[CS_CONTENTS_TEXT];
  size_t name_size;
} cs_psd_record;

/* Reads the record at the cursor and returns the cursor's status. is_large: a large document, with
 * some lengths of 8 bytes. */
void cs_psd_record_read(cs_cursor *cursor, bool is_large, cs_psd_record *out);
/* Reads the signature, key and length of a tagged block at the cursor; false if there is none. */
bool cs_psd_record_tag(cs_cursor *cursor, bool is_large, char key[5], uint64_t *size);

/* ---------------------------------------------------------------- the rows of a layer */

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
typedef enum cs_psd_packing {
  CS_PSD_RAW = 0, /* the numbers of the file */
  CS_PSD_PACK_BITS = 1,
  CS_PSD_ZIP = 2,
  CS_PSD_ZIP_PREDICTED = 3
} cs_psd_packing;

/* In the order of cs_psd_layer's channels; grey has only the first colour. */
enum { CS_PSD_RED, CS_PSD_GREEN, CS_PSD_BLUE, CS_PSD_ALPHA, CS_PSD_MASK, CS_PSD_CHANNELS };

typedef struct cs_psd_channel {
  bool is_there;
  cs_psd_packing packing;
  int64_t at, end;       /* where the packed rows are */
  int64_t sizes;         /* PACK_BITS: where the table of row sizes is */
  int32_t width, height; /* pixels */
} cs_psd_channel;

typedef struct cs_psd_mask {
  int32_t x, y;          /* where its rectangle begins, from the layer's corner */
  unsigned char beyond;  /* the value of the mask outside of the rectangle */
  unsigned char density; /* how much the mask counts; 255: fully */
  bool is_inverted;
} cs_psd_mask;

typedef struct cs_psd_layer {
  cs_rows_source base;
  bool is_grey;
  int size_bytes; /* bytes of an entry in a table of row sizes: 2, or 4 in large documents */
  cs_psd_channel channels[CS_PSD_CHANNELS];
  cs_psd_mask mask;
} cs_psd_layer;

/* A source of the layer's rows. layer: copied. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_psd_rows_create(celspan_context *context,
                                                  const cs_psd_layer *layer, cs_rows_source **out);
