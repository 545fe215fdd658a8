/* Rows of nodes as polylines.
 *
 *     value   v-----v                              a row of nodes is kept as a polyline: its
 *       |    /       `v--.                         vertices are nodes, the values between two of
 *       |   v  .  .  .    ` v  .  . v              them lie on the line from one to the other
 *       +---+--+--+--+--+---+--+----+--> node
 *
 * Invariant: lines from vertex to vertex are within a quarter of 1/1023 of the nodes between them.
 */
#pragma once

#include "base/arrays.h"

/* Rows of nodes as polylines: equal values at two vertices are a constant stretch. */
typedef struct cs_node_polyline {
  CS_ARRAY(int32_t, at);      /* nodes, ascending in each row, from the first to the last */
  CS_ARRAY(float[4], values); /* of each vertex, plane after plane */
  CS_ARRAY(bool, constant);   /* scratch: of the row being made, which lines are constant */
  size_t count;
} cs_node_polyline;

/* In an even group of nodes all are equal, and only its first and its last one need to be there. */
#define CS_DEFOCUSED_GROUP 8

typedef struct cs_node_row {
  const float (*planes[2])[4]; /* nodes */
  const bool *even;            /* by group, in all planes together; NULL: unknown */
  int plane_count;
  int32_t last;                  /* node */
  struct cs_node_stretch *found; /* scratch */
  /* every node is a pixel: a line may end in one node, and the next line begin in the next node */
  bool is_split;
} cs_node_row;

/* Appends the vertices of a row. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_node_row_append(celspan_context *context, cs_node_row *row,
                                                  cs_node_polyline *out);
void cs_node_row_free(cs_node_polyline *polyline, cs_memory *memory);
