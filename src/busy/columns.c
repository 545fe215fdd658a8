#include "busy/columns.h"

#include "area/edges.h"

static size_t word_count(const cs_columns *columns) { return ((size_t)columns->width + 63) / 64; }

celspan_status cs_columns_init(celspan_context *context, cs_columns *columns, int32_t width) {
  *columns = (cs_columns){.width = width};
  columns->heads = cs_mem_array(context->memory, (size_t)width, sizeof *columns->heads);
  columns->touched = cs_mem_array(context->memory, word_count(columns), sizeof *columns->touched);
  return columns->heads && columns->touched ? CELSPAN_OK : cs_fail_memory(context);
}

void cs_columns_finish(cs_columns *columns, cs_memory *memory) {
  cs_mem_free(memory, columns->heads, (size_t)columns->width * sizeof *columns->heads);
  cs_mem_free(memory, columns->touched, word_count(columns) * sizeof *columns->touched);
  cs_mem_free(memory, columns->nodes, columns->node_capacity * sizeof *columns->nodes);
  *columns = (cs_columns){0};
}

void cs_columns_clear(cs_columns *columns) {
  for (int32_t column = 0; (column = cs_columns_next(columns, column)) < columns->width; column++)
    columns->heads[column] = 0;
  memset(columns->touched, 0, word_count(columns) * sizeof *columns->touched);
}

/* ---------------------------------------------------------------- areas */

/* The area between a straight piece and the upright line at x, where the piece is left of it.
 * by_twice: height / (2 (high - low)). */
static inline double left_of(double low, double high, double height, double by_twice, double x) {
  return x <= low    ? 0
         : x >= high ? height * (x - 0.5 * (low + high))
                     : (x - low) * (x - low) * by_twice;
}

/* Adds a straight piece of a unit to the areas of its columns, each as the difference from that of
 * the column before.
 *
 *          |  \    |       |            areas of the piece   A      B      h
 *          |    \  |       |            differences          A    B - A  h - B
 *          |      \|       |
 *          |       |\      |            beyond its last column all of its height is right of it
 *             p      p + 1   p + 2
 */
static void add_piece(cs_node *nodes, const cs_unit *unit, const celspan_point *above,
                      const celspan_point *below) {
  double low = above->x < below->x ? above->x : below->x;
  double high = above->x < below->x ? below->x : above->x;
  double height = below->y - above->y, by_twice = 0.5 * height / (high - low);
  int32_t column = low > unit->first ? (int32_t)low : unit->first;
  column = column < unit->last ? column : unit->last;
  double split = column, before = 0, passed = left_of(low, high, height, by_twice, split);
  cs_node *node = nodes + (column - unit->first);
  do {
    split += 1;
    double reached = left_of(low, high, height, by_twice, split);
    node++->area += (reached - passed) - before;
    before = reached - passed;
    passed = reached;
  } while (column++ < unit->last && high > split);
  node->area += height - before;
}

/* The areas of a unit that crosses several columns, piece by piece. */
static void add_pieces(cs_node *nodes, const cs_unit *unit, const celspan_point *points) {
  uint32_t count = (uint32_t)(unit->last - unit->first) + 1;
  for (uint32_t k = 0; k <= count; k++)
    nodes[k].area = 0;
  for (uint32_t k = 1; k < unit->count; k++)
    add_piece(nodes, unit, &points[k - 1], &points[k]);
  double area = 0, height = unit->y1 - unit->y0;
  for (uint32_t k = 0; k < count; k++) {
    area += nodes[k].area;
    nodes[k].area = cs_number_clamp(cs_edges_round(area), 0, height);
  }
}

/* ---------------------------------------------------------------- lists */

/* The columns that a unit crosses, of the frame. An upright line between two columns is listed in
 * the right one. */
static void find_columns(cs_unit *unit, int32_t width) {
  unit->first = cs_edges_floor(unit->low, width);
  unit->last = cs_edges_ceil(unit->high, width) - 1;
  if (unit->last < unit->first && unit->first < width)
    unit->last = unit->high <= 0 && unit->low < 0 ? -1 : unit->first;
}

/* Puts the nodes of a unit into the lists of its columns. */
static void hang(cs_columns *columns, const cs_unit *unit, uint32_t index) {
  for (int32_t column = unit->first; column <= unit->last; column++) {
    uint32_t number = unit->node + (uint32_t)(column - unit->first);
    columns->nodes[number].unit = index;
    columns->nodes[number].next = columns->heads[column];
    columns->heads[column] = number;
    columns->touched[column / 64] |= (uint64_t)1 << (column % 64);
  }
}

static void list_unit(cs_columns *columns, const cs_units *units, uint32_t index) {
  cs_unit *unit = &units->units[index];
  cs_node *nodes = columns->nodes + columns->node_count;
  unit->node = (uint32_t)columns->node_count;
  if (unit->last == unit->first) {
    double height = unit->y1 - unit->y0;
    double area = cs_edges_round(height * (unit->first + 1) - unit->left);
    nodes->area = cs_number_clamp(area, 0, height);
  } else {
    add_pieces(nodes, unit, cs_units_points(units, unit));
  }
  hang(columns, unit, index);
  columns->node_count += (uint32_t)(unit->last - unit->first) + 1;
}

celspan_status cs_columns_list(celspan_context *context, cs_columns *columns, cs_units *units) {
  size_t count = 2; /* node 0, and one more than the last unit has */
  for (size_t i = 0; i < units->count; i++) {
    cs_unit *unit = &units->units[i];
    find_columns(unit, columns->width);
    if (unit->last >= unit->first)
      count += (size_t)(unit->last - unit->first) + 1;
  }
  CS_TRY(cs_mem_reserve(context, (void **)&columns->nodes, &columns->node_capacity, count,
                        sizeof *columns->nodes));
  columns->node_count = 1;
  for (size_t i = 0; i < units->count; i++)
    if (units->units[i].last >= units->units[i].first)
      list_unit(columns, units, (uint32_t)i);
  return CELSPAN_OK;
}
