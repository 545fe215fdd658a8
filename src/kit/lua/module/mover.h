/* The clock of drawings that move is a function of Lua. */
#pragma once

#include <lua.h>

#include "readers/svg/motion/motion.h"

/* function(mover, seconds, key) -> how long the drawing moves. seconds: nil: it is not moved.
 * key: an integer, the same for equal documents.
 *
 *   mover:animation(number) -> target | false, attribute, tag     of an element that animates
 *   mover:text(number, name, ...) -> text | nil, ...    attributes of one; number 0: properties of
 *         the visited element
 *   mover:mix(number, property, share, from, composition, to, composition, is_by, last, round)
 *         see cs_svg_mixture; the property is of the visited element
 *   mover:distance(number, a, b) -> distance | nil: b does not mix
 *   mover:spot(number, share) -> has_line, x, y, degrees, x and y of its end
 *   mover:place(number, x, y, degrees, adds)
 *   mover:visit(function)        called for each element whose styles name animations
 *   mover:frames(name) -> { { at =, property, text, property, text, ... }, ... }, size | nil
 *   mover:count(size)     counts what is read for the visited element against the limits
 *   mover:skip(number, sentence)       notes what is not run; number 0: of the visited element
 *   mover:refuse(sentence)             ends the reading
 */
typedef struct cs_mover {
  lua_State *L;
  int function, self;    /* the indices of the function and of this value */
  cs_svg_mover *mover;   /* NULL: the function does not run */
  celspan_status status; /* what the last function of the mover returned */
  int failure;           /* the index of the error that the function raised; 0: none */
} cs_mover;

/* Pushes a mover that calls the function at an index. */
cs_mover *cs_mover_push(lua_State *L, int function);
/* The clock; user: a cs_mover on the stack. */
celspan_status cs_mover_run(void *user, cs_svg_mover *mover, double *seconds);
/* Makes the metatable of movers. */
void cs_mover_open(lua_State *L);
