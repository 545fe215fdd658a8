#include "sums.h"

#include <math.h>

enum { ROOM = 1 << 20 /* bytes of slots, about */, WORDS = 8 /* of bits, read together */ };
#define UPRIGHT 1e-9         /* what is not more slanted, as dx / dy, is in one column */
#define PIXEL INT64_C(65536) /* PF_HEIGHTths of a pixel across, too */
/* 1.5 * 2^52 * PF_HEIGHT: a sum plus it is a whole number of PF_HEIGHTs: its last bits. */
#define ROUNDING 442721857769029238784.0

/* The next loop has no jumps even where all else is compiled to be small: it becomes vectors. */
#if defined(__clang__)
#define UNROLLED _Pragma("clang loop unroll(full)")
#else
#define UNROLLED
#endif

/* ---------------------------------------------------------------- life */

/* Slots are made when something is drawn: most tiles of a huge frame have one colour. */
static bool make_room(pf_sums *s) {
  if (!s->slots)
    s->slots = pf_make(&s->plane->memory, sizeof *s->slots, (size_t)s->view.columns * s->rows);
  s->failed |= !s->slots;
  return s->slots != NULL;
}

bool pf_sums_init(pf_sums *s, const planefile_plane *plane, const planefile_view *view) {
  *s = (pf_sums){.plane = plane, .view = *view, .left = view->x};
  s->right = s->left + view->columns;
  size_t width = view->columns, rows = ROOM / (width * sizeof *s->slots);
  rows = rows < view->rows ? rows : view->rows;
  s->rows = rows < 1 ? 1 : rows > PF_ROWS ? PF_ROWS : (uint32_t)rows;
  s->words = (width + 64 * WORDS - 1) / (64 * WORDS) * WORDS;
  s->bits = pf_make(&plane->memory, sizeof *s->bits, s->words * s->rows);
  s->spans = pf_make(&plane->memory, sizeof *s->spans, width);
  if (!plane->info.varies)
    return s->bits && s->spans;
  return s->bits && s->spans && make_room(s) &&
         pf_varied_init(&s->varied, plane, view->columns, s->rows);
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
  double out[4]; /* so that nothing is stored before all is loaded */
  UNROLLED
  for (int c = 0; c < 4; c++)
    out[c] = sums[c] + change->colour[c] * share;
  memcpy(sums, out, sizeof out);
}

static inline bool varies(const pf_step *change) {
  return (change->left & change->right) != PF_NO_CELL;
}

/* Marks a column of a row, if a bit is 1. */
static inline void mark(pf_sums *s, uint32_t row, uint32_t column, uint64_t bit) {
  s->bits[row * s->words + column / 64] |= bit << column % 64;
}

/* A part of a line in a pixel of the crop. area: right of it. */
typedef struct part {
  uint32_t row, column;
  int64_t area, height;
} part;

/* Adds to the shares of the cells that vary, at a column and the one after it. */
static void add_varied(pf_sums *s, const pf_step *change, const part *p) {
  const uint32_t cells[2] = {change->left, change->right};
  for (int side = 0; side < 2; side++) {
    int64_t sign = side == 0 ? -1 : 1;
    if (cells[side] == PF_NO_CELL)
      continue;
    pf_varied_add(&s->varied, p->row, p->column, cells[side], sign * p->area);
    if (p->area == p->height || p->column + 1 == s->view.columns)
      continue;
    pf_varied_add(&s->varied, p->row, p->column + 1, cells[side], sign * (p->height - p->area));
    mark(s, p->row, p->column + 1, 1);
  }
}

/* The area right of a part. beside: what is left of it at its ends, together. */
static inline int64_t area_of(int64_t height, int64_t beside) {
  return (height * (2 * PIXEL - beside) + PIXEL) >> 17;
}

static inline void add_to(pf_slot *slot, const pf_step *change, int64_t area, int64_t height) {
  add(slot->area, change, (double)area);
  add(slot->height, change, (double)height);
}

static void add_part(pf_sums *s, const pf_step *change, part p) {
  if (p.height == 0)
    return;
  add_to(&s->slots[(size_t)p.row * s->view.columns + p.column], change, p.area, p.height);
  mark(s, p.row, p.column, 1);
  if (varies(change))
    add_varied(s, change, &p);
}

void pf_sums_draw_left(pf_sums *s, const pf_step *change, int64_t y, int64_t foot) {
  uint32_t first = (uint32_t)(y / PIXEL), last = (uint32_t)(foot / PIXEL);
  int64_t above = y % PIXEL, below = foot % PIXEL;
  const uint32_t rows[4] = {first, first + 1, last, last + 1};
  const int64_t shares[4] = {PIXEL - above, above, below - PIXEL, -below};
  for (int i = 0; i < 4; i++)
    add(s->leads[rows[i]].colour, change, (double)shares[i]);
  for (uint32_t row = first; varies(change) && row <= last && row < s->rows; row++) {
    int64_t height = (row == last ? below : PIXEL) - (row == first ? above : 0);
    add_varied(s, change, &(part){row, 0, height, height});
    mark(s, row, 0, 1);
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

/* A line within a row, from its left end to its right one; across and down in PIXELs. */
typedef struct line {
  int64_t low, high, height;
  double rise; /* dy / dx of its chord, without a sign; 0 where it is upright */
  uint32_t row;
  pf_slot *slots; /* the slots of the row */
} line;

static inline int64_t fraction_of(int64_t x) { return x & (PIXEL - 1); }

/* How much of the height is left of an edge that the line crosses. */
static inline int64_t height_at(const line *l, int64_t edge) {
  double height = (double)(edge - l->low) * l->rise;
  return (int64_t)(height < (double)l->height ? height : (double)l->height);
}

/* A line within a column or two of the crop, of flat cells; no branches, which could not be
 * predicted. */
static inline void draw_short(pf_sums *s, const pf_step *change, const line *l) {
  int64_t first = l->low >> 16, edge = (first + 1) * PIXEL;
  bool is_across = l->high >= edge;
  int64_t middle = is_across ? edge : l->high, below = height_at(l, edge);
  int64_t height = is_across ? below : l->height, left = l->height - height;
  uint32_t column = (uint32_t)(first - s->left);
  pf_slot *slot = &l->slots[column];
  add_to(slot, change, area_of(height, l->low + middle - 2 * first * PIXEL), height);
  add_to(slot + is_across, change, area_of(left, fraction_of(l->high)), left);
  mark(s, l->row, column, 1);
  mark(s, l->row, column + is_across, 1);
}

/* A line that is anywhere. */
static void draw_long(pf_sums *s, const pf_step *change, const line *l) {
  int64_t first = l->low >> 16, last = l->high >> 16, done = 0;
  first = first > s->left ? first : s->left;
  if (l->low < s->left * PIXEL) {
    done = l->high < s->left * PIXEL ? l->height : height_at(l, s->left * PIXEL);
    pf_sums_draw_left(s, change, l->row * PIXEL, l->row * PIXEL + done);
  }
  for (int64_t column = first; column <= last && column < s->right; column++) {
    int64_t y = column < last ? height_at(l, (column + 1) * PIXEL) : l->height;
    int64_t beside = column == l->low >> 16 ? fraction_of(l->low) : 0;
    beside += column == last ? fraction_of(l->high) : PIXEL;
    add_part(s, change,
             (part){l->row, (uint32_t)(column - s->left), area_of(y - done, beside), y - done});
    done = y;
  }
}

static inline void draw_line(pf_sums *s, const pf_step *change, line *l, int64_t x0, int64_t x1) {
  l->low = x0 < x1 ? x0 : x1;
  l->high = x0 < x1 ? x1 : x0;
  bool is_inside = l->low >= s->left * PIXEL && l->high < s->right * PIXEL;
  if (is_inside && (l->high >> 16) - (l->low >> 16) < 2 && !varies(change))
    draw_short(s, change, l);
  else
    draw_long(s, change, l);
}

/* A line that crosses the height of a row's centres changes all pixels whose centre is right of
 * it. */
static void draw_centre(pf_sums *s, const pf_step *change, uint32_t row, int64_t x) {
  int64_t column = (x + PIXEL / 2 - 1) >> 16;
  column = column > s->left ? column : s->left;
  if (column < s->right)
    add_part(s, change, (part){row, (uint32_t)(column - s->left), PIXEL, PIXEL});
}

static inline int64_t x_at(const pf_chord *chord, int64_t y) {
  if (y == chord->y1)
    return (int64_t)chord->x1;
  return (int64_t)(chord->x0 + chord->slope * (double)(y - chord->y0));
}

static void draw_centres(pf_sums *s, const pf_step *change, const pf_chord *chord, int64_t y,
                         int64_t foot) {
  int64_t row = (y - s->top + PIXEL / 2 - 1) >> 16, centre;
  for (; (centre = s->top + row * PIXEL + PIXEL / 2) < foot; row++)
    draw_centre(s, change, (uint32_t)row, x_at(chord, centre));
}

void pf_sums_draw(pf_sums *s, const pf_step *change, const pf_chord *chord, int64_t y,
                  int64_t foot) {
  if (!make_room(s))
    return;
  if (s->view.sampling != PLANEFILE_AREA) {
    draw_centres(s, change, chord, y, foot);
    return;
  }
  int64_t x = x_at(chord, y), end = y - (y - s->top) % PIXEL;
  double slope = fabs(chord->slope);
  line l = {.rise = slope > UPRIGHT ? 1 / slope : 0, .row = (uint32_t)((y - s->top) / PIXEL)};
  l.slots = &s->slots[(size_t)l.row * s->view.columns];
  for (; y < foot; l.row++, l.slots += s->view.columns) {
    end += PIXEL;
    int64_t stop = end < foot ? end : foot, next = x_at(chord, stop);
    l.height = stop - y;
    draw_line(s, change, &l, x, next);
    x = next;
    y = stop;
  }
}

/* ---------------------------------------------------------------- rows */

void pf_sums_begin(pf_sums *s, int64_t top) {
  s->top = top;
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
  UNROLLED
  for (int c = 0; c < 4; c++) {
    double rounded = sums[c] + ROUNDING;
    uint64_t bits;
    memcpy(&bits, &rounded, sizeof bits);
    out.colour[c] = (int32_t)(uint32_t)bits;
  }
  return out;
}

static inline bool is_same(const planefile_cell *a, const planefile_cell *b) {
  int32_t difference = 0;
  UNROLLED
  for (int c = 0; c < 4; c++)
    difference |= a->colour[c] ^ b->colour[c];
  return difference == 0;
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
  size_t at =
      r->count > 0 && is_same(&spans[r->count - 1].colour, &colour) ? r->count - 1 : r->count;
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

/* Puts a column to which something was added, and the pixels before it; forgets what was added. */
static inline void put_column(reading *r, uint32_t made, uint32_t column, double total[4]) {
  pf_sums *s = r->sums;
  pf_slot *slot = &s->slots[(size_t)made * s->view.columns + column];
  double sums[4];
  put_part(r, column, total);
  if (s->plane->info.varies)
    pf_varied_take(&s->varied, made, column);
  UNROLLED
  for (int c = 0; c < 4; c++)
    sums[c] = total[c] + slot->area[c];
  UNROLLED
  for (int c = 0; c < 4; c++)
    total[c] += slot->height[c];
  memset(slot, 0, sizeof *slot);
  put_part(r, column + 1, sums);
}

/* Puts the columns of some words; most words of a large row are 0. */
static void put_words(reading *r, uint32_t made, size_t first, double total[4]) {
  uint64_t *words = &r->sums->bits[made * r->sums->words + first], any = 0;
  for (size_t i = 0; i < WORDS; i++)
    any |= words[i];
  for (size_t i = 0; any && i < WORDS; words[i++] = 0)
    for (uint64_t bits = words[i]; bits; bits &= bits - 1)
      put_column(r, made, (uint32_t)(first + i) * 64 + lowest_bit(bits), total);
}

size_t pf_sums_read(pf_sums *s, uint32_t row, uint32_t made) {
  reading r = {.sums = s, .row = row};
  double total[4];
  if (s->plane->info.varies)
    pf_varied_begin_row(&s->varied);
  UNROLLED
  for (int c = 0; c < 4; c++)
    total[c] = s->lead.colour[c] += s->leads[made].colour[c];
  for (size_t word = 0; word < s->words; word += WORDS)
    put_words(&r, made, word, total);
  put_part(&r, s->view.columns, total);
  return r.count;
}
