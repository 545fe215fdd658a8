#include "engine/map/sums.h"

/* ---------------------------------------------------------------- life */

celspan_status cs_map_sums_init(celspan_context *context, int32_t width, cs_map_sums *out) {
  *out = (cs_map_sums){.width = width, .words = (size_t)width / 64 + 1};
  CS_TRY(CS_MAKE(context, out->sums, CS_MAP_ROWS * ((size_t)width + 1)));
  return CS_MAKE(context, out->bits, CS_MAP_ROWS * out->words);
}

void cs_map_sums_finish(cs_map_sums *sums, cs_memory *memory) {
  cs_mem_free(memory, sums->sums, CS_MAP_ROWS * ((size_t)sums->width + 1) * sizeof *sums->sums);
  cs_mem_free(memory, sums->bits, CS_MAP_ROWS * sums->words * sizeof *sums->bits);
  cs_mem_free(memory, sums->parts, sums->part_capacity * sizeof *sums->parts);
  *sums = (cs_map_sums){0};
}

void cs_map_rows_finish(cs_map_rows *rows, cs_memory *memory) {
  cs_mem_free(memory, rows->lives, rows->live_capacity * sizeof *rows->lives);
  cs_mem_free(memory, rows->spans, rows->span_capacity * sizeof *rows->spans);
  cs_mem_free(memory, rows->shares, rows->share_capacity * sizeof *rows->shares);
  cs_mem_free(memory, rows->areas, rows->area_capacity * sizeof *rows->areas);
  *rows = (cs_map_rows){0};
}

static void clear(cs_map_sums *sums) {
  memset(sums->sums, 0, CS_MAP_ROWS * ((size_t)sums->width + 1) * sizeof *sums->sums);
  memset(sums->bits, 0, CS_MAP_ROWS * sums->words * sizeof *sums->bits);
}

/* ---------------------------------------------------------------- adding */

/* A border being added to one row. */
typedef struct adding {
  cs_map_sum *sums; /* of the row */
  uint64_t *bits;
  int32_t width;
  cs_v4d step;  /* by how much it changes the colour from its left to its right */
  uint64_t key; /* and the key */
  bool varies;  /* a cell beside it does */
  uint32_t sides[2];
  const cs_map *map;
  celspan_context *context;
  cs_map_sums *all;
} adding;

/* Adds an area to that of the cell on the right, and takes it from that on the left, of those that
 * vary. */
static void add_part(const adding *a, cs_map_sum *sum, int64_t area) {
  cs_map_sums *all = a->all;
  for (int side = 0; side < 2 && area != 0; side++) {
    const cs_map_part part = {side == 0 ? -area : area, a->sides[side], sum->part};
    if (a->map->cells[part.cell].length == 0)
      continue;
    celspan_status status =
        CS_APPEND(a->context, all->parts, all->part_count, all->part_capacity, part);
    if (status == CELSPAN_OK)
      sum->part = (uint32_t)all->part_count;
    else
      all->status = status;
  }
}

static inline void add(const adding *a, int32_t column, int64_t area, int64_t height) {
  cs_map_sum *sum = &a->sums[column];
  cs_v4d here = cs_v4d_scale((double)area, a->step);
  cs_v4d next = cs_v4d_scale((double)(height - area), a->step);
  sum[0].colour = cs_v4d_add(sum[0].colour, here);
  sum[1].colour = cs_v4d_add(sum[1].colour, next);
  sum[0].key += (uint64_t)area * a->key;
  sum[1].key += (uint64_t)(height - area) * a->key;
  if (a->varies) {
    add_part(a, &sum[0], area);
    add_part(a, &sum[1], height - area);
  }
  a->bits[column / 64] |= UINT64_C(1) << column % 64;
  a->bits[(column + 1) / 64] |= UINT64_C(1) << (column + 1) % 64;
}

/* From the line's left end: its height left of x. */
static inline int64_t height_to(double from, double to, int64_t height, double x) {
  return x >= to ? height : (int64_t)((double)height * ((x - from) / (to - from)) + 0.5);
}

/* A line from x = from to x = to, from < to, over several columns, or partly beyond the frame. */
static void add_columns(const adding *a, double from, double to, int64_t height) {
  int64_t done = 0;
  if (from < 0) {
    done = height_to(from, to, height, 0);
    add(a, 0, done, done);
  }
  double x = from < 0 ? 0 : from;
  for (int32_t column = (int32_t)x; x < to && column < a->width; column++) {
    double end = to < column + 1 ? to : column + 1;
    int64_t all = height_to(from, to, height, end);
    double area = (double)(all - done) * (column + 1 - 0.5 * (x + end));
    add(a, column, (int64_t)(area + 0.5), all - done);
    done = all;
    x = end;
  }
}

/* A line within the row, between two places of x. */
static inline void add_line(const adding *a, double xa, double xb, int64_t height) {
  double from = xa < xb ? xa : xb, to = xa < xb ? xb : xa;
  if (from >= a->width || height == 0)
    return;
  if (to <= 0) {
    add(a, 0, height, height);
    return;
  }
  int32_t column = (int32_t)from;
  if (from >= 0 && to <= column + 1)
    add(a, column, (int64_t)((double)height * (column + 1 - 0.5 * (from + to)) + 0.5), height);
  else
    add_columns(a, from, to, height);
}

/* ---------------------------------------------------------------- borders */

typedef struct swath {
  cs_map_sums *sums;
  const cs_map_drawing *drawing;
  int32_t row;
  int64_t top, foot; /* HEIGHTths of a pixel */
} swath;

static inline void choose_row(const swath *s, int64_t row, adding *a) {
  size_t k = (size_t)(row - s->row);
  a->sums = s->sums->sums + k * ((size_t)s->sums->width + 1);
  a->bits = s->sums->bits + k * s->sums->words;
}

/* The part of a line that is in the swath, row by row. */
static void add_rows(const swath *s, adding *a, cs_map_place above, cs_map_place below) {
  double slope = (below.x - above.x) / (double)(below.y - above.y), x = above.x;
  int64_t y = above.y, end = below.y < s->foot ? below.y : s->foot;
  if (y < s->top) {
    x += (double)(s->top - y) * slope;
    y = s->top;
  }
  while (y < end) {
    int64_t row = y / CS_MAP_HEIGHT, foot = (row + 1) * CS_MAP_HEIGHT;
    foot = foot < end ? foot : end;
    double next = foot == below.y ? below.x : above.x + (double)(foot - above.y) * slope;
    choose_row(s, row, a);
    add_line(a, x, next, foot - y);
    x = next;
    y = foot;
  }
}

uint32_t cs_map_find_point(const cs_map_drawing *drawing, const cs_map_border *border,
                           int32_t row) {
  const cs_map_point *points = drawing->lines->points + border->first;
  uint32_t low = 0, high = border->count;
  while (high - low > 1) {
    uint32_t middle = low + (high - low) / 2;
    if (cs_map_place_y(drawing, points[middle].y) <= row)
      low = middle;
    else
      high = middle;
  }
  return low;
}

/* Adds what a border has in the swath; live->at becomes the point where the next one begins. */
static void add_border(celspan_context *context, const swath *s, cs_map_live *live) {
  const cs_map *map = s->drawing->map;
  const cs_map_border *f = &s->drawing->lines->borders[live->border];
  const cs_map_point *points = s->drawing->lines->points + f->first;
  const cs_v4 *colours = s->drawing->colours;
  const cs_map_cell *left = &map->cells[f->left], *right = &map->cells[f->right];
  adding a = {.width = s->sums->width,
              .step = cs_v4d_step(colours[f->left], colours[f->right]),
              .key = right->key - left->key,
              .varies = left->length > 0 || right->length > 0,
              .sides = {f->left, f->right},
              .map = map,
              .context = context,
              .all = s->sums};
  uint32_t at = live->at;
  cs_map_place above = cs_map_place_of(s->drawing, points[at]);
  while (at + 1 < f->count && above.y < s->foot) {
    cs_map_place below = cs_map_place_of(s->drawing, points[at + 1]);
    if (below.y > s->top && below.y > above.y)
      add_rows(s, &a, above, below);
    if (below.y > s->foot)
      break;
    above = below;
    at++;
  }
  live->at = at;
}

/* ---------------------------------------------------------------- which borders */

/* Drops the borders that end above the swath. */
static void drop_lives(const swath *s, cs_map_rows *rows) {
  const cs_map_lines *lines = s->drawing->lines;
  size_t kept = 0;
  for (size_t i = 0; i < rows->live_count; i++) {
    const cs_map_border *f = &lines->borders[rows->lives[i].border];
    if (cs_map_place_y(s->drawing, f->foot) > s->row)
      rows->lives[kept++] = rows->lives[i];
  }
  rows->live_count = kept;
}

/* Adds the borders that begin above the foot of the swath. */
static celspan_status add_lives(celspan_context *context, const swath *s, cs_map_rows *rows) {
  const cs_map_lines *lines = s->drawing->lines;
  int32_t end = s->row + CS_MAP_ROWS;
  for (; rows->next < lines->border_count; rows->next++) {
    const cs_map_border *f = &lines->borders[rows->next];
    if (cs_map_place_y(s->drawing, lines->points[f->first].y) >= end)
      return CELSPAN_OK;
    if (cs_map_place_y(s->drawing, f->foot) > s->row &&
        cs_map_place_x(s->drawing, f->low) < s->sums->width)
      CS_TRY(CS_APPEND(context, rows->lives, rows->live_count, rows->live_capacity,
                       (cs_map_live){rows->next, cs_map_find_point(s->drawing, f, s->row)}));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- spans */

/* The cell that alone is in a pixel; BROKEN: several are. */
static inline uint32_t cell_of(const cs_map *map, uint64_t key) {
  uint64_t cell = key / CS_MAP_HEIGHT % CS_MAP_CELLS;
  return cell < map->cell_count && map->cells[cell].key * CS_MAP_HEIGHT == key ? (uint32_t)cell
                                                                               : CS_MAP_BROKEN;
}

/* From a column on, until the next one that is put, the pixels of a row are of this kind. first:
 * the row's spans. NULL: they are as those before. */
static inline cs_map_span *put(cs_map_rows *rows, size_t first, int32_t column, cs_map_span span) {
  if (column == 0)
    rows->span_count = first;
  if (rows->span_count > first) {
    cs_map_span *last = &rows->spans[rows->span_count - 1];
    if (last->cell == span.cell && span.cell != CS_MAP_BROKEN)
      return NULL;
    last->end = column;
  }
  rows->spans[rows->span_count] = span;
  return &rows->spans[rows->span_count++];
}

/* Adds a part to the areas of the cells. */
static celspan_status add_area(celspan_context *context, cs_map_rows *rows,
                               const cs_map_part *part) {
  size_t i = 0;
  while (i < rows->area_count && rows->areas[i].cell != part->cell)
    i++;
  if (i == rows->area_count)
    return CS_APPEND(context, rows->areas, rows->area_count, rows->area_capacity,
                     (cs_map_area){part->cell, part->area});
  rows->areas[i].area += part->area;
  if (rows->areas[i].area == 0) {
    size_t after = --rows->area_count - i;
    memmove(&rows->areas[i], &rows->areas[i + 1], after * sizeof *rows->areas);
  }
  return CELSPAN_OK;
}

/* Adds the parts of a pixel, from one of them on. */
static celspan_status add_areas(celspan_context *context, const cs_map_sums *sums,
                                cs_map_rows *rows, uint32_t part) {
  for (; part > 0; part = sums->parts[part - 1].next)
    CS_TRY(add_area(context, rows, &sums->parts[part - 1]));
  return CELSPAN_OK;
}

/* Gives a span what varies in it. */
static celspan_status add_shares(celspan_context *context, cs_map_rows *rows, cs_map_span *span) {
  span->share = (uint32_t)rows->share_count;
  span->share_count = (uint32_t)rows->area_count;
  CS_TRY(CS_RESERVE(context, rows->shares, rows->share_capacity,
                    rows->share_count + rows->area_count));
  for (size_t i = 0; i < rows->area_count; i++)
    rows->shares[rows->share_count++] = (cs_map_share){
        rows->areas[i].cell, (float)((double)rows->areas[i].area * (1.0 / CS_MAP_HEIGHT))};
  return CELSPAN_OK;
}

/* Adds what a pixel has, and clears it there. Returns the pixel. */
static inline cs_map_span read_pixel(const cs_map_drawing *drawing, cs_map_sum *sum,
                                     cs_map_sum *pixel) {
  sum->colour = cs_v4d_add(sum->colour, pixel->colour);
  sum->key += pixel->key;
  *pixel = (cs_map_sum){0};
  uint32_t cell = cell_of(drawing->map, sum->key);
  if (cell == CS_MAP_BROKEN)
    return (cs_map_span){.colour = cs_v4_narrow(cs_v4d_scale(1.0 / CS_MAP_HEIGHT, sum->colour)),
                         .cell = cell};
  sum->colour = cs_v4d_scale(CS_MAP_HEIGHT, cs_v4_wide(drawing->colours[cell]));
  return (cs_map_span){.colour = drawing->colours[cell], .cell = cell};
}

/* The spans of a row; its sums are cleared. varies: a constant of each of the two callers, since
 * most maps have no parts to be read. */
static inline celspan_status read_row(celspan_context *context, cs_map_sums *sums,
                                      cs_map_rows *rows, size_t k, bool varies) {
  const cs_map_drawing *drawing = rows->drawing;
  cs_map_sum *pixels = sums->sums + k * ((size_t)sums->width + 1);
  uint64_t *bits = sums->bits + k * sums->words;
  size_t first = rows->span_count, most = 1;
  for (size_t i = 0; i < sums->words; i++)
    most += (size_t)__builtin_popcountll(bits[i]);
  CS_TRY(CS_RESERVE(context, rows->spans, rows->span_capacity, first + most));
  cs_map_sum sum = {cs_v4d_scale(CS_MAP_HEIGHT, cs_v4_wide(drawing->colours[0])),
                    drawing->map->cells[0].key * CS_MAP_HEIGHT, 0};
  rows->area_count = 0;
  put(rows, first, 0, (cs_map_span){.colour = drawing->colours[0]});
  for (size_t i = 0; i < sums->words; bits[i++] = 0)
    for (uint64_t word = bits[i]; word; word &= word - 1) {
      int32_t column = (int32_t)(64 * i) + __builtin_ctzll(word);
      const uint32_t part = varies ? pixels[column].part : 0;
      cs_map_span span = read_pixel(drawing, &sum, &pixels[column]), *added = NULL;
      if (part > 0)
        CS_TRY(add_areas(context, sums, rows, part));
      if (column < sums->width)
        added = put(rows, first, column, span);
      if (varies && added && rows->area_count > 0)
        CS_TRY(add_shares(context, rows, added));
    }
  rows->spans[rows->span_count - 1].end = sums->width;
  return CELSPAN_OK;
}

static celspan_status read_rows(celspan_context *context, cs_map_sums *sums, cs_map_rows *rows) {
  const bool varies = rows->drawing->stack.layer_count > 0;
  rows->span_count = rows->share_count = 0;
  for (size_t k = 0; k < CS_MAP_ROWS; k++) {
    rows->first[k] = rows->span_count;
    if (varies)
      CS_TRY(read_row(context, sums, rows, k, true));
    else
      CS_TRY(read_row(context, sums, rows, k, false));
  }
  rows->first[CS_MAP_ROWS] = rows->span_count;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- a swath */

/* Goes back to the first border, or keeps those that cross the swath above. */
static void go_to(cs_map_rows *rows, int32_t row) {
  const cs_map_drawing *drawing = rows->drawing;
  if (rows->row < 0 || row < rows->row)
    rows->next = 0;
  if (rows->next == 0)
    rows->live_count = 0;
  for (size_t i = 0; i < rows->live_count && row != rows->row + CS_MAP_ROWS; i++) {
    cs_map_live *live = &rows->lives[i];
    live->at = cs_map_find_point(drawing, &drawing->lines->borders[live->border], row);
  }
  rows->row = -1;
}

celspan_status cs_map_rows_make(celspan_context *context, cs_map_sums *sums, cs_map_rows *rows,
                                int32_t row) {
  const swath s = {sums, rows->drawing, row, (int64_t)row * CS_MAP_HEIGHT,
                   ((int64_t)row + CS_MAP_ROWS) * CS_MAP_HEIGHT};
  go_to(rows, row);
  drop_lives(&s, rows);
  CS_TRY(add_lives(context, &s, rows));
  sums->part_count = 0;
  sums->status = CELSPAN_OK;
  for (size_t i = 0; i < rows->live_count; i++)
    add_border(context, &s, &rows->lives[i]);
  celspan_status status =
      sums->status == CELSPAN_OK ? read_rows(context, sums, rows) : sums->status;
  if (status == CELSPAN_OK)
    rows->row = row;
  else
    clear(sums);
  return status;
}
