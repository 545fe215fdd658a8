/* All lines that pass through a row of gates, and the one in their middle.
 *
 *        u0                        u1        a line is where it is beside both ends of the row, u0 and
 *      L ----___ L   L   L   L     |         u1; each middle of a pixel keeps (u0, u1) on one side of a
 *      |R   R  -----___ R   R    R |         line of its own, and all of them in a convex polygon: the
 *              R   R  ------____---          preimage of the row, as digital straight lines are called
 *
 * The one in the middle is halfway between the least and the greatest u0, and between those of u1: so
 * that at neither end it is farther from any line than need be.
 */
#ifndef CS_TRACE_PREIMAGE_H
#define CS_TRACE_PREIMAGE_H

#include "trace/gates.h"

/* Off the line it grows towards the left. False: no line passes. */
bool cs_preimage_middle(const cs_gate_row *row, cs_arc *line);

#endif
