/* Crowds, column by column: segments of edges, steps at the left sides of pixels, and cells. */
#include "engine/area/crowd.h"

#include "base/number.h"
#include "base/sort.h"

#define LEAST 8   /* the least number of boundaries of a crowd */
#define A_PIXEL 2 /* the least number of them in a pixel, on the average */
#define EACH 4    /* the most columns that an edge crosses, on the average */
#define NOBODY UINT32_MAX
#define STRONG 0.51f  /* a layer that hides more than this is strong */
#define STRONG_EACH 4 /* at most one edge in STRONG_EACH may belong to a strong layer */

void cs_crowd_init(cs_crowd *crowd) { *crowd = (cs_crowd){.pixel.solver.isa = cs_isa_best()}; }

void cs_crowd_finish(cs_crowd *crowd, cs_memory *memory) {
  cs_crowd_pixel_finish(&crowd->pixel, memory);
  CS_ARRAYS_FREE(memory, crowd, segments, crossings);
  CS_ARRAYS_FREE(memory, &crowd->here, list, list);
  CS_ARRAYS_FREE(memory, &crowd->next, list, list);
  *crowd = (cs_crowd){0};
}

/* The most light that a layer hides. */
static inline float strength(cs_v4 t) {
  float least = t[0] < t[1] ? t[0] : t[1];
  return 1 - (least < t[2] ? least : t[2]);
}

bool cs_crowd_suits(const cs_intervals *intervals, const cs_interval *interval,
                    const cs_composer *composer, int32_t width) {
  const cs_edges *edges = intervals->edges;
  const cs_stack *stack = composer->stack;
  size_t members = interval->high - interval->low, crossed = 0, strong = 0;
  if (members < LEAST || !composer->is_flat || stack->tree_count > 0)
    return false;
  for (size_t i = interval->low; i < interval->high; i++) {
    int32_t first = cs_edges_floor(edges->low[i], width),
            end = cs_edges_ceil(edges->high[i], width);
    crossed += (size_t)(end - first);
    strong += strength(stack->layers[intervals->active->crossing[i].layer].t) > STRONG;
  }
  int32_t columns =
      cs_edges_ceil(interval->extent.high, width) - cs_edges_floor(interval->extent.low, width);
  return crossed >= A_PIXEL * (size_t)columns && crossed <= EACH * members &&
         STRONG_EACH * strong <= members;
}

/* ---------------------------------------------------------------- segments */

typedef struct drawing {
  cs_crowd *crowd;
  cs_local_sweep *sweep;
  celspan_context *context;
  cs_composer *composer;
  double next;        /* the least x of everything drawn after the interval */
  int32_t first, end; /* the columns that are drawn */
  const cs_cell *left;
  bool is_same; /* the next column is like the last one, unless edges or steps are in it */
} drawing;

static inline int32_t unit_of(double x) {
  return (int32_t)cs_number_clamp(x * CS_CROWD_UNIT + 0.5, 0, CS_CROWD_UNIT);
}

/* Adds the part of an edge in column p, from which x is counted. Parts without height, and those
 * right of the interval, change nothing. */
static celspan_status add_segment(const drawing *d, uint32_t edge, int32_t p, const double x[2],
                                  const int32_t y[2]) {
  cs_crowd *crowd = d->crowd;
  if (y[0] >= y[1] || p >= d->end)
    return CELSPAN_OK;
  uint32_t *column = &crowd->columns[p - d->first + 1];
  cs_crowd_segment made = {(uint16_t)unit_of(x[0] - p),
                           (uint16_t)y[0],
                           (uint16_t)unit_of(x[1] - p),
                           (uint16_t)y[1],
                           edge,
                           *column};
  *column = (uint32_t)crowd->segment_count;
  return CS_ARRAY_APPEND(d->context, crowd->segments, crowd->segment_count, made);
}

/* The column of x, for a line that continues from there to the right or (leans < 0) to the left.
 * The columns left of the interval are one, and those right of it. */
static inline int32_t column_of(const drawing *d, double x, double leans) {
  if (!(x > d->first - 1))
    return d->first - 1;
  if (x >= d->end)
    return d->end - (leans < 0 && x == d->end);
  int32_t column = x < 0 ? -1 : (int32_t)x;
  return column - (leans < 0 && column == x);
}

/* Cuts a straight piece at the columns. The height where it enters a column depends on the piece
 * alone, so two shapes with a common edge are cut in the same places. */
static celspan_status cut_piece(const drawing *d, uint32_t edge, celspan_point above,
                                celspan_point below) {
  double leans = below.x - above.x, top = above.y - d->sweep->y0, foot = below.y - d->sweep->y0;
  int32_t p = column_of(d, above.x, leans), last = column_of(d, below.x, -leans);
  int32_t step = leans < 0 ? -1 : 1, y[2] = {unit_of(top), unit_of(top)}, end = unit_of(foot);
  double x[2] = {above.x, above.x}, rise = (foot - top) / leans;
  for (; step > 0 ? p < last : p > last; p += step) {
    x[1] = p + (step > 0);
    y[1] = unit_of(top + (x[1] - above.x) * rise);
    y[1] = y[1] < y[0] ? y[0] : y[1] < end ? y[1] : end;
    CS_TRY(add_segment(d, edge, p, x, y));
    x[0] = x[1];
    y[0] = y[1];
  }
  x[1] = below.x;
  y[1] = end;
  return add_segment(d, edge, last, x, y);
}

static celspan_status cut_members(const drawing *d) {
  cs_crowd *crowd = d->crowd;
  size_t columns = (size_t)(d->end - d->first) + 1;
  CS_TRY(CS_ARRAY_RESERVE(d->context, crowd->columns, columns));
  memset(crowd->columns, 0xff, columns * sizeof *crowd->columns);
  crowd->segment_count = 0;
  for (size_t i = 0; i < d->sweep->count + d->sweep->begin_count; i++) {
    const cs_member *member = cs_local_sweep_member(d->sweep, i);
    for (uint32_t k = 1; k < member->point_count; k++)
      CS_TRY(cut_piece(d, 2 * member->layer + (member->direction > 0), member->points[k - 1],
                       member->points[k]));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the layers of a column */

static inline bool key_is_before(const uint64_t *a, const uint64_t *b) { return *a < *b; }

CS_SORT_DEFINE(sort_keys, uint64_t, key_is_before)

/* Lists the segments of a column, the nearest layers first, those of a layer as they were added.
 */
static celspan_status order_column(const drawing *d, int32_t p) {
  cs_crowd *crowd = d->crowd;
  crowd->order_count = 0;
  for (uint32_t i = crowd->columns[p - d->first + 1]; i != NOBODY; i = crowd->segments[i].next) {
    uint64_t key = (uint64_t)(UINT32_MAX - crowd->segments[i].edge / 2) << 32 | i;
    CS_TRY(CS_ARRAY_APPEND(d->context, crowd->order, crowd->order_count, key));
  }
  sort_keys(crowd->order, crowd->order_count);
  return CELSPAN_OK;
}

/* A layer with segments or steps in a column. */
typedef struct group {
  uint32_t layer;
  size_t segment, segment_end, step, step_end; /* in `order` and `here` */
  size_t made;                                 /* its first step in `next` */
} group;

static inline uint32_t layer_of(const cs_crowd *crowd, size_t k) {
  return UINT32_MAX - (uint32_t)(crowd->order[k] >> 32);
}

/* The group that follows; false after the last one. */
static bool next_group(const cs_crowd *crowd, group *g) {
  size_t k = g->segment = g->segment_end, s = g->step = g->step_end;
  bool has_segment = k < crowd->order_count, has_step = s < crowd->here.count;
  if (!has_segment && !has_step)
    return false;
  g->layer = has_segment ? layer_of(crowd, k) : crowd->here.list[s].layer;
  if (has_step && crowd->here.list[s].layer > g->layer)
    g->layer = crowd->here.list[s].layer;
  for (; k < crowd->order_count && layer_of(crowd, k) == g->layer; k++)
    continue;
  for (; s < crowd->here.count && crowd->here.list[s].layer == g->layer; s++)
    continue;
  g->segment_end = k;
  g->step_end = s;
  g->made = crowd->next.count;
  return true;
}

/* Adds a line of the layer under way. */
static inline void add_line(cs_crowd_pixel *pixel, cs_crowd_line line) {
  pixel->solver.lines[pixel->solver.line_count++] = line;
}

/* Adds the lines of a layer to the pixel: its left side, then its segments. */
static int add_lines(const drawing *d, const group *g) {
  const cs_crowd *crowd = d->crowd;
  cs_crowd_pixel *pixel = &d->crowd->pixel;
  int32_t winding = d->composer->presences[g->layer].winding, y = 0;
  size_t first = pixel->solver.line_count;
  for (size_t s = g->step; s < g->step_end; s++) {
    const cs_crowd_step *step = &crowd->here.list[s];
    add_line(pixel, (cs_crowd_line){0, y, 0, step->y, winding});
    winding += step->change;
    y = step->y;
  }
  add_line(pixel, (cs_crowd_line){0, y, 0, CS_CROWD_UNIT, winding});
  size_t sides = pixel->solver.line_count - first;
  for (size_t k = g->segment; k < g->segment_end; k++) {
    const cs_crowd_segment *f = &crowd->segments[(uint32_t)crowd->order[k]];
    add_line(pixel, (cs_crowd_line){f->xa, f->ya, f->xb, f->yb, f->edge % 2 ? 1 : -1});
  }
  return cs_crowd_pixel_add(pixel, g->layer, first, sides);
}

/* Changes the winding of the group's layer in the next column, below a height. Steps that cancel
 * out stay, as nothing, until all are made. */
static inline void add_step(cs_crowd *crowd, const group *g, int32_t y, int32_t change) {
  size_t k = crowd->next.count;
  for (; k > g->made && crowd->next.list[k - 1].y >= y; k--)
    if (crowd->next.list[k - 1].y == y) {
      crowd->next.list[k - 1].change += change;
      return;
    }
  for (size_t i = crowd->next.count++; i > k; i--)
    crowd->next.list[i] = crowd->next.list[i - 1];
  crowd->next.list[k] = (cs_crowd_step){g->layer, y, change};
}

/* Makes the steps of the layer at the left side of the next column. What changes at the top
 * becomes a crossing. */
static celspan_status pass_group(const drawing *d, const group *g) {
  cs_crowd *crowd = d->crowd;
  for (size_t s = g->step; s < g->step_end; s++)
    crowd->next.list[crowd->next.count++] = crowd->here.list[s];
  for (size_t k = g->segment; k < g->segment_end; k++) {
    const cs_crowd_segment *f = &crowd->segments[(uint32_t)crowd->order[k]];
    add_step(crowd, g, f->ya, f->edge % 2 ? 1 : -1);
    add_step(crowd, g, f->yb, f->edge % 2 ? -1 : 1);
  }
  size_t end = crowd->next.count, at = g->made;
  int32_t crossed = at < end && crowd->next.list[at].y == 0 ? crowd->next.list[at++].change : 0;
  crowd->next.count = g->made;
  for (; at < end; at++)
    if (crowd->next.list[at].change != 0 && crowd->next.list[at].y < CS_CROWD_UNIT)
      crowd->next.list[crowd->next.count++] = crowd->next.list[at];
  return crossed == 0 ? CELSPAN_OK
                      : CS_ARRAY_APPEND(d->context, crowd->crossings, crowd->crossing_count,
                                        (cs_crossing){g->layer, crossed});
}

static inline bool is_inside(const cs_presence *presence, int32_t winding) {
  return (winding & presence->rule.winding_mask) != 0;
}

/* Brings the composer to the next column, by the crossings from `from` on. */
static void cross(const drawing *d, size_t from) {
  cs_crowd *crowd = d->crowd;
  for (size_t i = from; i < crowd->crossing_count; i++) {
    const cs_crossing *at = &crowd->crossings[i];
    const cs_presence *presence = &d->composer->presences[at->layer];
    bool was_inside = is_inside(presence, presence->winding);
    cs_composer_cross(d->composer, at->layer, at->direction);
    if (is_inside(presence, presence->winding) != was_inside)
      cs_crowd_pixel_change(&crowd->pixel, at->layer);
  }
}

/* Goes through the layers of column p: adds them to its pixel, if it has one, and brings steps and
 * composer to the next column. is_cell: the pixel is the cell at its right side. */
static celspan_status pass_column(drawing *d, int32_t p, cs_v4 *colour, bool *is_cell) {
  cs_crowd *crowd = d->crowd;
  cs_crowd_pixel *pixel = &crowd->pixel;
  size_t most = crowd->order_count + crowd->here.count, from = crowd->crossing_count;
  CS_TRY(CS_ARRAY_RESERVE(d->context, crowd->next.list, 2 * most + 2));
  CS_TRY(cs_crowd_pixel_begin(pixel, most));
  crowd->next.count = 0;
  *is_cell = true;
  for (group g = {0}; next_group(crowd, &g);) {
    bool was_hidden = pixel->is_hidden;
    int whole = p < d->first || was_hidden ? 0 : add_lines(d, &g);
    size_t crossed = crowd->crossing_count;
    CS_TRY(pass_group(d, &g));
    const cs_presence *presence = &d->composer->presences[g.layer];
    int32_t change = crowd->crossing_count > crossed ? crowd->crossings[crossed].direction : 0;
    *is_cell &= was_hidden || (crowd->next.count == g.made &&
                               whole == is_inside(presence, presence->winding + change));
  }
  if (!*is_cell && p >= d->first)
    CS_TRY(cs_crowd_pixel_colour(pixel, colour));
  cross(d, from);
  cs_crowd_steps here = crowd->here;
  crowd->here = crowd->next;
  crowd->next = here;
  return pixel->failure;
}

/* ---------------------------------------------------------------- the interval */

/* Gives the pixels from column p on the colours of a cell. */
static celspan_status put_cell(drawing *d, int32_t p, const cs_cell *cell) {
  cs_window *window = &d->sweep->target->window;
  const cs_border border = {{p, d->sweep->y0, p, d->sweep->y1}, d->left, cell};
  if (p <= d->next) /* edges that are drawn later may change the pixels from there on */
    CS_TRY(cs_window_begin_item(window, p));
  if (!cs_window_begin_with(window, p, cell) && !cs_composer_same(d->composer, d->left, cell))
    CS_TRY(cs_window_add(window, &border));
  cs_window_end_item(window, cell);
  d->left = cell;
  return CELSPAN_OK;
}

/* Crosses the deferred winding changes that are left of column p. */
static void cross_deferred(drawing *d, int32_t p) {
  const cs_deferred *next = d->sweep->deferred.next;
  cs_deferred_forward(&d->sweep->deferred, d->composer, p);
  if (next == d->sweep->deferred.next)
    return;
  cs_crowd_pixel_forget(&d->crowd->pixel);
  d->is_same = false;
}

static celspan_status draw_column(drawing *d, int32_t p) {
  cs_v4 colour;
  bool is_cell;
  cross_deferred(d, p);
  CS_TRY(order_column(d, p));
  bool is_alone = d->crowd->order_count == 0;
  if (is_alone && d->is_same)
    return CELSPAN_OK;
  CS_TRY(pass_column(d, p, &colour, &is_cell));
  d->is_same = is_alone;
  if (p < d->first)
    return CELSPAN_OK;
  cs_cell *cell = cs_arena_take(d->context, d->sweep->arena, sizeof *cell);
  if (!cell)
    return CELSPAN_NO_MEMORY;
  if (is_cell)
    cs_composer_cell(d->composer, cell);
  else
    *cell = (cs_cell){.colour = colour};
  CS_TRY(put_cell(d, p, cell));
  return d->composer->failure;
}

static celspan_status draw_columns(drawing *d, const cs_cell *right) {
  CS_TRY(cut_members(d));
  for (int32_t p = d->first - 1; p < d->end; p++)
    CS_TRY(draw_column(d, p));
  return put_cell(d, d->end, right);
}

/* Brings the composer back to the left of the interval. */
static void go_back(const drawing *d) {
  const cs_crowd *crowd = d->crowd;
  for (size_t i = crowd->crossing_count; i-- > 0;)
    cs_composer_cross(d->composer, crowd->crossings[i].layer, -crowd->crossings[i].direction);
  cs_deferred_to(&d->sweep->deferred, d->composer, -INFINITY);
}

celspan_status cs_crowd_draw(cs_crowd *crowd, cs_local_sweep *sweep, cs_extent extent, double next,
                             const cs_cell *right) {
  int32_t width = sweep->target->window.width;
  drawing d = {.crowd = crowd,
               .sweep = sweep,
               .context = sweep->composer->context,
               .composer = sweep->composer,
               .next = next,
               .first = cs_edges_floor(extent.low, width),
               .end = cs_edges_ceil(extent.high, width),
               .left = sweep->left};
  crowd->pixel.composer = d.composer;
  crowd->pixel.failure = CELSPAN_OK;
  crowd->here.count = crowd->crossing_count = 0;
  cs_crowd_pixel_forget(&crowd->pixel);
  celspan_status status = draw_columns(&d, right);
  go_back(&d);
  return status;
}
