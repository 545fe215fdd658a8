/* The pixels on both sides of a border, between which an edge passes: gates.
 *
 *      L   L   L
 *      +---+---+           L, R: the middles of the pixels left and right of each side; where pixels are
 *      R   R   | R         whole, of one colour or the other, the edge leaves every L on its left and
 *              +---        every R on its right, and nothing else is known of it
 *
 * INVARIANT: both middles of a gate are one pixel apart, and the side that they belong to is halfway.
 */
#ifndef CS_TRACE_GATES_H
#define CS_TRACE_GATES_H

#include "trace/arc.h"

/* Gates that are looked at together, at most. */
#define CS_GATES_MOST 40

typedef struct cs_gate {
  celspan_point left, right;
} cs_gate;

/* Gates in the order of their border. */
typedef struct cs_gate_row {
  cs_gate list[CS_GATES_MOST];
  size_t count;
} cs_gate_row;

static inline celspan_point cs_gate_middle(const cs_gate *gate) {
  return (celspan_point){0.5 * (gate->left.x + gate->right.x),
                         0.5 * (gate->left.y + gate->right.y)};
}

#endif
