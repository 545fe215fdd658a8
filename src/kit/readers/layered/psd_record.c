/* The record of a layer in a Photoshop file: everything except its pixels. */
#include "readers/layered/psd.h"

#include <stdio.h>
#include <string.h>

#include "common/utf8.h"

/* ---------------------------------------------------------------- tagged blocks */

/* Keys whose lengths have 8 bytes in large documents. */
static const char *const wide_keys[] = {"LMsk", "Lr16", "Lr32", "Layr", "Mt16", "Mt32", "Mtrn",
                                        "Alph", "FMsk", "lnk2", "FEid", "FXid", "PxSD", NULL};
static const char *const vector_mask_keys[] = {"vmsk", "vsms", NULL};
static const char *const effect_keys[] = {"lfx2", "lrFX", "lmfx", NULL};
static const char *const fill_keys[] = {"SoCo", "GdFl", "PtFl", NULL};
static const char *const adjustment_keys[] = {
    "levl", "curv", "brit", "hue2", "hue ", "blnc", "nvrt", "thrs", "post", "grdm",
    "selc", "mixr", "phfl", "vibA", "expA", "blwh", "CgEd", "clrL", NULL};

static bool is_in(const char *const *keys, const char *key) {
  for (; *keys; keys++)
    if (strcmp(*keys, key) == 0)
      return true;
  return false;
}

bool cs_psd_record_tag(cs_cursor *cursor, bool is_large, char key[5], uint64_t *size) {
  char signature[4];
  /* Blocks are padded to 2 or 4 bytes by some programs, but not by others. */
  for (int padding = 0; padding < 4; padding++) {
    if (cursor->end - cursor->at < 12)
      return false;
    int64_t at = cursor->at;
    cs_cursor_bytes(cursor, signature, sizeof signature);
    if (memcmp(signature, "8BIM", 4) == 0 || memcmp(signature, "8B64", 4) == 0)
      break;
    cursor->at = at + 1;
    if (padding == 3)
      return false;
  }
  cs_cursor_bytes(cursor, key, 4);
  key[4] = 0;
  *size = is_large && is_in(wide_keys, key) ? cs_cursor_64(cursor) : cs_cursor_32(cursor);
  return cursor->status == CELSPAN_OK;
}

/* Converts UTF-16 to UTF-8, as far as there is room. */
static void read_unicode_name(cs_cursor *cursor, uint64_t size, cs_psd_record *out) {
  uint32_t count = cs_cursor_32(cursor);
  if (size < 4 || count > (size - 4) / 2)
    return;
  out->name_size = 0;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t code = cs_cursor_16(cursor);
    if (code >= 0xD800 && code < 0xDC00 && i + 1 < count) {
      code = 0x10000 + ((code & 0x3FF) << 10) + (cs_cursor_16(cursor) & 0x3FF);
      i++;
    }
    char bytes[4];
    size_t added = cs_utf8_put(bytes, code);
    if (out->name_size + added >= sizeof out->name)
      return;
    memcpy(out->name + out->name_size, bytes, added);
    out->name_size += added;
  }
}

static void read_divider(cs_cursor *cursor, uint64_t size, cs_psd_record *out) {
  uint32_t type = cs_cursor_32(cursor);
  out->role = type == 1 || type == 2 ? CS_PSD_GROUP : type == 3 ? CS_PSD_GROUP_START : CS_PSD_LAYER;
  if (size < 12)
    return;
  cs_cursor_skip(cursor, 4);
  cs_cursor_bytes(cursor, out->group_blend, 4);
}

static void read_tag(cs_cursor *cursor, const char *key, uint64_t size, cs_psd_record *out) {
  if (strcmp(key, "luni") == 0)
    read_unicode_name(cursor, size, out);
  else if ((strcmp(key, "lsct") == 0 || strcmp(key, "lsdk") == 0) && size >= 4)
    read_divider(cursor, size, out);
  else if (strcmp(key, "iOpa") == 0 && size >= 1)
    out->fill = cs_cursor_8(cursor);
  else if (is_in(vector_mask_keys, key))
    out->has_vector_mask = true;
  else if (is_in(effect_keys, key))
    out->has_effects = true;
  else if (is_in(fill_keys, key))
    memcpy(out->fill_content, key, 5);
  else if (is_in(adjustment_keys, key))
    memcpy(out->adjustment, key, 5);
}

static void read_tags(cs_cursor *cursor, bool is_large, cs_psd_record *out) {
  char key[5];
  uint64_t size;
  while (cursor->status == CELSPAN_OK && cs_psd_record_tag(cursor, is_large, key, &size)) {
    int64_t end = cs_cursor_section(cursor, size, "a block of a layer");
    if (cursor->status != CELSPAN_OK)
      return;
    read_tag(cursor, key, size, out);
    if (cursor->status == CELSPAN_OK)
      cursor->at = end;
  }
}

/* ---------------------------------------------------------------- mask and ranges */

/* How much the mask counts, and how far its edge is blurred: for a painted mask, then for a mask
 * drawn as a path. */
static void read_mask_parameters(cs_cursor *cursor, cs_psd_record *out) {
  unsigned present = cs_cursor_8(cursor);
  if (present & 1)
    out->mask_density = cs_cursor_8(cursor);
  if (present & 2)
    out->mask_is_altered |= cs_cursor_64(cursor) != 0; /* a double; 0 is all bits clear */
  if (present & 4)
    out->mask_is_altered |= cs_cursor_8(cursor) != 255;
  if (present & 8)
    out->mask_is_altered |= cs_cursor_64(cursor) != 0;
}

static void read_mask(cs_cursor *cursor, cs_psd_record *out) {
  enum { OFF = 2, INVERTED = 4, PARAMETERS = 16 };
  uint32_t size = cs_cursor_32(cursor);
  int64_t end = cs_cursor_section(cursor, size, "a layer's mask");
  out->mask_density = 255;
  if (size < 18 || cursor->status != CELSPAN_OK) {
    cursor->at = end;
    return;
  }
  out->has_mask = true;
  out->mask_top = (int32_t)cs_cursor_32(cursor);
  out->mask_left = (int32_t)cs_cursor_32(cursor);
  out->mask_bottom = (int32_t)cs_cursor_32(cursor);
  out->mask_right = (int32_t)cs_cursor_32(cursor);
  out->mask_beyond = cs_cursor_8(cursor);
  unsigned flags = cs_cursor_8(cursor);
  out->mask_is_off = flags & OFF;
  out->mask_is_inverted = flags & INVERTED;
  if (size >= 36)
    cs_cursor_skip(cursor, 18); /* the mask before a vector mask was combined with it */
  if ((flags & PARAMETERS) && cursor->at < end)
    read_mask_parameters(cursor, out);
  if (cursor->status == CELSPAN_OK)
    cursor->at = end;
}

/* The ranges of lightness in which the layer is visible; the full range unless the user has moved a
 * slider. */
static void read_ranges(cs_cursor *cursor, cs_psd_record *out) {
  uint32_t size = cs_cursor_32(cursor);
  int64_t end = cs_cursor_section(cursor, size, "a layer's blending ranges");
  for (uint32_t i = 0; i + 4 <= size && cursor->status == CELSPAN_OK; i += 4)
    out->has_conditions |= cs_cursor_32(cursor) != 0xFFFF;
  if (cursor->status == CELSPAN_OK)
    cursor->at = end;
}

/* ---------------------------------------------------------------- the record */

static void read_name(cs_cursor *cursor, cs_psd_record *out) {
  unsigned size = cs_cursor_8(cursor);
  cs_cursor_bytes(cursor, out->name, size);
  out->name_size = size;
  cs_cursor_skip(cursor, (4 - (size + 1) % 4) % 4);
}

static void read_extra(cs_cursor *cursor, bool is_large, cs_psd_record *out) {
  int64_t outer = cursor->end;
  int64_t end = cs_cursor_section(cursor, cs_cursor_32(cursor), "a layer's record");
  cursor->end = end;
  read_mask(cursor, out);
  read_ranges(cursor, out);
  read_name(cursor, out);
  read_tags(cursor, is_large, out);
  cursor->end = outer;
  if (cursor->status == CELSPAN_OK)
    cursor->at = end;
}

static void read_channels(cs_cursor *cursor, bool is_large, cs_psd_record *out) {
  unsigned count = cs_cursor_16(cursor);
  if (count > CS_PSD_MOST_CHANNELS) {
    cs_cursor_fail(cursor, CELSPAN_INPUT, "a layer has more than 56 channels");
    return;
  }
  out->channel_count = (int)count;
  for (unsigned i = 0; i < count; i++) {
    out->ids[i] = (int16_t)cs_cursor_16(cursor);
    out->sizes[i] = is_large ? cs_cursor_64(cursor) : cs_cursor_32(cursor);
  }
}

void cs_psd_record_read(cs_cursor *cursor, bool is_large, cs_psd_record *out) {
  enum { HIDDEN = 2 };
  char signature[4];
  *out = (cs_psd_record){.fill = 255};
  out->top = (int32_t)cs_cursor_32(cursor);
  out->left = (int32_t)cs_cursor_32(cursor);
  out->bottom = (int32_t)cs_cursor_32(cursor);
  out->right = (int32_t)cs_cursor_32(cursor);
  read_channels(cursor, is_large, out);
  cs_cursor_bytes(cursor, signature, sizeof signature);
  if (cursor->status == CELSPAN_OK && memcmp(signature, "8BIM", 4) != 0)
    cs_cursor_fail(cursor, CELSPAN_INPUT, "the record of a layer is damaged");
  cs_cursor_bytes(cursor, out->blend, 4);
  out->opacity = cs_cursor_8(cursor);
  out->is_clipped = cs_cursor_8(cursor) != 0;
  out->is_hidden = cs_cursor_8(cursor) & HIDDEN;
  cs_cursor_skip(cursor, 1);
  read_extra(cursor, is_large, out);
}
