/* Planes to a file: checked, cut into bands, and written record by record. A record of a film that
 * is there already, of an earlier frame, is not written again: frames that are equal have one
 * index, and bands that are equal are one.
 *
 *   key frame:    its bands | index
 *   other frame:  bands by how they differ from the key's, or by themselves | index
 *
 * Frames have less and less in common with the key. When what this has cost since the key, beyond
 * what the first frame after it took, is three times as much as a frame that has no base, the next
 * key is due. Where a new key does not help, because the film has more in it than before, fewer
 * keys are better; where the cost grows by the same amount in each frame, keys at the best places
 * would take a seventh less.
 *
 * One file, because nearly every function changes the one writer.
 */
#include <math.h>

#include "band.h"
#include "written.h"

/* A band ends after this many beginnings of borders, or more where many cross its end: each of
 * those is in the next one, too. */
enum { BAND_BORDERS = 4096, BORDERS_A_LIVE = 8 };

typedef struct entry {
  int32_t top;
  uint64_t offset;
} entry;

/* A band of the key frame. */
typedef struct key_band {
  entry at;
  pf_band band; /* as it is read */
  pf_base base;
} key_band;

/* A band that may be written. */
typedef struct draft {
  unsigned char kind;
  pf_encoder code;
} draft;

struct planefile_writer {
  planefile_writer_desc desc;
  pf_memory memory;
  pf_codes codes;    /* where cells are codes */
  uint64_t offset;   /* in the file */
  pf_written *known; /* the records of a film; NULL: a single plane */
  uint64_t *frames;  /* the offsets of their indices */
  size_t frame_count, frame_capacity;
  uint64_t index;             /* the offset of the latest index */
  pf_written *shown_pictures; /* their numbers in the file, plus 1, by their keys; NULL: none */
  uint64_t *pictures;         /* their offsets */
  size_t picture_count, picture_capacity;

  /* the key frame of a film; no bands: there is none yet */
  key_band *key;
  size_t key_count, key_capacity;
  uint64_t key_index;
  uint32_t key_flags;
  size_t first, excess; /* bytes: of the first frame made from it, and of the others beyond that */

  /* of the current frame */
  const planefile_band *plane;
  uint32_t flags;
  bool has_base;             /* it is made from the key */
  draft *drafts;             /* the drafts of its bands */
  planefile_border *borders; /* by their tops */
  planefile_border *shown;   /* those of the current band */
  entry *entries;
  size_t shown_count, shown_capacity, entry_count, entry_capacity;
};
typedef planefile_writer writer;

static bool is_film(const writer *w) { return w->desc.frames_second > 0; }
/* NULL: cells are not codes. */
static const pf_codes *codes_of(const writer *w) { return w->desc.is_coded ? &w->codes : NULL; }

/* ---------------------------------------------------------------- checks */

static bool is_far(planefile_point at) {
  return at.x < -PLANEFILE_FAR || at.x > PLANEFILE_FAR || at.y < -PLANEFILE_FAR ||
         at.y > PLANEFILE_FAR;
}

/* Whether a coordinate is not on the grid. */
static bool is_between(int32_t at, uint16_t count) {
  return planefile_place_of(planefile_step_at(at, count), count) != at;
}

static bool is_piece(const planefile_band *plane, uint32_t index, planefile_grid grid) {
  const planefile_piece *piece = &plane->pieces[index];
  if (piece->degree < (piece->is_rational ? 2 : 1) || piece->degree > 3 ||
      piece->point > plane->point_count || plane->point_count - piece->point <= piece->degree)
    return false;
  const planefile_point *points = &plane->points[piece->point];
  for (int i = 0; i <= piece->degree; i++)
    if (is_far(points[i]) || is_between(points[i].x, grid.columns) ||
        is_between(points[i].y, grid.rows) ||
        (piece->is_rational &&
         (points[i].w < PLANEFILE_WEIGHT / 16 || points[i].w / 16 >= (uint32_t)PLANEFILE_WEIGHT)))
      return false;
  return points[piece->degree].y >= points[0].y;
}

static bool is_chain(const planefile_band *plane, const planefile_chain *chain,
                     planefile_grid grid) {
  if (chain->piece_count == 0 || chain->piece > plane->piece_count ||
      chain->piece_count > plane->piece_count - chain->piece)
    return false;
  for (uint32_t i = chain->piece; i < chain->piece + chain->piece_count; i++) {
    const planefile_piece *piece = &plane->pieces[i], *before = piece - 1;
    if (!is_piece(plane, i, grid))
      return false;
    if (i > chain->piece) {
      const planefile_point *end = &plane->points[before->point + before->degree];
      const planefile_point *start = &plane->points[piece->point];
      if (end->x != start->x || end->y != start->y)
        return false;
    }
  }
  return true;
}

static bool is_border(const planefile_band *plane, const planefile_border *border,
                      planefile_grid grid) {
  if (border->chain >= plane->chain_count || border->left >= plane->cell_count ||
      border->right >= plane->cell_count || border->left == border->right)
    return false;
  const planefile_chain *chain = &plane->chains[border->chain];
  const planefile_piece *last = &plane->pieces[chain->piece + chain->piece_count - 1];
  return !is_between(border->top, grid.rows) && !is_between(border->foot, grid.rows) &&
         border->top >= 0 && border->top < border->foot && border->foot <= PLANEFILE_SIDE &&
         border->top >= plane->points[plane->pieces[chain->piece].point].y &&
         border->foot <= plane->points[last->point + last->degree].y;
}

static bool is_cell(const planefile_cell *cell) {
  for (int c = 0; c < 4; c++)
    if (cell->colour[c] < -PLANEFILE_BRIGHT || cell->colour[c] > PLANEFILE_BRIGHT)
      return false;
  return true;
}

/* A cell that varies has no colour of its own, and cell 0 does not vary. */
static bool is_program(const planefile_band *plane, uint32_t cell) {
  static const planefile_cell none;
  const planefile_program *program = &plane->programs[cell];
  return program->step_count == 0 ||
         (cell > 0 && memcmp(&plane->cells[cell], &none, sizeof none) == 0 &&
          pf_program_is_good(plane, *program));
}

/* Whether those that are shown are good. */
static bool are_pictures(const planefile_band *plane) {
  bool is_good = true;
  for (uint32_t i = 0; i < plane->axis_count && is_good; i++) {
    const planefile_axis *axis = &plane->axes[i];
    is_good = axis->kind != PLANEFILE_PICTURE || axis->picture >= plane->picture_count ||
              (plane->pictures && pf_picture_is_good(&plane->pictures[axis->picture]));
  }
  return is_good;
}

static bool is_plane(const planefile_band *plane, planefile_grid grid) {
  bool is_good = plane->top == 0 && plane->foot == PLANEFILE_SIDE && plane->cell_count > 0;
  for (uint32_t i = 0; is_good && i < plane->chain_count; i++)
    is_good = is_chain(plane, &plane->chains[i], grid);
  for (uint32_t i = 0; is_good && i < plane->border_count; i++)
    is_good = is_border(plane, &plane->borders[i], grid);
  for (uint32_t i = 0; is_good && i < plane->cell_count; i++)
    is_good = is_cell(&plane->cells[i]) && (!plane->programs || is_program(plane, i));
  return is_good && are_pictures(plane);
}

/* ---------------------------------------------------------------- order */

static int order_of(int64_t a, int64_t b) { return (a > b) - (a < b); }

static int compare_by_chain(const void *first, const void *second) {
  const planefile_border *a = first, *b = second;
  int by_chain = order_of(a->chain, b->chain);
  return by_chain ? by_chain : order_of(a->top, b->top);
}

static int compare_by_top(const void *first, const void *second) {
  const planefile_border *a = first, *b = second;
  int by_top = order_of(a->top, b->top);
  return by_top ? by_top : order_of(a->chain, b->chain);
}

static planefile_status sort_borders(writer *w) {
  size_t count = w->plane->border_count;
  w->borders = pf_make(&w->memory, sizeof *w->borders, count);
  if (!w->borders)
    return PLANEFILE_NO_MEMORY;
  if (count == 0)
    return PLANEFILE_OK;
  memcpy(w->borders, w->plane->borders, count * sizeof *w->borders);
  qsort(w->borders, count, sizeof *w->borders, compare_by_chain);
  for (size_t i = 1; i < count; i++)
    if (w->borders[i].chain == w->borders[i - 1].chain &&
        w->borders[i].top < w->borders[i - 1].foot)
      return PLANEFILE_BAD_ARGUMENT;
  qsort(w->borders, count, sizeof *w->borders, compare_by_top);
  return PLANEFILE_OK;
}

/* ---------------------------------------------------------------- bytes */

static planefile_status put(writer *w, const void *bytes, size_t size) {
  w->offset += size;
  return w->desc.write(w->desc.user, bytes, size) ? PLANEFILE_OK : PLANEFILE_WRITE_FAILED;
}

static planefile_status put_record(writer *w, unsigned char kind, const unsigned char *payload,
                                   size_t size) {
  unsigned char head[PF_HEAD_BYTES] = {kind}, check[PF_CHECK_BYTES], offset[8];
  if (size > UINT32_MAX)
    return PLANEFILE_BAD_ARGUMENT;
  pf_store_64(offset, w->offset);
  pf_store_32(head + 1, (uint32_t)size);
  uint32_t sum = pf_crc32c(pf_crc32c(0, offset, sizeof offset), head, sizeof head);
  pf_store_32(check, pf_crc32c(sum, payload, size));
  planefile_status status = put(w, head, sizeof head);
  if (status == PLANEFILE_OK)
    status = put(w, payload, size);
  return status == PLANEFILE_OK ? put(w, check, sizeof check) : status;
}

/* Records that are read in different ways differ. */
static pf_print print_of(const writer *w, unsigned char kind, const unsigned char *payload,
                         size_t size) {
  uint64_t flags = (w->flags & PF_VARIES) << 8, base = kind == PF_CHANGED ? w->key_index : 0;
  return pf_print_of(payload, size, kind | flags | base << 16);
}

/* Whether a band is in the film already. */
static bool is_written(const writer *w, unsigned char kind, const pf_encoder *code) {
  return pf_written_has(w->known, print_of(w, kind, code->bytes, code->count));
}

/* A record that a film has once. *offset: where it is. */
static planefile_status put_once(writer *w, unsigned char kind, const unsigned char *payload,
                                 size_t size, uint64_t *offset) {
  pf_print print = print_of(w, kind, payload, size);
  *offset = w->offset;
  if (!w->known)
    return put_record(w, kind, payload, size);
  uint64_t *known = pf_written_find(w->known, print);
  if (!known)
    return PLANEFILE_NO_MEMORY;
  if (*known == 0) {
    *known = w->offset;
    return put_record(w, kind, payload, size);
  }
  *offset = *known;
  return PLANEFILE_OK;
}

static planefile_status put_header(writer *w) {
  unsigned char header[PF_HEADER_BYTES] = {0};
  memcpy(header, pf_magic, sizeof pf_magic);
  pf_store_32(header + 8, PF_VERSION);
  pf_store_32(header + 12, is_film(w) ? PF_FILM : w->flags);
  pf_store_double(header + 16, w->desc.width);
  pf_store_double(header + 24, w->desc.height);
  pf_store_32(header + 32, w->desc.grid.columns | (uint32_t)w->desc.grid.rows << 16);
  pf_store_32(header + 36, pf_crc32c(0, header, 36));
  return put(w, header, sizeof header);
}

/* The list of pictures in an index. */
static size_t list_bytes(const writer *w) {
  return w->flags & PF_PICTURED ? PF_LIST_BYTES + PF_OFFSET_BYTES * w->picture_count : 0;
}

static size_t put_list(const writer *w, unsigned char *at) {
  if (list_bytes(w) > 0)
    pf_store_32(at, (uint32_t)w->picture_count);
  for (size_t i = 0; list_bytes(w) > 0 && i < w->picture_count; i++)
    pf_store_64(at + PF_LIST_BYTES + PF_OFFSET_BYTES * i, w->pictures[i]);
  return list_bytes(w);
}

static planefile_status put_index(writer *w) {
  size_t flags = is_film(w) ? PF_FLAG_BYTES : 0;
  size_t size = flags + list_bytes(w) + w->entry_count * PF_ENTRY_BYTES;
  unsigned char *payload = pf_make(&w->memory, 1, size);
  if (!payload)
    return PLANEFILE_NO_MEMORY;
  unsigned char *at = payload + flags;
  at += put_list(w, at);
  if (flags) {
    pf_store_32(payload, w->flags);
    pf_store_64(payload + 4, w->has_base ? w->key_index : 0);
  }
  for (size_t i = 0; i < w->entry_count; i++, at += PF_ENTRY_BYTES) {
    pf_store_32(at, (uint32_t)w->entries[i].top);
    pf_store_64(at + 4, w->entries[i].offset);
  }
  planefile_status status = put_once(w, PF_INDEX, payload, size, &w->index);
  pf_free(&w->memory, payload, 1, size);
  return status;
}

static planefile_status put_frames(writer *w) {
  size_t size = PF_RATE_BYTES + w->frame_count * PF_FRAME_BYTES;
  unsigned char *payload = pf_make(&w->memory, 1, size);
  if (!payload)
    return PLANEFILE_NO_MEMORY;
  pf_store_double(payload, w->desc.frames_second);
  for (size_t i = 0; i < w->frame_count; i++)
    pf_store_64(payload + PF_RATE_BYTES + i * PF_FRAME_BYTES, w->frames[i]);
  planefile_status status = put_record(w, PF_FRAMES, payload, size);
  pf_free(&w->memory, payload, 1, size);
  return status;
}

static planefile_status put_trailer(writer *w, uint64_t last) {
  unsigned char trailer[PF_TRAILER_BYTES] = {0};
  memcpy(trailer, pf_end_magic, sizeof pf_end_magic);
  pf_store_64(trailer + 8, last);
  pf_store_64(trailer + 16, w->offset + PF_TRAILER_BYTES);
  pf_store_32(trailer + 28, pf_crc32c(0, trailer, 28));
  return put(w, trailer, sizeof trailer);
}

/* ---------------------------------------------------------------- pictures */

static planefile_status put_picture(writer *w, const planefile_picture *picture) {
  uint64_t *pictures = pf_grow(&w->memory, w->pictures, sizeof *pictures, &w->picture_capacity,
                               w->picture_count + 1);
  if (!pictures)
    return PLANEFILE_NO_MEMORY;
  w->pictures = pictures;
  w->pictures[w->picture_count++] = w->offset;
  pf_encoder code;
  planefile_status status = pf_picture_encode(&w->memory, picture, &code);
  if (status == PLANEFILE_OK)
    status = put_record(w, PF_PICTURE, code.bytes, code.count);
  pf_encoder_finish(&code);
  return status;
}

/* *number: of a picture in the file, which is written if it is new. */
static planefile_status find_picture(writer *w, const planefile_picture *picture,
                                     uint32_t *number) {
  const pf_print print = {{picture->key[0], picture->key[1]},
                          (uint64_t)picture->width << 32 | picture->height << 2 | picture->kind};
  if (!w->shown_pictures && !(w->shown_pictures = pf_written_create(&w->memory)))
    return PLANEFILE_NO_MEMORY;
  uint64_t *known = pf_written_find(w->shown_pictures, print);
  if (!known)
    return PLANEFILE_NO_MEMORY;
  if (*known == 0) {
    *known = w->picture_count + 1;
    *number = (uint32_t)w->picture_count;
    return put_picture(w, picture);
  }
  *number = (uint32_t)*known - 1;
  return PLANEFILE_OK;
}

/* Marks the pictures of the programs of cells that are seen. seen: of each cell, false. */
static void mark_pictures(const planefile_band *plane, bool *seen, uint32_t *numbers) {
  for (uint32_t i = 0; i < 2 * plane->border_count; i++) {
    uint32_t cell = i % 2 ? plane->borders[i / 2].right : plane->borders[i / 2].left;
    const planefile_program *program = &plane->programs[cell];
    for (uint32_t k = 0; !seen[cell] && k < program->step_count; k++) {
      const planefile_step *step = &plane->steps[program->step + k];
      const planefile_axis *axis = &plane->axes[step->axis];
      if (step->kind == PLANEFILE_RAMP && axis->kind == PLANEFILE_PICTURE)
        numbers[axis->picture] = 1;
    }
    seen[cell] = true;
  }
}

/* Writes the pictures that are seen and gives axes the numbers that these have in the file. */
static planefile_status number_pictures(writer *w, const planefile_band *plane, uint32_t *numbers,
                                        planefile_axis *axes) {
  planefile_status status = PLANEFILE_OK;
  for (uint32_t i = 0; i < plane->picture_count && status == PLANEFILE_OK; i++)
    if (numbers[i] > 0)
      status = find_picture(w, &plane->pictures[i], &numbers[i]);
  for (uint32_t i = 0; i < plane->axis_count; i++) {
    axes[i] = plane->axes[i];
    if (axes[i].kind == PLANEFILE_PICTURE && axes[i].picture < plane->picture_count)
      axes[i].picture = numbers[axes[i].picture];
  }
  return status;
}

/* axes: room for those of the plane. */
static planefile_status put_pictures(writer *w, const planefile_band *plane, planefile_axis *axes) {
  bool *seen = pf_make(&w->memory, sizeof *seen, plane->cell_count);
  uint32_t *numbers = pf_make(&w->memory, sizeof *numbers, plane->picture_count);
  planefile_status status = PLANEFILE_NO_MEMORY;
  if (seen && numbers) {
    if (plane->programs)
      mark_pictures(plane, seen, numbers);
    status = number_pictures(w, plane, numbers, axes);
  }
  pf_free(&w->memory, numbers, sizeof *numbers, plane->picture_count);
  pf_free(&w->memory, seen, sizeof *seen, plane->cell_count);
  return status;
}

/* ---------------------------------------------------------------- bands */

/* Forgets the borders that end above the band that begins now. */
static void drop_ended(writer *w, int32_t top) {
  size_t kept = 0;
  for (size_t i = 0; i < w->shown_count; i++)
    if (w->shown[i].foot > top)
      w->shown[kept++] = w->shown[i];
  w->shown_count = kept;
}

/* Adds the borders from `next` on that begin in the band from `top` on, until there are enough; all
 * that begin at one height are in one band. Returns where it stopped. */
static size_t add_begun(writer *w, int32_t top, size_t next) {
  size_t count = w->plane->border_count, live = w->shown_count;
  size_t enough = BORDERS_A_LIVE * live;
  enough = enough > BAND_BORDERS ? enough : BAND_BORDERS;
  for (size_t i = next; i < count; i++) {
    const planefile_border *border = &w->borders[i];
    if (i - next >= enough && border->top > w->borders[i - 1].top && border->top > top)
      return i;
    w->shown[w->shown_count++] = *border;
  }
  return count;
}

/* Encodes the borders that are shown. */
static planefile_status encode(writer *w, int32_t top, int32_t foot, const pf_base *base,
                               pf_encoder *out) {
  const pf_part part = {.plane = w->plane,
                        .borders = w->shown,
                        .count = w->shown_count,
                        .top = top,
                        .foot = foot,
                        .is_whole = is_film(w) && !base,
                        .base = base,
                        .codes = codes_of(w),
                        .grid = w->desc.grid};
  if (!pf_is_moderate(w->plane->cells, w->shown, w->shown_count)) {
    *out = (pf_encoder){0};
    return PLANEFILE_BAD_ARGUMENT;
  }
  return pf_band_encode(&w->memory, &part, out);
}

static planefile_status add_entry(writer *w, unsigned char kind, int32_t top,
                                  const pf_encoder *code) {
  entry *entries =
      pf_grow(&w->memory, w->entries, sizeof *entries, &w->entry_capacity, w->entry_count + 1);
  if (!entries)
    return PLANEFILE_NO_MEMORY;
  w->entries = entries;
  uint64_t *offset = &w->entries[w->entry_count].offset;
  w->entries[w->entry_count++].top = top;
  return put_once(w, kind, code->bytes, code->count, offset);
}

/* The latest band that was added becomes one of the key. */
static planefile_status add_key(writer *w, const pf_encoder *code) {
  const char *reason;
  pf_payload payload = {.bytes = code->bytes,
                        .size = code->count,
                        .varies = w->flags & PF_VARIES,
                        .codes = codes_of(w),
                        .grid = w->desc.grid,
                        .picture_count = (uint32_t)w->picture_count};
  key_band *key = pf_grow(&w->memory, w->key, sizeof *key, &w->key_capacity, w->key_count + 1);
  if (!key)
    return PLANEFILE_NO_MEMORY;
  w->key = key;
  key = &w->key[w->key_count++];
  *key = (key_band){.at = w->entries[w->entry_count - 1]};
  if (!pf_base_begin(&w->memory, &key->base))
    return PLANEFILE_NO_MEMORY;
  key->base.code = code->count;
  payload.learned = key->base.learned;
  return pf_band_decode(&w->memory, &payload, &key->band, &reason);
}

static planefile_status put_band(writer *w, int32_t top, int32_t foot) {
  pf_encoder code;
  planefile_status status = encode(w, top, foot, NULL, &code);
  if (status == PLANEFILE_OK)
    status = add_entry(w, PF_BAND, top, &code);
  if (status == PLANEFILE_OK && is_film(w))
    status = add_key(w, &code);
  pf_encoder_finish(&code);
  return status;
}

static planefile_status put_bands(writer *w) {
  planefile_status status = PLANEFILE_OK;
  size_t count = w->plane->border_count, next = 0;
  for (int32_t top = 0, foot; top < PLANEFILE_SIDE && status == PLANEFILE_OK; top = foot) {
    drop_ended(w, top);
    next = add_begun(w, top, next);
    foot = next < count ? w->borders[next].top : PLANEFILE_SIDE;
    status = put_band(w, top, foot);
  }
  return status;
}

/* ---------------------------------------------------------------- keys */

static void forget_key(writer *w) {
  for (size_t i = 0; i < w->key_count; i++) {
    pf_base_free(&w->key[i].base);
    pf_band_free(&w->memory, &w->key[i].band);
  }
  w->key_count = 0;
}

/* What is needed of the key to make other frames from it. */
static planefile_status keep_key(writer *w) {
  w->key_index = w->index;
  w->key_flags = w->flags;
  w->first = SIZE_MAX;
  w->excess = 0;
  for (size_t i = 0; i < w->key_count; i++) {
    key_band *key = &w->key[i];
    if (!pf_base_complete(&key->band.band, key->base.code, &key->base))
      return PLANEFILE_NO_MEMORY;
  }
  return PLANEFILE_OK;
}

/* Frames that have a base know of all its cells, and cell 0 is one of them. */
static bool can_have_base(const writer *w) {
  const planefile_cell *cell = &w->plane->cells[0];
  return w->key_count > 0 && (w->flags & PF_VARIES) == (w->key_flags & PF_VARIES) &&
         (w->flags & PF_OPAQUE) <= (w->key_flags & PF_OPAQUE) &&
         memcmp(cell, &w->key->band.band.cells[0], sizeof *cell) == 0;
}

static int32_t foot_of(const writer *w, size_t band) {
  return band + 1 < w->key_count ? w->key[band + 1].at.top : PLANEFILE_SIDE;
}

/* Shows the borders of the band at the heights of one of the key's. */
static void show_band(writer *w, int32_t top, int32_t foot) {
  w->shown_count = 0;
  for (size_t i = 0; i < w->plane->border_count; i++)
    if (w->borders[i].top < foot && w->borders[i].foot > top)
      w->shown[w->shown_count++] = w->borders[i];
}

/* Makes both forms of a band, of which the smaller one is left; *alone: the size of the one that
 * has no base. One that is in the file already takes nothing. */
static planefile_status make_draft(writer *w, size_t band, size_t *alone) {
  draft *d = &w->drafts[band];
  int32_t top = w->key[band].at.top, foot = foot_of(w, band);
  show_band(w, top, foot);
  d->kind = PF_BAND;
  planefile_status status = encode(w, top, foot, NULL, &d->code);
  *alone = d->code.count;
  if (status != PLANEFILE_OK || is_written(w, PF_BAND, &d->code))
    return status;
  pf_encoder other;
  status = encode(w, top, foot, &w->key[band].base, &other);
  if (status != PLANEFILE_OK || other.count >= d->code.count) {
    pf_encoder_finish(&other);
    return status;
  }
  pf_encoder_finish(&d->code);
  *d = (draft){PF_CHANGED, other};
  return PLANEFILE_OK;
}

/* *is_good: the drafts are worth it. */
static planefile_status make_drafts(writer *w, bool *is_good) {
  size_t all = 0, drafted = 0, alone;
  for (size_t i = 0; i < w->key_count; i++) {
    planefile_status status = make_draft(w, i, &alone);
    if (status != PLANEFILE_OK)
      return status;
    all += alone;
    drafted += is_written(w, w->drafts[i].kind, &w->drafts[i].code) ? 0 : w->drafts[i].code.count;
  }
  w->first = drafted < w->first ? drafted : w->first;
  w->excess += drafted - w->first;
  *is_good = drafted < all && w->excess <= 3 * all;
  return PLANEFILE_OK;
}

/* Writes the frame by what differs from the key, if that is worth it: w->has_base. */
static planefile_status put_changed(writer *w) {
  size_t count = w->key_count;
  w->drafts = pf_make(&w->memory, sizeof *w->drafts, count);
  if (!w->drafts)
    return PLANEFILE_NO_MEMORY;
  planefile_status status = make_drafts(w, &w->has_base);
  for (size_t i = 0; i < count && w->has_base && status == PLANEFILE_OK; i++)
    status = add_entry(w, w->drafts[i].kind, w->key[i].at.top, &w->drafts[i].code);
  for (size_t i = 0; i < count; i++)
    pf_encoder_finish(&w->drafts[i].code);
  pf_free(&w->memory, w->drafts, sizeof *w->drafts, count);
  w->shown_count = 0;
  return status;
}

static planefile_status put_key(writer *w) {
  forget_key(w);
  planefile_status status = put_bands(w);
  if (status == PLANEFILE_OK)
    status = put_index(w);
  return status == PLANEFILE_OK ? keep_key(w) : status;
}

/* ---------------------------------------------------------------- frames */

/* Whether any cell has a program. */
static bool varies(const planefile_band *plane) {
  for (uint32_t i = 0; plane->programs && i < plane->cell_count; i++)
    if (plane->programs[i].step_count > 0)
      return true;
  return false;
}

static planefile_status put_plane(writer *w) {
  size_t count = w->plane->border_count;
  planefile_status status = sort_borders(w);
  w->has_base = false;
  w->shown_capacity = count;
  w->shown = pf_make(&w->memory, sizeof *w->shown, count);
  if (status == PLANEFILE_OK && !w->shown)
    status = PLANEFILE_NO_MEMORY;
  if (status == PLANEFILE_OK && can_have_base(w))
    status = put_changed(w);
  if (status != PLANEFILE_OK)
    return status;
  return w->has_base ? put_index(w) : put_key(w);
}

static void forget_frame(writer *w) {
  pf_free(&w->memory, w->borders, sizeof *w->borders, w->plane->border_count);
  pf_free(&w->memory, w->shown, sizeof *w->shown, w->shown_capacity);
  w->plane = NULL;
  w->borders = w->shown = NULL;
  w->shown_count = w->entry_count = 0;
}

/* The latest index is that of the next frame. */
static planefile_status add_frame(writer *w) {
  uint64_t *frames =
      pf_grow(&w->memory, w->frames, sizeof *frames, &w->frame_capacity, w->frame_count + 1);
  if (!frames)
    return PLANEFILE_NO_MEMORY;
  w->frames = frames;
  w->frames[w->frame_count++] = w->index;
  return PLANEFILE_OK;
}

planefile_status planefile_writer_repeat(planefile_writer *w) {
  return is_film(w) && w->frame_count > 0 ? add_frame(w) : PLANEFILE_BAD_ARGUMENT;
}

/* Copies of the parts of a plane that are changed before it is written. */
typedef struct copies {
  planefile_axis *axes;
  planefile_cell *cells;
  planefile_step *steps;
  planefile_stop *stops;
} copies;

static bool make_copies(const writer *w, const planefile_band *plane, copies *out) {
  *out = (copies){pf_make(&w->memory, sizeof *out->axes, plane->axis_count),
                  pf_make(&w->memory, sizeof *out->cells, plane->cell_count),
                  pf_make(&w->memory, sizeof *out->steps, plane->step_count),
                  pf_make(&w->memory, sizeof *out->stops, plane->stop_count)};
  return out->axes && out->cells && out->steps && out->stops;
}

static void free_copies(const writer *w, const planefile_band *plane, const copies *of) {
  pf_free(&w->memory, of->axes, sizeof *of->axes, plane->axis_count);
  pf_free(&w->memory, of->cells, sizeof *of->cells, plane->cell_count);
  pf_free(&w->memory, of->steps, sizeof *of->steps, plane->step_count);
  pf_free(&w->memory, of->stops, sizeof *of->stops, plane->stop_count);
}

static planefile_cell round_shades(planefile_cell colour) {
  for (int c = 0; c < 4; c++) {
    int32_t half = colour.colour[c] < 0 ? -PLANEFILE_SHADE / 2 : PLANEFILE_SHADE / 2;
    colour.colour[c] = (colour.colour[c] + half) / PLANEFILE_SHADE * PLANEFILE_SHADE;
  }
  return colour;
}

static void memcpy_some(void *to, const void *from, size_t size) {
  if (size > 0)
    memcpy(to, from, size);
}

/* Rounds the colours that a program shows. */
static void round_program(const planefile_band *plane, planefile_program program,
                          const copies *out) {
  for (uint32_t i = program.step; i < program.step + program.step_count; i++) {
    const planefile_step *step = &plane->steps[i];
    if (step->kind == PLANEFILE_FLAT || step->kind == PLANEFILE_LEAVE)
      out->steps[i].colour = round_shades(step->colour);
    for (uint32_t k = 0; step->kind == PLANEFILE_RAMP && k < step->stop_count; k++)
      out->stops[step->stop + k].colour = round_shades(plane->stops[step->stop + k].colour);
  }
}

/* Rounds the cells of a plane to codes, and the colours of its programs to shades. */
static void round_colours(const writer *w, planefile_band *plane, const copies *out) {
  int32_t straight[4];
  for (uint32_t i = 0; i < plane->cell_count; i++) {
    pf_codes_of(&w->codes, &plane->cells[i], straight);
    out->cells[i] = pf_codes_cell(&w->codes, straight);
  }
  memcpy_some(out->steps, plane->steps, plane->step_count * sizeof *out->steps);
  memcpy_some(out->stops, plane->stops, plane->stop_count * sizeof *out->stops);
  for (uint32_t i = 0; i < plane->cell_count && plane->programs; i++)
    round_program(plane, plane->programs[i], out);
  plane->cells = out->cells;
  plane->steps = out->steps;
  plane->stops = out->stops;
}

/* The pictures of a frame, and its bands. axes: room for those of the plane. */
static planefile_status put_frame(writer *w, planefile_band *plane, planefile_axis *axes) {
  w->plane = plane;
  w->flags = (pf_band_is_opaque(plane) ? PF_OPAQUE : 0) | (plane->programs ? PF_VARIES : 0) |
             (w->desc.is_coded ? PF_CODED : 0);
  for (uint32_t i = 0; plane->programs && i < plane->axis_count; i++)
    w->flags |= plane->axes[i].kind == PLANEFILE_PICTURE ? PF_PICTURED : 0;
  planefile_status status = w->offset == 0 ? put_header(w) : PLANEFILE_OK;
  if (status == PLANEFILE_OK)
    status = put_pictures(w, plane, axes);
  plane->axes = axes;
  plane->picture_count = (uint32_t)w->picture_count;
  return status == PLANEFILE_OK ? put_plane(w) : status;
}

planefile_status planefile_writer_frame(planefile_writer *w, const planefile_band *given) {
  planefile_band plane = *given;
  plane.programs = varies(given) ? given->programs : NULL;
  if (!plane.programs)
    plane.step_count = plane.stop_count = plane.axis_count = 0;
  if ((!is_film(w) && w->frame_count > 0) || !is_plane(&plane, w->desc.grid))
    return PLANEFILE_BAD_ARGUMENT;
  copies room;
  planefile_status status = PLANEFILE_NO_MEMORY;
  if (make_copies(w, &plane, &room)) {
    if (w->desc.is_coded)
      round_colours(w, &plane, &room);
    status = put_frame(w, &plane, room.axes);
    forget_frame(w);
  }
  free_copies(w, &plane, &room);
  return status == PLANEFILE_OK ? add_frame(w) : status;
}

/* ---------------------------------------------------------------- files */

static bool is_file(const planefile_writer_desc *desc) {
  return desc->width > 0 && desc->height > 0 && isfinite(desc->width) && isfinite(desc->height) &&
         desc->frames_second >= 0 && isfinite(desc->frames_second);
}

planefile_status planefile_writer_create(const planefile_writer_desc *desc,
                                         planefile_writer **out) {
  pf_memory memory = pf_memory_of(desc->resize, desc->resize_user);
  *out = NULL;
  if (!is_file(desc))
    return PLANEFILE_BAD_ARGUMENT;
  writer *w = pf_make(&memory, sizeof *w, 1);
  if (!w)
    return PLANEFILE_NO_MEMORY;
  w->desc = *desc;
  w->memory = memory;
  if (desc->is_coded)
    pf_codes_make(&w->codes);
  if (is_film(w) && !(w->known = pf_written_create(&memory))) {
    planefile_writer_destroy(w);
    return PLANEFILE_NO_MEMORY;
  }
  *out = w;
  return PLANEFILE_OK;
}

planefile_status planefile_writer_end(planefile_writer *w) {
  if (w->frame_count == 0)
    return PLANEFILE_BAD_ARGUMENT;
  uint64_t last = is_film(w) ? w->offset : w->index;
  planefile_status status = is_film(w) ? put_frames(w) : PLANEFILE_OK;
  return status == PLANEFILE_OK ? put_trailer(w, last) : status;
}

void planefile_writer_destroy(planefile_writer *w) {
  if (!w)
    return;
  pf_memory memory = w->memory;
  forget_key(w);
  pf_free(&memory, w->key, sizeof *w->key, w->key_capacity);
  pf_written_destroy(w->known);
  pf_written_destroy(w->shown_pictures);
  pf_free(&memory, w->pictures, sizeof *w->pictures, w->picture_capacity);
  pf_free(&memory, w->frames, sizeof *w->frames, w->frame_capacity);
  pf_free(&memory, w->entries, sizeof *w->entries, w->entry_capacity);
  pf_free(&memory, w, sizeof *w, 1);
}

planefile_status planefile_write(const planefile_writer_desc *desc, const planefile_band *plane) {
  writer *w;
  planefile_status status = planefile_writer_create(desc, &w);
  if (status == PLANEFILE_OK)
    status = planefile_writer_frame(w, plane);
  if (status == PLANEFILE_OK)
    status = planefile_writer_end(w);
  planefile_writer_destroy(w);
  return status;
}
