/* Rows of a plane: its chains, each followed downwards along its borders.
 *
 *   chains that come to the rows being made --> chords --> sums --> spans
 *
 * A chain keeps its place on its curve from one border to the next one, and from rows to rows.
 */

#include "sums.h"

/* A chain that crosses the rows being made, and where it is. */
typedef struct live {
  const planefile_band *band;
  uint32_t border;       /* the current one */
  uint32_t piece, chord; /* chord: the vertex that ends the current one */
  int64_t y, foot;       /* all above y is done; foot: of the border */
  pf_step change;
  pf_chord at;
  pf_curve curve;
} live;

struct planefile_drawer {
  const planefile_plane *plane;
  pf_scale scale;
  int64_t end;          /* the lowest height of the crop */
  double above, beyond; /* in units: what ends above and begins beyond is not in the crop */
  uint32_t band, run;   /* those before have begun */
  live *lives;
  size_t live_count, live_capacity;
  uint32_t made, next; /* rows: begun so far, given so far */
  pf_sums sums;
};

static int64_t height_of(const planefile_drawer *d, int32_t units) {
  return pf_round(units * d->scale.y);
}

/* ---------------------------------------------------------------- chords */

/* The current chord, whatever is rounded in its heights. */
static void set_chord(live *l, pf_vertex from, pf_vertex to) {
  int64_t foot = to.y > from.y ? to.y : from.y;
  double slope = to.y > from.y ? (to.x - from.x) / (double)(to.y - from.y) : 0;
  l->at = (pf_chord){from.x, to.x, slope, from.y, foot};
}

/* Goes to a piece. One that is all outside the crop needs no more than its ends. */
static void enter_piece(const planefile_drawer *d, live *l, uint32_t piece) {
  const planefile_piece *of = &l->band->pieces[piece];
  const planefile_point *points = &l->band->points[of->point];
  const double pixel = PF_HEIGHT;
  pf_curve_make(points, of, d->scale, &l->curve);
  if (of->degree > 1 && l->curve.high >= ((double)d->sums.left - 1) * pixel &&
      l->curve.low <= ((double)d->sums.right + 1) * pixel)
    pf_curve_bend(points, of, d->scale, &l->curve);
  l->piece = piece;
}

/* Goes to the chord that ends at a vertex of the piece. */
static void enter_chord(live *l, uint32_t chord) {
  l->chord = chord;
  set_chord(l, pf_curve_vertex(&l->curve, chord - 1), pf_curve_vertex(&l->curve, chord));
}

static const planefile_chain *chain_of(const live *l) {
  return &l->band->chains[l->band->borders[l->border].chain];
}

/* Goes to the next chord; false at the chain's end. */
static bool next_chord(const planefile_drawer *d, live *l) {
  const planefile_chain *chain = chain_of(l);
  if (l->chord < l->curve.chords) {
    pf_vertex from = {l->at.x1, l->at.y1};
    set_chord(l, from, pf_curve_vertex(&l->curve, ++l->chord));
    return true;
  }
  if (l->piece + 1 == chain->piece + chain->piece_count)
    return false;
  enter_piece(d, l, l->piece + 1);
  enter_chord(l, 1);
  return true;
}

static int64_t piece_foot(const planefile_drawer *d, const planefile_band *band, uint32_t piece) {
  const planefile_piece *of = &band->pieces[piece];
  return height_of(d, band->points[of->point + of->degree].y);
}

/* The piece of a chain at a height, from a piece on; the height is above the chain's foot. */
static uint32_t find_piece(const planefile_drawer *d, const planefile_band *band,
                           const planefile_chain *chain, uint32_t piece, int64_t y) {
  uint32_t low = piece, high = chain->piece + chain->piece_count - 1;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (piece_foot(d, band, middle) > y)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

/* Goes to the chord at the height l->y. */
static void seek(const planefile_drawer *d, live *l, uint32_t piece) {
  enter_piece(d, l, piece);
  enter_chord(l, pf_curve_find(&l->curve, l->y) + 1);
}

/* ---------------------------------------------------------------- borders */

/* The number of a cell among those of all bands; NO_CELL: it is flat. */
static uint32_t number_of(const planefile_drawer *d, const planefile_band *band, uint32_t cell) {
  const pf_band *of = (const pf_band *)band; /* its first member */
  if (!band->programs || band->programs[cell].step_count == 0)
    return PF_NO_CELL;
  return d->sums.varied.first[of - d->plane->bands] + cell;
}

static pf_step find_change(const planefile_drawer *d, const planefile_band *band,
                           const planefile_border *border) {
  const planefile_cell *left = &band->cells[border->left], *right = &band->cells[border->right];
  pf_step out = {.left = number_of(d, band, border->left),
                 .right = number_of(d, band, border->right)};
  for (int c = 0; c < 4; c++)
    out.colour[c] = right->colour[c] - left->colour[c];
  return out;
}

/* Begins the current border, not above a height. */
static void begin_border(const planefile_drawer *d, live *l, int64_t y) {
  const planefile_border *border = &l->band->borders[l->border];
  int64_t top = height_of(d, border->top);
  l->y = top > y ? top : y;
  l->foot = height_of(d, border->foot);
  l->change = find_change(d, l->band, border);
}

/* Goes to the next border of the chain; false: there is none. */
static bool next_border(const planefile_drawer *d, live *l) {
  const planefile_border *border = &l->band->borders[l->border];
  if (l->border + 1 == l->band->border_count || border[1].chain != border->chain)
    return false;
  l->border++;
  begin_border(d, l, l->y);
  if (l->y >= l->at.y1 && l->y < l->foot)
    seek(d, l, find_piece(d, l->band, chain_of(l), l->piece, l->y));
  return true;
}

/* Draws the part of the current chord that is in the crop, or beside it. */
static void draw_chord(planefile_drawer *d, live *l, int64_t foot) {
  double low = l->at.x0 < l->at.x1 ? l->at.x0 : l->at.x1;
  double high = l->at.x0 < l->at.x1 ? l->at.x1 : l->at.x0;
  bool is_left = high <= (double)(d->sums.left * PF_HEIGHT);
  bool is_beside = is_left || low >= (double)(d->sums.right * PF_HEIGHT);
  if (!is_beside || d->sums.view.sampling != PLANEFILE_AREA)
    pf_sums_draw(&d->sums, &l->change, &l->at, l->y, foot);
  else if (is_left)
    pf_sums_draw_left(&d->sums, &l->change, l->y - d->sums.top, foot - d->sums.top);
  l->y = foot;
}

/* Draws the current border down to a height. */
static void draw_border(planefile_drawer *d, live *l, int64_t foot) {
  foot = l->foot < foot ? l->foot : foot;
  while (l->y < foot) {
    if (l->at.y1 > l->y)
      draw_chord(d, l, l->at.y1 < foot ? l->at.y1 : foot);
    if (l->y < foot && !next_chord(d, l))
      return;
  }
}

/* Draws a chain down to a height; false: it ends above. */
static bool draw_chain(planefile_drawer *d, live *l, int64_t foot) {
  do {
    if (l->y >= foot)
      return true;
    draw_border(d, l, foot);
    if (l->foot > foot)
      return true;
  } while (next_border(d, l));
  return false;
}

/* ---------------------------------------------------------------- beginnings */

/* Where a chain is from a height on to the foot of the crop, as far as one piece has all of it: -1:
 * left of the crop; 1: right of it; 0: it may be in it. */
static int side_of(const planefile_drawer *d, const planefile_band *band, uint32_t piece,
                   int64_t foot) {
  const planefile_piece *of = &band->pieces[piece];
  double left = ((double)d->sums.left - 1) * PF_HEIGHT / d->scale.x;
  double right = ((double)d->sums.right + 1) * PF_HEIGHT / d->scale.x;
  bool is_left = true, is_right = true;
  if (piece_foot(d, band, piece) < (foot < d->end ? foot : d->end))
    return 0;
  for (int i = 0; i <= of->degree; i++) {
    is_left &= band->points[of->point + i].x < left;
    is_right &= band->points[of->point + i].x > right;
  }
  return is_right - is_left;
}

static planefile_status add_live(planefile_drawer *d, const live *begun) {
  live *lives =
      pf_grow(&d->plane->memory, d->lives, sizeof *lives, &d->live_capacity, d->live_count + 1);
  if (!lives)
    return PLANEFILE_NO_MEMORY;
  d->lives = lives;
  d->lives[d->live_count++] = *begun;
  return PLANEFILE_OK;
}

/* The first border of a run that ends below a height; the last one does. */
static uint32_t find_border(const planefile_drawer *d, const planefile_band *band, uint32_t border,
                            int64_t y) {
  while (band->borders[border].foot < d->above || height_of(d, band->borders[border].foot) <= y)
    border++;
  return border;
}

static int side_of_place(const planefile_drawer *d, double x) {
  return (x >= (double)(d->sums.right * PF_HEIGHT)) - (x <= (double)(d->sums.left * PF_HEIGHT));
}

/* The same from the current chord on, as far as the piece has all of it: the points of a curve may
 * lie on both sides where the curve does not. */
static int side_of_chords(const planefile_drawer *d, const live *l) {
  int side = side_of_place(d, l->at.x0);
  pf_vertex end = {l->at.x1, l->at.y1};
  uint32_t chord = l->chord;
  while (side_of_place(d, end.x) == side && end.y < d->end && chord < l->curve.chords)
    end = pf_curve_vertex(&l->curve, ++chord);
  return side_of_place(d, end.x) == side && end.y >= d->end ? side : 0;
}

/* Begins a chain, unless it changes nothing in the crop. top: of the rows being made. */
static planefile_status begin_run(planefile_drawer *d, const pf_band *band, const pf_run *run,
                                  int64_t top) {
  int64_t foot = height_of(d, run->foot);
  if (foot <= top)
    return PLANEFILE_OK;
  live begun = {.band = &band->band, .border = find_border(d, &band->band, run->border, top)};
  begin_border(d, &begun, top);
  if (begun.y >= d->end)
    return PLANEFILE_OK;
  uint32_t piece = find_piece(d, begun.band, chain_of(&begun), chain_of(&begun)->piece, begun.y);
  int side = side_of(d, begun.band, piece, foot);
  bool is_long = begun.y == (int64_t)d->sums.view.y * PF_HEIGHT && begun.foot >= d->end;
  if (side == 0 || (side < 0 && !is_long)) {
    seek(d, &begun, piece);
    side = side_of_chords(d, &begun);
    if (side == 0 || !is_long || d->sums.view.sampling != PLANEFILE_AREA)
      return add_live(d, &begun);
  }
  if (side < 0)
    pf_sums_add_start(&d->sums, &begun.change);
  return PLANEFILE_OK;
}

/* Begins all chains whose first borders are above a height. */
static planefile_status begin_runs(planefile_drawer *d, int64_t top, int64_t foot) {
  planefile_status status = PLANEFILE_OK;
  for (; d->band < d->plane->info.band_count; d->band++, d->run = 0) {
    const pf_band *band = &d->plane->bands[d->band];
    if (height_of(d, band->band.foot) <= top)
      continue;
    for (; d->run < band->run_count && status == PLANEFILE_OK; d->run++) {
      const pf_run *run = &band->runs[d->run];
      if (run->foot < d->above || run->low > d->beyond)
        continue;
      if (height_of(d, run->top) >= foot)
        return status;
      status = begin_run(d, band, run, top);
    }
    if (status != PLANEFILE_OK || height_of(d, band->band.foot) > foot)
      return status;
  }
  return status;
}

/* ---------------------------------------------------------------- rows */

/* The sums of the next rows. */
static planefile_status make_rows(planefile_drawer *d) {
  const planefile_view *view = &d->sums.view;
  int64_t top = ((int64_t)view->y + d->made) * PF_HEIGHT;
  uint32_t rows = view->rows - d->made;
  rows = rows < d->sums.rows ? rows : d->sums.rows;
  int64_t foot = top + (int64_t)rows * PF_HEIGHT;
  planefile_status status = begin_runs(d, top, foot);
  if (status != PLANEFILE_OK)
    return status;
  pf_sums_begin(&d->sums, top);
  for (size_t i = 0; i < d->live_count;)
    if (draw_chain(d, &d->lives[i], foot))
      i++;
    else
      d->lives[i] = d->lives[--d->live_count];
  d->made += rows;
  return d->sums.failed || d->sums.varied.failed ? PLANEFILE_NO_MEMORY : PLANEFILE_OK;
}

planefile_status planefile_drawer_row(planefile_drawer *d, const planefile_span **spans,
                                      size_t *count) {
  if (d->next == d->sums.view.rows)
    return PLANEFILE_BAD_ARGUMENT;
  if (d->next == d->made) {
    planefile_status status = make_rows(d);
    if (status != PLANEFILE_OK)
      return status;
  }
  uint32_t row = d->next++;
  *count = pf_sums_read(&d->sums, row, row % d->sums.rows);
  *spans = d->sums.spans;
  return PLANEFILE_OK;
}

/* ---------------------------------------------------------------- life */

static bool is_view(const planefile_view *v) {
  return v->width > 0 && v->height > 0 && v->width <= PLANEFILE_PIXELS_MOST &&
         v->height <= PLANEFILE_PIXELS_MOST && v->columns > 0 && v->rows > 0 && v->x < v->width &&
         v->columns <= v->width - v->x && v->y < v->height && v->rows <= v->height - v->y &&
         v->sampling <= PLANEFILE_NONE;
}

/* Whether the bands at the heights of the crop have been read. */
static bool has_bands(const planefile_drawer *d, const planefile_view *view) {
  int64_t top = (int64_t)view->y * PF_HEIGHT;
  for (uint32_t i = 0; i < d->plane->info.band_count; i++) {
    const planefile_band *band = &d->plane->bands[i].band;
    if (height_of(d, band->top) < d->end && height_of(d, band->foot) > top && band->cell_count == 0)
      return false;
  }
  return true;
}

planefile_status planefile_drawer_create(const planefile_plane *plane, const planefile_view *view,
                                         planefile_drawer **out) {
  *out = NULL;
  if (!is_view(view))
    return PLANEFILE_BAD_ARGUMENT;
  const double unit = (double)PF_HEIGHT / PLANEFILE_SIDE;
  planefile_drawer begun = {.plane = plane,
                            .scale = {view->width * unit, view->height * unit},
                            .end = ((int64_t)view->y + view->rows) * PF_HEIGHT};
  if (!has_bands(&begun, view))
    return PLANEFILE_BAD_ARGUMENT;
  planefile_drawer *d = pf_make(&plane->memory, sizeof *d, 1);
  if (!d)
    return PLANEFILE_NO_MEMORY;
  *d = begun;
  d->above = ((double)view->y - 1) * PF_HEIGHT / d->scale.y - 1;
  d->beyond = ((double)view->x + view->columns + 1) * PF_HEIGHT / d->scale.x;
  if (!pf_sums_init(&d->sums, plane, view)) {
    planefile_drawer_destroy(d);
    return PLANEFILE_NO_MEMORY;
  }
  pf_step base = {.left = PF_NO_CELL, .right = PF_NO_CELL};
  for (int c = 0; c < 4; c++)
    base.colour[c] = plane->base.colour[c];
  pf_sums_add_start(&d->sums, &base);
  *out = d;
  return PLANEFILE_OK;
}

void planefile_drawer_destroy(planefile_drawer *d) {
  if (!d)
    return;
  const pf_memory *memory = &d->plane->memory;
  pf_free(memory, d->lives, sizeof *d->lives, d->live_capacity);
  pf_sums_finish(&d->sums);
  pf_free(memory, d, sizeof *d, 1);
}
