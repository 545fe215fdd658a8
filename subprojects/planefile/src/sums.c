#include "sums.h"

#include <math.h>

enum { ROOM = 1 << 20 /* bytes of slots, about */ };
#define PIXEL INT64_C(65536) /* PF_HEIGHTths of a pixel across, too */
/* 1.5 * 2^52 * PF_HEIGHT: a sum plus it has a whole number of PF_HEIGHTs, and that in its last bits.
 */
#define ROUNDING 442721857769029238784.0

/* ---------------------------------------------------------------- life */

bool pf_sums_init(pf_sums *s, const planefile_plane *plane, const planefile_view *view) {
  *s = (pf_sums){.plane = plane, .view = *view, .left = view->x};
  s->right = s->left + view->columns;
  size_t width = view->columns, rows = ROOM / (width * sizeof *s->slots);
  rows = rows < view->rows ? rows : view->rows;
  s->rows = rows < 1 ? 1 : rows > PF_ROWS ? PF_ROWS : (uint32_t)rows;
  s->words = (width + 63) / 64;
  s->slots = pf_make(&plane->memory, sizeof *s->slots, width * s->rows);
  s->bits = pf_make(&plane->memory, sizeof *s->bits, s->words * s->rows);
  s->spans = pf_make(&plane->memory, sizeof *s->spans, width);
  return s->slots && s->bits && s->spans &&
         (!plane->info.varies || pf_varied_init(&s->varied, plane, view->columns, s->rows));
}

void pf_sums_finish(pf_sums *s) {
  const pf_memory *memory = &s->plane->memory;
  size_t width = s->view.columns;
  pf_free(memory, s->slots, sizeof *s->slots, width * s->rows);
  pf_free(memory, s->bits, sizeof *s->bits, s->words * s->rows);
  pf_free(memory, s->spans, sizeof *s->spans, width);
  pf_varied_finish(&s->varied);
}

/* ---------------------------------------------------------------- what is added */

static inline void add(double sums[4], const pf_step *change, double share) {
  for (int c = 0; c < 4; c++)
    sums[c] += change->colour[c] * share;
}

/* Adds to the shares of the cells that vary, at a column of the crop and the one after it. */
static void add_varied(pf_sums *s, const pf_pen *pen, uint32_t column, int64_t area) {
  const uint32_t cells[2] = {pen->change->left, pen->change->right};
  for (int side = 0; side < 2; side++) {
    int64_t sign = side == 0 ? -1 : 1;
    if (cells[side] == PF_NO_CELL)
      continue;
    pf_varied_add(&s->varied, pen->row, column, cells[side], sign * area);
    if (area == pen->height || column + 1 == s->view.columns)
      continue;
    pf_varied_add(&s->varied, pen->row, column + 1, cells[side], sign * (pen->height - area));
    s->bits[pen->row * s->words + (column + 1) / 64] |= UINT64_C(1) << (column + 1) % 64;
  }
}

static inline bool varies(const pf_step *change) {
  return (change->left & change->right) != PF_NO_CELL;
}

static void lift(pf_sums *s, pf_pen pen) {
  if (pen.height == 0 || pen.column >= s->right)
    return;
  if (pen.column < s->left) {
    int64_t y = pen.row * PIXEL;
    pf_sums_draw_left(s, y, y + pen.height, pen.change);
    return;
  }
  uint32_t column = (uint32_t)(pen.column - s->left);
  int64_t area = (pen.area + PIXEL) >> 17;
  pf_slot *slot = &s->slots[(size_t)pen.row * s->view.columns + column];
  add(slot->area, pen.change, (double)area);
  add(slot->height, pen.change, (double)pen.height);
  s->bits[pen.row * s->words + column / 64] |= UINT64_C(1) << column % 64;
  if (varies(pen.change))
    add_varied(s, &pen, column, area);
}

void pf_sums_lift(pf_sums *s, const pf_pen *pen) { lift(s, *pen); }

void pf_sums_draw_left(pf_sums *s, int64_t y, int64_t foot, const pf_step *change) {
  uint32_t first = (uint32_t)(y / PIXEL), last = (uint32_t)(foot / PIXEL);
  int64_t above = y % PIXEL, below = foot % PIXEL;
  add(s->leads[first].colour, change, (double)(PIXEL - above));
  add(s->leads[first + 1].colour, change, (double)above);
  add(s->leads[last].colour, change, (double)(below - PIXEL));
  add(s->leads[last + 1].colour, change, (double)-below);
  for (uint32_t row = first; varies(change) && row <= last && row < s->rows; row++) {
    int64_t height = (row == last ? below : PIXEL) - (row == first ? above : 0);
    const pf_pen pen = {.change = change, .height = height, .row = row};
    add_varied(s, &pen, 0, height);
    s->bits[row * s->words] |= 1;
  }
}

void pf_sums_add_start(pf_sums *s, const pf_step *change) {
  add(s->start.colour, change, PIXEL);
  if (change->left != PF_NO_CELL)
    pf_varied_add_start(&s->varied, change->left, -PIXEL);
  if (change->right != PF_NO_CELL)
    pf_varied_add_start(&s->varied, change->right, PIXEL);
}

/* ---------------------------------------------------------------- lines */

/* Collects a part of a line within a column. beside: what is left of it at its ends, together. */
static inline void collect(pf_sums *s, pf_pen *pen, uint32_t row, int64_t column, int64_t height,
                           int64_t beside) {
  if (pen->column != column || pen->row != row) {
    lift(s, *pen);
    *pen = (pf_pen){.change = pen->change, .column = column, .row = row};
  }
  pen->area += height * (2 * PIXEL - beside);
  pen->height += height;
}

static inline int64_t clamp(int64_t at, int64_t low, int64_t high) {
  return at < low ? low : at > high ? high : at;
}

/* A line from x to another one that is in another column. from, to: their columns, or those beside
 * the crop. */
static inline void draw_across(pf_sums *s, pf_pen *pen, uint32_t row, const int64_t x[2], int64_t from,
                        int64_t to, int64_t height) {
  int64_t way = x[1] > x[0] ? 1 : -1, far = x[1] > x[0] ? PIXEL : 0;
  int64_t done = 0, beside = x[0] & (PIXEL - 1);
  double slope = (double)height / (double)((x[1] - x[0]) * way);
  for (int64_t column = from; column != to; column += way) {
    int64_t edge = column * PIXEL + far;
    int64_t y = (int64_t)((double)((edge - x[0]) * way) * slope);
    collect(s, pen, row, column, y - done, beside + far);
    done = y;
    beside = PIXEL - far;
  }
  collect(s, pen, row, to, height - done, beside + (x[1] & (PIXEL - 1)));
}

/* A line within a row. */
static inline void draw_line(pf_sums *s, pf_pen *pen, uint32_t row, int64_t x0, int64_t x1,
                             int64_t height) {
  int64_t from = clamp(x0 >> 16, s->left - 1, s->right);
  int64_t to = clamp(x1 >> 16, s->left - 1, s->right);
  if (from == to)
    collect(s, pen, row, from, height, (x0 & (PIXEL - 1)) + (x1 & (PIXEL - 1)));
  else
    draw_across(s, pen, row, (int64_t[2]){x0, x1}, from, to, height);
}

/* A line that crosses the height of a row's centres changes all pixels whose centre is right of
 * it. */
static void draw_centre(pf_sums *s, const pf_pen *pen, uint32_t row, int64_t x) {
  int64_t column = clamp((x + PIXEL / 2 - 1) >> 16, s->left - 1, s->right);
  lift(s, (pf_pen){pen->change, column, 2 * PIXEL * PIXEL, PIXEL, row});
}

static inline int64_t x_at(const pf_chord *chord, int64_t y) {
  if (y == chord->y1)
    return (int64_t)chord->x1;
  return (int64_t)(chord->x0 + chord->slope * (double)(y - chord->y0));
}

static void draw_centres(pf_sums *s, const pf_pen *pen, const pf_chord *chord, int64_t y,
                         int64_t foot, int64_t top) {
  int64_t row = (y - top + PIXEL / 2 - 1) >> 16, centre;
  for (; (centre = top + row * PIXEL + PIXEL / 2) < foot; row++)
    draw_centre(s, pen, (uint32_t)row, x_at(chord, centre));
}

void pf_sums_draw(pf_sums *s, pf_pen *pen, const pf_chord *chord, int64_t y, int64_t foot,
                  int64_t top) {
  pf_pen at = *pen; /* a copy is kept in registers */
  int64_t x = x_at(chord, y);
  if (s->view.sampling != PLANEFILE_AREA) {
    draw_centres(s, pen, chord, y, foot, top);
    return;
  }
  for (int64_t row = (y - top) >> 16; y < foot; row++) {
    int64_t end = top + (row + 1) * PIXEL;
    end = end < foot ? end : foot;
    int64_t next = x_at(chord, end);
    draw_line(s, &at, (uint32_t)row, x, next, end - y);
    x = next;
    y = end;
  }
  *pen = at;
}

/* ---------------------------------------------------------------- rows */

void pf_sums_begin(pf_sums *s) {
  memset(s->leads, 0, sizeof s->leads);
  s->lead = s->start;
  if (s->plane->info.varies)
    pf_varied_begin(&s->varied);
}

static inline uint32_t lowest_bit(uint64_t bits) {
#if defined(__GNUC__)
  return (uint32_t)__builtin_ctzll(bits);
#else
  uint32_t at = 0;
  for (; !(bits & 1); bits >>= 1)
    at++;
  return at;
#endif
}

/* The colour of a sum: to the nearest, whatever it is. */
static inline planefile_cell colour_of(const double sums[4]) {
  planefile_cell out;
  for (int c = 0; c < 4; c++) {
    double rounded = sums[c] + ROUNDING;
    uint64_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    out.colour[c] = (int32_t)(uint32_t)bits;
  }
  return out;
}

static inline bool is_same(const planefile_cell *a, const planefile_cell *b) {
  return memcmp(a, b, sizeof *a) == 0;
}

/* Spans of the row being read, so far. */
typedef struct reading {
  pf_sums *sums;
  uint32_t row, end; /* row: of the crop; end: of the latest span */
  size_t count;
} reading;

static inline void put_span(reading *r, uint32_t end, const double sums[4]) {
  planefile_span *spans = r->sums->spans;
  planefile_cell colour = colour_of(sums);
  size_t at = r->count > 0 && is_same(&spans[r->count - 1].colour, &colour) ? r->count - 1 : r->count;
  spans[at] = (planefile_span){end, colour};
  r->count = at + 1;
  r->end = end;
}

/* Where cells vary each pixel is a span. */
static void paint_pixels(reading *r, uint32_t end, const double flat[4]) {
  pf_sums *s = r->sums;
  for (uint32_t size; r->end < end; r->end += size, r->count += size) {
    size = end - r->end < PF_BATCH ? end - r->end : PF_BATCH;
    pf_pixels pixels = {s->view.width, s->view.height, s->view.x + r->end, s->view.y + r->row,
                        size};
    planefile_span *spans = &s->spans[r->count];
    pf_varied_paint(&s->varied, &pixels, flat, spans);
    for (uint32_t k = 0; k < size; k++) {
      spans[k].end = r->end + k + 1;
      if (s->plane->info.is_opaque)
        spans[k].colour.colour[3] = PLANEFILE_WHITE;
    }
  }
}

static inline void put_part(reading *r, uint32_t end, const double sums[4]) {
  if (r->end < end && r->sums->varied.active_count > 0)
    paint_pixels(r, end, sums);
  else if (r->end < end)
    put_span(r, end, sums);
}

/* Puts a column to which something was added, and what is before it; forgets what was added. */
static inline void put_column(reading *r, uint32_t made, uint32_t column, double total[4]) {
  pf_sums *s = r->sums;
  pf_slot *slot = &s->slots[(size_t)made * s->view.columns + column];
  double sums[4];
  put_part(r, column, total);
  if (s->plane->info.varies)
    pf_varied_take(&s->varied, made, column);
  for (int c = 0; c < 4; c++) {
    sums[c] = total[c] + slot->area[c];
    total[c] += slot->height[c];
  }
  *slot = (pf_slot){{0}, {0}};
  put_part(r, column + 1, sums);
}

size_t pf_sums_read(pf_sums *s, uint32_t row, uint32_t made) {
  reading r = {.sums = s, .row = row};
  double total[4];
  if (s->plane->info.varies)
    pf_varied_begin_row(&s->varied);
  for (int c = 0; c < 4; c++)
    total[c] = s->lead.colour[c] += s->leads[made].colour[c];
  for (size_t word = 0; word < s->words; word++) {
    uint64_t bits = s->bits[made * s->words + word];
    s->bits[made * s->words + word] = 0;
    for (; bits; bits &= bits - 1)
      put_column(&r, made, (uint32_t)word * 64 + lowest_bit(bits), total);
  }
  put_part(&r, s->view.columns, total);
  return r.count;
}
