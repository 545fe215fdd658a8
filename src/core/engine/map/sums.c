#include "engine/map/sums.h"

#include "engine/map/adding.h"
#include "engine/map/reading.h"

/* ---------------------------------------------------------------- life */

static size_t sums_size(const cs_map_sums *sums) {
  return CS_MAP_ROWS * ((size_t)sums->width + 1) * sizeof *sums->sums;
}

static size_t storage_size(const cs_map_sums *sums) { return CS_WIDE_LINE + sums_size(sums); }

/* One word more than the rows need, because bits are marked four bytes at a time. */
static size_t bit_words(const cs_map_sums *sums) { return CS_MAP_ROWS * sums->words + 1; }

celspan_status cs_map_sums_init(celspan_context *context, int32_t width, cs_map_sums *out) {
  *out = (cs_map_sums){
      .isa = cs_isa_best(), .width = width, .words = ((size_t)width / 64 + 4) / 4 * 4};
  out->storage = cs_mem_array(context->memory, storage_size(out), 1);
  if (!out->storage)
    return cs_fail_memory(context);
  out->sums = cs_wide_align(out->storage);
  CS_TRY(CS_MAKE(context, out->columns, (size_t)width));
  return CS_MAKE(context, out->bits, bit_words(out));
}

void cs_map_sums_finish(cs_map_sums *sums, cs_memory *memory) {
  cs_mem_free(memory, sums->storage, storage_size(sums));
  cs_mem_free(memory, sums->columns, (size_t)sums->width * sizeof *sums->columns);
  cs_mem_free(memory, sums->bits, bit_words(sums) * sizeof *sums->bits);
  cs_mem_free(memory, sums->parts, sums->part_capacity * sizeof *sums->parts);
  *sums = (cs_map_sums){0};
}

void cs_map_rows_finish(cs_map_rows *rows, cs_memory *memory) {
  cs_mem_free(memory, rows->lives, rows->live_capacity * sizeof *rows->lives);
  cs_mem_free(memory, rows->places, rows->place_capacity * sizeof *rows->places);
  cs_mem_free(memory, rows->spans, rows->span_capacity * sizeof *rows->spans);
  cs_mem_free(memory, rows->through, rows->through_capacity * sizeof *rows->through);
  cs_mem_free(memory, rows->shares, rows->share_capacity * sizeof *rows->shares);
  cs_mem_free(memory, rows->areas, rows->area_capacity * sizeof *rows->areas);
  cs_mem_free(memory, rows->near, rows->near_capacity * sizeof *rows->near);
  *rows = (cs_map_rows){0};
}

static void clear(cs_map_sums *sums) {
  memset(sums->sums, 0, sums_size(sums));
  memset(sums->bits, 0, bit_words(sums) * sizeof *sums->bits);
  sums->unread = 0;
}

/* Clears the rows that nobody has asked for. */
static void clear_unread(cs_map_sums *sums) {
  for (; sums->unread; sums->unread &= sums->unread - 1)
    CS_WIDE_CHOOSE(sums->isa, cs_map_clear_row)(sums, (size_t)__builtin_ctz(sums->unread));
}

/* ---------------------------------------------------------------- which borders */

/* The swath that is being made. */
typedef struct swath {
  celspan_context *context;
  cs_map_sums *sums;
  cs_map_rows *rows;
  const cs_map_drawing *drawing;
  cs_map_placing placing;
  int32_t row, top, foot; /* top, foot: in places */
} swath;

static swath begin_swath(celspan_context *context, cs_map_sums *sums, cs_map_rows *rows,
                         int32_t row) {
  const cs_map_drawing *d = rows->drawing;
  swath s = {.context = context, .sums = sums, .rows = rows, .drawing = d, .row = row};
  s.top = row * CS_MAP_UNIT;
  s.foot = s.top + CS_MAP_ROWS * CS_MAP_UNIT;
  for (int lane = 0; lane < 4; lane++) {
    bool is_x = lane % 2 == 0;
    s.placing.origin[lane] = (double)(is_x ? d->left : d->top) * CS_MAP_UNIT;
    s.placing.scale[lane] = (is_x ? d->scale_x : d->scale_y) * CS_MAP_UNIT;
    s.placing.shift[lane] = (is_x ? d->shift_x : d->shift_y) * CS_MAP_UNIT + 0.5;
  }
  return s;
}

/* There is room for one point more. */
static void put_places(const swath *s, const cs_map_point *points, size_t count,
                       cs_map_point *out) {
  CS_WIDE_CHOOSE(s->sums->isa, cs_map_put_places)(&s->placing, points, count, out);
}

/* The first line of a live border, from a place on, that is in the swath. */
static uint32_t find_place(const swath *s, const cs_map_live *live, uint32_t from) {
  const cs_map_point *places = s->rows->places;
  uint32_t low = from, high = live->end;
  while (high - low > 1) {
    uint32_t middle = low + (high - low) / 2;
    if (places[middle].y <= s->top)
      low = middle;
    else
      high = middle;
  }
  return low;
}

/* Moves the places of the live borders to the front of their array. */
static void pack_places(cs_map_rows *rows) {
  uint32_t count = 0;
  for (size_t i = 0; i < rows->live_count; i++) {
    cs_map_live *live = &rows->lives[i];
    uint32_t kept = live->end - live->at;
    memmove(rows->places + count, rows->places + live->at, kept * sizeof *rows->places);
    live->at = count;
    count += kept;
    live->end = count;
  }
  rows->place_count = count;
}

/* Removes the borders that end above the swath. */
static void drop_lives(const swath *s) {
  cs_map_rows *rows = s->rows;
  size_t kept = 0, places = 0;
  for (size_t i = 0; i < rows->live_count; i++) {
    const cs_map_live *live = &rows->lives[i];
    if (live->foot > s->top) {
      places += live->end - live->at;
      rows->lives[kept++] = *live;
    }
  }
  rows->live_count = kept;
  if (rows->place_count > 2 * places)
    pack_places(rows);
}

/* The difference of the cells' colours from the left to the right of a border. */
static void find_step(const cs_v4 *colours, const cs_map_border *f, cs_map_live *live) {
  cs_v4_store(live->step, (colours[f->right] - colours[f->left]) * (1.0f / CS_MAP_HEIGHT));
}

/* The same for keys; also whether a cell on one side of the border varies. */
static void find_change(const cs_map_drawing *drawing, const cs_map_border *f, cs_map_live *live) {
  const cs_map_cell *left = &drawing->map->cells[f->left], *right = &drawing->map->cells[f->right];
  live->varies = left->length > 0 || right->length > 0;
  live->key = right->key - left->key;
}

/* The places of a border are appended to the others. box: its lowest and its highest place. If a
 * border is left of the frame, only its heights count. */
static celspan_status add_live(const swath *s, uint32_t number, const cs_map_point *box) {
  cs_map_rows *rows = s->rows;
  const cs_map_lines *lines = s->drawing->lines;
  const cs_map_border *f = &lines->borders[number];
  const bool is_outside = box[1].x < 0;
  const cs_map_point *points = lines->points + f->first;
  uint32_t first = (uint32_t)rows->place_count, count = is_outside ? 2 : f->count;
  cs_map_live live = {.border = number,
                      .at = first,
                      .end = first + count,
                      .low = box[0].x,
                      .high = box[1].x,
                      .foot = box[1].y};
  find_change(s->drawing, f, &live);
  find_step(s->drawing->colours, f, &live);
  CS_TRY(CS_RESERVE(s->context, rows->places, rows->place_capacity, first + count + 1));
  if (is_outside)
    memcpy(rows->places + first, box, 2 * sizeof *box);
  else
    put_places(s, points, count, rows->places + first);
  if (rows->places[first].y < s->top)
    live.at = find_place(s, &live, first);
  rows->place_count = live.end;
  return CS_APPEND(s->context, rows->lives, rows->live_count, rows->live_capacity, live);
}

/* Adds the borders that begin above the foot of the swath. */
static celspan_status add_lives(const swath *s) {
  cs_map_rows *rows = s->rows;
  const cs_map_lines *lines = s->drawing->lines;
  for (; rows->next < lines->border_count; rows->next++) {
    const cs_map_border *f = &lines->borders[rows->next];
    const cs_map_point ends[2] = {{f->low, lines->points[f->first].y}, {f->high, f->foot}};
    cs_map_point box[3];
    put_places(s, ends, 2, box);
    if (box[0].y >= s->foot)
      return CELSPAN_OK;
    if (box[1].y > s->top && box[0].x / CS_MAP_UNIT < s->sums->width)
      CS_TRY(add_live(s, rows->next, box));
  }
  return CELSPAN_OK;
}

/* Goes back to the first border, or keeps the borders that cross the swath above. */
static void go_to(const swath *s) {
  cs_map_rows *rows = s->rows;
  if (rows->row < 0 || s->row < rows->row)
    rows->next = 0;
  if (rows->next == 0)
    rows->live_count = 0;
  bool is_next = s->row == rows->row + CS_MAP_ROWS;
  for (size_t i = 0; i < rows->live_count; i++) {
    cs_map_live *live = &rows->lives[i];
    live->at = is_next ? live->next : find_place(s, live, live->at);
  }
  rows->row = -1;
}

/* ---------------------------------------------------------------- a swath */

/* Finds the borders that cross the swath. */
static celspan_status find_lives(const swath *s) {
  clear_unread(s->sums);
  go_to(s);
  drop_lives(s);
  CS_TRY(add_lives(s));
  s->sums->part_count = 0;
  s->rows->width = s->sums->width;
  s->rows->has_near = false;
  return CELSPAN_OK;
}

static celspan_status add_all(const swath *s) {
  celspan_status status = CELSPAN_OK;
  const cs_map_adding adding = {s->context, s->sums, s->rows, s->row, &status};
  CS_WIDE_CHOOSE(s->sums->isa, cs_map_add)(&adding);
  return status;
}

static celspan_status make_rows(const swath *s, const cs_v4 *colours) {
  CS_TRY(add_all(s));
  return CS_WIDE_CHOOSE(s->sums->isa, cs_map_read)(s->context, s->sums, colours, s->rows);
}

static void find_steps(const swath *s, const cs_v4 *colours) {
  for (size_t i = 0; i < s->rows->live_count; i++) {
    cs_map_live *live = &s->rows->lives[i];
    find_step(colours, &s->drawing->lines->borders[live->border], live);
  }
}

/* The transmission of the spans. Its spans are made like the spans of colours, and end at the same
 * columns, because keys alone decide where a span ends. */
static celspan_status make_through(const swath *s) {
  cs_map_rows *rows = s->rows;
  find_steps(s, s->drawing->through);
  CS_TRY(make_rows(s, s->drawing->through));
  CS_TRY(CS_RESERVE(s->context, rows->through, rows->through_capacity, rows->span_count));
  for (size_t i = 0; i < rows->span_count; i++)
    rows->through[i] = rows->spans[i].colour;
  find_steps(s, s->drawing->colours);
  return CELSPAN_OK;
}

celspan_status cs_map_rows_make(celspan_context *context, cs_map_sums *sums, cs_map_rows *rows,
                                int32_t row) {
  const swath s = begin_swath(context, sums, rows, row);
  CS_TRY(find_lives(&s));
  celspan_status status = s.drawing->through ? make_through(&s) : CELSPAN_OK;
  if (status == CELSPAN_OK)
    status = make_rows(&s, s.drawing->colours);
  if (status == CELSPAN_OK)
    rows->row = row;
  else
    clear(sums);
  return status;
}

celspan_status cs_map_rows_sum(celspan_context *context, cs_map_sums *sums, cs_map_rows *rows,
                               int32_t row) {
  const swath s = begin_swath(context, sums, rows, row);
  CS_TRY(find_lives(&s));
  CS_TRY(add_all(&s));
  sums->unread = (1U << CS_MAP_ROWS) - 1;
  rows->row = row;
  return CELSPAN_OK;
}
