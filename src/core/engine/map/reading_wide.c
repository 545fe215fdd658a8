#include "engine/map/reading.h"

#include "engine/span/row_writer.h"

/* ---------------------------------------------------------------- pixels */

typedef uint64_t words __attribute__((vector_size(sizeof(cs_map_sum))));

/* The pixel that a walk along a row has reached. */
typedef struct pixel {
  const cs_map_cell *cells;
  const cs_v4 *colours; /* the colours of the cells */
  size_t cell_count;
  cs_v4 sum;     /* the colour summed so far */
  uint64_t key;  /* the same sum for keys, multiplied by HEIGHT */
  uint32_t cell; /* the only cell in the pixel; BROKEN: several cells are in it */
} pixel;

static inline pixel clear_pixel(const cs_map_rows *rows, const cs_v4 *colours) {
  const cs_map *map = rows->drawing->map;
  return (pixel){.cells = map->cells,
                 .colours = colours,
                 .cell_count = map->cell_count,
                 .sum = colours[0],
                 .key = map->cells[0].key * CS_MAP_HEIGHT};
}

/* The only cell in a pixel; BROKEN: several cells are in it. */
static inline uint32_t cell_of(const pixel *p) {
  uint64_t cell = p->key / CS_MAP_HEIGHT % CS_MAP_CELLS;
  return p->key % CS_MAP_HEIGHT == 0 && cell < p->cell_count &&
                 p->cells[cell].key * CS_MAP_HEIGHT == p->key
             ? (uint32_t)cell
             : CS_MAP_BROKEN;
}

/* In one store. */
static inline void clear_sum(cs_map_sum *sum) {
  const words none = {0};
  memcpy(sum, &none, sizeof *sum);
}

/* Adds the difference between a pixel and the pixel on its left to the sum, and clears the
 * difference. */
static inline void change(pixel *p, cs_map_sum *sum) {
  p->sum += cs_v4_load(sum->colour);
  p->key += sum->key;
  p->cell = cell_of(p);
  if (p->cell != CS_MAP_BROKEN)
    p->sum = p->colours[p->cell];
  clear_sum(sum);
}

/* A bit for each of up to 64 words: whether it is not 0. count: a multiple of four. */
static inline uint64_t find_filled(const uint64_t *row, size_t count) {
  uint64_t filled = 0;
  for (size_t i = 0; i < count; i += 4) {
#ifdef __AVX2__
    const __m256i four = _mm256_loadu_si256((const __m256i *)(const void *)(row + i));
    const __m256i is_0 = _mm256_cmpeq_epi64(four, _mm256_setzero_si256());
    filled |= (uint64_t)(15 & ~_mm256_movemask_pd((__m256d)is_0)) << i;
#else
    for (size_t k = i; k < i + 4; k++)
      filled |= (uint64_t)(row[k] != 0) << k;
#endif
  }
  return filled;
}

/* A walk over the pixels of a row to which something was added, from left to right. It clears their
 * bits. */
typedef struct walk {
  uint64_t *bits;
  size_t count;           /* words of the row */
  size_t first, next;     /* the word of the first bit of `filled`, and the words visited */
  uint64_t filled, word;  /* what is left of these words, and of the pixels of one of them */
  int32_t corner, column; /* of the first pixel of `word`; the column that is reached */
} walk;

static inline walk walk_along(const cs_map_sums *sums, size_t k) {
  const int32_t width = sums->width;
  uint64_t *bits = sums->bits + k * sums->words;
  clear_sum(&sums->sums[CS_MAP_ROWS * (size_t)width + k]);
  bits[width / 64] &= (UINT64_C(1) << width % 64) - 1;
  return (walk){.bits = bits, .count = sums->words};
}

/* Goes to the next word that is not empty. False: there is none. */
static inline bool go_on(walk *w) {
  for (; w->filled == 0; w->next += 64) {
    if (w->next >= w->count)
      return false;
    w->first = w->next;
    w->filled =
        find_filled(w->bits + w->first, w->count - w->first < 64 ? w->count - w->first : 64);
  }
  const size_t i = w->first + (size_t)__builtin_ctzll(w->filled);
  w->filled &= w->filled - 1;
  w->corner = (int32_t)(64 * i);
  w->word = w->bits[i];
  w->bits[i] = 0;
  return true;
}

/* Goes to the next pixel. False: there is none. */
static inline bool step(walk *w) {
  if (w->word == 0 && !go_on(w))
    return false;
  w->column = w->corner + __builtin_ctzll(w->word);
  w->word &= w->word - 1;
  return true;
}

void CS_WIDE(cs_map_clear_row)(const cs_map_sums *sums, size_t k) {
  for (walk w = walk_along(sums, k); step(&w);)
    clear_sum(&sums->sums[CS_MAP_ROWS * (size_t)w.column + k]);
}

/* ---------------------------------------------------------------- the only sheet of a frame */

void CS_WIDE(cs_map_read_alone)(const cs_map_sums *sums, const cs_map_rows *rows,
                                const cs_map_frame *frame, size_t k, cs_row *out) {
  /* Copies, which stay in registers. */
  const cs_map_sheet sheet = {.back = frame->sheets[0].back, .keep = frame->sheets[0].keep};
  const cs_map_frame behind = {.back = frame->back, .keep = frame->keep};
  cs_map_sum *pixels = sums->sums + k;
  cs_row_writer writer = cs_row_writer_begin(out, 0);
  pixel p = clear_pixel(rows, rows->drawing->colours);
  for (walk w = walk_along(sums, k); step(&w);) {
    const cs_v4 colour = p.sum;
    const uint32_t cell = p.cell;
    change(&p, &pixels[CS_MAP_ROWS * (size_t)w.column]);
    if (p.cell != cell || cell == CS_MAP_BROKEN)
      cs_row_writer_to(&writer, w.column, cs_map_fold_one(&sheet, &behind, colour));
  }
  cs_row_writer_to(&writer, sums->width, cs_map_fold_one(&sheet, &behind, p.sum));
  cs_row_writer_end(&writer);
}

/* The row that is being read. */
typedef struct reader {
  celspan_context *context;
  cs_map_rows *rows;
  const cs_v4 *colours;      /* the colours of the cells */
  cs_map_span *first, *last; /* the row's spans so far; last: before `first` where there are none */
  pixel pixel;
} reader;

/* ---------------------------------------------------------------- cells that vary */

/* Adds a part to the areas of the cells. */
static celspan_status add_area(reader *r, const cs_map_part *part) {
  cs_map_rows *rows = r->rows;
  size_t i = 0;
  while (i < rows->area_count && rows->areas[i].cell != part->cell)
    i++;
  if (i == rows->area_count)
    CS_TRY(CS_ARRAY_APPEND(r->context, rows->areas, rows->area_count,
                           (cs_map_area){.cell = part->cell}));
  rows->areas[i].area += part->change;
  return CELSPAN_OK;
}

/* Changes the areas by the parts of a pixel, and drops areas that become 0. */
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

/* Gives the last span the shares of the cells that vary in this span. */
static celspan_status add_shares(reader *r) {
  cs_map_rows *rows = r->rows;
  cs_map_span *span = r->last;
  span->share = (uint32_t)rows->share_count;
  CS_TRY(CS_ARRAY_RESERVE(r->context, rows->shares, rows->share_count + rows->area_count));
  for (size_t i = 0; i < rows->area_count; i++)
    rows->shares[rows->share_count++] = (cs_map_share){
        rows->areas[i].cell, (float)((double)rows->areas[i].area * (1.0 / CS_MAP_HEIGHT))};
  span->share_count = (uint32_t)rows->share_count - span->share;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- spans */

/* Begins a span; its end is not known yet. */
static inline void begin_span(const pixel *p, cs_map_span *span) {
  span->cell = p->cell;
  span->share = span->share_count = 0;
  span->colour = p->sum;
}

/* Begins a span at a column, where cells may vary. There is room for it. */
static inline celspan_status put(reader *r, int32_t column) {
  const uint32_t cell = r->pixel.cell;
  if (r->last >= r->first) {
    if (r->last->cell == cell && cell != CS_MAP_BROKEN)
      return CELSPAN_OK;
    r->last->end = column;
  }
  begin_span(&r->pixel, ++r->last);
  return r->rows->area_count > 0 ? add_shares(r) : CELSPAN_OK;
}

static celspan_status begin_row(reader *r, int32_t width) {
  cs_map_rows *rows = r->rows;
  size_t first = rows->span_count;
  CS_TRY(CS_ARRAY_RESERVE(r->context, rows->spans, first + (size_t)width));
  r->first = rows->spans + first;
  r->last = r->first - 1;
  r->pixel = clear_pixel(rows, r->colours);
  rows->area_count = 0;
  return CELSPAN_OK;
}

static celspan_status read_varied_row(reader *r, const cs_map_sums *sums, size_t k) {
  walk w = walk_along(sums, k);
  CS_TRY(begin_row(r, sums->width));
  bool is_inside = step(&w);
  if (!is_inside || w.column > 0)
    CS_TRY(put(r, 0));
  for (; is_inside; is_inside = step(&w)) {
    cs_map_sum *sum = &sums->sums[CS_MAP_ROWS * (size_t)w.column + k];
    CS_TRY(change_areas(r, sums, sum->head));
    change(&r->pixel, sum);
    CS_TRY(put(r, w.column));
  }
  r->last->end = sums->width;
  return CELSPAN_OK;
}

/* A row in which nothing varies: its pixel stays in registers. */
static celspan_status read_flat_row(reader *r, const cs_map_sums *sums, size_t k) {
  cs_map_sum *pixels = sums->sums + k;
  walk w = walk_along(sums, k);
  CS_TRY(begin_row(r, sums->width));
  pixel p = r->pixel;
  cs_map_span *span = r->first;
  bool is_inside = step(&w);
  if (is_inside && w.column == 0) {
    change(&p, pixels);
    is_inside = step(&w);
  }
  begin_span(&p, span);
  for (; is_inside; is_inside = step(&w)) {
    change(&p, &pixels[CS_MAP_ROWS * (size_t)w.column]);
    if (p.cell == span->cell && p.cell != CS_MAP_BROKEN)
      continue;
    span->end = w.column;
    begin_span(&p, ++span);
  }
  span->end = sums->width;
  r->last = span;
  return CELSPAN_OK;
}

celspan_status CS_WIDE(cs_map_read)(celspan_context *context, cs_map_sums *sums,
                                    const cs_v4 *colours, cs_map_rows *rows) {
  const bool varies = rows->drawing->stack.layer_count > 0;
  reader r = {.context = context, .rows = rows, .colours = colours};
  rows->span_count = rows->share_count = 0;
  for (size_t k = 0; k < CS_MAP_ROWS; k++) {
    rows->first[k] = rows->span_count;
    CS_TRY(varies ? read_varied_row(&r, sums, k) : read_flat_row(&r, sums, k));
    rows->span_count = (size_t)(r.last + 1 - rows->spans);
  }
  rows->first[CS_MAP_ROWS] = rows->span_count;
  return CELSPAN_OK;
}
