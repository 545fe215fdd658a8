#include "engine/map/reading.h"

#include "engine/map/doubles.h"

typedef float floats __attribute__((vector_size(16)));

/* The row that is being read. */
typedef struct reader {
  celspan_context *context;
  cs_map_rows *rows;
  const cs_v4 *colours; /* of the cells */
  const cs_map_cell *cells;
  size_t cell_count;
  cs_map_span *first, *last; /* the row's spans so far; last: NULL before there are any */
  cs_doubles run;            /* what is left of the next pixel */
  uint64_t run_key;
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
  rows->areas[i].area += part->area;
  rows->areas[i].height += part->height;
  return CELSPAN_OK;
}

/* After a pixel: what there is of each cell right of it. */
static void pass_areas(cs_map_rows *rows) {
  size_t kept = 0;
  for (size_t i = 0; i < rows->area_count; i++)
    if (rows->areas[i].height != 0) {
      rows->areas[kept] = rows->areas[i];
      rows->areas[kept].area = rows->areas[kept].height;
      kept++;
    }
  rows->area_count = kept;
}

/* Gives the last span what varies in it. */
static celspan_status add_shares(reader *r) {
  cs_map_rows *rows = r->rows;
  cs_map_span *span = r->last;
  span->share = (uint32_t)rows->share_count;
  CS_TRY(CS_RESERVE(r->context, rows->shares, rows->share_capacity,
                    rows->share_count + rows->area_count));
  for (size_t i = 0; i < rows->area_count; i++)
    if (rows->areas[i].area != 0)
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

/* From a column on, until the next one that is put, pixels show a cell, or else this sum. There is
 * room. varies: whether any cell does. */
static inline celspan_status put(reader *r, bool varies, int32_t column, uint32_t cell,
                                 cs_doubles sum) {
  if (r->last >= r->first) {
    if (r->last->cell == cell && cell != CS_MAP_BROKEN)
      return CELSPAN_OK;
    r->last->end = column;
  }
  cs_map_span *span = ++r->last;
  span->cell = cell;
  span->share = span->share_count = 0;
  if (cell == CS_MAP_BROKEN) {
    floats colour = __builtin_convertvector(sum * (1.0 / CS_MAP_HEIGHT), floats);
    memcpy(&span->colour, &colour, sizeof colour);
  } else {
    span->colour = r->colours[cell];
  }
  return varies && r->rows->area_count > 0 ? add_shares(r) : CELSPAN_OK;
}

/* Pixels to which nothing was added, from a column on. */
static inline celspan_status put_gap(reader *r, bool varies, int32_t column) {
  uint32_t cell = cell_of(r, r->run_key);
  if (cell != CS_MAP_BROKEN) {
    floats colour;
    memcpy(&colour, &r->colours[cell], sizeof colour);
    r->run = __builtin_convertvector(colour, cs_doubles) * CS_MAP_HEIGHT;
  }
  return put(r, varies, column, cell, r->run);
}

/* A pixel to which something was added; that is cleared. */
static inline celspan_status put_pixel(reader *r, bool varies, int32_t column, cs_map_sum *sum,
                                       cs_map_keys *keys) {
  cs_doubles colour = r->run + cs_doubles_load(sum->area);
  uint32_t cell = cell_of(r, r->run_key + keys->area);
  r->run += cs_doubles_load(sum->height);
  r->run_key += keys->height;
  *sum = (cs_map_sum){0};
  *keys = (cs_map_keys){0};
  return put(r, varies, column, cell, colour);
}

/* ---------------------------------------------------------------- a row */

static inline celspan_status read_row(reader *r, cs_map_sums *sums, size_t k, bool varies) {
  cs_map_sum *pixels = sums->sums + k;
  cs_map_keys *keys = sums->keys + k;
  uint32_t *heads = sums->heads + k;
  uint64_t *bits = sums->bits + k * sums->words;
  int32_t next = 0; /* the column after the last one that was put */
  for (size_t i = 0; i < sums->words; bits[i++] = 0)
    for (uint64_t word = bits[i]; word; word &= word - 1) {
      int32_t column = (int32_t)(64 * i) + __builtin_ctzll(word);
      const size_t at = CS_MAP_ROWS * (size_t)column;
      if (varies)
        pass_areas(r->rows);
      if (column > next)
        CS_TRY(put_gap(r, varies, next));
      for (; varies && heads[at]; heads[at] = sums->parts[heads[at] - 1].next)
        CS_TRY(add_area(r, &sums->parts[heads[at] - 1]));
      CS_TRY(put_pixel(r, varies, column, &pixels[at], &keys[at]));
      next = column + 1;
    }
  if (varies)
    pass_areas(r->rows);
  if (next < sums->width)
    CS_TRY(put_gap(r, varies, next));
  r->last->end = sums->width;
  return CELSPAN_OK;
}

static celspan_status begin_row(reader *r, int32_t width) {
  cs_map_rows *rows = r->rows;
  size_t first = rows->span_count;
  const cs_v4d clear = cs_v4d_scale(CS_MAP_HEIGHT, cs_v4_wide(r->colours[0]));
  CS_TRY(CS_RESERVE(r->context, rows->spans, rows->span_capacity, first + (size_t)width));
  r->first = rows->spans + first;
  r->last = r->first - 1;
  memcpy(&r->run, &clear, sizeof r->run);
  r->run_key = r->cells[0].key * CS_MAP_HEIGHT;
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
