#include "trace/shapes.h"

#include <string.h>

#include "base/sort.h"
#include "trace/text.h"

typedef struct maker {
  celspan_context *context;
  const cs_material *material;
  const cs_regions *regions;
  const cs_borders *borders;
  const cs_curves *curves;
  cs_way *first;       /* by region: its first way */
  cs_way *next;        /* by way: another one around the same region */
  unsigned char *used; /* by way: it is in a path */
} maker;

/* ---------------------------------------------------------------- ways around a region */

static uint32_t region_left_of(const cs_borders *borders, cs_way way) {
  const cs_chain *chain = &borders->chains[way / 2];
  return way % 2 == 0 ? chain->left : chain->right;
}

static void list_ways(const maker *m) {
  for (size_t i = 0; i < m->regions->count; i++)
    m->first[i] = CS_WAY_NONE;
  for (size_t i = 2 * m->borders->chain_count; i-- > 0;) {
    uint32_t region = region_left_of(m->borders, (cs_way)i);
    if (region == CS_REGION_OUTSIDE)
      continue;
    m->next[i] = m->first[region];
    m->first[region] = (cs_way)i;
  }
}

/* The way that goes on around the region on the left: the sharpest turn to the left that there is.
 */
static cs_way go_on(const cs_borders *borders, cs_way way) {
  const cs_chain *chain = &borders->chains[way / 2];
  bool is_back = way % 2 == 1;
  uint32_t end = is_back ? chain->from : chain->to;
  if (end == CS_NODE_NONE)
    return way;
  int direction = is_back ? (borders->directions[chain->first] + 2) % 4
                          : borders->directions[chain->first + chain->count - 1];
  static const int turns[] = {3, 0, 1, 2};
  for (size_t i = 0; i < sizeof turns / sizeof *turns; i++) {
    cs_way next = borders->nodes[end].out[(direction + turns[i]) % 4];
    if (next != CS_WAY_NONE)
      return next;
  }
  return way;
}

/* ---------------------------------------------------------------- paths */

static celspan_point start_of(const maker *m, cs_way way) {
  const cs_curve *curve = &m->curves->list[way / 2];
  const cs_piece *pieces = m->curves->pieces.items + curve->first;
  return way % 2 == 0 || curve->count == 0 ? curve->start : pieces[curve->count - 1].to;
}

static celspan_status draw_way(const maker *m, cs_writing *path, cs_way way) {
  const cs_curve *curve = &m->curves->list[way / 2];
  const cs_piece *pieces = m->curves->pieces.items + curve->first;
  bool is_back = way % 2 == 1;
  for (size_t i = 0; i < curve->count; i++) {
    size_t at = is_back ? curve->count - 1 - i : i;
    celspan_point to = !is_back ? pieces[at].to : at > 0 ? pieces[at - 1].to : curve->start;
    CS_TRY(cs_pieces_draw(m->context, path, &pieces[at], to, is_back));
  }
  return CELSPAN_OK;
}

/* Around, from one way until it comes again. */
static celspan_status draw_around(const maker *m, cs_writing *path, cs_way begun) {
  celspan_point start = start_of(m, begun);
  CS_TRY(cs_writing_draw(m->context, path, 'M', &start, 1));
  cs_way way = begun;
  do {
    m->used[way] = 1;
    CS_TRY(draw_way(m, path, way));
    way = go_on(m->borders, way);
  } while (way != begun && !m->used[way]);
  return cs_writing_add(m->context, path, "Z");
}

static celspan_status draw_region(const maker *m, cs_writing *path, uint32_t region) {
  for (cs_way way = m->first[region]; way != CS_WAY_NONE; way = m->next[way])
    if (!m->used[way])
      CS_TRY(draw_around(m, path, way));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- shapes */

static celspan_status add_shape(const maker *m, uint32_t region, celspan_trace *out) {
  const cs_region *from = &m->regions->list[region];
  const cs_flat_colour *colour = &m->material->colours->list[from->label];
  cs_shape shape = {.x = from->x, .y = from->y, .area = from->area};
  cs_writing path = {.bytes = NULL};
  memcpy(shape.colour, colour->code, sizeof shape.colour);
  celspan_status status = draw_region(m, &path, region);
  if (status != CELSPAN_OK) {
    cs_writing_finish(m->context, &path);
    return status;
  }
  shape.data = path.bytes;
  shape.data_size = path.capacity;
  return cs_result_add(m->context, out, &shape);
}

typedef struct place {
  uint32_t region, area;
} place;

static inline bool is_before(const place *a, const place *b) {
  return a->area != b->area ? a->area > b->area : a->region < b->region;
}
CS_SORT_DEFINE(sort_places, place, is_before)

static celspan_status add_shapes(const maker *m, place *order, celspan_trace *out) {
  size_t count = 0;
  list_ways(m);
  for (uint32_t i = 0; i < m->regions->count; i++)
    if (m->regions->list[i].label < m->material->colours->count)
      order[count++] = (place){i, m->regions->list[i].area};
  sort_places(order, count);
  for (size_t i = 0; i < count; i++)
    CS_TRY(add_shape(m, order[i].region, out));
  return CELSPAN_OK;
}

celspan_status cs_shapes_make(celspan_context *context, const cs_material *material,
                              const cs_regions *regions, const cs_borders *borders,
                              const cs_curves *curves, celspan_trace *out) {
  cs_memory *memory = context->memory;
  size_t ways = 2 * borders->chain_count;
  maker m = {context, material, regions, borders, curves, NULL, NULL, NULL};
  m.first = cs_mem_array(memory, regions->count, sizeof *m.first);
  m.next = cs_mem_array(memory, ways, sizeof *m.next);
  m.used = cs_mem_array(memory, ways, 1);
  place *order = cs_mem_array(memory, regions->count, sizeof *order);
  celspan_status status =
      m.first && m.next && m.used && order ? add_shapes(&m, order, out) : cs_fail_memory(context);
  cs_mem_free(memory, m.first, regions->count * sizeof *m.first);
  cs_mem_free(memory, m.next, ways * sizeof *m.next);
  cs_mem_free(memory, m.used, ways);
  cs_mem_free(memory, order, regions->count * sizeof *order);
  return status;
}
