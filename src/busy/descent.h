/* The descent: chains followed down the rows of a frame, and cut into units.
 *
 *     row   |   \      \    /|            \, /, |: chains
 *           +----\------*--/-|----        *: one begins, ends, or both
 *     row   |     \    /     |            a unit is what lies between two of the lines
 *           +------\--/------|----
 *
 * Nothing is put in order: the columns of the row do that (columns.h). A chain costs the points that
 * it has in the row, wherever it lies.
 *
 * Invariant: the units of a row depend on the boundaries and the row alone, but for their order.
 */
#ifndef CS_BUSY_DESCENT_H
#define CS_BUSY_DESCENT_H

#include "busy/unit.h"
#include "geometry/chords.h"

/* A chain that reaches the top of the next row, and the chord that is there. */
typedef struct cs_followed {
  double x, y;                  /* where the next unit begins */
  double x0, y0, x1, y1, slope; /* the chord from its top to its foot */
  const cs_boundary_chain *chain;
  uint32_t piece;     /* index into the pieces of all chains */
  uint32_t chords;    /* of the piece */
  uint32_t first;     /* the number of the first vertex in `made` */
  uint32_t at, count; /* the chord is number `at` of the `count` in `made` */
  cs_chords made;
} cs_followed;

typedef struct cs_descent {
  const cs_boundary_set *set; /* borrowed, sorted */
  cs_followed *followed;
  size_t count, capacity;
  size_t next;    /* the first chain that has not begun */
  int32_t row;    /* whose units come next; NONE: the descent has not begun */
  cs_units units; /* of the last row */
} cs_descent;

#define CS_DESCENT_NONE INT32_MIN

void cs_descent_init(cs_descent *descent, const cs_boundary_set *set);
void cs_descent_finish(cs_descent *descent, cs_memory *memory);
/* Makes the units of a row: cheapest from top to bottom. Errors: NO_MEMORY; the descent begins anew
 * after one. */
CELSPAN_CHECKED celspan_status cs_descent_row(celspan_context *context, cs_descent *descent,
                                              int32_t row);

#endif
