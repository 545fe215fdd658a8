#include "engine/map/sums.h"

#include "engine/map/adding.h"
#include "engine/map/reading.h"

/* ---------------------------------------------------------------- life */

static size_t sums_size(const cs_map_sums *sums) {
  return CS_MAP_ROWS * ((size_t)sums->width + 1) * sizeof *sums->sums;
}

celspan_status cs_map_sums_init(celspan_context *context, int32_t width, cs_map_sums *out) {
  *out = (cs_map_sums){
      .isa = cs_isa_best(), .width = width, .words = ((size_t)width / 64 + 4) / 4 * 4};
  CS_TRY(CS_ARRAY_MAKE(context, out->storage, CS_WIDE_LINE + sums_size(out)));
  out->sums = cs_wide_align(out->storage);
  /* one word more than the rows need, because bits are marked four bytes at a time */
  return CS_ARRAY_MAKE(context, out->bits, CS_MAP_ROWS * out->words + 1);
}

void cs_map_sums_finish(cs_map_sums *sums, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, sums, storage, parts);
  *sums = (cs_map_sums){0};
}

void cs_map_rows_finish(cs_map_rows *rows, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, rows, lives, near);
  *rows = (cs_map_rows){0};
}

static void clear(cs_map_sums *sums) {
  memset(sums->sums, 0, sums_size(sums));
  memset(sums->bits, 0, CS_ARRAYS_BYTES(sums, bits, bits));
  sums->unread = 0;
}

/* Clears the rows that nobody has asked for. */
static void clear_unread(cs_map_sums *sums) {
  for (; sums->unread; sums->unread &= sums->unread - 1)
    CS_WIDE_CHOOSE(sums->isa, cs_map_clear_row)(sums, (size_t)__builtin_ctz(sums->unread));
}

/* ---------------------------------------------------------------- a swath */

/* Finds the borders that cross the swath. */
static celspan_status find_lives(const cs_map_adding *a) {
  clear_unread(a->sums);
  CS_TRY(CS_WIDE_CHOOSE(a->sums->isa, cs_map_find_lives)(a));
  a->sums->part_count = 0;
  a->rows->width = a->sums->width;
  a->rows->has_near = false;
  return CELSPAN_OK;
}

static celspan_status add_all(const cs_map_adding *a) {
  celspan_status status = CELSPAN_OK;
  cs_map_adding adding = *a;
  adding.status = &status;
  CS_WIDE_CHOOSE(a->sums->isa, cs_map_add)(&adding);
  return status;
}

static celspan_status make_rows(const cs_map_adding *a, const cs_v4 *colours) {
  CS_TRY(add_all(a));
  return CS_WIDE_CHOOSE(a->sums->isa, cs_map_read)(a->context, a->sums, colours, a->rows);
}

static void find_steps(const cs_map_rows *rows, const cs_v4 *colours) {
  for (size_t i = 0; i < rows->live_count; i++) {
    cs_map_live *live = &rows->lives[i];
    cs_map_find_step(colours, &rows->drawing->lines->borders[live->border], live);
  }
}

/* The transmission of the spans. Its spans are made like the spans of colours, and end at the same
 * columns, because keys alone decide where a span ends. */
static celspan_status make_through(const cs_map_adding *a) {
  cs_map_rows *rows = a->rows;
  find_steps(rows, rows->drawing->through);
  CS_TRY(make_rows(a, rows->drawing->through));
  CS_TRY(CS_ARRAY_RESERVE(a->context, rows->through, rows->span_count));
  for (size_t i = 0; i < rows->span_count; i++)
    rows->through[i] = rows->spans[i].colour;
  find_steps(rows, rows->drawing->colours);
  return CELSPAN_OK;
}

celspan_status cs_map_rows_make(celspan_context *context, cs_map_sums *sums, cs_map_rows *rows,
                                int32_t row) {
  const cs_map_adding a = {.context = context, .sums = sums, .rows = rows, .row = row};
  CS_TRY(find_lives(&a));
  celspan_status status = rows->drawing->through ? make_through(&a) : CELSPAN_OK;
  if (status == CELSPAN_OK)
    status = make_rows(&a, rows->drawing->colours);
  if (status == CELSPAN_OK)
    rows->row = row;
  else
    clear(sums);
  return status;
}

celspan_status cs_map_rows_sum(celspan_context *context, cs_map_sums *sums, cs_map_rows *rows,
                               int32_t row) {
  const cs_map_adding a = {.context = context, .sums = sums, .rows = rows, .row = row};
  CS_TRY(find_lives(&a));
  CS_TRY(add_all(&a));
  sums->unread = (1U << CS_MAP_ROWS) - 1;
  rows->row = row;
  return CELSPAN_OK;
}
