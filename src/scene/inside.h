/* Inside or outside: shapes at a point, by winding numbers. Shares no code with the sweep.
 *
 * A point is taken down to a primitive through the inverse of the matrix of all levels together,
 * and is not there when it arrives from behind the horizon.
 */
#ifndef CS_SCENE_INSIDE_H
#define CS_SCENE_INSIDE_H

#include "geometry/outline.h"
#include "scene/scene.h"

/* The point below a matrix; false when that is singular, or the point behind the horizon. */
bool cs_inside_arrive(const celspan_matrix *matrix, celspan_point point, celspan_point *out);

/* Whether a point is inside an outline. Half-open, as pixels are: left and top edges are in, right
 * and bottom ones are out. */
bool cs_inside_outline(const cs_outline *outline, celspan_rule rule, celspan_point point);

/* Whether a boolean is there, of whose operands `present` are. first: whether the first one is. */
static inline bool cs_inside_holds(celspan_operator op, size_t present, size_t operand_count,
                                   bool first) {
  switch (op) {
  case CELSPAN_UNION:
    return present > 0;
  case CELSPAN_INTERSECTION:
    return present > 0 && present == operand_count;
  case CELSPAN_DIFFERENCE:
    return first && present == 1;
  case CELSPAN_XOR:
    return present % 2 == 1;
  case CELSPAN_CLIP:
    break;
  }
  return first && present == 2;
}

/* Whether a boolean shows the paint of its operand of this index, where that is there. */
static inline bool cs_inside_shows(celspan_operator op, size_t index) {
  return index == 0 || (op != CELSPAN_DIFFERENCE && op != CELSPAN_CLIP);
}

#endif
