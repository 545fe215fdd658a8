/* Following a curve: the way of the tips of its spokes, as cubics.
 *
 *    line       a ---------------------> b     A curve is halved until five of its spokes, evenly
 *                \      \    |    /     /      spaced by the parameter, turn by little and go one
 *    spokes       \      \   |   /     /       way: forwards, where one cubic is fitted to their
 *                  *------*--*--*-----*        tips, or backwards, where another is fitted to their
 *                s[0]   s[1] .. s[3] s[4]      pivots. Where the tips turn round it is cut.
 *
 * Invariants: the cubics are within the view's tolerance of the spokes, so their number grows with
 * the fourth root of the size, or less. Two sides of a curve are halved at the same places, so the
 * points that they share are the same to the bit.
 */
#pragma once

#include "model/stroke/side.h"

/* Appends the side along a curve, from the tip of its first spoke to the tip of its last spoke.
 * Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_follow_curve(cs_side *side, const cs_curve *curve,
                                               const cs_spoke *first, const cs_spoke *last);
