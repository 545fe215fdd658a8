/* The motion that pairs of places agree on.
 *
 *   translation      similarity         perspective
 *   +--+   +--+      +--+    /\         +--+     ____
 *   |  |-> |  |      |  |-> /  \        |  |->  /    \      2, 4 and 8 numbers; a pair gives 2
 *   +--+   +--+      +--+   \  /        +--+   /______\
 *                            \/
 *
 * INVARIANT: the answer depends on the pairs and their order alone: samples are drawn by a
 * generator that begins with the same seed each time.
 */
#pragma once

#include "base/context.h"
#include "celspan/track.h"

enum { CS_MOTION_MOST = 256 }; /* pairs */

typedef struct cs_motion_pair {
  celspan_point from, to;
  bool agrees; /* the result of cs_motion_agree */
} cs_motion_pair;

/* How many pairs a motion needs at least, so that it is not only a guess. */
size_t cs_motion_least(celspan_motion model);

typedef struct cs_motion_verdict {
  celspan_matrix matrix; /* takes `from` to `to` */
  size_t agreeing;       /* pairs */
  double error;          /* pixels: the root of the mean square of how far these are off */
} cs_motion_verdict;

/* The motion of the most pairs that agree within `tolerance` pixels; the others are left out, and
 * those far off weigh less. count: CS_MOTION_MOST at most. False where fewer agree than needed. */
bool cs_motion_agree(celspan_motion model, cs_motion_pair *pairs, size_t count, double tolerance,
                     cs_motion_verdict *out);

/* Where a motion takes a point. False behind the horizon. */
bool cs_motion_apply(const celspan_matrix *matrix, celspan_point point, celspan_point *out);
