/* Bytes of a file to a plane in memory.
 *
 *   head of a nest --> its outer plane: all offsets below are in that
 *   trailer --> index --> bands at the heights that are wanted --> plane
 *        \--> frames --^  \--> index of the base --> its bands --^
 *
 * INVARIANT: nothing in the file is trusted. Every number is checked before it is used, and memory
 * is allocated only for bytes that the file has.
 *
 * One file, because every step reads records of the one reader, and says what is wrong in them.
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "plane.h"

typedef struct reader {
  const planefile_source *source;
  planefile_fault *fault; /* may be NULL */
  planefile_plane *plane;
  planefile_plane *before; /* a frame of the same file, whose bands may be taken; NULL: none */
  uint64_t start, size;    /* the bytes of the plane in the file */
  uint64_t end;            /* offset of the trailer */
  uint64_t left;           /* bytes that the records that are still to be read may have */
  bool is_film, keeps;     /* keeps: what bands are made from */
  pf_codes codes;
  bool is_pictured;     /* the latest index has a list of pictures */
  uint64_t *offsets;    /* the offsets of the bands, and after them where the last one ends */
  uint64_t *bases;      /* the bases of the bands of the base; NULL: there is none */
  uint64_t *pictures;   /* of those of the file */
  unsigned char *bytes; /* the bytes of the latest record */
  size_t capacity;
} reader;

/* subject: what the reason is of, and ": ", or nothing. */
static planefile_status fail_of(reader *r, planefile_status status, uint64_t offset,
                                const char *subject, const char *reason) {
  if (r->fault) {
    r->fault->offset = r->start + offset;
    snprintf(r->fault->reason, sizeof r->fault->reason, "%s%s", subject, reason);
  }
  return status;
}

static planefile_status fail(reader *r, planefile_status status, uint64_t offset,
                             const char *reason) {
  return fail_of(r, status, offset, "", reason);
}

static planefile_status refuse(reader *r, uint64_t offset, const char *reason) {
  return fail(r, PLANEFILE_BAD_FILE, offset, reason);
}

#define TRY(call)                                                                                  \
  do {                                                                                             \
    planefile_status try_status = (call);                                                          \
    if (try_status != PLANEFILE_OK)                                                                \
      return try_status;                                                                           \
  } while (0)

/* The reason ends with a number. */
static planefile_status refuse_number(reader *r, planefile_status status, uint64_t offset,
                                      const char *reason, uint32_t number) {
  char text[16];
  snprintf(text, sizeof text, " %" PRIu32, number);
  return fail_of(r, status, offset, reason, text);
}

static planefile_status fail_memory(reader *r, uint64_t offset) {
  return fail(r, PLANEFILE_NO_MEMORY, offset, "no memory");
}

static planefile_status load(reader *r, uint64_t offset, void *bytes, size_t size) {
  if (r->source->read(r->source->user, r->start + offset, bytes, size))
    return PLANEFILE_OK;
  return fail(r, PLANEFILE_READ_FAILED, offset, "cannot read");
}

/* ---------------------------------------------------------------- the ends of the file */

bool planefile_is(const void *bytes, size_t size) {
  return size >= sizeof pf_magic && (memcmp(bytes, pf_magic, sizeof pf_magic) == 0 ||
                                     memcmp(bytes, pf_nest_magic, sizeof pf_magic) == 0);
}

/* If the file is a nest, its outer plane is what is read. */
static planefile_status enter_nest(reader *r) {
  size_t size;
  unsigned char start[PF_NEST_BYTES];
  const pf_memory *memory = &r->plane->memory;
  planefile_info *info = &r->plane->info;
  TRY(load(r, 0, start, sizeof start));
  if (memcmp(start, pf_nest_magic, sizeof pf_nest_magic) != 0)
    return PLANEFILE_OK;
  const char *reason = pf_nest_begin(start, r->size, &size);
  if (reason)
    return refuse(r, 0, reason);
  uint32_t planes = pf_load_32(start + 12);
  r->bytes = pf_grow(memory, NULL, 1, &r->capacity, size);
  r->plane->inner = pf_make(memory, sizeof *r->plane->inner, planes);
  info->inner_count = planes - 1;
  info->window_count = pf_load_32(start + 16);
  if (!r->bytes || !r->plane->inner)
    return fail_memory(r, 0);
  TRY(load(r, 0, r->bytes, size));
  reason = pf_nest_check(r->bytes, size, r->size, r->plane->inner);
  if (reason)
    return refuse(r, 0, reason);
  r->start = size;
  r->size = r->plane->inner[0] - size;
  return PLANEFILE_OK;
}

static planefile_status refuse_short(reader *r) {
  if (r->size < PF_HEADER_BYTES + PF_TRAILER_BYTES)
    return refuse(r, 0, "the file is too short for a plane file");
  return PLANEFILE_OK;
}

/* Whether flags are those of a plane: only cells that may vary show pictures. */
static bool are_flags(uint32_t flags) {
  return (flags & ~(uint32_t)(PF_OPAQUE | PF_VARIES | PF_CODED | PF_PICTURED)) == 0 &&
         (flags & (PF_VARIES | PF_PICTURED)) != PF_PICTURED;
}

static planefile_status load_header(reader *r) {
  unsigned char header[PF_HEADER_BYTES];
  planefile_info *info = &r->plane->info;
  TRY(refuse_short(r));
  TRY(enter_nest(r));
  TRY(refuse_short(r));
  TRY(load(r, 0, header, sizeof header));
  if (memcmp(header, pf_magic, sizeof pf_magic) != 0)
    return refuse(r, 0, "this is not a plane file");
  if (pf_load_32(header + 36) != pf_crc32c(0, header, 36))
    return refuse(r, 0, "the checksum of the header is wrong");
  if (pf_load_32(header + 8) != PF_VERSION)
    return refuse_number(r, PLANEFILE_BAD_FILE, 8,
                         "the plane file has another version:", pf_load_32(header + 8));
  uint32_t flags = pf_load_32(header + 12);
  info->is_opaque = flags & PF_OPAQUE;
  info->varies = flags & PF_VARIES;
  info->is_coded = flags & PF_CODED;
  r->is_film = flags == PF_FILM;
  r->is_pictured = flags & PF_PICTURED;
  info->grid = (planefile_grid){(uint16_t)pf_load_32(header + 32),
                                (uint16_t)(pf_load_32(header + 32) >> 16)};
  info->width = pf_load_double(header + 16);
  info->height = pf_load_double(header + 24);
  if (!(info->width > 0 && info->height > 0 && isfinite(info->width) && isfinite(info->height)) ||
      (!r->is_film && !are_flags(flags)))
    return refuse(r, 12, "the header has a value that is not allowed");
  return PLANEFILE_OK;
}

/* *last: the offset of the last record, which is the index, or the frames of a film. */
static planefile_status load_trailer(reader *r, uint64_t *last) {
  unsigned char trailer[PF_TRAILER_BYTES];
  r->end = r->size - PF_TRAILER_BYTES;
  TRY(load(r, r->end, trailer, sizeof trailer));
  if (memcmp(trailer, pf_end_magic, sizeof pf_end_magic) != 0 ||
      pf_load_64(trailer + 16) != r->size)
    return refuse(r, r->end, "the file does not end where it should");
  if (pf_load_32(trailer + 28) != pf_crc32c(0, trailer, 28) || pf_load_32(trailer + 24) != 0)
    return refuse(r, r->end, "the checksum of the trailer is wrong");
  *last = pf_load_64(trailer + 8);
  r->left = r->end;
  return PLANEFILE_OK;
}

/* ---------------------------------------------------------------- records */

/* The subject of a message. */
typedef struct subject_text {
  char text[28];
} subject_text;
static subject_text subject(unsigned char kind, uint32_t band) {
  subject_text out = {"the index: "};
  if (kind == PF_BAND)
    snprintf(out.text, sizeof out.text, "band %" PRIu32 ": ", band);
  else if (kind == PF_PICTURE)
    snprintf(out.text, sizeof out.text, "picture %" PRIu32 ": ", band);
  else if (kind == PF_FRAMES)
    snprintf(out.text, sizeof out.text, "the list of frames: ");
  return out;
}

/* The payload of the record of a kind at an offset; *size: its own. end: where the record ends; 0:
 * wherever it says. Valid until the next call. No byte of a file is worth two of what is read: a
 * file whose records are in each other would take longer to read than it is long. */
static planefile_status load_record(reader *r, unsigned char kind, uint32_t band, uint64_t offset,
                                    uint64_t end, size_t *size) {
  unsigned char head[PF_HEAD_BYTES];
  subject_text name = subject(kind, band);
  if (offset < PF_HEADER_BYTES || offset > r->end ||
      r->end - offset < PF_HEAD_BYTES + PF_CHECK_BYTES)
    return fail_of(r, PLANEFILE_BAD_FILE, r->end, name.text, "its record is outside the file");
  TRY(load(r, offset, head, sizeof head));
  uint64_t whole = PF_HEAD_BYTES + (uint64_t)pf_load_32(head + 1) + PF_CHECK_BYTES;
  if (head[0] != kind)
    return fail_of(r, PLANEFILE_BAD_FILE, offset, name.text, "there is another record");
  if ((end > 0 && whole != end - offset) || whole > r->end - offset || whole > SIZE_MAX / 4)
    return fail_of(r, PLANEFILE_BAD_FILE, offset, name.text, "its record has another length");
  if (whole > r->left)
    return fail_of(r, PLANEFILE_BAD_FILE, offset, name.text, "its record is a part of another");
  r->left -= whole;
  unsigned char *bytes = pf_grow(&r->plane->memory, r->bytes, 1, &r->capacity, (size_t)whole);
  if (!bytes)
    return fail_memory(r, offset);
  r->bytes = bytes;
  TRY(load(r, offset, bytes, (size_t)whole));
  if (pf_load_32(bytes + whole - PF_CHECK_BYTES) !=
      pf_crc32c_record(offset, bytes, (size_t)whole - PF_CHECK_BYTES))
    return fail_of(r, PLANEFILE_BAD_FILE, offset, name.text, "the checksum is wrong");
  *size = (size_t)whole - PF_HEAD_BYTES - PF_CHECK_BYTES;
  return PLANEFILE_OK;
}

/* ---------------------------------------------------------------- films */

/* *index: the offset of that of a frame. */
static planefile_status load_frames(reader *r, uint32_t frame, uint64_t offset, uint64_t *index) {
  size_t size;
  planefile_info *info = &r->plane->info;
  TRY(load_record(r, PF_FRAMES, 0, offset, r->end, &size));
  const unsigned char *payload = r->bytes + PF_HEAD_BYTES;
  if (size < PF_RATE_BYTES + PF_FRAME_BYTES || (size - PF_RATE_BYTES) % PF_FRAME_BYTES != 0)
    return refuse(r, offset, "the list of frames: it has no whole number of them");
  info->frame_count = (uint32_t)((size - PF_RATE_BYTES) / PF_FRAME_BYTES);
  info->frames_second = pf_load_double(payload);
  if (!(info->frames_second > 0 && isfinite(info->frames_second)))
    return refuse(r, offset, "the list of frames: there is no such rate");
  if (frame < info->frame_count)
    *index = pf_load_64(payload + PF_RATE_BYTES + PF_FRAME_BYTES * (size_t)frame);
  return PLANEFILE_OK;
}

/* The flags of a frame of a film, before its entries. */
static planefile_status load_flags(reader *r, uint64_t offset, size_t size) {
  planefile_info *info = &r->plane->info;
  uint32_t flags = size < PF_FLAG_BYTES ? UINT32_MAX : pf_load_32(r->bytes + PF_HEAD_BYTES);
  if (!are_flags(flags))
    return refuse(r, offset, "the index: it has a value that is not allowed");
  info->is_opaque = flags & PF_OPAQUE;
  info->varies = flags & PF_VARIES;
  info->is_coded = flags & PF_CODED;
  r->is_pictured = flags & PF_PICTURED;
  return PLANEFILE_OK;
}

/* ---------------------------------------------------------------- bands */

/* The offset of the index of a frame's base, or 0. */
static uint64_t load_base_offset(const reader *r) {
  return r->is_film ? pf_load_64(r->bytes + PF_HEAD_BYTES + 4) : 0;
}

/* The place of a band in the frame, from entry i of the index on. */
static planefile_status load_entry(reader *r, uint64_t offset, const unsigned char *entry,
                                   uint32_t i) {
  planefile_band *band = &r->plane->bands[i].band;
  uint32_t top = pf_load_32(entry), foot = PLANEFILE_SIDE;
  if (i + 1 < r->plane->info.band_count)
    foot = pf_load_32(entry + PF_ENTRY_BYTES);
  if ((i == 0 && top != 0) || top >= foot || foot > PLANEFILE_SIDE)
    return refuse(r, offset, "the index: the heights do not follow each other");
  band->top = (int32_t)top;
  band->foot = (int32_t)foot;
  return PLANEFILE_OK;
}

/* An index that has been read. */
typedef struct index_parts {
  const unsigned char *pictures, *entries;
  uint32_t picture_count, entry_count;
} index_parts;

static planefile_status find_parts(reader *r, uint64_t offset, size_t size, index_parts *out) {
  size_t head = r->is_film ? PF_FLAG_BYTES : 0;
  *out = (index_parts){0};
  if (r->is_film)
    TRY(load_flags(r, offset, size));
  if (r->is_pictured && size - head >= PF_LIST_BYTES) {
    out->picture_count = pf_load_32(r->bytes + PF_HEAD_BYTES + head);
    head += PF_LIST_BYTES;
    if (out->picture_count > (size - head) / PF_OFFSET_BYTES)
      return refuse(r, offset, "the index: it has less pictures than it claims");
    out->pictures = r->bytes + PF_HEAD_BYTES + head;
    head += (size_t)PF_OFFSET_BYTES * out->picture_count;
  }
  out->entries = r->bytes + PF_HEAD_BYTES + head;
  out->entry_count = (uint32_t)((size - head) / PF_ENTRY_BYTES);
  if (out->entry_count == 0 || (size - head) % PF_ENTRY_BYTES != 0)
    return refuse(r, offset, "the index: it has no whole number of entries");
  return PLANEFILE_OK;
}

/* The offsets of the bands of a base, which lie at the heights of the frame's. */
static planefile_status load_base(reader *r, uint64_t offset) {
  size_t size;
  index_parts parts;
  planefile_plane *plane = r->plane;
  const planefile_info info = plane->info;
  TRY(load_record(r, PF_INDEX, 0, offset, 0, &size));
  TRY(find_parts(r, offset, size, &parts));
  bool is_good = parts.entry_count == info.band_count && plane->info.varies == info.varies &&
                 plane->info.is_coded == info.is_coded && load_base_offset(r) == 0;
  plane->info = info;
  r->bases = pf_make(&plane->memory, sizeof *r->bases, info.band_count);
  if (!r->bases)
    return fail_memory(r, offset);
  const unsigned char *entry = parts.entries;
  for (uint32_t i = 0; is_good && i < parts.entry_count; i++, entry += PF_ENTRY_BYTES) {
    is_good = pf_load_32(entry) == (uint32_t)plane->bands[i].band.top;
    r->bases[i] = pf_load_64(entry + 4);
  }
  return is_good ? PLANEFILE_OK : refuse(r, offset, "the index: it is no base of the frame's");
}

/* Room for the pictures of the file, which are read when it is known which are shown. */
static planefile_status load_pictures(reader *r, uint64_t offset, const index_parts *parts) {
  planefile_plane *plane = r->plane;
  uint32_t count = parts->picture_count;
  plane->info.picture_count = count;
  plane->pictures = pf_make(&plane->memory, sizeof *plane->pictures, count);
  r->pictures = pf_make(&plane->memory, sizeof *r->pictures, count);
  if (!plane->pictures || !r->pictures)
    return fail_memory(r, offset);
  for (uint32_t i = 0; i < count; i++)
    r->pictures[i] = pf_load_64(parts->pictures + (size_t)PF_OFFSET_BYTES * i);
  return PLANEFILE_OK;
}

static planefile_status load_index(reader *r, uint64_t offset) {
  size_t size;
  index_parts parts;
  TRY(load_record(r, PF_INDEX, 0, offset, r->is_film ? 0 : r->end, &size));
  TRY(find_parts(r, offset, size, &parts));
  if (r->is_pictured)
    TRY(load_pictures(r, offset, &parts));
  uint32_t count = parts.entry_count;
  planefile_plane *plane = r->plane;
  uint64_t base = load_base_offset(r);
  plane->bands = pf_make(&plane->memory, sizeof *plane->bands, count);
  r->offsets = pf_make(&plane->memory, sizeof *r->offsets, (size_t)count + 1);
  plane->info.band_count = count;
  if (r->keeps)
    plane->kept = pf_make(&plane->memory, sizeof *plane->kept, count);
  if (!plane->bands || !r->offsets || (r->keeps && !plane->kept))
    return fail_memory(r, offset);
  const unsigned char *entry = parts.entries;
  for (uint32_t i = 0; i < count; i++, entry += PF_ENTRY_BYTES) {
    TRY(load_entry(r, offset, entry, i));
    r->offsets[i] = pf_load_64(entry + 4);
  }
  r->offsets[count] = offset;
  return base > 0 ? load_base(r, base) : PLANEFILE_OK;
}

/* Whether cell 0 is that of the bands before, if there are any. */
static bool has_base(planefile_plane *plane, const planefile_band *band) {
  if (!plane->has_base)
    plane->base = band->cells[0];
  plane->has_base = true;
  return memcmp(&plane->base, &band->cells[0], sizeof plane->base) == 0;
}

static planefile_status decode_band(reader *r, uint32_t index, uint64_t offset, size_t size,
                                    const pf_base *base, pf_learned *learned, pf_band *out) {
  const char *reason;
  const planefile_info *info = &r->plane->info;
  const pf_payload payload = {.bytes = r->bytes + PF_HEAD_BYTES,
                              .size = size,
                              .varies = info->varies,
                              .codes = info->is_coded ? &r->codes : NULL,
                              .picture_count = info->picture_count,
                              .base = base,
                              .grid = info->grid,
                              .learned = learned};
  int32_t top = r->plane->bands[index].band.top, foot = r->plane->bands[index].band.foot;
  planefile_status status = pf_band_decode(&r->plane->memory, &payload, out, &reason);
  if (status != PLANEFILE_OK)
    return fail_of(r, status, offset, subject(PF_BAND, index).text, reason);
  if (out->band.top != top || out->band.foot != foot)
    return fail_of(r, PLANEFILE_BAD_FILE, offset, subject(PF_BAND, index).text,
                   "it has other heights");
  return PLANEFILE_OK;
}

/* ---------------------------------------------------------------- bands of the base */

static void free_kept(const pf_memory *memory, pf_kept *kept) {
  pf_base_free(&kept->base);
  pf_band_free(memory, &kept->band);
}

/* What the frame before was made from at the same place. */
static bool take_kept(reader *r, uint32_t index, pf_kept *out) {
  planefile_plane *before = r->before;
  const planefile_band *band = &r->plane->bands[index].band;
  if (!before || index >= before->info.band_count ||
      before->info.picture_count != r->plane->info.picture_count)
    return false;
  pf_kept *kept = &before->kept[index];
  if (kept->offset == 0 || kept->offset != r->bases[index] || kept->band.band.top != band->top ||
      kept->band.band.foot != band->foot)
    return false;
  *out = *kept;
  *kept = (pf_kept){0};
  out->base.band = &out->band.band;
  return true;
}

static planefile_status load_from(reader *r, uint32_t index, pf_kept *out) {
  size_t size;
  uint64_t offset = r->bases[index];
  if (take_kept(r, index, out))
    return PLANEFILE_OK;
  TRY(load_record(r, PF_BAND, index, offset, 0, &size));
  if (!pf_base_begin(&r->plane->memory, &out->base))
    return fail_memory(r, offset);
  TRY(decode_band(r, index, offset, size, NULL, out->base.learned, &out->band));
  if (!pf_base_complete(&out->band.band, size, &out->base))
    return fail_memory(r, offset);
  out->offset = offset;
  return PLANEFILE_OK;
}

/* A band that is made from that of the base. */
static planefile_status load_changed(reader *r, uint32_t index, pf_kept *from) {
  size_t size;
  uint64_t offset = r->offsets[index];
  TRY(load_from(r, index, from));
  TRY(load_record(r, PF_CHANGED, index, offset, 0, &size));
  return decode_band(r, index, offset, size, &from->base, NULL, &r->plane->bands[index]);
}

/* ---------------------------------------------------------------- bands of the frame */

static planefile_status load_kind(reader *r, uint32_t index, unsigned char *kind) {
  uint64_t offset = r->offsets[index];
  *kind = PF_BAND;
  return r->bases && offset < r->end ? load(r, offset, kind, 1) : PLANEFILE_OK;
}

static planefile_status load_either(reader *r, uint32_t index) {
  size_t size;
  unsigned char kind;
  pf_kept from = {0}, *kept = r->plane->kept;
  const uint64_t *offsets = &r->offsets[index];
  TRY(load_kind(r, index, &kind));
  if (kind != PF_CHANGED) {
    TRY(load_record(r, PF_BAND, index, offsets[0], r->is_film ? 0 : offsets[1], &size));
    return decode_band(r, index, offsets[0], size, NULL, NULL, &r->plane->bands[index]);
  }
  if (kept)
    return load_changed(r, index, &kept[index]);
  planefile_status status = load_changed(r, index, &from);
  free_kept(&r->plane->memory, &from);
  return status;
}

static planefile_status load_picture(reader *r, uint32_t index) {
  size_t size;
  uint64_t offset = r->pictures[index];
  planefile_plane *plane = r->plane;
  TRY(load_record(r, PF_PICTURE, index, offset, 0, &size));
  const pf_picture_code code = {r->bytes + PF_HEAD_BYTES, size};
  const char *reason =
      pf_picture_decode(r->source, &plane->memory, &plane->curve, code, &plane->pictures[index]);
  if (reason)
    return fail_of(r, reason == pf_no_memory ? PLANEFILE_NO_MEMORY : PLANEFILE_BAD_FILE, offset,
                   subject(PF_PICTURE, index).text, reason);
  return PLANEFILE_OK;
}

/* The pictures that a band shows, unless they have been read. */
static planefile_status load_shown(reader *r, const planefile_band *band) {
  for (uint32_t i = 0; i < band->axis_count; i++) {
    const planefile_axis *axis = &band->axes[i];
    if (axis->kind == PLANEFILE_PICTURE && axis->picture < band->picture_count &&
        !r->plane->pictures[axis->picture].texels)
      TRY(load_picture(r, axis->picture));
  }
  return PLANEFILE_OK;
}

static planefile_status load_band(reader *r, uint32_t index) {
  uint64_t offset = r->offsets[index];
  const planefile_band *band = &r->plane->bands[index].band;
  TRY(load_either(r, index));
  TRY(load_shown(r, band));
  if (r->plane->info.is_opaque && !pf_band_is_opaque(band))
    return fail_of(r, PLANEFILE_BAD_FILE, offset, subject(PF_BAND, index).text, "it is not opaque");
  if (!has_base(r->plane, band))
    return fail_of(r, PLANEFILE_BAD_FILE, offset, subject(PF_BAND, index).text,
                   "it has another cell 0");
  return PLANEFILE_OK;
}

/* Each band of a single plane ends where the next one begins. */
static planefile_status load_bands(reader *r, int32_t top, int32_t foot) {
  for (uint32_t i = 0; i < r->plane->info.band_count; i++) {
    const planefile_band *band = &r->plane->bands[i].band;
    if (band->top < foot && band->foot > top)
      TRY(load_band(r, i));
  }
  return PLANEFILE_OK;
}

static planefile_status load_plane(reader *r, uint32_t frame, int32_t top, int32_t foot) {
  uint64_t last = 0;
  r->plane->info.frame_count = 1;
  TRY(load_header(r));
  TRY(load_trailer(r, &last));
  uint64_t index = last;
  if (r->is_film)
    TRY(load_frames(r, frame, last, &index));
  if (frame >= r->plane->info.frame_count)
    return refuse_number(r, PLANEFILE_BAD_ARGUMENT, r->end, "it has no frame", frame);
  TRY(load_index(r, index));
  if (r->plane->info.varies)
    pf_light_curve_make(&r->plane->curve);
  return load_bands(r, top, foot);
}

static void forget(reader *r) {
  const pf_memory *memory = &r->plane->memory;
  size_t count = r->plane->info.band_count;
  pf_free(memory, r->offsets, sizeof *r->offsets, count + 1);
  pf_free(memory, r->bases, sizeof *r->bases, count);
  pf_free(memory, r->pictures, sizeof *r->pictures, r->plane->info.picture_count);
  pf_free(memory, r->bytes, 1, r->capacity);
}

/* ---------------------------------------------------------------- the plane */

static planefile_status read_frame(reader *r, uint32_t frame, int32_t top, int32_t foot,
                                   planefile_plane **out) {
  pf_memory memory = pf_memory_of(r->source->resize, r->source->resize_user);
  *out = NULL;
  r->size = r->source->size;
  if (top < 0 || top >= foot || foot > PLANEFILE_SIDE)
    return fail(r, PLANEFILE_BAD_ARGUMENT, 0, "there are no such heights");
  r->plane = pf_make(&memory, sizeof *r->plane, 1);
  if (!r->plane)
    return fail_memory(r, 0);
  r->plane->memory = memory;
  pf_codes_make(&r->codes);
  planefile_status status = load_plane(r, frame, top, foot);
  forget(r);
  if (status != PLANEFILE_OK) {
    planefile_plane_destroy(r->plane);
    return status;
  }
  pf_pixels_make(&r->codes, r->plane->codes);
  *out = r->plane;
  return PLANEFILE_OK;
}

planefile_status planefile_read_frame(const planefile_source *source, uint32_t frame, int32_t top,
                                      int32_t foot, planefile_plane **out, planefile_fault *fault) {
  reader r = {.source = source, .fault = fault};
  return read_frame(&r, frame, top, foot, out);
}

/* Leaves what the next frame may be made from. */
static void free_drawn(planefile_plane *plane) {
  pf_memory *memory = &plane->memory;
  for (uint32_t i = 0; plane->bands && i < plane->info.band_count; i++)
    pf_band_free(memory, &plane->bands[i]);
  pf_free(memory, plane->bands, sizeof *plane->bands, plane->info.band_count);
  for (uint32_t i = 0; plane->pictures && i < plane->info.picture_count; i++)
    pf_picture_free(memory, &plane->pictures[i]);
  pf_free(memory, plane->pictures, sizeof *plane->pictures, plane->info.picture_count);
  plane->bands = NULL;
  plane->pictures = NULL;
}

planefile_status planefile_read_next(const planefile_source *source, uint32_t frame,
                                     planefile_plane **plane, planefile_fault *fault) {
  planefile_plane *before = *plane;
  reader r = {.source = source, .fault = fault, .keeps = true};
  if (before && before->kept)
    r.before = before;
  if (before)
    free_drawn(before);
  planefile_status status = read_frame(&r, frame, 0, PLANEFILE_SIDE, plane);
  planefile_plane_destroy(before);
  return status;
}

planefile_status planefile_read(const planefile_source *source, int32_t top, int32_t foot,
                                planefile_plane **out, planefile_fault *fault) {
  return planefile_read_frame(source, 0, top, foot, out, fault);
}

void planefile_plane_destroy(planefile_plane *plane) {
  if (!plane)
    return;
  pf_memory memory = plane->memory;
  free_drawn(plane);
  for (uint32_t i = 0; plane->kept && i < plane->info.band_count; i++)
    free_kept(&memory, &plane->kept[i]);
  pf_free(&memory, plane->kept, sizeof *plane->kept, plane->info.band_count);
  pf_free(&memory, plane->inner, sizeof *plane->inner, (size_t)plane->info.inner_count + 1);
  pf_free(&memory, plane, sizeof *plane, 1);
}

void planefile_plane_inner(const planefile_plane *plane, uint32_t index, uint64_t *offset,
                           uint64_t *size) {
  *offset = plane->inner[index];
  *size = plane->inner[index + 1] - *offset;
}

planefile_info planefile_plane_info(const planefile_plane *plane) { return plane->info; }

const planefile_band *planefile_plane_band(const planefile_plane *plane, uint32_t index) {
  return &plane->bands[index].band;
}
