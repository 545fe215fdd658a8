/* The record of a layer in a Photoshop file: everything except its pixels.
 *
 * Photoshop writes a group as two records, in the order of painting:
 *
 *   hidden divider    CS_PSD_GROUP_START     the layers of the group begin here
 *   ...
 *   the group         CS_PSD_GROUP           its name, opacity and blend mode
 */
#pragma once

#include "readers/layered/contents.h"
#include "readers/layered/input.h"

typedef enum cs_psd_role { CS_PSD_LAYER = 0, CS_PSD_GROUP, CS_PSD_GROUP_START } cs_psd_role;

#define CS_PSD_MOST_CHANNELS 56 /* the format's own limit */

typedef struct cs_psd_record {
  cs_psd_role role;
  int32_t left, top, right, bottom;
  int channel_count;
  /* 0..2 colour, -1 alpha, -2 mask, -3 mask before a vector mask. */
  int16_t ids[CS_PSD_MOST_CHANNELS];
  uint64_t sizes[CS_PSD_MOST_CHANNELS];
  char blend[5], group_blend[5]; /* keys of four letters; "": the file has none */
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

/* Reads the record at the cursor, whose status is the result. is_large: a large document, with
 * some lengths of 8 bytes. */
void cs_psd_record_read(cs_cursor *cursor, bool is_large, cs_psd_record *out);
/* The word of celspan for a blend key; "" does not change, and neither do keys without a word. */
void cs_psd_record_blend(const char key[5], char out[32]);
/* Reads the signature, key and length of a tagged block at the cursor; false where there is none.
 */
bool cs_psd_record_tag(cs_cursor *cursor, bool is_large, char key[5], uint64_t *size);
