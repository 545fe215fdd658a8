/* The columns of a row: which units cross each of them, and the area right of each there.
 *
 *     units        a \      b |   / c
 *                     \       |  /
 *     columns  |   |   |\ |   |//|   |    touched: 1, 2 and 4
 *     nodes          a  a      b             lists of a column, in no order
 *                              c
 *
 * Invariant: nodes of a unit lie one after the other, from unit->node on. Areas are multiples of
 * 2^-28, 0..1; where units have the same points, they have the same areas. Between rows no column is
 * touched and all lists are empty.
 */
#ifndef CS_BUSY_COLUMNS_H
#define CS_BUSY_COLUMNS_H

#include "busy/unit.h"

typedef struct cs_node {
  double area;   /* right of the unit in the column, within the unit's heights */
  uint32_t unit; /* index into the units of the row */
  uint32_t next; /* of the column; 0: none */
} cs_node;

typedef struct cs_columns {
  int32_t width;
  uint32_t *heads;   /* by column: a node, or 0 */
  uint64_t *touched; /* bits by column */
  cs_node *nodes;    /* node 0 is not used */
  size_t node_count, node_capacity;
} cs_columns;

/* Errors: NO_MEMORY; cs_columns_finish must be called then, too. */
CELSPAN_CHECKED celspan_status cs_columns_init(celspan_context *context, cs_columns *columns,
                                               int32_t width);
void cs_columns_finish(cs_columns *columns, cs_memory *memory);
/* Finds the columns of all units of a row, and lists them there. The columns of a unit that lies
 * beside the frame are not listed: `last` is less than 0, or `first` is `width` or more.
 * Errors: NO_MEMORY, and nothing is listed. */
CELSPAN_CHECKED celspan_status cs_columns_list(celspan_context *context, cs_columns *columns,
                                               cs_units *units);
/* Empties all lists. */
void cs_columns_clear(cs_columns *columns);

/* The first touched column from `column` on; the width: there is none. */
static inline int32_t cs_columns_next(const cs_columns *columns, int32_t column) {
  if (column >= columns->width)
    return columns->width;
  size_t word = (size_t)column / 64, words = ((size_t)columns->width + 63) / 64;
  uint64_t bits = columns->touched[word] & (~(uint64_t)0 << (column % 64));
  while (bits == 0)
    if (++word == words)
      return columns->width;
    else
      bits = columns->touched[word];
  return (int32_t)(word * 64) + __builtin_ctzll(bits);
}

static inline double cs_columns_area(const cs_columns *columns, const cs_unit *unit,
                                     int32_t column) {
  return columns->nodes[unit->node + (uint32_t)(column - unit->first)].area;
}

#endif
