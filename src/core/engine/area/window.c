/* Closing windows: how the pixels of one are made from its borders. One file, because the four ways
 * begin with the same borders and sums.
 *
 *   one border over several columns , flat cells    its ends and a ramp            close_lone
 *   flat cells, few columns                         the sums made on the way       close_narrow
 *   flat cells, many columns                        sums, tile by tile             close_wide
 *   cells that vary                                 colours weighted by areas      close_varying
 */
#include "engine/area/window.h"

#include "base/number.h"
#include "base/sort.h"
#include "engine/area/direct.h"
#include "engine/paint/colours.h"
#include "engine/paint/run.h"
#include "engine/sweep/pieces.h"

#define TILE 256 /* pixels summed at a time */
/* if at most this many pixels of a window lie between cells that vary, they become single spans */
#define FEW 2
/* columns of the next window that the painter folds together with those of a cell, if it can */
#define AHEAD 4

/* Clears the sums of the open window. */
static void clear_change(cs_window *window) {
  if (!window->has_change)
    return;
  window->has_change = false;
  int32_t columns = window->end - window->from;
  columns = columns < CS_WINDOW_NARROW ? columns : CS_WINDOW_NARROW;
  memset(window->change, 0, (size_t)(columns + 3) * sizeof *window->change);
}

void cs_window_init(cs_window *window, cs_painter *painter, cs_arena *arena, int32_t width) {
  *window = (cs_window){
      .painter = painter, .composer = painter->composer, .arena = arena, .width = width};
}

void cs_window_finish(cs_window *window, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, window, borders, borders);
  cs_arena_finish(&window->tiles, memory);
}

void cs_window_begin_row(cs_window *window, int32_t y, const cs_cell *leftmost, cs_row *out) {
  if (window->is_open) /* a row failed */
    clear_change(window);
  window->out = out;
  window->centre = y + 0.5;
  window->from = window->end = 0;
  window->base = window->cell = leftmost;
  window->border_count = 0;
  window->is_open = window->varies = window->is_whole_row = false;
  window->ahead = NULL;
}

void cs_window_open_row(cs_window *window) {
  window->is_open = window->is_whole_row = true;
  window->varies = window->base->length > 0;
}

/* The part of a border inside the open window. Because of rounding, the border may begin left of
 * the window, which begins at the end of the written columns. */
static inline cs_direct_piece measure(const cs_window *window, const cs_border *border) {
  double xa = border->line.xa, xb = border->line.xb, top = window->centre - 0.5;
  int32_t first = cs_edges_floor(cs_number_least(xa, xb), window->width);
  int32_t end = cs_edges_ceil(cs_number_most(xa, xb), window->width);
  if (first < window->from) {
    first = window->from;
    end = end > first ? end : first;
  }
  return (cs_direct_piece){
      xa, xb, cs_cover_round(border->line.yb - top) - cs_cover_round(border->line.ya - top), first,
      end};
}

/* The area right of a border in the pixel of column p, 0..height. */
static inline double cover(const cs_direct_piece *f, int32_t p) {
  return cs_cover_of(f->xa, f->xb, f->height, p);
}

/* Says which columns of the cell right of the open window will be asked for. */
static void say_ahead(cs_window *window, int32_t next) {
  int32_t end = window->width - next < AHEAD ? window->width : next + AHEAD;
  if (window->cell->length == 0 || (window->cell == window->ahead && end <= window->ahead_end))
    return;
  window->ahead = window->cell;
  window->ahead_end = end;
  cs_painter_ahead(window->painter, window->cell, (cs_run){window->from, end, window->centre});
}

/* ---------------------------------------------------------------- closing */

/* A window with one border, which crosses columns between flat cells. */
static celspan_status close_lone(cs_window *window) {
  const cs_border *border = &window->borders->border;
  const cs_direct_piece *f = &window->borders->piece;
  cs_v4 base = window->base->colour, step = border->right->colour - border->left->colour;
  int32_t last = f->end - 1;
  double across = f->xa < f->xb ? f->xb - f->xa : f->xa - f->xb;
  cs_direct_shares shares = {(float)cover(f, f->first), (float)cover(f, f->first + 1),
                             (float)cover(f, last), (float)(f->height / across)};
  CS_TRY(cs_row_reserve(window->composer->context, window->out, CS_DIRECT_EACH));
  cs_row_writer p = cs_row_writer_begin(window->out, window->from);
  cs_direct_ramp(&p, f->first, last, base, step, shares);
  cs_row_writer_end(&p);
  return CELSPAN_OK;
}

/* A border of a window over many columns. */
typedef struct crossing {
  cs_direct_piece piece;
  const cs_border *border;
  struct crossing *next; /* in the list of a tile */
} crossing;

/* Adds a border to the sums by column: change[k] is the sum of column p0 + k minus the sum of the
 * previous column. */
static void add_changes(const crossing *c, int32_t p0, int32_t p1, cs_sum4 *change) {
  const cs_direct_piece *f = &c->piece;
  cs_sum4 step = CS_SUM4(c->border->right->colour) - CS_SUM4(c->border->left->colour);
  int32_t p = f->first > p0 ? f->first : p0, end = f->end < p1 - 1 ? f->end : p1 - 1;
  double before = p > f->first ? cover(f, p - 1) : 0;
  for (; p <= end; p++) {
    double now = p < f->end ? cover(f, p) : f->height;
    change[p - p0] += step * (now - before);
    before = now;
  }
}

/* Draws the pixels from the writer's end to p1, and leaves the sum of the last of these pixels. */
static inline void draw_sums(cs_row_writer *p, int32_t p1, const cs_sum4 *change, cs_sum4 *sum) {
  for (int32_t k = 0, count = p1 - p->from; k < count; k++) {
    *sum += change[k];
    cs_row_writer_to(p, p->from + 1, cs_v4_settled(__builtin_convertvector(*sum, cs_v4)));
  }
}

/* ---- wide windows
 *
 *      tile 0        tile 1        tile 2       a local sweep gives its borders slab by slab, each
 *   |  \    /    |           \|/            |   across the whole window: so they are listed by the
 *   |   \  /  .--+--. /      /|\            |   tile in which they begin, and one that crosses into
 *                                               the next tile is passed on to its list
 *
 * The lists are in the order of the borders, since that is the order of the sums. */

/* The lists of all tiles of a window. */
static celspan_status list_by_tiles(const cs_window *window, crossing ***out) {
  celspan_context *context = window->composer->context;
  size_t count = (size_t)((window->end - window->from + TILE - 1) / TILE);
  crossing **lists = cs_arena_take(context, window->arena, count * sizeof *lists);
  crossing *all = cs_arena_take(context, window->arena, window->border_count * sizeof *all);
  if (!lists || !all)
    return CELSPAN_NO_MEMORY;
  memset(lists, 0, count * sizeof *lists);
  for (size_t i = window->border_count; i-- > 0;) {
    const cs_window_border *at = &window->borders[i];
    if (at->piece.first >= window->end)
      continue;
    crossing **list = &lists[(at->piece.first - window->from) / TILE];
    all[i] = (crossing){at->piece, &at->border, *list};
    *list = &all[i];
  }
  *out = lists;
  return CELSPAN_OK;
}

static crossing *join_lists(crossing *a, crossing *b) {
  crossing *joined, **last = &joined;
  while (a && b) {
    crossing **earlier = a < b ? &a : &b;
    *last = *earlier;
    last = &(*last)->next;
    *earlier = *last;
  }
  *last = a ? a : b;
  return joined;
}

/* The borders of a list that still change the sums from column p on. */
static crossing *pass_on(crossing *list, int32_t p) {
  crossing *passed, **last = &passed;
  for (; list; list = list->next)
    if (list->piece.end >= p) {
      *last = list;
      last = &list->next;
    }
  *last = NULL;
  return passed;
}

/* The drawn part of the window. */
typedef struct drawn {
  int32_t end; /* the end of the drawn columns */
  cs_sum4 sum; /* the sum in the last drawn column */
} drawn;

/* Draws the columns up to p1. The borders of a list change the columns from p0 on. */
static celspan_status draw_tile(const cs_window *window, const crossing *list, int32_t p0,
                                int32_t p1, drawn *done) {
  cs_sum4 change[TILE];
  memset(change, 0, (size_t)(p1 - p0) * sizeof *change);
  for (; list; list = list->next)
    add_changes(list, p0, p1, change);
  CS_TRY(cs_row_reserve(window->composer->context, window->out, (size_t)(p1 - p0) + 1));
  cs_row_writer p = cs_row_writer_begin(window->out, done->end);
  cs_row_writer_to(&p, p0, cs_v4_settled(__builtin_convertvector(done->sum, cs_v4)));
  draw_sums(&p, p1, change, &done->sum);
  cs_row_writer_end(&p);
  done->end = p1;
  return CELSPAN_OK;
}

/* Flat cells on all sides: sums of colour steps, in the order of the borders. */
static celspan_status close_wide(const cs_window *window) {
  drawn done = {window->from, CS_SUM4(window->base->colour)};
  crossing **lists, *list = NULL;
  CS_TRY(list_by_tiles(window, &lists));
  for (int32_t p0 = window->from, p1; p0 < window->end; p0 = p1) {
    p1 = window->end - p0 < TILE ? window->end : p0 + TILE;
    list = join_lists(list, *lists++);
    if (list || p1 == window->end)
      CS_TRY(draw_tile(window, list, p0, p1, &done));
    list = pass_on(list, p1);
  }
  return CELSPAN_OK;
}

/* The same if the window is a few pixels wide, as nearly all windows are: the sums have been made
 * already. */
static celspan_status close_narrow(cs_window *window) {
  cs_sum4 sum = CS_SUM4(window->base->colour);
  CS_TRY(
      cs_row_reserve(window->composer->context, window->out, (size_t)(window->end - window->from)));
  cs_row_writer p = cs_row_writer_begin(window->out, window->from);
  draw_sums(&p, window->end, window->change, &sum);
  cs_row_writer_end(&p);
  return CELSPAN_OK;
}

/* ---- cells that vary: every cell's colour at the pixel's centre, weighted by its area there
 *
 * The window is made in tiles from left to right. A border takes area from the cell on its left
 * and gives it to the one on its right: pixel by pixel in the columns that it crosses, and as a
 * whole (the cell's carry) in all tiles after. Areas add exactly, so a cell that is not in a pixel
 * weighs 0 there. */

typedef struct weighted_cell {
  const cs_cell *cell;
  double carry;    /* the weight of the colour in pixels that no border crosses */
  double *weights; /* a weight for each pixel of the tile; NULL: all weights are the carry */
} weighted_cell;

typedef struct cell_edge {
  cs_direct_piece piece;
  const cs_border *border;
  uint32_t left, right; /* indices into cells */
} cell_edge;

typedef struct mixture {
  cs_window *window;
  weighted_cell *cells;
  size_t cell_count;
  cell_edge *edges; /* by first column */
  size_t edge_count;
  size_t begun, ended; /* edges [ended, begun) may cross the tile */
} mixture;

/* The index of a cell, or of another cell with the same colours. */
static uint32_t find_cell(mixture *m, const cs_cell *cell) {
  for (size_t i = 0; i < m->cell_count; i++)
    if (m->cells[i].cell == cell || cs_composer_same(m->window->composer, m->cells[i].cell, cell))
      return (uint32_t)i;
  m->cells[m->cell_count] = (weighted_cell){.cell = cell};
  return (uint32_t)m->cell_count++;
}

static inline bool edge_is_before(const cell_edge *a, const cell_edge *b) {
  return a->piece.first != b->piece.first ? a->piece.first < b->piece.first : a->border < b->border;
}

CS_SORT_DEFINE(sort_edges, cell_edge, edge_is_before)

static celspan_status begin_mixture(cs_window *window, mixture *m) {
  celspan_context *context = window->composer->context;
  size_t count = window->border_count;
  *m = (mixture){.window = window, .edge_count = count};
  m->cells = cs_arena_take(context, window->arena, (2 * count + 1) * sizeof *m->cells);
  m->edges = cs_arena_take(context, window->arena, count * sizeof *m->edges);
  if (!m->cells || !m->edges)
    return CELSPAN_NO_MEMORY;
  m->cells[find_cell(m, window->base)].carry = 1;
  for (size_t i = 0; i < count; i++) {
    const cs_border *border = &window->borders[i].border;
    uint32_t left = find_cell(m, border->left);
    m->edges[i] = (cell_edge){window->borders[i].piece, border, left, find_cell(m, border->right)};
  }
  sort_edges(m->edges, count);
  return CELSPAN_OK;
}

static celspan_status open_weights(mixture *m, weighted_cell *cell, int32_t count) {
  if (cell->weights)
    return CELSPAN_OK;
  cell->weights = cs_arena_take(m->window->composer->context, &m->window->tiles,
                                (size_t)count * sizeof *cell->weights);
  for (int32_t k = 0; cell->weights && k < count; k++)
    cell->weights[k] = cell->carry;
  return cell->weights ? CELSPAN_OK : CELSPAN_NO_MEMORY;
}

/* Moves area from cell to cell in the pixels of the tile. */
static celspan_status add_edge(mixture *m, const cell_edge *c, int32_t p0, int32_t p1) {
  const cs_direct_piece *f = &c->piece;
  weighted_cell *left = &m->cells[c->left], *right = &m->cells[c->right];
  CS_TRY(open_weights(m, left, p1 - p0));
  CS_TRY(open_weights(m, right, p1 - p0));
  for (int32_t p = f->first > p0 ? f->first : p0; p < p1; p++) {
    double area = p < f->end ? cover(f, p) : f->height;
    left->weights[p - p0] -= area;
    right->weights[p - p0] += area;
  }
  return CELSPAN_OK;
}

/* Turns the edges that end in the tile into carries; the others remain listed. */
static void retire_edges(mixture *m, int32_t p1) {
  size_t kept = m->begun;
  for (size_t i = m->begun; i-- > m->ended;) {
    const cell_edge c = m->edges[i];
    if (c.piece.end > p1) {
      m->edges[--kept] = c;
      continue;
    }
    m->cells[c.left].carry -= c.piece.height;
    m->cells[c.right].carry += c.piece.height;
  }
  m->ended = kept;
}

static inline double weight_in(const weighted_cell *cell, int32_t k) {
  return cell->weights ? cell->weights[k] : cell->carry;
}

/* Adds a cell to the pixels in which it has area. Its colours are computed only there. sum: four
 * floats a pixel. */
static celspan_status add_cell(const mixture *m, const weighted_cell *cell, int32_t p0, int32_t p1,
                               float *sum) {
  float rgba[TILE][4];
  int32_t first = 0, end = p1 - p0;
  while (first < end && weight_in(cell, first) == 0)
    first++;
  while (end > first && weight_in(cell, end - 1) == 0)
    end--;
  CS_TRY(cs_painter_colours(m->window->painter, cell->cell,
                            (cs_run){p0 + first, p0 + end, m->window->centre}, rgba));
  for (int32_t k = first; k < end; k++)
    cs_v4_store(sum + 4 * k,
                cs_v4_load(sum + 4 * k) + cs_v4_load(rgba[k - first]) * (float)weight_in(cell, k));
  return CELSPAN_OK;
}

/* Room for the colours of [p0, p1), 4 floats a pixel: memory of the row or, for few colours,
 * `room`. */
static celspan_status open_pixels(cs_window *window, int32_t p0, int32_t p1, float *room,
                                  float **out) {
  *out = room;
  return p1 - p0 <= FEW ? CELSPAN_OK
                        : cs_row_array(window->composer->context, window->out, p0, p1, out);
}

static celspan_status put_pixels(cs_window *window, int32_t p0, int32_t p1, float *sum) {
  for (int32_t k = 0; k < p1 - p0; k++) {
    cs_v4 colour = cs_v4_settled(cs_v4_load(sum + 4 * k));
    if (p1 - p0 > FEW)
      cs_v4_store(sum + 4 * k, colour);
    else
      CS_TRY(cs_row_single(window->composer->context, window->out, p0 + k, p0 + k + 1, colour));
  }
  return CELSPAN_OK;
}

static celspan_status close_tile(mixture *m, int32_t p0, int32_t p1) {
  cs_window *window = m->window;
  float room[4 * FEW], *sum;
  cs_arena_reset(&window->tiles);
  for (size_t i = 0; i < m->cell_count; i++)
    m->cells[i].weights = NULL;
  while (m->begun < m->edge_count && m->edges[m->begun].piece.first < p1)
    m->begun++;
  for (size_t i = m->ended; i < m->begun; i++)
    CS_TRY(add_edge(m, &m->edges[i], p0, p1));
  CS_TRY(open_pixels(window, p0, p1, room, &sum));
  memset(sum, 0, (size_t)(p1 - p0) * 4 * sizeof *sum);
  for (size_t i = 0; i < m->cell_count; i++)
    if (m->cells[i].weights || m->cells[i].carry != 0)
      CS_TRY(add_cell(m, &m->cells[i], p0, p1, sum));
  retire_edges(m, p1);
  return put_pixels(window, p0, p1, sum);
}

/* Adds the areas right of a border in the columns of the window. */
static void add_areas(const cs_window *window, const cs_direct_piece *f, double *areas) {
  for (int32_t p = f->first; p < window->end; p++)
    areas[p - window->from] += p < f->end ? cover(f, p) : f->height;
}

/* The same where one boundary goes through the whole row, straight or bent, as in most windows. */
static celspan_status close_between(cs_window *window) {
  const cs_border *border = &window->borders->border;
  int32_t p0 = window->from, p1 = window->end;
  float left[CS_WINDOW_NARROW][4], right[CS_WINDOW_NARROW][4], room[4 * FEW], *sum;
  double areas[CS_WINDOW_NARROW];
  cs_run run = {p0, p1, window->centre};
  CS_TRY(cs_painter_colours(window->painter, border->left, run, left));
  CS_TRY(cs_painter_colours(window->painter, border->right, run, right));
  CS_TRY(open_pixels(window, p0, p1, room, &sum));
  memset(areas, 0, (size_t)(p1 - p0) * sizeof *areas);
  for (size_t i = 0; i < window->border_count; i++)
    add_areas(window, &window->borders[i].piece, areas);
  for (int32_t k = 0; k < p1 - p0; k++)
    cs_v4_store(sum + 4 * k, cs_v4_load(left[k]) * (float)(1 - areas[k]) +
                                 cs_v4_load(right[k]) * (float)areas[k]);
  return put_pixels(window, p0, p1, sum);
}

/* Whether the borders are the pieces of one boundary that goes through the whole row. */
static bool is_between(const cs_window *window) {
  const cs_border *first = &window->borders->border;
  const cs_composer *composer = window->composer;
  bool is_one = window->end - window->from <= CS_WINDOW_NARROW;
  double height = 0;
  for (size_t i = 0; i < window->border_count && is_one; i++) {
    const cs_window_border *at = &window->borders[i];
    is_one = at->border.left == first->left && at->border.right == first->right;
    height += at->piece.height;
  }
  return is_one && height == 1 &&
         (first->left == window->base || cs_composer_same(composer, first->left, window->base)) &&
         !cs_composer_same(composer, first->left, first->right);
}

static celspan_status close_varying(cs_window *window) {
  mixture m;
  CS_TRY(begin_mixture(window, &m));
  for (int32_t p = window->from; p < window->end; p += TILE)
    CS_TRY(close_tile(&m, p, window->end - p < TILE ? window->end : p + TILE));
  return CELSPAN_OK;
}

static celspan_status draw_window(cs_window *window) {
  if (window->varies)
    return is_between(window) ? close_between(window) : close_varying(window);
  if (window->border_count == 1 && window->borders->piece.end > window->borders->piece.first)
    return close_lone(window);
  return window->end - window->from <= CS_WINDOW_NARROW ? close_narrow(window) : close_wide(window);
}

/* next: the first column of the next window. */
static celspan_status close_window(cs_window *window, int32_t next) {
  say_ahead(window, next);
  if (window->end > window->from)
    CS_TRY(draw_window(window));
  clear_change(window);
  window->from = window->end;
  window->border_count = 0;
  window->is_open = window->varies = false;
  return CELSPAN_OK;
}

/* Closes the open window, if any, and writes the cell up to the next one. */
static celspan_status write_to(cs_window *window, int32_t next) {
  if (window->is_open)
    CS_TRY(close_window(window, next));
  else
    say_ahead(window, next);
  return cs_painter_run(window->painter, window->cell, (cs_run){window->from, next, window->centre},
                        window->out);
}

/* ---------------------------------------------------------------- items */

celspan_status cs_window_begin_item(cs_window *window, double x) {
  int32_t first = cs_edges_floor(x, window->width);
  if (window->is_whole_row || (window->is_open && first < window->end))
    return CELSPAN_OK;
  CS_TRY(write_to(window, first));
  if (first > window->from)
    window->from = first;
  window->end = window->from;
  window->base = window->cell;
  window->varies = window->base->length > 0;
  window->is_open = true;
  return CELSPAN_OK;
}

/* Extends the window to the columns of a new border. If the cells of the border are flat and the
 * columns few, adds the border to the sums of the columns. */
static void note_border(cs_window *window, const cs_window_border *noted) {
  const cs_border *border = &noted->border;
  window->end = noted->piece.end > window->end ? noted->piece.end : window->end;
  if ((border->left->length | border->right->length) != 0) {
    window->varies = true;
  } else if (noted->piece.end - window->from <= CS_WINDOW_NARROW) {
    cs_sum4 step = CS_SUM4(border->right->colour) - CS_SUM4(border->left->colour);
    cs_direct_add(window->change, window->from, noted->piece, &step);
    window->has_change = true;
  }
}

celspan_status cs_window_add(cs_window *window, const cs_border *border) {
  CS_TRY(CS_ARRAY_RESERVE(window->composer->context, window->borders, window->border_count + 1));
  cs_window_border *added = &window->borders[window->border_count++];
  *added = (cs_window_border){*border, measure(window, border)};
  note_border(window, added);
  return CELSPAN_OK;
}

/* Draws the edges from the first on, up to an edge that cannot be drawn directly. Returns their
 * number. */
static size_t draw_edges(cs_window *window, const cs_direct_edges *direct) {
  cs_row_writer writer = cs_row_writer_begin(window->out, window->from);
  size_t done = CS_WIDE_CHOOSE(window->painter->isa, cs_direct_draw)(direct, &writer);
  cs_row_writer_end(&writer);
  window->from = window->end = writer.from;
  if (done > 0)
    window->cell = &direct->cells[direct->boundaries[done - 1] + 1];
  return done;
}

/* Boundary i, as an item of the window. */
static celspan_status add_boundary(cs_window *window, const cs_direct_edges *edges, size_t i) {
  const cs_cell *left = &edges->cells[i];
  const cs_bend *bend = edges->edges->is_bent[i] ? cs_active_bend(edges->active, i) : NULL;
  CS_TRY(cs_window_begin_item(window, edges->edges->low[i]));
  cs_window_end_item(window, left + 1);
  for (cs_pieces p = cs_pieces_of(edges->active, i, bend); cs_pieces_next(&p);) {
    const cs_border border = {{p.above.x, p.above.y, p.below.x, p.below.y}, left, left + 1};
    CS_TRY(cs_window_add(window, &border));
  }
  return CELSPAN_OK;
}

celspan_status cs_window_edges(cs_window *window, cs_direct_edges *rest) {
  for (; rest->count > 0; rest->boundaries++, rest->count--) {
    size_t i = rest->boundaries[0];
    if (window->is_open && rest->edges->first[i] >= window->end)
      CS_TRY(close_window(window, rest->edges->first[i]));
    if (!window->is_open) {
      CS_TRY(
          cs_row_reserve(window->composer->context, window->out, CS_DIRECT_EACH * rest->count + 1));
      size_t done = draw_edges(window, rest);
      rest->boundaries += done;
      rest->count -= done;
      if (rest->count == 0)
        break;
    }
    CS_TRY(add_boundary(window, rest, rest->boundaries[0]));
  }
  return CELSPAN_OK;
}

celspan_status cs_window_end_row(cs_window *window) { return write_to(window, window->width); }
