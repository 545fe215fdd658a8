/* One row of tiles while one layer is culled and then fills it. Layers come from the camera
 * backwards; every row of tiles is treated by itself.
 *
 *     tile     0   1   2   3   4   5   6   7
 *            +---+---+---+---+---+---+---+---+  top of the row
 *            | \ |   |   |   |   |   | / |   |  \ /: chords of chains, which meet at o
 *            |  o|   |   |   |   |   |o  |   |  chain A: +1, touches tiles 0 and 1
 *            |   |\  |   |   |   |  /|   |   |  chain B: -1, touches tiles 5 and 6
 *            +---+---+---+---+---+---+---+---+  foot of the row
 *   touched    1   1   0   0   0   1   1   0    by some chord, widened by its slack
 *   winding    1   1   1   1   1   0   0   0    changed in the first tile that a chain touches
 *   inside     0   0   1   1   1   0   0   0    the winding is that of the layer's presence, and no
 *                                               chain touches the tile
 *   live       1   1   1   0   0   1   1   1    inside tiles whose layers now let almost nothing
 *                                               through are dead for the layers behind
 *
 * Where all tiles that a chain touches are dead already, it is not kept in this row of tiles, and a
 * deferred winding change takes its place. A chain that begins or ends inside the row is kept, and
 * no tile between such chains counts as inside, because the winding is not the same at all heights.
 *
 * The whole cull is in one file, because its steps share the grid and the jobs declared here.
 */
#include "sweep/cull.h"

#include "base/number.h"
#include "base/thread_pool.h"
#include "geometry/polyline.h"
#include "geometry/polyline_vertex.h"

#include <math.h>
#include <string.h>

#define LAYERS_LEAST 8 /* with fewer there is nothing to gain */
#define TILE_ROWS_MOST 256
#define TILE_HEIGHT_LEAST 4
/* How far, in tiles, a chord may lie from the curve that it replaces. Fewer chords are quicker, but
 * a boundary that is treated as wider than it is leaves fewer tiles dead. */
#define SLACK_TILES 0.25
#define SLACK_LEAST 0x1p-8 /* pixels: more than all rounding */
/* The chains of one job, and how many jobs the rows of tiles are divided into for each worker,
 * where there are several. A thread that is free takes the next job. */
#define JOB_CHAINS 256
#define JOBS_A_WORKER 4

/* The columns (tiles of a row) that a chain touches in one row of tiles: low..high. */
typedef struct column_range {
  uint8_t low, high;
} column_range;

/* One thread culls the rows of tiles first..end - 1. */
typedef struct job {
  celspan_context context; /* a branch */
  celspan_status status;
  int32_t first, end;
  cs_deferred *deferred_list; /* in the order they were found */
  uint32_t *deferred_rows;
  size_t deferred_count, deferred_capacity, deferred_row_capacity;
} job;

typedef struct culler {
  celspan_context *context;
  const cs_cull_desc *desc;
  double width, height, margin; /* pixels */
  double slack;                 /* of chords, pixels */
  double columns_a_pixel;
  cs_cull *cull;
  /* By chain: its last row of tiles; less than its first one where it is outside the frame. */
  int32_t *last_rows;
  column_range *columns;  /* indexed as cull->kept */
  uint32_t *layer_starts; /* layer_count + 1, into by_layer */
  uint32_t *by_layer;     /* chains of each layer */
  uint64_t *live;         /* one a row of tiles */
  double *through;        /* one a tile */
  job *jobs;
  int32_t job_count;
} culler;

/* ---------------------------------------------------------------- the grid */

static int32_t choose_rows(size_t layers, int32_t height) {
  int32_t rows = 16;
  while (rows < TILE_ROWS_MOST && (double)rows * rows < 64.0 * (double)layers)
    rows *= 2;
  while (rows > 1 && height / rows < TILE_HEIGHT_LEAST)
    rows /= 2;
  return rows;
}

static double row_top(const culler *c, int32_t row) {
  return row == 0 ? -c->margin : (double)row * c->cull->tile_height;
}

static double row_foot(const culler *c, int32_t row) {
  return row == c->cull->tile_rows - 1 ? c->height + c->margin
                                       : (double)(row + 1) * c->cull->tile_height;
}

/* Finds the rows of tiles that every chain crosses. */
static void find_rows(culler *c) {
  for (size_t i = 0; i < c->desc->set->chain_count; i++) {
    const cs_boundary_chain *chain = &c->desc->set->chains[i];
    bool is_near = chain->y1 > -c->margin && chain->y0 < c->height + c->margin;
    c->cull->first_rows[i] = is_near ? cs_cull_row(c->cull, chain->y0) : 0;
    c->last_rows[i] = is_near ? cs_cull_row(c->cull, chain->y1) : -1;
  }
}

/* The column at x. Callers have added a slack to x that is larger than any rounding error. */
static inline uint8_t column(const culler *c, double x) {
  const double most = CS_CULL_COLUMNS - 1;
  double at = x * c->columns_a_pixel, least = at > 0 ? at : 0; /* NaN counts as 0 */
  return (uint8_t)(least < most ? least : most);
}

static double column_edge(const culler *c, uint8_t index) {
  return c->width * index / CS_CULL_COLUMNS;
}

static uint64_t column_mask(column_range r) {
  uint64_t upto = r.high == 63 ? ~(uint64_t)0 : ((uint64_t)1 << (r.high + 1)) - 1;
  return upto & (~(uint64_t)0 << r.low);
}

/* ---------------------------------------------------------------- the columns of chains */

static void widen(column_range *r, uint8_t at) {
  r->low = at < r->low ? at : r->low;
  r->high = at > r->high ? at : r->high;
}

/* A chord of a chain, and how far the chain may be from it. */
typedef struct chord {
  celspan_point top, foot;
  double slack;
} chord;

/* x of the chord at a height; beyond its ends, x of the end. */
static inline double chord_x(const chord *line, double slope, double y) {
  double above = y < line->foot.y ? y : line->foot.y;
  double inside = above > line->top.y ? above : line->top.y;
  return line->top.x + (inside - line->top.y) * slope;
}

/* Notes the columns that a chord touches in the rows first..last. */
static void find_chord_columns(const culler *c, const chord *line, int32_t first, int32_t last,
                               column_range *columns) {
  int32_t from = cs_cull_row(c->cull, line->top.y - line->slack);
  int32_t to = cs_cull_row(c->cull, line->foot.y + line->slack);
  from = from > first ? from : first;
  to = to < last ? to : last;
  double height = line->foot.y - line->top.y;
  double slope = height > 0 ? (line->foot.x - line->top.x) / height : 0;
  for (int32_t row = from; row <= to; row++) {
    double top = chord_x(line, slope, row_top(c, row) - line->slack);
    double foot = chord_x(line, slope, row_foot(c, row) + line->slack);
    widen(&columns[row - first], column(c, (top < foot ? top : foot) - line->slack));
    widen(&columns[row - first], column(c, (top < foot ? foot : top) + line->slack));
  }
}

/* Covers a piece with chords that are as long as the slack allows. A chord over s of the piece's
 * own chords lies within s^2 sags of the curve. What the sweep walks later, in segments at most 1.5
 * times as long as the piece's own chords, lies within 2.25 sags of the curve, and its displaced
 * vertices within CS_POLYLINE_LIFT sags more. */
static void find_piece_columns(const culler *c, const cs_boundary_piece *piece, int32_t first,
                               int32_t last, column_range *columns) {
  const double near = 2.25 + CS_POLYLINE_LIFT;
  double stride = piece->sag > 0 ? sqrt(fmax(c->slack / piece->sag - near, 1)) : 1;
  uint32_t step = stride < piece->chords ? (uint32_t)stride : piece->chords;
  chord line = {.slack = SLACK_LEAST + ((double)step * step + near) * piece->sag};
  line.top = cs_polyline_plain(c->desc->set, piece, 0);
  for (uint32_t vertex = 0; vertex < piece->chords; line.top = line.foot) {
    vertex = piece->chords - vertex > step ? vertex + step : piece->chords;
    line.foot = cs_polyline_plain(c->desc->set, piece, vertex);
    find_chord_columns(c, &line, first, last, columns);
  }
}

static void find_chain_columns(const culler *c, uint32_t chain, column_range *columns) {
  const cs_boundary_chain *ch = &c->desc->set->chains[chain];
  int32_t first = c->cull->first_rows[chain], last = c->last_rows[chain];
  for (int32_t row = first; row <= last; row++)
    columns[row - first] = (column_range){CS_CULL_COLUMNS - 1, 0};
  for (uint32_t k = 0; k < ch->piece_count; k++)
    find_piece_columns(c, &c->desc->set->pieces[ch->piece + k], first, last, columns);
}

static void find_columns_job(void *user, int worker, int32_t number) {
  const culler *c = user;
  (void)worker;
  size_t first = (size_t)number * JOB_CHAINS, end = first + JOB_CHAINS;
  for (size_t chain = first; chain < end && chain < c->desc->set->chain_count; chain++)
    find_chain_columns(c, (uint32_t)chain, c->columns + c->cull->places[chain]);
}

static celspan_status find_columns(culler *c) {
  cs_cull *cull = c->cull;
  size_t chains = c->desc->set->chain_count, places = 0;
  for (uint32_t chain = 0; chain < chains; chain++) {
    cull->places[chain] = places;
    places += (size_t)(c->last_rows[chain] - cull->first_rows[chain] + 1);
  }
  cull->kept_count = places;
  c->columns = cs_mem_array(c->context->memory, places, sizeof *c->columns);
  cull->kept = cs_mem_array(c->context->memory, places, sizeof *cull->kept);
  if (places > 0 && (!c->columns || !cull->kept))
    return cs_fail_memory(c->context);
  cs_thread_pool_run(c->desc->workers, (int32_t)((chains + JOB_CHAINS - 1) / JOB_CHAINS),
                     find_columns_job, c);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- one layer */

static celspan_status defer_chain(job *s, int32_t row, double x, const cs_boundary_chain *chain) {
  CS_TRY(cs_mem_reserve(&s->context, (void **)&s->deferred_list, &s->deferred_capacity,
                        s->deferred_count + 1, sizeof *s->deferred_list));
  CS_TRY(cs_mem_reserve(&s->context, (void **)&s->deferred_rows, &s->deferred_row_capacity,
                        s->deferred_count + 1, sizeof *s->deferred_rows));
  s->deferred_rows[s->deferred_count] = (uint32_t)row;
  s->deferred_list[s->deferred_count++] = (cs_deferred){x, chain->layer, chain->direction};
  return CELSPAN_OK;
}

/* The chains of one layer in one row of tiles. A chain is partial where it begins or ends inside
 * the row. */
typedef struct footprint {
  uint64_t touched;
  column_range partial; /* from the first to the last column of partial chains */
  bool is_partial, keeps_any;
  uint64_t crossed;                 /* columns in which some chain crosses the top of the row */
  int32_t winding[CS_CULL_COLUMNS]; /* the sum of the crossings of a column, where crossed */
} footprint;

static void cross_column(footprint *f, uint8_t index, int32_t direction) {
  uint64_t bit = (uint64_t)1 << index;
  f->winding[index] = (f->crossed & bit ? f->winding[index] : 0) + direction;
  f->crossed |= bit;
}

static celspan_status place_chain(const culler *c, job *s, uint32_t chain, int32_t row,
                                  footprint *f) {
  const cs_boundary_chain *ch = &c->desc->set->chains[chain];
  double top = row_top(c, row), foot = row_foot(c, row);
  size_t place = c->cull->places[chain] + (size_t)(row - c->cull->first_rows[chain]);
  column_range r = c->columns[place];
  f->touched |= column_mask(r);
  if (ch->y0 <= top && top < ch->y1)
    cross_column(f, r.low, ch->direction);
  bool is_partial = ch->y0 > top || ch->y1 < foot;
  if (is_partial) {
    f->partial = f->is_partial ? f->partial : r;
    widen(&f->partial, r.low);
    widen(&f->partial, r.high);
    f->is_partial = true;
  }
  if (is_partial || (column_mask(r) & c->live[row])) {
    c->cull->kept[place] = f->keeps_any = true;
    return CELSPAN_OK;
  }
  return defer_chain(s, row, column_edge(c, r.low), ch);
}

/* The columns that lie inside the layer over the whole height of the row of tiles. */
static uint64_t inside_mask(const footprint *f, int32_t winding_mask) {
  uint64_t inside = 0;
  int32_t winding = 0;
  for (uint64_t left = f->crossed; left; left &= left - 1) {
    int index = __builtin_ctzll(left);
    bool was_inside = winding & winding_mask;
    winding += f->winding[index];
    if (was_inside != ((winding & winding_mask) != 0))
      inside ^= ~(uint64_t)0 << index; /* from this column on */
  }
  inside &= ~f->touched;
  return f->is_partial ? inside & ~column_mask(f->partial) : inside;
}

/* Lets the layer reduce what the tiles inside it let through; tiles below `opaque` become dead. */
static void cover(const culler *c, int32_t row, uint64_t inside, double through) {
  for (uint64_t left = inside & c->live[row]; left; left &= left - 1) {
    int index = __builtin_ctzll(left);
    double *tile = &c->through[(size_t)row * CS_CULL_COLUMNS + (size_t)index];
    *tile *= through;
    if (*tile < c->desc->opaque)
      c->live[row] &= ~((uint64_t)1 << index);
  }
}

static celspan_status cull_layer_row(const culler *c, job *s, uint32_t layer, int32_t row) {
  footprint f;
  f.touched = f.crossed = 0;
  f.partial = (column_range){0, 0};
  f.is_partial = f.keeps_any = false;
  size_t deferred_before = s->deferred_count;
  for (uint32_t k = c->layer_starts[layer]; k < c->layer_starts[layer + 1]; k++) {
    uint32_t chain = c->by_layer[k];
    if (row >= c->cull->first_rows[chain] && row <= c->last_rows[chain])
      CS_TRY(place_chain(c, s, chain, row, &f));
  }
  uint64_t inside = f.touched ? inside_mask(&f, c->desc->layers[layer].winding_mask) : 0;
  if (!f.keeps_any && !(inside & c->live[row]))
    s->deferred_count = deferred_before; /* nothing of the layer can be seen in this row */
  if (c->desc->layers[layer].through < 1)
    cover(c, row, inside, c->desc->layers[layer].through);
  return CELSPAN_OK;
}

static celspan_status cull_layer(const culler *c, job *s, uint32_t layer) {
  int32_t top = s->end, bottom = s->first - 1;
  for (uint32_t k = c->layer_starts[layer]; k < c->layer_starts[layer + 1]; k++) {
    int32_t first = c->cull->first_rows[c->by_layer[k]], last = c->last_rows[c->by_layer[k]];
    top = first <= last && first < top ? first : top;
    bottom = last > bottom ? last : bottom;
  }
  top = top > s->first ? top : s->first;
  bottom = bottom < s->end ? bottom : s->end - 1;
  for (int32_t row = top; row <= bottom; row++)
    CS_TRY(cull_layer_row(c, s, layer, row));
  return CELSPAN_OK;
}

static void run_cull_job(void *user, int worker, int32_t number) {
  const culler *c = user;
  (void)worker;
  job *s = &c->jobs[number];
  for (size_t layer = c->desc->layer_count; layer-- > 0 && s->status == CELSPAN_OK;)
    s->status = cull_layer(c, s, (uint32_t)layer);
}

/* Culls all layers. The rows of tiles are divided into jobs, because they are independent. */
static celspan_status cull_layers(culler *c) {
  int32_t rows = c->cull->tile_rows,
          wanted = c->desc->workers > 1 ? JOBS_A_WORKER * c->desc->workers : 1;
  int32_t count = wanted < rows ? wanted : rows;
  c->jobs = cs_mem_array(c->context->memory, (size_t)count, sizeof *c->jobs);
  if (!c->jobs)
    return cs_fail_memory(c->context);
  c->job_count = count;
  for (int32_t i = 0; i < count; i++) {
    job *s = &c->jobs[i];
    cs_context_branch(&s->context, c->context);
    s->first = (int32_t)((int64_t)rows * i / count);
    s->end = (int32_t)((int64_t)rows * (i + 1) / count);
  }
  cs_thread_pool_run(c->desc->workers, count, run_cull_job, c);
  for (int32_t i = 0; i < count; i++)
    if (c->jobs[i].status != CELSPAN_OK)
      return cs_fail(c->context, c->jobs[i].status, "%s", c->jobs[i].context.error);
  return CELSPAN_OK;
}

/* Lists the chains of every layer. */
static void group_by_layer(culler *c) {
  size_t chains = c->desc->set->chain_count;
  for (size_t i = 0; i < chains; i++)
    c->layer_starts[c->desc->set->chains[i].layer + 1]++;
  for (size_t layer = 0; layer < c->desc->layer_count; layer++)
    c->layer_starts[layer + 1] += c->layer_starts[layer];
  for (size_t i = 0; i < chains; i++)
    c->by_layer[c->layer_starts[c->desc->set->chains[i].layer]++] = (uint32_t)i;
  for (size_t layer = c->desc->layer_count; layer > 0; layer--)
    c->layer_starts[layer] = c->layer_starts[layer - 1];
  c->layer_starts[0] = 0;
}

/* ---------------------------------------------------------------- by row of tiles */

static size_t deferred_key(const culler *c, const job *s, size_t i) {
  return s->deferred_rows[i] * CS_CULL_COLUMNS + column(c, s->deferred_list[i].x);
}

/* Writes the deferred changes in order; starts: by key, the index of its first one. */
static void place_deferred(const culler *c, uint32_t *starts) {
  for (int32_t k = 0; k < c->job_count; k++)
    for (size_t i = 0; i < c->jobs[k].deferred_count; i++)
      c->cull->deferred_list[starts[deferred_key(c, &c->jobs[k], i)]++] =
          c->jobs[k].deferred_list[i];
}

/* Sorts the deferred changes by row of tiles, then by column. A counting sort is stable, so equal
 * ones keep their order. */
static celspan_status sort_deferred(culler *c) {
  cs_cull *cull = c->cull;
  size_t keys = (size_t)cull->tile_rows * CS_CULL_COLUMNS;
  uint32_t *starts = cs_mem_array(c->context->memory, keys + 1, sizeof *starts);
  if (!starts)
    return cs_fail_memory(c->context);
  for (int32_t k = 0; k < c->job_count; k++)
    for (size_t i = 0; i < c->jobs[k].deferred_count; i++)
      starts[deferred_key(c, &c->jobs[k], i) + 1]++;
  for (size_t key = 0; key < keys; key++)
    starts[key + 1] += starts[key];
  for (int32_t row = 0; row <= cull->tile_rows; row++)
    cull->deferred_starts[row] = starts[(size_t)row * CS_CULL_COLUMNS];
  cull->deferred_count = starts[keys];
  cull->deferred_list =
      cs_mem_array(c->context->memory, cull->deferred_count, sizeof *cull->deferred_list);
  if (cull->deferred_list)
    place_deferred(c, starts);
  cs_mem_free(c->context->memory, starts, (keys + 1) * sizeof *starts);
  return cull->deferred_count > 0 && !cull->deferred_list ? cs_fail_memory(c->context) : CELSPAN_OK;
}

/* Counts, or (enters) lists, by row of tiles the chains that are kept there but not in the row
 * above it. */
static void list_enters(culler *c, uint32_t *counts, uint32_t *enters) {
  const cs_cull *cull = c->cull;
  for (uint32_t chain = 0; chain < c->desc->set->chain_count; chain++)
    for (int32_t row = cull->first_rows[chain] + 1; row <= c->last_rows[chain]; row++)
      if (cs_cull_keeps(cull, chain, row) && !cs_cull_keeps(cull, chain, row - 1)) {
        if (enters)
          enters[counts[row]] = chain;
        counts[row]++;
      }
}

static celspan_status find_enters(culler *c) {
  cs_cull *cull = c->cull;
  list_enters(c, cull->enter_starts + 1, NULL);
  for (int32_t row = 0; row < cull->tile_rows; row++)
    cull->enter_starts[row + 1] += cull->enter_starts[row];
  cull->enter_count = cull->enter_starts[cull->tile_rows];
  cull->enters = cs_mem_array(c->context->memory, cull->enter_count, sizeof *cull->enters);
  if (cull->enter_count > 0 && !cull->enters)
    return cs_fail_memory(c->context);
  list_enters(c, cull->enter_starts, cull->enters);
  for (int32_t row = cull->tile_rows; row > 0; row--)
    cull->enter_starts[row] = cull->enter_starts[row - 1];
  cull->enter_starts[0] = 0;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- life */

static celspan_status make_room(culler *c) {
  cs_memory *memory = c->context->memory;
  cs_cull *cull = c->cull;
  size_t rows = (size_t)cull->tile_rows, chains = c->desc->set->chain_count;
  cull->places = cs_mem_array(memory, chains, sizeof *cull->places);
  cull->first_rows = cs_mem_array(memory, chains, sizeof *cull->first_rows);
  c->last_rows = cs_mem_array(memory, chains, sizeof *c->last_rows);
  cull->deferred_starts = cs_mem_array(memory, rows + 1, sizeof *cull->deferred_starts);
  cull->enter_starts = cs_mem_array(memory, rows + 1, sizeof *cull->enter_starts);
  c->layer_starts = cs_mem_array(memory, c->desc->layer_count + 1, sizeof *c->layer_starts);
  c->by_layer = cs_mem_array(memory, chains, sizeof *c->by_layer);
  c->live = cs_mem_array(memory, rows, sizeof *c->live);
  c->through = cs_mem_array(memory, rows * CS_CULL_COLUMNS, sizeof *c->through);
  if (!cull->places || !cull->first_rows || !c->last_rows || !cull->deferred_starts ||
      !cull->enter_starts || !c->layer_starts || !c->by_layer || !c->live || !c->through)
    return cs_fail_memory(c->context);
  memset(c->live, 0xff, rows * sizeof *c->live);
  for (size_t i = 0; i < rows * CS_CULL_COLUMNS; i++)
    c->through[i] = 1;
  return CELSPAN_OK;
}

static void free_room(culler *c) {
  cs_memory *memory = c->context->memory;
  size_t rows = (size_t)c->cull->tile_rows;
  for (int32_t i = 0; i < c->job_count; i++) {
    job *s = &c->jobs[i];
    cs_mem_free(memory, s->deferred_list, s->deferred_capacity * sizeof *s->deferred_list);
    cs_mem_free(memory, s->deferred_rows, s->deferred_row_capacity * sizeof *s->deferred_rows);
  }
  cs_mem_free(memory, c->jobs, (size_t)c->job_count * sizeof *c->jobs);
  cs_mem_free(memory, c->columns, c->cull->kept_count * sizeof *c->columns);
  cs_mem_free(memory, c->last_rows, c->desc->set->chain_count * sizeof *c->last_rows);
  cs_mem_free(memory, c->layer_starts, (c->desc->layer_count + 1) * sizeof *c->layer_starts);
  cs_mem_free(memory, c->by_layer, c->desc->set->chain_count * sizeof *c->by_layer);
  cs_mem_free(memory, c->live, rows * sizeof *c->live);
  cs_mem_free(memory, c->through, rows * CS_CULL_COLUMNS * sizeof *c->through);
}

static celspan_status cull_all(culler *c) {
  CS_TRY(make_room(c));
  find_rows(c);
  CS_TRY(find_columns(c));
  group_by_layer(c);
  CS_TRY(cull_layers(c));
  CS_TRY(sort_deferred(c));
  return find_enters(c);
}

celspan_status cs_cull_create(celspan_context *context, const cs_cull_desc *desc, cs_cull *out) {
  size_t chains = desc->set->chain_count;
  cs_cull cull = {.chain_count = chains};
  *out = cull;
  if (desc->layer_count < LAYERS_LEAST || chains == 0)
    return CELSPAN_OK;
  int32_t rows = choose_rows(desc->layer_count, desc->height);
  cull.tile_height = (int32_t)(((int64_t)desc->height + rows - 1) / rows);
  cull.tile_rows = (int32_t)(((int64_t)desc->height + cull.tile_height - 1) / cull.tile_height);
  culler c = {.context = context,
              .desc = desc,
              .width = desc->width,
              .height = desc->height,
              .margin = desc->margin,
              .cull = &cull};
  c.columns_a_pixel = CS_CULL_COLUMNS / c.width;
  c.slack = SLACK_TILES * fmin(c.width / CS_CULL_COLUMNS, cull.tile_height);
  celspan_status status = cull_all(&c);
  free_room(&c);
  if (status == CELSPAN_OK)
    *out = cull;
  else
    cs_cull_free(&cull, context->memory);
  return status;
}

void cs_cull_free(cs_cull *cull, cs_memory *memory) {
  size_t rows = (size_t)cull->tile_rows + 1;
  cs_mem_free(memory, cull->deferred_list, cull->deferred_count * sizeof *cull->deferred_list);
  cs_mem_free(memory, cull->deferred_starts, rows * sizeof *cull->deferred_starts);
  cs_mem_free(memory, cull->enters, cull->enter_count * sizeof *cull->enters);
  cs_mem_free(memory, cull->enter_starts, rows * sizeof *cull->enter_starts);
  cs_mem_free(memory, cull->kept, cull->kept_count * sizeof *cull->kept);
  cs_mem_free(memory, cull->places, cull->chain_count * sizeof *cull->places);
  cs_mem_free(memory, cull->first_rows, cull->chain_count * sizeof *cull->first_rows);
  *cull = (cs_cull){0};
}
