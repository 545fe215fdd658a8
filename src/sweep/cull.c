#include "sweep/cull.h"

#include "base/number.h"
#include "base/thread_pool.h"
#include "geometry/polyline.h"

#include <math.h>
#include <string.h>

#define LEAVES_LEAST 8 /* with fewer there is nothing to gain */
#define TILE_ROWS_MOST 256
#define TILE_HEIGHT_LEAST 4
/* How far, in tiles, chords may lie from the curves they stand for: fewer chords are quicker, a
 * boundary that is taken for wider hides less. */
#define SLACK_TILES 0.25
#define SLACK_LEAST 0x1p-8 /* pixels: more than all rounding */
/* What is done at a time, by whichever thread is free; a worker gets so many slices of the rows of
 * tiles, where there are several workers. */
#define SLICE_CHAINS 256
#define SLICES_A_WORKER 4

/* The columns a chain touches in one row of tiles. */
typedef struct reach {
  uint8_t low, high;
} reach;

/* Some rows of tiles that follow one another. */
typedef struct slice {
  celspan_context context; /* a branch */
  celspan_status status;
  int32_t first, end;
  cs_deferred *deferred_list; /* in the order they were found */
  uint32_t *deferred_rows;
  size_t deferred_count, deferred_capacity, deferred_row_capacity;
} slice;

typedef struct culler {
  celspan_context *context;
  const cs_boundary_set *set;
  const cs_cull_layer *layers;
  size_t layer_count;
  double width, height, margin, opaque;
  double slack; /* pixels */
  double columns_a_pixel;
  int workers;
  cs_cull *cull;
  int32_t *last_rows;     /* by chain: of tiles; less than the first where it is nowhere near */
  reach *reaches;         /* as cull->kept */
  uint32_t *layer_starts; /* leaf_count + 1, into by_leaf */
  uint32_t *by_layer;     /* chains of each leaf */
  uint64_t *live;         /* one a row of tiles */
  double *through;        /* one a tile */
  slice *slices;
  int32_t slice_count;
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
  for (size_t i = 0; i < c->set->chain_count; i++) {
    const cs_boundary_chain *chain = &c->set->chains[i];
    bool is_near = chain->y1 > -c->margin && chain->y0 < c->height + c->margin;
    c->cull->first_rows[i] = is_near ? cs_cull_row(c->cull, chain->y0) : 0;
    c->last_rows[i] = is_near ? cs_cull_row(c->cull, chain->y1) : -1;
  }
}

/* Rounding may err by less than the slack that x has been given. */
static inline uint8_t column(const culler *c, double x) {
  const double most = CS_CULL_COLUMNS - 1;
  double at = x * c->columns_a_pixel, held = at > 0 ? at : 0; /* what is no number counts as 0 */
  return (uint8_t)(held < most ? held : most);
}

static double column_edge(const culler *c, uint8_t index) {
  return c->width * index / CS_CULL_COLUMNS;
}

static uint64_t column_mask(reach r) {
  uint64_t upto = r.high == 63 ? ~(uint64_t)0 : ((uint64_t)1 << (r.high + 1)) - 1;
  return upto & (~(uint64_t)0 << r.low);
}

/* ---------------------------------------------------------------- where chains go */

static void widen(reach *r, uint8_t at) {
  r->low = at < r->low ? at : r->low;
  r->high = at > r->high ? at : r->high;
}

/* A chord of a chain, and how far from it the chain may be. */
typedef struct chord {
  celspan_point top, foot;
  double slack;
} chord;

/* x of the chord at a height, held to its ends. */
static inline double chord_x(const chord *line, double slope, double y) {
  double above = y < line->foot.y ? y : line->foot.y;
  double held = above > line->top.y ? above : line->top.y;
  return line->top.x + (held - line->top.y) * slope;
}

/* Notes the columns that a chord touches in the rows first..last. */
static void trace_chord(const culler *c, const chord *line, int32_t first, int32_t last,
                        reach *reaches) {
  int32_t from = cs_cull_row(c->cull, line->top.y - line->slack);
  int32_t to = cs_cull_row(c->cull, line->foot.y + line->slack);
  from = from > first ? from : first;
  to = to < last ? to : last;
  double height = line->foot.y - line->top.y;
  double slope = height > 0 ? (line->foot.x - line->top.x) / height : 0;
  for (int32_t row = from; row <= to; row++) {
    double top = chord_x(line, slope, row_top(c, row) - line->slack);
    double foot = chord_x(line, slope, row_foot(c, row) + line->slack);
    widen(&reaches[row - first], column(c, (top < foot ? top : foot) - line->slack));
    widen(&reaches[row - first], column(c, (top < foot ? foot : top) + line->slack));
  }
}

/* Walks a piece in chords as long as the slack allows: s of the piece's own lie within s^2 sags of
 * theirs; what is walked in the end, in steps at most 1.5 times as long, within 2.25 sags of the
 * curve and its displaced vertices. */
static void trace_piece(const culler *c, const cs_boundary_piece *piece, int32_t first,
                        int32_t last, reach *reaches) {
  const double near = 2.25 + CS_POLYLINE_LIFT;
  double stride = piece->sag > 0 ? sqrt(fmax(c->slack / piece->sag - near, 1)) : 1;
  uint32_t step = stride < piece->chords ? (uint32_t)stride : piece->chords;
  chord line = {.slack = SLACK_LEAST + ((double)step * step + near) * piece->sag};
  line.top = cs_polyline_plain(c->set, piece, 0);
  for (uint32_t vertex = 0; vertex < piece->chords; line.top = line.foot) {
    vertex = piece->chords - vertex > step ? vertex + step : piece->chords;
    line.foot = cs_polyline_plain(c->set, piece, vertex);
    trace_chord(c, &line, first, last, reaches);
  }
}

static void trace_chain(const culler *c, uint32_t chain, reach *reaches) {
  const cs_boundary_chain *ch = &c->set->chains[chain];
  int32_t first = c->cull->first_rows[chain], last = c->last_rows[chain];
  for (int32_t row = first; row <= last; row++)
    reaches[row - first] = (reach){CS_CULL_COLUMNS - 1, 0};
  for (uint32_t k = 0; k < ch->piece_count; k++)
    trace_piece(c, &c->set->pieces[ch->piece + k], first, last, reaches);
}

static void trace_slice(void *user, int32_t number) {
  const culler *c = user;
  size_t first = (size_t)number * SLICE_CHAINS, end = first + SLICE_CHAINS;
  for (size_t chain = first; chain < end && chain < c->set->chain_count; chain++)
    trace_chain(c, (uint32_t)chain, c->reaches + c->cull->places[chain]);
}

static celspan_status trace_chains(culler *c) {
  cs_cull *cull = c->cull;
  size_t chains = c->set->chain_count, places = 0;
  for (uint32_t chain = 0; chain < chains; chain++) {
    cull->places[chain] = places;
    places += (size_t)(c->last_rows[chain] - cull->first_rows[chain] + 1);
  }
  cull->kept_count = places;
  c->reaches = cs_mem_array(c->context->memory, places, sizeof *c->reaches);
  cull->kept = cs_mem_array(c->context->memory, places, sizeof *cull->kept);
  if (places > 0 && (!c->reaches || !cull->kept))
    return cs_fail_memory(c->context);
  cs_thread_pool_run(c->workers, (int32_t)((chains + SLICE_CHAINS - 1) / SLICE_CHAINS), trace_slice,
                     c);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- one leaf */

static celspan_status note_toggle(slice *s, int32_t row, double x, const cs_boundary_chain *chain) {
  CS_TRY(cs_mem_reserve(&s->context, (void **)&s->deferred_list, &s->deferred_capacity,
                        s->deferred_count + 1, sizeof *s->deferred_list));
  CS_TRY(cs_mem_reserve(&s->context, (void **)&s->deferred_rows, &s->deferred_row_capacity,
                        s->deferred_count + 1, sizeof *s->deferred_rows));
  s->deferred_rows[s->deferred_count] = (uint32_t)row;
  s->deferred_list[s->deferred_count++] = (cs_deferred){x, chain->layer, chain->direction};
  return CELSPAN_OK;
}

/* What the chains of a leaf do in one row of tiles. */
typedef struct footprint {
  uint64_t touched;
  reach turning; /* columns between what begins and ends in the row */
  bool turns, keeps;
  uint64_t crossed;                 /* columns that some chain enters from, at the top of the row */
  int32_t winding[CS_CULL_COLUMNS]; /* what the crossings of a column add up to, where crossed */
} footprint;

static void cross_column(footprint *f, uint8_t index, int32_t direction) {
  uint64_t bit = (uint64_t)1 << index;
  f->winding[index] = (f->crossed & bit ? f->winding[index] : 0) + direction;
  f->crossed |= bit;
}

static celspan_status place_chain(const culler *c, slice *s, uint32_t chain, int32_t row,
                                  footprint *f) {
  const cs_boundary_chain *ch = &c->set->chains[chain];
  double top = row_top(c, row), foot = row_foot(c, row);
  size_t place = c->cull->places[chain] + (size_t)(row - c->cull->first_rows[chain]);
  reach r = c->reaches[place];
  f->touched |= column_mask(r);
  if (ch->y0 <= top)
    cross_column(f, r.low, ch->direction);
  bool turns = ch->y0 > top || ch->y1 < foot;
  if (turns) {
    f->turning = f->turns ? f->turning : r;
    widen(&f->turning, r.low);
    widen(&f->turning, r.high);
    f->turns = true;
  }
  if (turns || (column_mask(r) & c->live[row])) {
    c->cull->kept[place] = f->keeps = true;
    return CELSPAN_OK;
  }
  return note_toggle(s, row, column_edge(c, r.low), ch);
}

/* The columns that lie wholly inside the leaf through the row of tiles. */
static uint64_t inside_mask(const footprint *f, int32_t winding_mask) {
  uint64_t inside = 0;
  int32_t winding = 0;
  for (uint64_t left = f->crossed; left; left &= left - 1) {
    int index = __builtin_ctzll(left);
    bool was_inside = winding & winding_mask;
    winding += f->winding[index];
    if (was_inside != ((winding & winding_mask) != 0))
      inside ^= ~(uint64_t)0 << index; /* from here on */
  }
  inside &= ~f->touched;
  return f->turns ? inside & ~column_mask(f->turning) : inside;
}

/* Darkens the tiles that the leaf covers. */
static void cover(const culler *c, int32_t row, uint64_t inside, double through) {
  for (uint64_t left = inside & c->live[row]; left; left &= left - 1) {
    int index = __builtin_ctzll(left);
    double *tile = &c->through[(size_t)row * CS_CULL_COLUMNS + (size_t)index];
    *tile *= through;
    if (*tile < c->opaque)
      c->live[row] &= ~((uint64_t)1 << index);
  }
}

static celspan_status cull_layer_row(const culler *c, slice *s, uint32_t layer, int32_t row) {
  footprint f;
  f.touched = f.crossed = 0;
  f.turning = (reach){0, 0};
  f.turns = f.keeps = false;
  size_t deferred_list = s->deferred_count;
  for (uint32_t k = c->layer_starts[layer]; k < c->layer_starts[layer + 1]; k++) {
    uint32_t chain = c->by_layer[k];
    if (row >= c->cull->first_rows[chain] && row <= c->last_rows[chain])
      CS_TRY(place_chain(c, s, chain, row, &f));
  }
  uint64_t inside = f.touched ? inside_mask(&f, c->layers[layer].winding_mask) : 0;
  if (!f.keeps && !(inside & c->live[row]))
    s->deferred_count = deferred_list; /* it is nowhere to be seen in this row of tiles */
  if (c->layers[layer].through < 1)
    cover(c, row, inside, c->layers[layer].through);
  return CELSPAN_OK;
}

static celspan_status cull_layer(const culler *c, slice *s, uint32_t layer) {
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

static void cull_slice(void *user, int32_t number) {
  const culler *c = user;
  slice *s = &c->slices[number];
  for (size_t layer = c->layer_count; layer-- > 0 && s->status == CELSPAN_OK;)
    s->status = cull_layer(c, s, (uint32_t)layer);
}

/* From the camera backwards, in slices: a row of tiles knows nothing of the others. */
static celspan_status cull_layers(culler *c) {
  int32_t rows = c->cull->tile_rows, wanted = c->workers > 1 ? SLICES_A_WORKER * c->workers : 1;
  int32_t count = wanted < rows ? wanted : rows;
  c->slices = cs_mem_array(c->context->memory, (size_t)count, sizeof *c->slices);
  if (!c->slices)
    return cs_fail_memory(c->context);
  c->slice_count = count;
  for (int32_t i = 0; i < count; i++) {
    slice *s = &c->slices[i];
    cs_context_branch(&s->context, c->context);
    s->first = (int32_t)((int64_t)rows * i / count);
    s->end = (int32_t)((int64_t)rows * (i + 1) / count);
  }
  cs_thread_pool_run(c->workers, count, cull_slice, c);
  for (int32_t i = 0; i < count; i++)
    if (c->slices[i].status != CELSPAN_OK)
      return cs_fail(c->context, c->slices[i].status, "%s", c->slices[i].context.error);
  return CELSPAN_OK;
}

/* Lists the chains of every leaf. */
static void group_by_layer(culler *c) {
  size_t chains = c->set->chain_count;
  for (size_t i = 0; i < chains; i++)
    c->layer_starts[c->set->chains[i].layer + 1]++;
  for (size_t layer = 0; layer < c->layer_count; layer++)
    c->layer_starts[layer + 1] += c->layer_starts[layer];
  for (size_t i = 0; i < chains; i++)
    c->by_layer[c->layer_starts[c->set->chains[i].layer]++] = (uint32_t)i;
  for (size_t layer = c->layer_count; layer > 0; layer--)
    c->layer_starts[layer] = c->layer_starts[layer - 1];
  c->layer_starts[0] = 0;
}

/* ---------------------------------------------------------------- by row of tiles */

static size_t deferred_key(const culler *c, const slice *s, size_t i) {
  return s->deferred_rows[i] * CS_CULL_COLUMNS + column(c, s->deferred_list[i].x);
}

/* Puts the toggles in their places; starts: by key, the first of its places. */
static void place_toggles(const culler *c, uint32_t *starts) {
  for (int32_t k = 0; k < c->slice_count; k++)
    for (size_t i = 0; i < c->slices[k].deferred_count; i++)
      c->cull->deferred_list[starts[deferred_key(c, &c->slices[k], i)]++] =
          c->slices[k].deferred_list[i];
}

/* Sorts the toggles by row of tiles, then column: counting, so that equal ones keep their order. */
static celspan_status sort_toggles(culler *c) {
  cs_cull *cull = c->cull;
  size_t keys = (size_t)cull->tile_rows * CS_CULL_COLUMNS;
  uint32_t *starts = cs_mem_array(c->context->memory, keys + 1, sizeof *starts);
  if (!starts)
    return cs_fail_memory(c->context);
  for (int32_t k = 0; k < c->slice_count; k++)
    for (size_t i = 0; i < c->slices[k].deferred_count; i++)
      starts[deferred_key(c, &c->slices[k], i) + 1]++;
  for (size_t key = 0; key < keys; key++)
    starts[key + 1] += starts[key];
  for (int32_t row = 0; row <= cull->tile_rows; row++)
    cull->deferred_starts[row] = starts[(size_t)row * CS_CULL_COLUMNS];
  cull->deferred_count = starts[keys];
  cull->deferred_list =
      cs_mem_array(c->context->memory, cull->deferred_count, sizeof *cull->deferred_list);
  if (cull->deferred_list)
    place_toggles(c, starts);
  cs_mem_free(c->context->memory, starts, (keys + 1) * sizeof *starts);
  return cull->deferred_count > 0 && !cull->deferred_list ? cs_fail_memory(c->context) : CELSPAN_OK;
}

/* Calls for every row of tiles of every chain below its first in which it is kept and was not. */
static void list_enters(culler *c, uint32_t *counts, uint32_t *enters) {
  const cs_cull *cull = c->cull;
  for (uint32_t chain = 0; chain < c->set->chain_count; chain++)
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

static celspan_status take_room(culler *c) {
  cs_memory *memory = c->context->memory;
  cs_cull *cull = c->cull;
  size_t rows = (size_t)cull->tile_rows, chains = c->set->chain_count;
  cull->places = cs_mem_array(memory, chains, sizeof *cull->places);
  cull->first_rows = cs_mem_array(memory, chains, sizeof *cull->first_rows);
  c->last_rows = cs_mem_array(memory, chains, sizeof *c->last_rows);
  cull->deferred_starts = cs_mem_array(memory, rows + 1, sizeof *cull->deferred_starts);
  cull->enter_starts = cs_mem_array(memory, rows + 1, sizeof *cull->enter_starts);
  c->layer_starts = cs_mem_array(memory, c->layer_count + 1, sizeof *c->layer_starts);
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

static void give_room_back(culler *c) {
  cs_memory *memory = c->context->memory;
  size_t rows = (size_t)c->cull->tile_rows;
  for (int32_t i = 0; i < c->slice_count; i++) {
    slice *s = &c->slices[i];
    cs_mem_free(memory, s->deferred_list, s->deferred_capacity * sizeof *s->deferred_list);
    cs_mem_free(memory, s->deferred_rows, s->deferred_row_capacity * sizeof *s->deferred_rows);
  }
  cs_mem_free(memory, c->slices, (size_t)c->slice_count * sizeof *c->slices);
  cs_mem_free(memory, c->reaches, c->cull->kept_count * sizeof *c->reaches);
  cs_mem_free(memory, c->last_rows, c->set->chain_count * sizeof *c->last_rows);
  cs_mem_free(memory, c->layer_starts, (c->layer_count + 1) * sizeof *c->layer_starts);
  cs_mem_free(memory, c->by_layer, c->set->chain_count * sizeof *c->by_layer);
  cs_mem_free(memory, c->live, rows * sizeof *c->live);
  cs_mem_free(memory, c->through, rows * CS_CULL_COLUMNS * sizeof *c->through);
}

static celspan_status cull_all(culler *c) {
  CS_TRY(take_room(c));
  find_rows(c);
  CS_TRY(trace_chains(c));
  group_by_layer(c);
  CS_TRY(cull_layers(c));
  CS_TRY(sort_toggles(c));
  return find_enters(c);
}

celspan_status cs_cull_create(celspan_context *context, const cs_boundary_set *set,
                              const cs_cull_layer *layers, size_t layer_count, int32_t width,
                              int32_t height, int32_t margin, double opaque, int workers,
                              cs_cull *out) {
  *out = (cs_cull){.chain_count = set->chain_count};
  if (layer_count < LEAVES_LEAST || set->chain_count == 0)
    return CELSPAN_OK;
  cs_cull cull = {.chain_count = set->chain_count};
  int32_t rows = choose_rows(layer_count, height);
  cull.tile_height = (int32_t)(((int64_t)height + rows - 1) / rows);
  cull.tile_rows = (int32_t)(((int64_t)height + cull.tile_height - 1) / cull.tile_height);
  culler c = {.context = context,
              .set = set,
              .layers = layers,
              .layer_count = layer_count,
              .width = width,
              .height = height,
              .margin = margin,
              .opaque = opaque,
              .workers = workers,
              .cull = &cull};
  c.columns_a_pixel = CS_CULL_COLUMNS / c.width;
  c.slack = SLACK_TILES * fmin((double)width / CS_CULL_COLUMNS, cull.tile_height);
  celspan_status status = cull_all(&c);
  give_room_back(&c);
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
