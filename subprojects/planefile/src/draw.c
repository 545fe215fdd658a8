/* Rows of a plane: sums of what its borders change.
 *
 *      border             pixel p           p + 1
 *                   +-----------/-----+-----------------+    right of a border the colour changes
 *                   |          /######|#################|    by right - left, in the area that is
 *                   |   left  / right |                 |    marked: pixel p gets that times its
 *                   |        /########|#################|    area, and pixel p + 1 what is left of
 *                   +-------/---------+-----------------+    the border's height
 *
 * The colour of a pixel is the sum of all pixels up to it. Several rows are summed together; a
 * pixel to which nothing was added has the colour of the one before it.
 *
 * INVARIANT: sums are integers modulo 2^64, so that they do not depend on any order, and areas are
 * functions of the chord, the row and the column alone: a crop has the pixels of the whole.
 */
#include <math.h>

#include "chords.h"
#include "varied.h"

enum { ROOM = 1 << 20 /* bytes of sums, about */ };

typedef struct sum {
  uint64_t channels[4]; /* times HEIGHT */
} sum;

/* From the left of a border to its right. */
typedef struct step {
  int32_t colour[4];
  uint32_t left, right; /* cells that vary, by their numbers in all bands, or NONE */
} step;
#define NONE UINT32_MAX

/* A border that crosses the rows being made, and where it is. */
typedef struct live {
  const planefile_band *band;
  uint32_t border, piece, chord; /* chord: the vertex that ends the current one */
  int64_t foot;                  /* of the border */
  pf_vertex from, to;            /* the current chord */
  double slope;                  /* of it: dx / dy */
  int64_t y;                     /* all above is done */
  step change;
  pf_curve curve;
} live;

struct planefile_drawer {
  const planefile_plane *plane;
  planefile_view view;
  pf_scale scale;
  uint32_t band, border; /* those before have begun */
  live *lives;
  size_t live_count, live_capacity;
  sum *sums;              /* of `group` rows, each of columns + 1 pixels */
  sum steps[PF_ROWS + 1]; /* of rows: by what all pixels differ from those of the row before */
  sum step;               /* of the rows given so far */
  sum start;              /* of every row: cell 0, and borders that are left of all rows */
  uint64_t *bits;
  size_t words;               /* of a row's bits */
  uint32_t group, made, next; /* rows: of a group, begun so far, given so far */
  planefile_span *spans;
  pf_varied varied; /* where the plane varies */
};

/* ---------------------------------------------------------------- sums */

/* Adds to pixel `column` of the crop a share of the change from one cell to another. */
static inline void add(planefile_drawer *d, uint32_t row, uint32_t column, const step *change,
                       int64_t area) {
  size_t at = (size_t)row * (d->view.columns + 1) + column;
  for (int c = 0; c < 4; c++)
    d->sums[at].channels[c] += (uint64_t)(change->colour[c] * area);
  d->bits[row * d->words + column / 64] |= UINT64_C(1) << column % 64;
  if (change->left != NONE)
    pf_varied_add(&d->varied, row, column, change->left, -area);
  if (change->right != NONE)
    pf_varied_add(&d->varied, row, column, change->right, area);
}

/* The share of a line from x = low to high, within [edge - 1, edge] or beyond it, that is left of
 * `edge`, each place of it by how much of the pixel it leaves on its right. by_width: 1 / (high -
 * low); only where the line crosses a pixel's edge. */
static inline double share_left(double low, double high, double by_width, double edge) {
  double above = edge - low, over = high - (edge - 1);
  if (high > edge)
    return above < 1 ? 0.5 * above * above * by_width : (above - 0.5) * by_width;
  return above > 1 ? 1 - 0.5 * over * over * by_width : edge - 0.5 * (low + high);
}

/* A line left of the crop, from height y to foot of the rows being made. In the rows that it goes
 * through it changes all pixels alike. */
static void add_left(planefile_drawer *d, int64_t y, int64_t foot, const step *change) {
  uint32_t first = (uint32_t)(y / PF_HEIGHT), last = (uint32_t)(foot / PF_HEIGHT);
  if (first == last) {
    add(d, first, 0, change, foot - y);
    return;
  }
  add(d, first, 0, change, (first + INT64_C(1)) * PF_HEIGHT - y);
  bool varies = change->left != NONE || change->right != NONE;
  for (uint32_t row = first + 1; varies && row < last; row++)
    add(d, row, 0, change, PF_HEIGHT);
  for (int c = 0; !varies && c < 4; c++) {
    d->steps[first + 1].channels[c] += (uint64_t)(change->colour[c] * INT64_C(65536));
    d->steps[last].channels[c] -= (uint64_t)(change->colour[c] * INT64_C(65536));
  }
  if (foot % PF_HEIGHT > 0)
    add(d, last, 0, change, foot % PF_HEIGHT);
}

/* A line within a row. */
static inline void add_line(planefile_drawer *d, uint32_t row, double a, double b, int64_t height,
                            const step *change) {
  double low = a < b ? a : b, high = a < b ? b : a;
  double left = d->view.x, right = left + d->view.columns;
  if (low >= right)
    return;
  uint32_t column = low > left ? (uint32_t)(low - left) : 0;
  double by_width = high - low > 1e-9 ? 1 / (high - low) : 0;
  int64_t before = 0;
  for (; column < d->view.columns && left + column < high; column++) {
    double share = share_left(low, high, by_width, left + column + 1);
    int64_t area = (int64_t)((double)height * share + 0.5);
    add(d, row, column, change, area - before);
    before = area;
  }
  if (column < d->view.columns)
    add(d, row, column, change, height - before);
}

/* A line that crosses the height of a row's centres changes all pixels whose centre is right of
 * it. */
static void add_centre(planefile_drawer *d, uint32_t row, double x, const step *change) {
  double column = ceil(x - 0.5) - d->view.x;
  if (column < d->view.columns)
    add(d, row, column > 0 ? (uint32_t)column : 0, change, PF_HEIGHT);
}

/* ---------------------------------------------------------------- borders */

static double x_at(const live *l, int64_t y) {
  if (y == l->to.y)
    return l->to.x;
  return l->from.x + l->slope * (double)(y - l->from.y);
}

/* The number of a cell among those of all bands; NONE: it is flat. */
static uint32_t number_of(const planefile_drawer *d, const planefile_band *band, uint32_t cell) {
  const pf_band *of = (const pf_band *)band; /* its first member */
  if (!band->programs || band->programs[cell].step_count == 0)
    return NONE;
  return d->varied.first[of - d->plane->bands] + cell;
}

static step find_change(const planefile_drawer *d, const planefile_band *band,
                        const planefile_border *border) {
  const planefile_cell *left = &band->cells[border->left], *right = &band->cells[border->right];
  step out = {.left = number_of(d, band, border->left), .right = number_of(d, band, border->right)};
  for (int c = 0; c < 4; c++)
    out.colour[c] = right->colour[c] - left->colour[c];
  return out;
}

/* Draws the part beside the crop of the current chord, if all of it is there. */
static bool draw_beside(planefile_drawer *d, live *l, int64_t top, int64_t foot) {
  double low = l->from.x < l->to.x ? l->from.x : l->to.x;
  double high = l->from.x < l->to.x ? l->to.x : l->from.x;
  bool is_left = high <= d->view.x, is_beyond = low >= (double)d->view.x + d->view.columns;
  if (d->view.sampling != PLANEFILE_AREA || !(is_left || is_beyond))
    return false;
  if (is_left && l->y < foot)
    add_left(d, l->y - top, foot - top, &l->change);
  l->y = foot;
  return true;
}

/* Draws the current chord down to a height that it reaches. top: of the rows being made. */
static void draw_chord(planefile_drawer *d, live *l, int64_t top, int64_t foot) {
  if (l->y >= foot || draw_beside(d, l, top, foot))
    return;
  while (l->y < foot) {
    int64_t row = (l->y - top) / PF_HEIGHT, end = top + (row + 1) * PF_HEIGHT;
    int64_t centre = end - PF_HEIGHT / 2;
    end = end < foot ? end : foot;
    if (d->view.sampling == PLANEFILE_AREA)
      add_line(d, (uint32_t)row, x_at(l, l->y), x_at(l, end), end - l->y, &l->change);
    else if (l->y <= centre && centre < end)
      add_centre(d, (uint32_t)row, x_at(l, centre), &l->change);
    l->y = end;
  }
}

/* The current chord, whatever is rounded in its heights. */
static void set_chord(live *l, pf_vertex from, pf_vertex to) {
  l->from = from;
  l->to = to;
  l->to.y = to.y > from.y ? to.y : from.y;
  l->slope = to.y > from.y ? (to.x - from.x) / (double)(to.y - from.y) : 0;
}

/* Goes to a piece. One that is all outside the crop needs no more than its ends. */
static void enter_piece(const planefile_drawer *d, live *l, uint32_t piece) {
  const planefile_piece *of = &l->band->pieces[piece];
  pf_curve_make(&l->band->points[of->point], of, d->scale, &l->curve);
  if (of->degree > 1 && l->curve.high >= d->view.x - 1.0 &&
      l->curve.low <= (double)d->view.x + d->view.columns + 1)
    pf_curve_bend(&l->band->points[of->point], of, d->scale, &l->curve);
  l->piece = piece;
  l->chord = 1;
  set_chord(l, pf_curve_vertex(&l->curve, 0), pf_curve_vertex(&l->curve, 1));
}

/* Goes to the next chord; false at the chain's end. */
static bool next_chord(const planefile_drawer *d, live *l) {
  const planefile_chain *chain = &l->band->chains[l->band->borders[l->border].chain];
  if (l->chord == l->curve.chords) {
    if (l->piece + 1 == chain->piece + chain->piece_count)
      return false;
    enter_piece(d, l, l->piece + 1);
    return true;
  }
  set_chord(l, l->to, pf_curve_vertex(&l->curve, ++l->chord));
  return true;
}

static int64_t piece_foot(const planefile_drawer *d, const planefile_band *band, uint32_t piece) {
  const planefile_piece *of = &band->pieces[piece];
  return pf_height(band->points[of->point + of->degree].y, d->scale.y);
}

/* The piece of a chain at a height, which is above the chain's foot. */
static uint32_t find_piece(const planefile_drawer *d, const planefile_band *band, uint32_t chain,
                           int64_t y) {
  uint32_t low = band->chains[chain].piece, high = low + band->chains[chain].piece_count - 1;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (piece_foot(d, band, middle) > y)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

/* Where the part of a border is that is in the rows of the crop, as far as one piece has all of it:
 * -1: left of the crop; 1: right of it; 0: it may be in it. */
static int side_of(const planefile_drawer *d, const planefile_band *band, uint32_t piece,
                   int64_t foot) {
  const planefile_piece *of = &band->pieces[piece];
  int64_t end = ((int64_t)d->view.y + d->view.rows) * PF_HEIGHT;
  double left = (d->view.x - 1.0) / d->scale.x;
  double right = ((double)d->view.x + d->view.columns + 1) / d->scale.x;
  bool is_left = true, is_right = true;
  if (piece_foot(d, band, piece) < (foot < end ? foot : end))
    return 0;
  for (int i = 0; i <= of->degree; i++) {
    is_left &= band->points[of->point + i].x < left;
    is_right &= band->points[of->point + i].x > right;
  }
  return is_right - is_left;
}

/* Whether a border is in all rows of the crop, from a height to another one. */
static bool is_long(const planefile_drawer *d, int64_t y, int64_t foot) {
  int64_t top = (int64_t)d->view.y * PF_HEIGHT;
  return y == top && foot >= top + (int64_t)d->view.rows * PF_HEIGHT;
}

/* Goes to the chord of a piece at the height l->y. */
static void seek(const planefile_drawer *d, live *l, uint32_t piece) {
  enter_piece(d, l, piece);
  l->chord = pf_curve_find(&l->curve, l->y) + 1;
  set_chord(l, pf_curve_vertex(&l->curve, l->chord - 1), pf_curve_vertex(&l->curve, l->chord));
}

/* Draws a border in the rows [top, foot). */
static void draw_border(planefile_drawer *d, live *l, int64_t top, int64_t foot) {
  foot = l->foot < foot ? l->foot : foot;
  while (l->y < foot) {
    draw_chord(d, l, top, l->to.y < foot ? l->to.y : foot);
    if (l->y < foot && !next_chord(d, l))
      return;
  }
}

/* ---------------------------------------------------------------- rows */

/* Adds to what every row begins with. */
static void add_start(planefile_drawer *d, const step *change) {
  for (int c = 0; c < 4; c++)
    d->start.channels[c] += (uint64_t)(change->colour[c] * (int64_t)PF_HEIGHT);
  if (change->left != NONE)
    pf_varied_add_start(&d->varied, change->left, -PF_HEIGHT);
  if (change->right != NONE)
    pf_varied_add_start(&d->varied, change->right, PF_HEIGHT);
}

/* Adds to the borders that live one from a height on. */
static planefile_status add_live(planefile_drawer *d, const planefile_band *band, uint32_t index,
                                 uint32_t piece, int64_t y) {
  const planefile_border *border = &band->borders[index];
  live *lives =
      pf_grow(&d->plane->memory, d->lives, sizeof *lives, &d->live_capacity, d->live_count + 1);
  if (!lives)
    return PLANEFILE_NO_MEMORY;
  d->lives = lives;
  live *l = &d->lives[d->live_count++];
  l->band = band;
  l->border = index;
  l->foot = pf_height(border->foot, d->scale.y);
  l->y = y;
  l->change = find_change(d, band, border);
  seek(d, l, piece);
  return PLANEFILE_OK;
}

/* Begins a border, unless it ends above or changes nothing in the crop. top: of the rows being
 * made. */
static planefile_status begin_border(planefile_drawer *d, const planefile_band *band,
                                     uint32_t index, int64_t top) {
  const planefile_border *border = &band->borders[index];
  int64_t y = pf_height(border->top, d->scale.y), foot = pf_height(border->foot, d->scale.y);
  y = y > top ? y : top;
  if (foot <= y)
    return PLANEFILE_OK;
  uint32_t piece = find_piece(d, band, border->chain, y);
  int side = side_of(d, band, piece, foot);
  if (side == 0 || (side < 0 && !is_long(d, y, foot)))
    return add_live(d, band, index, piece, y);
  if (side < 0) {
    const step change = find_change(d, band, border);
    add_start(d, &change);
  }
  return PLANEFILE_OK;
}

/* The first border from `index` on that may end below a height. */
static uint32_t skip_ended(const planefile_drawer *d, const planefile_band *band, uint32_t index,
                           int64_t top) {
  double units = (double)top / PF_HEIGHT / d->scale.y - 1;
  while (index < band->border_count && band->borders[index].foot < units)
    index++;
  return index;
}

/* Begins all borders whose tops are above a height. */
static planefile_status begin_borders(planefile_drawer *d, int64_t top, int64_t foot) {
  planefile_status status = PLANEFILE_OK;
  for (; d->band < d->plane->info.band_count; d->band++, d->border = 0) {
    const planefile_band *band = &d->plane->bands[d->band].band;
    if (pf_height(band->foot, d->scale.y) <= top)
      continue;
    for (; (d->border = skip_ended(d, band, d->border, top)) < band->border_count; d->border++) {
      if (pf_height(band->borders[d->border].top, d->scale.y) >= foot)
        return status;
      status = begin_border(d, band, d->border, top);
      if (status != PLANEFILE_OK)
        return status;
    }
    if (pf_height(band->foot, d->scale.y) > foot)
      return status;
  }
  return status;
}

/* The sums of the next rows. */
static planefile_status make_rows(planefile_drawer *d) {
  int64_t top = ((int64_t)d->view.y + d->made) * PF_HEIGHT;
  uint32_t rows = d->view.rows - d->made;
  rows = rows < d->group ? rows : d->group;
  int64_t foot = top + (int64_t)rows * PF_HEIGHT;
  memset(d->steps, 0, sizeof d->steps);
  pf_varied_begin(&d->varied);
  planefile_status status = begin_borders(d, top, foot);
  if (status != PLANEFILE_OK)
    return status;
  d->step = d->start;
  size_t kept = 0;
  for (size_t i = 0; i < d->live_count; i++) {
    draw_border(d, &d->lives[i], top, foot);
    if (d->lives[i].foot > foot && kept++ < i)
      d->lives[kept - 1] = d->lives[i];
  }
  d->live_count = kept;
  d->made += rows;
  return d->varied.failed ? PLANEFILE_NO_MEMORY : PLANEFILE_OK;
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

/* Adds to the sum what was added to something, which is cleared; returns the colour. */
static planefile_cell take(sum *total, sum *at) {
  planefile_cell out;
  for (int c = 0; c < 4; c++) {
    total->channels[c] += at->channels[c];
    at->channels[c] = 0;
    int64_t rounded = (int64_t)(total->channels[c] + PF_HEIGHT / 2);
    out.colour[c] = (int32_t)(rounded >> 16);
  }
  return out;
}

static bool is_same(const planefile_cell *a, const planefile_cell *b) {
  return memcmp(a, b, sizeof *a) == 0;
}

/* Reads the sums of a row of the group; returns the number of spans. */
static size_t read_row(planefile_drawer *d, uint32_t row) {
  sum total, *sums = &d->sums[(size_t)row * (d->view.columns + 1)];
  size_t count = 0;
  planefile_span span = {0, take(&d->step, &d->steps[row])};
  total = d->step;
  for (size_t word = 0; word < d->words; word++) {
    uint64_t bits = d->bits[row * d->words + word];
    d->bits[row * d->words + word] = 0;
    for (; bits; bits &= bits - 1) {
      uint32_t column = (uint32_t)word * 64 + lowest_bit(bits);
      planefile_cell colour = take(&total, &sums[column]);
      if (is_same(&colour, &span.colour))
        continue;
      span.end = column;
      if (column > 0)
        d->spans[count++] = span;
      span.colour = colour;
    }
  }
  span.end = d->view.columns;
  d->spans[count++] = span;
  return count;
}

/* ---------------------------------------------------------------- rows that vary */

/* Appends the pixels of a row from a column to another one, each a span. */
static size_t paint_pixels(planefile_drawer *d, uint32_t row, uint32_t from, uint32_t to,
                           const sum *flat, size_t count) {
  for (uint32_t x = from, size; x < to; x += size, count += size) {
    size = to - x < PF_BATCH ? to - x : PF_BATCH;
    pf_pixels pixels = {d->view.width, d->view.height, d->view.x + x, d->view.y + row, size};
    planefile_span *spans = &d->spans[count];
    pf_varied_paint(&d->varied, &pixels, flat->channels, spans);
    for (uint32_t k = 0; k < size; k++) {
      spans[k].end = x + k + 1;
      if (d->plane->info.is_opaque)
        spans[k].colour.colour[3] = PLANEFILE_WHITE;
    }
  }
  return count;
}

/* Appends a part of a row in which no sum changes. */
static size_t put_part(planefile_drawer *d, uint32_t row, uint32_t from, uint32_t to,
                       const sum *total, size_t count) {
  sum none = {{0}}, flat = *total;
  if (from == to)
    return count;
  if (d->varied.active_count > 0)
    return paint_pixels(d, row, from, to, total, count);
  d->spans[count] = (planefile_span){to, take(&flat, &none)};
  if (count == 0 || !is_same(&d->spans[count].colour, &d->spans[count - 1].colour))
    return count + 1;
  d->spans[count - 1].end = to;
  return count;
}

/* As read_row, where cells may vary. row: of the view; it is `row % group` of those that were
 * made. */
static size_t read_varied_row(planefile_drawer *d, uint32_t row) {
  uint32_t made = row % d->group, from = 0;
  sum total, *sums = &d->sums[(size_t)made * (d->view.columns + 1)];
  size_t count = 0;
  take(&d->step, &d->steps[made]);
  total = d->step;
  pf_varied_begin_row(&d->varied);
  for (size_t word = 0; word < d->words; word++) {
    uint64_t bits = d->bits[made * d->words + word];
    d->bits[made * d->words + word] = 0;
    for (; bits; bits &= bits - 1) {
      uint32_t column = (uint32_t)word * 64 + lowest_bit(bits);
      count = put_part(d, row, from, column, &total, count);
      take(&total, &sums[column]);
      pf_varied_take(&d->varied, made, column);
      from = column;
    }
  }
  return put_part(d, row, from, d->view.columns, &total, count);
}

planefile_status planefile_drawer_row(planefile_drawer *d, const planefile_span **spans,
                                      size_t *count) {
  if (d->next == d->view.rows)
    return PLANEFILE_BAD_ARGUMENT;
  if (d->next == d->made) {
    planefile_status status = make_rows(d);
    if (status != PLANEFILE_OK)
      return status;
  }
  uint32_t row = d->next++;
  *count = d->plane->info.varies ? read_varied_row(d, row) : read_row(d, row % d->group);
  *spans = d->spans;
  return PLANEFILE_OK;
}

/* ---------------------------------------------------------------- life */

static bool is_view(const planefile_view *v) {
  return v->width > 0 && v->height > 0 && v->width <= PLANEFILE_PIXELS_MOST &&
         v->height <= PLANEFILE_PIXELS_MOST && v->columns > 0 && v->rows > 0 && v->x < v->width &&
         v->columns <= v->width - v->x && v->y < v->height && v->rows <= v->height - v->y &&
         v->sampling <= PLANEFILE_NONE;
}

/* Whether the bands at the heights of a view have been read. */
static bool has_bands(const planefile_plane *plane, const planefile_view *v, pf_scale scale) {
  int64_t top = (int64_t)v->y * PF_HEIGHT, foot = ((int64_t)v->y + v->rows) * PF_HEIGHT;
  for (uint32_t i = 0; i < plane->info.band_count; i++) {
    const planefile_band *band = &plane->bands[i].band;
    if (pf_height(band->top, scale.y) < foot && pf_height(band->foot, scale.y) > top &&
        band->cell_count == 0)
      return false;
  }
  return true;
}

static bool make_sums(planefile_drawer *d) {
  size_t width = (size_t)d->view.columns + 1, rows = ROOM / (width * sizeof *d->sums);
  d->group = rows < 1 ? 1 : rows > PF_ROWS ? PF_ROWS : (uint32_t)rows;
  d->words = width / 64 + 1;
  d->sums = pf_make(&d->plane->memory, sizeof *d->sums, width * d->group);
  d->bits = pf_make(&d->plane->memory, sizeof *d->bits, d->words * d->group);
  d->spans = pf_make(&d->plane->memory, sizeof *d->spans, width);
  return d->sums && d->bits && d->spans &&
         (!d->plane->info.varies ||
          pf_varied_init(&d->varied, d->plane, d->view.columns, d->group));
}

planefile_status planefile_drawer_create(const planefile_plane *plane, const planefile_view *view,
                                         planefile_drawer **out) {
  *out = NULL;
  if (!is_view(view))
    return PLANEFILE_BAD_ARGUMENT;
  pf_scale scale = {(double)view->width / PLANEFILE_SIDE, (double)view->height / PLANEFILE_SIDE};
  if (!has_bands(plane, view, scale))
    return PLANEFILE_BAD_ARGUMENT;
  planefile_drawer *d = pf_make(&plane->memory, sizeof *d, 1);
  if (!d)
    return PLANEFILE_NO_MEMORY;
  d->plane = plane;
  d->view = *view;
  d->scale = scale;
  step base = {.left = NONE, .right = NONE};
  memcpy(base.colour, plane->base.colour, sizeof base.colour);
  add_start(d, &base);
  if (!make_sums(d)) {
    planefile_drawer_destroy(d);
    return PLANEFILE_NO_MEMORY;
  }
  *out = d;
  return PLANEFILE_OK;
}

void planefile_drawer_destroy(planefile_drawer *d) {
  if (!d)
    return;
  const pf_memory *memory = &d->plane->memory;
  size_t width = (size_t)d->view.columns + 1;
  pf_free(memory, d->lives, sizeof *d->lives, d->live_capacity);
  pf_free(memory, d->sums, sizeof *d->sums, width * d->group);
  pf_free(memory, d->bits, sizeof *d->bits, d->words * d->group);
  pf_free(memory, d->spans, sizeof *d->spans, width);
  pf_varied_finish(&d->varied);
  pf_free(memory, d, sizeof *d, 1);
}
