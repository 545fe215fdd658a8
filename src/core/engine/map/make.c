/* Making a map: the boundaries of a plan are swept by events (engine/events/events.h), the cells
 * are composed once for each of the windings, and the visible parts (engine/events/visit.h) become
 * borders.
 *
 *   windings   0 --A+-- 1 --B+-- 2    they are visited from the first one along their tree: each
 *               `--B+-- 3             is found by crossing one boundary
 *
 *   parts      1|2  0|3  2|3          cells: red|red  clear|blue  red|blue: a part, of which the
 *                                     first is left out, because nothing changes there
 */
#include "base/keys.h"
#include "engine/events/visit.h"
#include "engine/map/cells.h"

/* Windings of a zone. Many shapes that hide others have fewer than EACH for a course. Translucent
 * shapes that cross have many times more, and each winding would be a cell. The rule does not apply
 * to FEW windings. */
#define EACH 4
#define FEW 1024

typedef struct maker {
  celspan_context *context;
  const cs_plan *plan;
  cs_map *map;
  cs_events events;
  cs_map_cells cells;
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

/* The textures of the varying cells. The map has a reference to each. */
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
  CS_ARRAYS_FREE(memory, map, flats, items);
  free_stack(&map->stack, memory);
  cs_mem_free(memory, map, sizeof *map);
  cs_memory_unref(memory);
}

size_t cs_map_bytes(const cs_map *map) {
  return sizeof *map + CS_ARRAYS_BYTES(&map->lines, borders, points) +
         CS_ARRAYS_BYTES(map, flats, items) + cs_stack_bytes(&map->stack);
}

static void finish(maker *m) {
  cs_memory *memory = m->context->memory;
  cs_map_cells_finish(&m->cells, memory);
  cs_events_finish(&m->events, memory);
}

static bool is_coloured(const cs_stack *stack) {
  bool is_coloured = false;
  for (size_t i = 0; i < stack->layer_count; i++)
    is_coloured |= !cs_stack_layer_is_grey(stack, &stack->layers[i]);
  return is_coloured;
}

bool cs_map_suits(const cs_plan *plan) {
  const cs_stack *stack = &plan->stack;
  bool suits = !plan->is_crowded && stack->light_count == 0 && stack->procedure_count == 0;
  for (size_t i = 0; suits && i < stack->layer_count; i++) {
    const cs_layer *layer = &stack->layers[i];
    suits = layer->role == CS_LAYER_PAINT && layer->kind != CS_LAYER_DEFOCUSED;
  }
  return suits;
}

/* ---------------------------------------------------------------- composing */

/* The number of a cell, until the map cannot be whole any more; a cs_events_visitor. */
static celspan_status find_cell(void *user, cs_composer *composer, const cs_cell *cell,
                                uint32_t *out) {
  maker *m = user;
  cs_map *map = m->map;
  cs_map_content what = {.colour = cell->colour};
  if (cell->length > 0) {
    what = (cs_map_content){.items = composer->items + cell->program, .length = cell->length};
    map->is_whole &=
        !map->is_coloured || cs_map_cells_is_even(&m->plan->stack, what.items, what.length);
  } else if (map->is_coloured) {
    CS_TRY(cs_composer_through(composer, &what.through));
  }
  return map->is_whole ? cs_map_cells_find(m->context, &m->cells, what, out) : CELSPAN_OK;
}

/* Cell 0 always exists. */
static celspan_status add_clear(maker *m) {
  uint32_t clear;
  const cs_map_content nothing = {.through = cs_v4_all(m->map->is_coloured ? 1 : 0)};
  return cs_map_cells_find(m->context, &m->cells, nothing, &clear);
}

/* ---------------------------------------------------------------- borders */

static int32_t unit_at(const cs_course_point *from, int32_t y) {
  return (int32_t)floor(cs_course_x(from, y) + 0.5);
}

/* Borders that have no points of their own yet, chain by chain: `first` is, among the points of all
 * courses, where the segment at the top begins. */
typedef struct drafts {
  CS_ARRAY(cs_map_border, borders);
  CS_ARRAY(cs_map_point, tops);
  CS_ARRAY(uint64_t, keys); /* of the order that is being made */
  size_t count, point_count;
} drafts;

static inline void extend(cs_map_border *border, int32_t x) {
  border->low = x < border->low ? x : border->low;
  border->high = x > border->high ? x : border->high;
}

/* Measures the part of a course between two heights as a border, for which there is room. from: a
 * point of its course above both heights. */
static void measure_border(const maker *m, const cs_events_part *part, cs_map_point top,
                           int32_t foot, const cs_course_point **from, drafts *out) {
  const cs_course_point *points = m->events.courses.points, *p = *from;
  while (p[1].y <= top.y)
    p++;
  top.x = unit_at(p, top.y);
  cs_map_border border = {.left = part->left,
                          .right = part->right,
                          .first = (uint32_t)(p - points),
                          .low = top.x,
                          .high = top.x,
                          .foot = foot};
  for (; p[1].y < foot; p++)
    extend(&border, p[1].x);
  extend(&border, unit_at(p, foot));
  border.count = (uint32_t)(p - points) - border.first + 2;
  *from = p;
  out->tops[out->count] = top;
  out->borders[out->count++] = border;
  out->point_count += border.count;
}

/* Measures a part as borders, one in each zone. */
static void measure_part(const maker *m, const cs_events_part *part, drafts *out) {
  const int32_t zone = m->map->zone * CS_MAP_UNIT;
  const cs_courses *courses = &m->events.courses;
  const cs_course_point *from = courses->points + courses->courses[part->course].first;
  for (int32_t top = part->top, foot; top < part->foot; top = foot) {
    int32_t below = top - top % zone + zone;
    foot = part->foot < below ? part->foot : below;
    measure_border(m, part, (cs_map_point){0, top}, foot, &from, out);
  }
}

/* Measures the parts, chain by chain: the order must not depend on the zones that were swept. Then
 * there is room for a key of each border. */
static celspan_status measure_parts(const maker *m, drafts *out) {
  const cs_events *events = &m->events;
  const int32_t zone = m->map->zone * CS_MAP_UNIT;
  size_t count = events->part_count, most = 1;
  for (size_t i = 0; i < count; i++)
    most += (size_t)((events->parts[i].foot - 1) / zone - events->parts[i].top / zone + 1);
  CS_TRY(CS_ARRAY_MAKE(m->context, out->borders, most));
  CS_TRY(CS_ARRAY_MAKE(m->context, out->tops, most));
  CS_TRY(CS_ARRAY_MAKE(m->context, out->keys, count + 1));
  for (size_t i = 0; i < count; i++)
    out->keys[i] = cs_key((int32_t)events->parts[i].course, i);
  CS_TRY(cs_keys_sort(m->context, out->keys, count));
  for (size_t i = 0; i < count; i++)
    measure_part(m, &events->parts[cs_key_number(out->keys[i])], out);
  return CS_ARRAY_MAKE(m->context, out->keys, out->count + 1);
}

/* Adds a border with its points, for which there is room. */
static void add_border(maker *m, cs_map_border border, cs_map_point top) {
  cs_map_lines *lines = &m->map->lines;
  const cs_course_point *from = m->events.courses.points + border.first;
  cs_map_point *points = lines->points + lines->point_count;
  const uint32_t last = border.count - 1;
  points[0] = top;
  for (uint32_t k = 1; k < last; k++)
    points[k] = (cs_map_point){from[k].x, from[k].y};
  points[last] = (cs_map_point){unit_at(from + last - 1, border.foot), border.foot};
  border.first = (uint32_t)lines->point_count;
  lines->point_count += border.count;
  lines->borders[lines->border_count++] = border;
}

/* Adds the borders in the order in which rows need them. */
static celspan_status add_in_order(maker *m, const drafts *all) {
  cs_map_lines *lines = &m->map->lines;
  CS_TRY(cs_map_lines_order(m->context, all->tops, all->count, all->keys));
  CS_TRY(cs_map_lines_make(m->context, all->count, all->point_count, lines));
  for (size_t i = 0; i < all->count; i++) {
    const uint32_t number = cs_key_number(all->keys[i]);
    add_border(m, all->borders[number], all->tops[number]);
  }
  return CELSPAN_OK;
}

static celspan_status add_borders(maker *m) {
  drafts all = {0};
  celspan_status status = measure_parts(m, &all);
  if (status == CELSPAN_OK && all.count > 0)
    status = add_in_order(m, &all);
  CS_ARRAYS_FREE(m->context->memory, &all, borders, keys);
  return status;
}

/* Takes ownership of everything that the programs refer to. */
static void take_stack(cs_map *map, cs_stack *stack) {
  cs_map_cells_find_hiding(map, stack);
  map->stack = *stack;
  *stack = (cs_stack){0};
  change_references(&map->stack, keep_texture);
}

static celspan_status make_zones(maker *m, int32_t first, int32_t end) {
  const cs_events_rows rows = {first, end, m->map->height, m->map->zone};
  const cs_events_limits limits = {CS_MAP_CELLS / CS_MAP_ZONES, FEW, EACH};
  CS_TRY(add_clear(m));
  CS_TRY(
      cs_events_find(m->context, &m->plan->boundaries, &m->plan->cull, rows, limits, &m->events));
  m->map->missing = m->events.missing;
  CS_TRY(cs_events_show(m->context, m->plan, &m->events, find_cell, m));
  return m->map->is_whole ? add_borders(m) : CELSPAN_OK;
}

celspan_status cs_map_make(celspan_context *context, cs_plan *plan, int32_t first, int32_t end,
                           cs_map *map) {
  maker m = {.context = context, .plan = plan, .map = map, .cells = {.map = map}};
  map->is_coloured = is_coloured(&plan->stack);
  map->is_whole = true;
  celspan_status status = make_zones(&m, first, end);
  if (status == CELSPAN_OK && map->item_count > 0)
    take_stack(map, &plan->stack);
  finish(&m);
  return status;
}
