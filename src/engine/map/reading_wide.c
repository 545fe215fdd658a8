#include "engine/map/reading.h"

/* The row that is being read. */
typedef struct reader {
  celspan_context *context;
  cs_map_rows *rows;
  const cs_v4 *colours; /* of the cells */
  const cs_map_cell *cells;
  size_t cell_count;
  cs_map_span *first, *last; /* the row's spans so far; last: NULL before there are any */
  cs_v4 sum;                 /* of the pixel, times HEIGHT */
  uint64_t key;              /* the same of keys */
} reader;

/* ---------------------------------------------------------------- cells that vary */

/* Adds a part to the areas of the cells. */
static celspan_status add_area(reader *r, const cs_map_part *part) {
  cs_map_rows *rows = r->rows;
  size_t i = 0;
  while (i < rows->area_count && rows->areas[i].cell != part->cell)
    i++;
  if (i == rows->area_count)
    CS_TRY(CS_APPEND(r->context, rows->areas, rows->area_count, rows->area_capacity,
                     (cs_map_area){.cell = part->cell}));
  rows->areas[i].area += part->change;
  return CELSPAN_OK;
}

/* Changes the areas by the parts of a pixel, and drops those that are 0 then. */
static celspan_status change_areas(reader *r, const cs_map_sums *sums, uint32_t head) {
  cs_map_rows *rows = r->rows;
  size_t kept = 0;
  for (; head; head = sums->parts[head - 1].next)
    CS_TRY(add_area(r, &sums->parts[head - 1]));
  for (size_t i = 0; i < rows->area_count; i++)
    if (rows->areas[i].area != 0)
      rows->areas[kept++] = rows->areas[i];
  rows->area_count = kept;
  return CELSPAN_OK;
}

/* Gives the last span what varies in it. */
static celspan_status add_shares(reader *r) {
  cs_map_rows *rows = r->rows;
  cs_map_span *span = r->last;
  span->share = (uint32_t)rows->share_count;
  CS_TRY(CS_RESERVE(r->context, rows->shares, rows->share_capacity,
                    rows->share_count + rows->area_count));
  for (size_t i = 0; i < rows->area_count; i++)
    rows->shares[rows->share_count++] = (cs_map_share){
        rows->areas[i].cell, (float)((double)rows->areas[i].area * (1.0 / CS_MAP_HEIGHT))};
  span->share_count = (uint32_t)rows->share_count - span->share;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- spans */

/* The cell that alone is in a pixel; BROKEN: several are. */
static inline uint32_t cell_of(const reader *r, uint64_t key) {
  uint64_t cell = key / CS_MAP_HEIGHT % CS_MAP_CELLS;
  return key % CS_MAP_HEIGHT == 0 && cell < r->cell_count &&
                 r->cells[cell].key * CS_MAP_HEIGHT == key
             ? (uint32_t)cell
             : CS_MAP_BROKEN;
}

/* Begins a span at a column. There is room. varies: whether any cell does. */
static inline celspan_status put(reader *r, bool varies, int32_t column) {
  const uint32_t cell = cell_of(r, r->key);
  if (cell != CS_MAP_BROKEN)
    r->sum = r->colours[cell] * CS_MAP_HEIGHT;
  if (r->last >= r->first) {
    if (r->last->cell == cell && cell != CS_MAP_BROKEN)
      return CELSPAN_OK;
    r->last->end = column;
  }
  cs_map_span *span = ++r->last;
  span->cell = cell;
  span->share = span->share_count = 0;
  span->colour = cell == CS_MAP_BROKEN ? r->sum * (1.0f / CS_MAP_HEIGHT) : r->colours[cell];
  return varies && r->rows->area_count > 0 ? add_shares(r) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- a row */

static inline celspan_status read_row(reader *r, cs_map_sums *sums, size_t k, bool varies) {
  cs_map_sum *pixels = sums->sums + k;
  uint64_t *bits = sums->bits + k * sums->words;
  const int32_t width = sums->width;
  pixels[CS_MAP_ROWS * (size_t)width] = (cs_map_sum){.head = 0};
  bits[width / 64] &= (UINT64_C(1) << width % 64) - 1;
  if (!(bits[0] & 1))
    CS_TRY(put(r, varies, 0));
  for (size_t i = 0; i < sums->words; bits[i++] = 0)
    for (uint64_t word = bits[i]; word; word &= word - 1) {
      int32_t column = (int32_t)(64 * i) + __builtin_ctzll(word);
      cs_map_sum *sum = &pixels[CS_MAP_ROWS * (size_t)column];
      r->sum += cs_v4_load(sum->colour);
      r->key += sum->key;
      if (varies)
        CS_TRY(change_areas(r, sums, sum->head));
      *sum = (cs_map_sum){.head = 0};
      CS_TRY(put(r, varies, column));
    }
  r->last->end = width;
  return CELSPAN_OK;
}

static celspan_status begin_row(reader *r, int32_t width) {
  cs_map_rows *rows = r->rows;
  size_t first = rows->span_count;
  CS_TRY(CS_RESERVE(r->context, rows->spans, rows->span_capacity, first + (size_t)width));
  r->first = rows->spans + first;
  r->last = r->first - 1;
  r->sum = r->colours[0] * CS_MAP_HEIGHT;
  r->key = r->cells[0].key * CS_MAP_HEIGHT;
  rows->area_count = 0;
  return CELSPAN_OK;
}

celspan_status CS_WIDE(cs_map_read)(celspan_context *context, cs_map_sums *sums,
                                    const cs_v4 *colours, cs_map_rows *rows) {
  const cs_map_drawing *drawing = rows->drawing;
  reader r = {.context = context,
              .rows = rows,
              .colours = colours,
              .cells = drawing->map->cells,
              .cell_count = drawing->map->cell_count};
  rows->span_count = rows->share_count = 0;
  for (size_t k = 0; k < CS_MAP_ROWS; k++) {
    rows->first[k] = rows->span_count;
    CS_TRY(begin_row(&r, sums->width));
    CS_TRY(drawing->stack.layer_count > 0 ? read_row(&r, sums, k, true)
                                          : read_row(&r, sums, k, false));
    rows->span_count = (size_t)(r.last + 1 - rows->spans);
  }
  rows->first[CS_MAP_ROWS] = rows->span_count;
  return CELSPAN_OK;
}
