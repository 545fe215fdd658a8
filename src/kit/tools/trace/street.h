/* The line or the arc that passes through a row of gates, and how wide a street it is the middle
 * of.
 *
 *  L   L   L .  '          the widest street that has every L on its left and every R on its right
 *      .  '  ___ '         is as wide as the least distance between the convex hulls of both; for
 *  . '  ___ '  .  ' R      arcs the hulls are those of (x, y, x^2 + y^2), for what is a plane there
 *   ___ '  . '  R          is a circle here
 *       '   R   R
 *
 * The least distance is found by Wolfe ("Finding the nearest point in a polytope", 1976), in steps
 * of which each is nearer than all before.
 */
#pragma once

#include "tools/trace/arc.h"

/* The pixels on both sides of a border, between which an edge passes: gates.
 *
 * L   L   L
 * +---+---+           L, R: the middles of the pixels left and right of each side; where pixels are
 * R   R   | R         whole, of one colour or the other, the edge leaves every L on its left and
 *         +---        every R on its right, and nothing else is known of it
 *
 * INVARIANT: both middles of a gate are one pixel apart, and the side that they belong to is
 * halfway.
 */

/* The most gates that are examined together. */
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

typedef struct cs_street {
  cs_arc middle; /* the distance from it grows towards the left */
  double width;
} cs_street;

/* The widest street of a line or an arc; false: no street passes the gates. */
bool cs_street_find(const cs_gate_row *row, bool is_line, cs_street *out);
/* The same for any street, which may be narrower but is found sooner. */
bool cs_street_find_any(const cs_gate_row *row, bool is_line, cs_street *out);
/* Whether the middle of a street passes one more gate. */
bool cs_street_passes(const cs_street *street, const cs_gate *gate);
