/* Making a map: the rows of a plan are swept, and their visible edges are joined to borders.
 *
 *   row y        \        edge: from row to row, or from event to event
 *   row y + 1     \
 *   row y + 2      |      the ends of the borders so far are found by place and cells: which of
 *                         two borders that end in one place is continued makes no difference
 *
 * A point is dropped where the border is straight: where the edge from the point before it to the
 * next one passes within TOLERANCE of all that was dropped. It is so small that two drawings with a
 * common boundary, which may have their points at different places of it, differ by less than
 * anyone can see.
 */
#include <math.h>

#include "base/splitmix.h"
#include "engine/compose/over.h"
#include "engine/map/map.h"
#include "engine/row/row.h"

#define TOLERANCE 4 /* units of a map */
#define NONE UINT32_MAX

/* A point of a border that is being made. */
typedef struct link {
  cs_map_point point;
  uint32_t previous; /* NONE: it is the first */
} link;

typedef struct growing {
  uint32_t left, right;
  uint32_t last, count; /* links */
  int64_t row;          /* in which it was extended last */
  double low, high;     /* slopes from the link before the last one that pass what was dropped */
} growing;

/* An entry of the table of ends. Those of earlier rows are free. */
typedef struct end {
  uint32_t border; /* NONE: it has been continued */
  uint32_t row;
} end;

typedef struct maker {
  celspan_context *context;
  cs_map *map;
  link *links;
  growing *borders;
  uint32_t *open;  /* the borders that end in the current row */
  end *ends;       /* a power of two */
  uint32_t *cells; /* a table: the number of a cell plus 1; 0: free. A power of two */
  size_t link_count, link_capacity, border_count, border_capacity, open_count, open_capacity;
  size_t end_capacity, cell_capacity;
  uint32_t row; /* the current one plus 1 */
} maker;

/* ---------------------------------------------------------------- life */

celspan_status cs_map_create(celspan_context *context, cs_map **out) {
  CS_TRY(CS_MAKE(context, *out, 1));
  atomic_init(&(*out)->references, 1);
  (*out)->memory = cs_memory_ref(context->memory);
  return CELSPAN_OK;
}

void cs_map_ref(cs_map *map) {
  atomic_fetch_add_explicit(&map->references, 1, memory_order_relaxed);
}

static void keep_texture(celspan_texture *texture) { (void)celspan_texture_ref(texture); }

/* The textures of what varies, of which the map has references. */
static void change_references(const cs_stack *stack, void (*change)(celspan_texture *texture)) {
  for (size_t i = 0; i < stack->shade_count; i++)
    change((celspan_texture *)stack->shades[i].texture);
  for (size_t i = 0; i < stack->image_count; i++)
    change((celspan_texture *)stack->images[i].texture);
}

static void free_stack(cs_stack *stack, cs_memory *memory) {
  change_references(stack, celspan_texture_unref);
  cs_stack_finish(stack, memory);
}

void cs_map_unref(cs_map *map) {
  if (!map || atomic_fetch_sub_explicit(&map->references, 1, memory_order_acq_rel) > 1)
    return;
  cs_memory *memory = map->memory;
  cs_map_lines_finish(&map->lines, memory);
  cs_mem_free(memory, map->flats, map->flat_capacity * sizeof *map->flats);
  cs_mem_free(memory, map->cells, map->cell_capacity * sizeof *map->cells);
  cs_mem_free(memory, map->items, map->item_capacity * sizeof *map->items);
  free_stack(&map->stack, memory);
  cs_mem_free(memory, map, sizeof *map);
  cs_memory_unref(memory);
}

size_t cs_map_bytes(const cs_map *map) {
  return sizeof *map + map->lines.border_capacity * sizeof *map->lines.borders +
         map->lines.point_capacity * sizeof *map->lines.points +
         map->flat_capacity * sizeof *map->flats + map->cell_capacity * sizeof *map->cells +
         map->item_capacity * sizeof *map->items + cs_stack_bytes(&map->stack);
}

static void finish(maker *m) {
  cs_memory *memory = m->context->memory;
  cs_mem_free(memory, m->links, m->link_capacity * sizeof *m->links);
  cs_mem_free(memory, m->borders, m->border_capacity * sizeof *m->borders);
  cs_mem_free(memory, m->open, m->open_capacity * sizeof *m->open);
  cs_mem_free(memory, m->ends, m->end_capacity * sizeof *m->ends);
  cs_mem_free(memory, m->cells, m->cell_capacity * sizeof *m->cells);
}

bool cs_map_suits(const cs_plan *plan) {
  const cs_stack *stack = &plan->stack;
  bool suits = !plan->is_crowded && stack->light_count == 0 && stack->procedure_count == 0;
  for (size_t i = 0; suits && i < stack->layer_count; i++) {
    const cs_layer *layer = &stack->layers[i];
    suits = layer->role == CS_LAYER_PAINT && layer->kind != CS_LAYER_DEFOCUSED &&
            layer->t[0] == layer->t[1] && layer->t[1] == layer->t[2];
  }
  return suits;
}

/* ---------------------------------------------------------------- cells */

static uint64_t mix(uint64_t word) { return cs_splitmix_next(&word); }

/* What shows in a cell: a colour where length is 0. */
typedef struct content {
  cs_v4 colour;
  const cs_item *items;
  uint32_t length;
} content;

static content content_of(const cs_map *map, uint32_t cell) {
  const cs_map_cell *of = &map->cells[cell];
  return (content){of->colour, of->length > 0 ? map->items + of->item : NULL, of->length};
}

static content content_at(const cs_retained_row *retained, const cs_retained_side *side) {
  if (side->program < 0)
    return (content){.colour = side->colour};
  const cs_program *program = &retained->programs[side->program].program;
  return (content){cs_v4_all(0), program->items, program->length};
}

static bool is_content(content a, content b) {
  return a.length == b.length && memcmp(&a.colour, &b.colour, sizeof a.colour) == 0 &&
         (a.length == 0 || memcmp(a.items, b.items, a.length * sizeof *a.items) == 0);
}

static size_t content_place(const maker *m, content what) {
  uint64_t words[2], name = what.length;
  memcpy(words, &what.colour, sizeof words);
  for (uint32_t i = 0; i < what.length; i++)
    name = mix(name ^ what.items[i].layer);
  return mix(words[0] ^ mix(words[1] ^ name)) & (m->cell_capacity - 1);
}

/* Puts a cell into the table, which has room. */
static void place_cell(maker *m, uint32_t cell) {
  size_t at = content_place(m, content_of(m->map, cell));
  while (m->cells[at])
    at = (at + 1) & (m->cell_capacity - 1);
  m->cells[at] = cell + 1;
}

static celspan_status widen_cells(maker *m) {
  cs_memory *memory = m->context->memory;
  cs_mem_free(memory, m->cells, m->cell_capacity * sizeof *m->cells);
  size_t capacity = m->cell_capacity > 0 ? 2 * m->cell_capacity : 256;
  m->cell_capacity = 0;
  CS_TRY(CS_MAKE(m->context, m->cells, capacity));
  m->cell_capacity = capacity;
  for (size_t i = 0; i < m->map->cell_count; i++)
    place_cell(m, (uint32_t)i);
  return CELSPAN_OK;
}

/* Appends a cell and its program. Where there are too many the map is not whole. */
static celspan_status add_cell(maker *m, content what, uint32_t *out) {
  cs_map *map = m->map;
  *out = (uint32_t)map->cell_count;
  map->is_whole = map->cell_count < CS_MAP_CELLS && map->item_count + what.length < NONE;
  CS_TRY(CS_RESERVE(m->context, map->items, map->item_capacity, map->item_count + what.length));
  if (what.length > 0)
    memcpy(map->items + map->item_count, what.items, what.length * sizeof *what.items);
  const cs_map_cell cell = {.colour = what.colour,
                            .key = (mix(*out) << 18 | *out) & CS_MAP_KEY,
                            .item = (uint32_t)map->item_count,
                            .length = what.length};
  map->item_count += what.length;
  return CS_APPEND(m->context, map->cells, map->cell_count, map->cell_capacity, cell);
}

/* The number of the cell of what shows there. */
static celspan_status find_cell(maker *m, content what, uint32_t *out) {
  if (2 * m->map->cell_count >= m->cell_capacity)
    CS_TRY(widen_cells(m));
  size_t at = content_place(m, what);
  for (; m->cells[at]; at = (at + 1) & (m->cell_capacity - 1))
    if (is_content(content_of(m->map, m->cells[at] - 1), what)) {
      *out = m->cells[at] - 1;
      return CELSPAN_OK;
    }
  CS_TRY(add_cell(m, what, out));
  m->cells[at] = *out + 1;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- ends */

static size_t end_place(const maker *m, cs_map_point at, uint32_t left, uint32_t right) {
  uint64_t place = (uint64_t)(uint32_t)at.x << 32 | (uint32_t)at.y;
  return mix(place ^ mix((uint64_t)left << 32 | right)) & (m->end_capacity - 1);
}

static void place_end(maker *m, uint32_t index) {
  const growing *f = &m->borders[index];
  size_t at = end_place(m, m->links[f->last].point, f->left, f->right);
  while (m->ends[at].row == m->row)
    at = (at + 1) & (m->end_capacity - 1);
  m->ends[at] = (end){index, m->row};
}

/* Takes a border out of the table that ends at a point; NONE: there is none. */
static uint32_t take_end(maker *m, cs_map_point point, uint32_t left, uint32_t right) {
  size_t at = end_place(m, point, left, right);
  for (; m->ends[at].row == m->row; at = (at + 1) & (m->end_capacity - 1)) {
    uint32_t index = m->ends[at].border;
    if (index == NONE)
      continue;
    const growing *f = &m->borders[index];
    const cs_map_point *last = &m->links[f->last].point;
    if (last->x == point.x && last->y == point.y && f->left == left && f->right == right) {
      m->ends[at].border = NONE;
      return index;
    }
  }
  return NONE;
}

/* Begins a row with this number of edges: the table has the borders that end at its top. */
static celspan_status begin_row(maker *m, int64_t y, size_t edges) {
  size_t wanted = 256;
  while (wanted < 2 * (m->open_count + edges))
    wanted *= 2;
  m->row = (uint32_t)y + 1;
  if (wanted > m->end_capacity) {
    cs_mem_free(m->context->memory, m->ends, m->end_capacity * sizeof *m->ends);
    m->end_capacity = 0;
    CS_TRY(CS_MAKE(m->context, m->ends, wanted));
    m->end_capacity = wanted;
  }
  CS_TRY(CS_RESERVE(m->context, m->open, m->open_capacity, m->open_count + edges));
  for (size_t i = 0; i < m->open_count; i++)
    if (m->links[m->borders[m->open[i]].last].point.y == y * CS_MAP_UNIT)
      place_end(m, m->open[i]);
  m->open_count = 0;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- borders */

static celspan_status add_link(maker *m, growing *f, cs_map_point point) {
  CS_TRY(CS_APPEND(m->context, m->links, m->link_count, m->link_capacity, (link){point, f->last}));
  f->last = (uint32_t)m->link_count - 1;
  f->count++;
  f->low = -INFINITY;
  f->high = INFINITY;
  return CELSPAN_OK;
}

/* Narrows the slopes to those that pass a point below the link before the last one. */
static void narrow(growing *f, cs_map_point above, cs_map_point point) {
  double dx = (double)point.x - above.x, dy = (double)point.y - above.y;
  f->low = fmax(f->low, (dx - TOLERANCE) / dy);
  f->high = fmin(f->high, (dx + TOLERANCE) / dy);
}

/* Continues a border down to a point. */
static celspan_status extend(maker *m, growing *f, cs_map_point point) {
  if (f->count > 1) {
    link *last = &m->links[f->last];
    cs_map_point above = m->links[last->previous].point;
    double slope = ((double)point.x - above.x) / ((double)point.y - above.y);
    if (slope >= f->low && slope <= f->high) {
      last->point = point;
      narrow(f, above, point);
      return CELSPAN_OK;
    }
  }
  cs_map_point above = m->links[f->last].point;
  CS_TRY(add_link(m, f, point));
  narrow(f, above, point);
  return CELSPAN_OK;
}

static celspan_status begin_border(maker *m, cs_map_point point, uint32_t left, uint32_t right,
                                   uint32_t *out) {
  CS_TRY(CS_APPEND(m->context, m->borders, m->border_count, m->border_capacity,
                   (growing){.left = left, .right = right, .last = NONE, .row = -1}));
  *out = (uint32_t)m->border_count - 1;
  return add_link(m, &m->borders[*out], point);
}

static int32_t round_to_unit(double place) { return (int32_t)floor(place * CS_MAP_UNIT + 0.5); }

static celspan_status add_edge(maker *m, const cs_retained_row *retained,
                               const cs_retained_edge *edge) {
  cs_map_point above = {round_to_unit(edge->xa), round_to_unit(edge->ya)};
  cs_map_point below = {round_to_unit(edge->xb), round_to_unit(edge->yb)};
  uint32_t left, right, index;
  CS_TRY(find_cell(m, content_at(retained, &edge->left), &left));
  CS_TRY(find_cell(m, content_at(retained, &edge->right), &right));
  if (left == right || above.y >= below.y)
    return CELSPAN_OK;
  index = take_end(m, above, left, right);
  if (index == NONE)
    CS_TRY(begin_border(m, above, left, right, &index));
  growing *f = &m->borders[index];
  CS_TRY(extend(m, f, below));
  if (f->row != m->row)
    m->open[m->open_count++] = index;
  f->row = m->row;
  place_end(m, index);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the map */

/* Copies the points of a border, which are linked from the last one up. There is room. */
static void finish_border(const maker *m, const growing *f) {
  cs_map_lines *lines = &m->map->lines;
  const link *last = &m->links[f->last];
  cs_map_border *out = &lines->borders[lines->border_count++];
  *out = (cs_map_border){.left = f->left,
                         .right = f->right,
                         .first = (uint32_t)lines->point_count,
                         .count = f->count,
                         .low = INT32_MAX,
                         .high = INT32_MIN,
                         .foot = last->point.y};
  lines->point_count += f->count;
  for (uint32_t at = f->last, k = f->count; k-- > 0; at = m->links[at].previous) {
    cs_map_point point = m->links[at].point;
    lines->points[out->first + k] = point;
    out->low = point.x < out->low ? point.x : out->low;
    out->high = point.x > out->high ? point.x : out->high;
  }
}

static celspan_status finish_borders(const maker *m) {
  cs_map_lines *lines = &m->map->lines;
  CS_TRY(CS_RESERVE(m->context, lines->borders, lines->border_capacity, m->border_count));
  CS_TRY(CS_RESERVE(m->context, lines->points, lines->point_capacity, m->link_count));
  for (size_t i = 0; i < m->border_count; i++)
    finish_border(m, &m->borders[i]);
  return cs_map_lines_sort(m->context, lines);
}

static celspan_status add_row(maker *m, cs_row_maker *rows, int32_t y, cs_retained_row *retained) {
  CS_TRY(cs_row_retain(rows, y, retained));
  CS_TRY(begin_row(m, y, retained->edge_count));
  for (size_t i = 0; i < retained->edge_count; i++)
    CS_TRY(add_edge(m, retained, &retained->edges[i]));
  return CELSPAN_OK;
}

static celspan_status add_rows(maker *m, const cs_plan *plan) {
  cs_retained_row retained = {0};
  cs_row_maker rows;
  uint32_t clear;
  celspan_status status = cs_row_maker_init(&rows, m->context, plan);
  if (status == CELSPAN_OK)
    status = find_cell(m, (content){.colour = cs_v4_all(0)}, &clear);
  for (int32_t y = 0; status == CELSPAN_OK && m->map->is_whole && y < plan->height; y++)
    status = add_row(m, &rows, y, &retained);
  cs_row_maker_finish(&rows);
  cs_retained_finish(&retained, m->context->memory);
  return status;
}

/* Whether nothing shines through some layer of a program, which is in no group. */
static bool hides(const cs_map *map, const cs_map_cell *cell, const cs_stack *stack) {
  bool hides = false;
  for (uint32_t i = 0; i < cell->length && !hides; i++) {
    const cs_layer *layer = &stack->layers[map->items[cell->item + i].layer];
    hides = layer->group == CS_STACK_NONE && cs_over_is_opaque(layer->t);
  }
  return hides;
}

/* Takes over what the programs name. */
static void take_stack(cs_map *map, cs_stack *stack) {
  for (size_t i = 0; i < map->cell_count; i++)
    map->cells[i].hides = hides(map, &map->cells[i], stack);
  map->stack = *stack;
  *stack = (cs_stack){0};
  change_references(&map->stack, keep_texture);
}

celspan_status cs_map_make(celspan_context *context, cs_plan *plan, cs_map *map) {
  maker m = {.context = context, .map = map};
  map->is_whole = true;
  celspan_status status = add_rows(&m, plan);
  if (status == CELSPAN_OK && map->is_whole)
    status = finish_borders(&m);
  if (status == CELSPAN_OK && map->item_count > 0)
    take_stack(map, &plan->stack);
  finish(&m);
  return status;
}
