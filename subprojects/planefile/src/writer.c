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
 */
#include <math.h>

#include "writer.h"

/* A band ends after this many beginnings of borders, or more where many cross its end: each of
 * those is in the next one, too. */
enum { BAND_BORDERS = 4096, BORDERS_A_LIVE = 8 };

/* NULL: cells are not codes. */
static const pf_codes *codes_of(const planefile_writer *w) {
  return w->desc.is_coded ? &w->codes : NULL;
}

/* ---------------------------------------------------------------- order */

static int compare_by_top(const void *first, const void *second) {
  const planefile_border *a = first, *b = second;
  int by_top = pf_order(a->top, b->top);
  return by_top ? by_top : pf_order(a->chain, b->chain);
}

static planefile_status sort_borders(planefile_writer *w) {
  size_t count = w->plane->border_count;
  w->borders = pf_make(&w->memory, sizeof *w->borders, count);
  if (!w->borders)
    return PLANEFILE_NO_MEMORY;
  if (count == 0)
    return PLANEFILE_OK;
  memcpy(w->borders, w->plane->borders, count * sizeof *w->borders);
  qsort(w->borders, count, sizeof *w->borders, pf_border_compare);
  for (size_t i = 1; i < count; i++)
    if (w->borders[i].chain == w->borders[i - 1].chain &&
        w->borders[i].top < w->borders[i - 1].foot)
      return PLANEFILE_BAD_ARGUMENT;
  qsort(w->borders, count, sizeof *w->borders, compare_by_top);
  return PLANEFILE_OK;
}

/* ---------------------------------------------------------------- bands */

/* Forgets the borders that end above the band that begins now. */
static void drop_ended(planefile_writer *w, int32_t top) {
  size_t kept = 0;
  for (size_t i = 0; i < w->shown_count; i++)
    if (w->shown[i].foot > top)
      w->shown[kept++] = w->shown[i];
  w->shown_count = kept;
}

/* Adds the borders from `next` on that begin in the band from `top` on, until there are enough; all
 * that begin at one height are in one band. Returns where it stopped. */
static size_t add_begun(planefile_writer *w, int32_t top, size_t next) {
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
static planefile_status encode(planefile_writer *w, int32_t top, int32_t foot, const pf_base *base,
                               pf_encoder *out) {
  const pf_part part = {.plane = w->plane,
                        .borders = w->shown,
                        .count = w->shown_count,
                        .top = top,
                        .foot = foot,
                        .is_whole = pf_is_film(w) && !base,
                        .base = base,
                        .codes = codes_of(w),
                        .grid = w->desc.grid};
  if (!pf_is_moderate(w->plane->cells, w->shown, w->shown_count)) {
    *out = (pf_encoder){0};
    return PLANEFILE_BAD_ARGUMENT;
  }
  return pf_band_encode(&w->memory, &part, out);
}

static planefile_status add_entry(planefile_writer *w, unsigned char kind, int32_t top,
                                  const pf_encoder *code) {
  pf_entry *entries =
      pf_grow(&w->memory, w->entries, sizeof *entries, &w->entry_capacity, w->entry_count + 1);
  if (!entries)
    return PLANEFILE_NO_MEMORY;
  w->entries = entries;
  uint64_t *offset = &w->entries[w->entry_count].offset;
  w->entries[w->entry_count++].top = top;
  return pf_writer_put_once(w, kind, code->bytes, code->count, offset);
}

/* The latest band that was added becomes one of the key. */
static planefile_status add_key(planefile_writer *w, const pf_encoder *code) {
  const char *reason;
  pf_payload payload = {.bytes = code->bytes,
                        .size = code->count,
                        .varies = w->flags & PF_VARIES,
                        .codes = codes_of(w),
                        .grid = w->desc.grid,
                        .picture_count = (uint32_t)w->picture_count};
  pf_key_band *key = pf_grow(&w->memory, w->key, sizeof *key, &w->key_capacity, w->key_count + 1);
  if (!key)
    return PLANEFILE_NO_MEMORY;
  w->key = key;
  key = &w->key[w->key_count++];
  *key = (pf_key_band){.at = w->entries[w->entry_count - 1]};
  if (!pf_base_begin(&w->memory, &key->base))
    return PLANEFILE_NO_MEMORY;
  key->base.code = code->count;
  payload.learned = key->base.learned;
  return pf_band_decode(&w->memory, &payload, &key->band, &reason);
}

static planefile_status put_band(planefile_writer *w, int32_t top, int32_t foot) {
  pf_encoder code;
  planefile_status status = encode(w, top, foot, NULL, &code);
  if (status == PLANEFILE_OK)
    status = add_entry(w, PF_BAND, top, &code);
  if (status == PLANEFILE_OK && pf_is_film(w))
    status = add_key(w, &code);
  pf_encoder_finish(&code);
  return status;
}

static planefile_status put_bands(planefile_writer *w) {
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

static void forget_key(planefile_writer *w) {
  for (size_t i = 0; i < w->key_count; i++) {
    pf_base_free(&w->key[i].base);
    pf_band_free(&w->memory, &w->key[i].band);
  }
  w->key_count = 0;
}

/* What is needed of the key to make other frames from it. */
static planefile_status keep_key(planefile_writer *w) {
  w->key_index = w->index;
  w->key_flags = w->flags;
  w->first = SIZE_MAX;
  w->excess = 0;
  for (size_t i = 0; i < w->key_count; i++) {
    pf_key_band *key = &w->key[i];
    if (!pf_base_complete(&key->band.band, key->base.code, &key->base))
      return PLANEFILE_NO_MEMORY;
  }
  return PLANEFILE_OK;
}

/* Frames that have a base know of all its cells, and cell 0 is one of them. */
static bool can_have_base(const planefile_writer *w) {
  const planefile_cell *cell = &w->plane->cells[0];
  return w->key_count > 0 && (w->flags & PF_VARIES) == (w->key_flags & PF_VARIES) &&
         (w->flags & PF_OPAQUE) <= (w->key_flags & PF_OPAQUE) &&
         memcmp(cell, &w->key->band.band.cells[0], sizeof *cell) == 0;
}

static int32_t foot_of(const planefile_writer *w, size_t band) {
  return band + 1 < w->key_count ? w->key[band + 1].at.top : PLANEFILE_SIDE;
}

/* Shows the borders of the band at the heights of one of the key's. */
static void show_band(planefile_writer *w, int32_t top, int32_t foot) {
  w->shown_count = 0;
  for (size_t i = 0; i < w->plane->border_count; i++)
    if (w->borders[i].top < foot && w->borders[i].foot > top)
      w->shown[w->shown_count++] = w->borders[i];
}

/* Makes both forms of a band, of which the smaller one is left; *alone: the size of the one that
 * has no base. One that is in the file already takes nothing. */
static planefile_status make_draft(planefile_writer *w, size_t band, size_t *alone) {
  pf_draft *d = &w->drafts[band];
  int32_t top = w->key[band].at.top, foot = foot_of(w, band);
  show_band(w, top, foot);
  d->kind = PF_BAND;
  planefile_status status = encode(w, top, foot, NULL, &d->code);
  *alone = d->code.count;
  if (status != PLANEFILE_OK || pf_writer_has(w, PF_BAND, &d->code))
    return status;
  pf_encoder other;
  status = encode(w, top, foot, &w->key[band].base, &other);
  if (status != PLANEFILE_OK || other.count >= d->code.count) {
    pf_encoder_finish(&other);
    return status;
  }
  pf_encoder_finish(&d->code);
  *d = (pf_draft){PF_CHANGED, other};
  return PLANEFILE_OK;
}

/* *is_good: the drafts are worth it. */
static planefile_status make_drafts(planefile_writer *w, bool *is_good) {
  size_t all = 0, drafted = 0, alone;
  for (size_t i = 0; i < w->key_count; i++) {
    planefile_status status = make_draft(w, i, &alone);
    if (status != PLANEFILE_OK)
      return status;
    all += alone;
    drafted +=
        pf_writer_has(w, w->drafts[i].kind, &w->drafts[i].code) ? 0 : w->drafts[i].code.count;
  }
  w->first = drafted < w->first ? drafted : w->first;
  w->excess += drafted - w->first;
  *is_good = drafted < all && w->excess <= 3 * all;
  return PLANEFILE_OK;
}

/* Writes the frame by what differs from the key, if that is worth it: w->has_base. */
static planefile_status put_changed(planefile_writer *w) {
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

static planefile_status put_key(planefile_writer *w) {
  forget_key(w);
  planefile_status status = put_bands(w);
  if (status == PLANEFILE_OK)
    status = pf_writer_put_index(w);
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

static planefile_status put_plane(planefile_writer *w) {
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
  return w->has_base ? pf_writer_put_index(w) : put_key(w);
}

static void forget_frame(planefile_writer *w) {
  pf_free(&w->memory, w->borders, sizeof *w->borders, w->plane->border_count);
  pf_free(&w->memory, w->shown, sizeof *w->shown, w->shown_capacity);
  w->plane = NULL;
  w->borders = w->shown = NULL;
  w->shown_count = w->entry_count = 0;
}

/* The latest index is that of the next frame. */
static planefile_status add_frame(planefile_writer *w) {
  uint64_t *frames =
      pf_grow(&w->memory, w->frames, sizeof *frames, &w->frame_capacity, w->frame_count + 1);
  if (!frames)
    return PLANEFILE_NO_MEMORY;
  w->frames = frames;
  w->frames[w->frame_count++] = w->index;
  return PLANEFILE_OK;
}

planefile_status planefile_writer_repeat(planefile_writer *w) {
  return pf_is_film(w) && w->frame_count > 0 ? add_frame(w) : PLANEFILE_BAD_ARGUMENT;
}

/* Copies of the parts of a plane that are changed before it is written. */
typedef struct copies {
  planefile_axis *axes;
  planefile_cell *cells;
  planefile_step *steps;
  planefile_stop *stops;
} copies;

static bool make_copies(const planefile_writer *w, const planefile_band *plane, copies *out) {
  *out = (copies){pf_make(&w->memory, sizeof *out->axes, plane->axis_count),
                  pf_make(&w->memory, sizeof *out->cells, plane->cell_count),
                  pf_make(&w->memory, sizeof *out->steps, plane->step_count),
                  pf_make(&w->memory, sizeof *out->stops, plane->stop_count)};
  return out->axes && out->cells && out->steps && out->stops;
}

static void free_copies(const planefile_writer *w, const planefile_band *plane, const copies *of) {
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
static void round_colours(const planefile_writer *w, planefile_band *plane, const copies *out) {
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
static planefile_status put_frame(planefile_writer *w, planefile_band *plane,
                                  planefile_axis *axes) {
  w->plane = plane;
  w->flags = (pf_band_is_opaque(plane) ? PF_OPAQUE : 0) | (plane->programs ? PF_VARIES : 0) |
             (w->desc.is_coded ? PF_CODED : 0);
  for (uint32_t i = 0; plane->programs && i < plane->axis_count; i++)
    w->flags |= plane->axes[i].kind == PLANEFILE_PICTURE ? PF_PICTURED : 0;
  planefile_status status = w->offset == 0 ? pf_writer_put_header(w) : PLANEFILE_OK;
  if (status == PLANEFILE_OK)
    status = pf_writer_put_pictures(w, plane, axes);
  plane->axes = axes;
  plane->picture_count = (uint32_t)w->picture_count;
  return status == PLANEFILE_OK ? put_plane(w) : status;
}

planefile_status planefile_writer_frame(planefile_writer *w, const planefile_band *given) {
  planefile_band plane = *given;
  plane.programs = varies(given) ? given->programs : NULL;
  if (!plane.programs)
    plane.step_count = plane.stop_count = plane.axis_count = 0;
  if ((!pf_is_film(w) && w->frame_count > 0) || !pf_plane_is_good(&plane, w->desc.grid))
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
  planefile_writer *w = pf_make(&memory, sizeof *w, 1);
  if (!w)
    return PLANEFILE_NO_MEMORY;
  w->desc = *desc;
  w->memory = memory;
  if (desc->is_coded)
    pf_codes_make(&w->codes);
  if (pf_is_film(w) && !(w->known = pf_written_create(&memory))) {
    planefile_writer_destroy(w);
    return PLANEFILE_NO_MEMORY;
  }
  *out = w;
  return PLANEFILE_OK;
}

planefile_status planefile_writer_end(planefile_writer *w) {
  if (w->frame_count == 0)
    return PLANEFILE_BAD_ARGUMENT;
  uint64_t last = pf_is_film(w) ? w->offset : w->index;
  planefile_status status = pf_is_film(w) ? pf_writer_put_frames(w) : PLANEFILE_OK;
  return status == PLANEFILE_OK ? pf_writer_put_trailer(w, last) : status;
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
  planefile_writer *w;
  planefile_status status = planefile_writer_create(desc, &w);
  if (status == PLANEFILE_OK)
    status = planefile_writer_frame(w, plane);
  if (status == PLANEFILE_OK)
    status = planefile_writer_end(w);
  planefile_writer_destroy(w);
  return status;
}
