#include "varied.h"

#include <assert.h>

#include "chords.h"

/* ---------------------------------------------------------------- life */

static bool number_cells(pf_varied *v) {
  uint32_t count = v->plane->info.band_count;
  v->first = pf_make(&v->plane->memory, sizeof *v->first, (size_t)count + 1);
  for (uint32_t i = 0; v->first && i < count; i++) {
    v->first[i + 1] = v->first[i] + v->plane->bands[i].band.cell_count;
    if (v->first[i + 1] < v->first[i])
      return false;
  }
  return v->first != NULL;
}

bool pf_varied_init(pf_varied *v, const planefile_plane *plane, uint32_t columns, uint32_t rows) {
  *v = (pf_varied){.plane = plane, .columns = columns, .rows = rows};
  if (!number_cells(v))
    return false;
  size_t cells = v->first[plane->info.band_count];
  v->heads = pf_make(&plane->memory, sizeof *v->heads, ((size_t)columns + 1) * rows);
  v->shares = pf_make(&plane->memory, sizeof *v->shares, cells);
  v->places = pf_make(&plane->memory, sizeof *v->places, cells);
  v->active = pf_make(&plane->memory, sizeof *v->active, cells);
  v->room = pf_make(&plane->memory, sizeof *v->room, PF_ROOM);
  return v->heads && v->shares && v->places && v->active && v->room;
}

void pf_varied_finish(pf_varied *v) {
  if (!v->plane)
    return;
  const pf_memory *memory = &v->plane->memory;
  size_t bands = v->plane->info.band_count, cells = v->first ? v->first[bands] : 0;
  pf_free(memory, v->first, sizeof *v->first, bands + 1);
  pf_free(memory, v->entries, sizeof *v->entries, v->entry_capacity);
  pf_free(memory, v->start, sizeof *v->start, v->start_capacity);
  pf_free(memory, v->heads, sizeof *v->heads, ((size_t)v->columns + 1) * v->rows);
  pf_free(memory, v->shares, sizeof *v->shares, cells);
  pf_free(memory, v->places, sizeof *v->places, cells);
  pf_free(memory, v->active, sizeof *v->active, cells);
  pf_free(memory, v->room, sizeof *v->room, PF_ROOM);
}

/* ---------------------------------------------------------------- entries */

void pf_varied_begin(pf_varied *v) { v->entry_count = 0; }

/* Appends; NULL: no memory. */
static pf_entry *append(pf_varied *v, pf_entry **entries, size_t *count, size_t *capacity) {
  pf_entry *room = NULL;
  if (!v->failed && *count < UINT32_MAX - 1)
    room = pf_grow(&v->plane->memory, *entries, sizeof *room, capacity, *count + 1);
  v->failed |= room == NULL;
  if (!room)
    return NULL;
  *entries = room;
  return &room[(*count)++];
}

void pf_varied_add(pf_varied *v, uint32_t row, uint32_t column, uint32_t cell, int64_t share) {
  uint32_t *head = &v->heads[(size_t)row * (v->columns + 1) + column];
  pf_entry *entry = append(v, &v->entries, &v->entry_count, &v->entry_capacity);
  if (!entry)
    return;
  *entry = (pf_entry){cell, *head, share};
  *head = (uint32_t)v->entry_count;
}

void pf_varied_add_start(pf_varied *v, uint32_t cell, int64_t share) {
  pf_entry *entry = append(v, &v->start, &v->start_count, &v->start_capacity);
  if (entry)
    *entry = (pf_entry){cell, 0, share};
}

/* ---------------------------------------------------------------- shares */

static void change(pf_varied *v, const pf_entry *entry) {
  uint32_t cell = entry->cell;
  bool was_active = v->shares[cell] != 0;
  v->shares[cell] = (int64_t)((uint64_t)v->shares[cell] + (uint64_t)entry->share);
  bool is_active = v->shares[cell] != 0;
  if (is_active && !was_active) {
    v->places[cell] = v->active_count;
    v->active[v->active_count++] = cell;
  } else if (was_active && !is_active) {
    uint32_t last = v->active[--v->active_count];
    v->active[v->places[cell]] = last;
    v->places[last] = v->places[cell];
  }
}

void pf_varied_begin_row(pf_varied *v) {
  while (v->active_count > 0)
    v->shares[v->active[--v->active_count]] = 0;
  for (size_t i = 0; i < v->start_count; i++)
    change(v, &v->start[i]);
}

void pf_varied_take(pf_varied *v, uint32_t row, uint32_t column) {
  uint32_t *head = &v->heads[(size_t)row * (v->columns + 1) + column];
  for (uint32_t at = *head; at > 0; at = v->entries[at - 1].next)
    change(v, &v->entries[at - 1]);
  *head = 0;
}

/* ---------------------------------------------------------------- colours */

/* The band of a cell. */
static uint32_t find_band(const pf_varied *v, uint32_t cell) {
  uint32_t low = 0, high = v->plane->info.band_count - 1;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (v->first[middle + 1] > cell)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

#define FINE 64 /* parts of a unit */
static_assert(PF_HEIGHT * FINE == 1 << 22, "as rounded");

/* What cells that vary add to pixels: parts times PF_HEIGHT, modulo 2^64. */
typedef struct added {
  uint64_t channels[4][PF_BATCH];
} added;

/* A channel in parts, the nearest towards 0; also of what is not a number. */
static inline int32_t to_fine(float channel) {
  const float most = (float)PLANEFILE_BRIGHT * FINE;
  float fine = channel * (PLANEFILE_WHITE * (float)FINE);
  fine = fine > -most ? fine : -most;
  fine = fine < most ? fine : most;
  return (int32_t)fine;
}

/* The colours of an active cell. */
static const pf_colours *find_colours(pf_varied *v, uint32_t cell, const pf_pixels *pixels) {
  uint32_t index = find_band(v, cell);
  const planefile_band *band = &v->plane->bands[index].band;
  const pf_program_source source = {band, v->plane->pictures, &v->plane->curve};
  pf_program_colours(&source, band->programs[cell - v->first[index]], pixels, v->room);
  return v->room;
}

static void add_cell(pf_varied *v, uint32_t cell, const pf_pixels *pixels, added *out) {
  const pf_colours *colours = find_colours(v, cell, pixels);
  uint64_t share = (uint64_t)v->shares[cell];
  for (int c = 0; c < 4; c++)
    for (uint32_t k = 0; k < pixels->count; k++)
      out->channels[c][k] += share * (uint64_t)(int64_t)to_fine(colours->channels[c][k]);
}

/* A sum as an integer, whatever it is. */
static inline uint64_t whole_of(double sum) {
  const double most = 9007199254740992.0; /* 2^53 */
  sum = sum > -most ? sum : -most;
  return (uint64_t)(int64_t)(sum < most ? sum : most);
}

/* Pixels that several cells have a share of, or flat ones. */
static void paint_shares(pf_varied *v, const pf_pixels *pixels, const double flat[4],
                         planefile_span *out) {
  added sums;
  for (int c = 0; c < 4; c++)
    for (uint32_t k = 0; k < pixels->count; k++)
      sums.channels[c][k] = whole_of(flat[c]) * FINE + (uint64_t)PF_HEIGHT * FINE / 2;
  for (uint32_t i = 0; i < v->active_count; i++)
    add_cell(v, v->active[i], pixels, &sums);
  for (int c = 0; c < 4; c++)
    for (uint32_t k = 0; k < pixels->count; k++)
      out[k].colour.colour[c] = (int32_t)((int64_t)sums.channels[c][k] >> 22);
}

/* Pixels that one cell covers: the same arithmetic, without the share. */
static void paint_whole(pf_varied *v, const pf_pixels *pixels, planefile_span *out) {
  const pf_colours *colours = find_colours(v, v->active[0], pixels);
  for (uint32_t k = 0; k < pixels->count; k++)
    for (int c = 0; c < 4; c++)
      out[k].colour.colour[c] = (to_fine(colours->channels[c][k]) + FINE / 2) >> 6;
}

void pf_varied_paint(pf_varied *v, const pf_pixels *pixels, const double flat[4],
                     planefile_span *out) {
  if (v->active_count == 1 && v->shares[v->active[0]] == PF_HEIGHT && flat[0] == 0 &&
      flat[1] == 0 && flat[2] == 0 && flat[3] == 0)
    paint_whole(v, pixels, out);
  else
    paint_shares(v, pixels, flat, out);
}
