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

#include "celspan/track.h"
#include "inside/context.h"

enum { CS_MOTION_MOST = 256 }; /* pairs */

typedef struct cs_motion_pair {
  celspan_point from, to;
  bool agrees; /* the result of cs_motion_agree */
} cs_motion_pair;

/* The least number of pairs that gives a motion more than a guess. */
size_t cs_motion_least(celspan_motion model);

typedef struct cs_motion_verdict {
  celspan_matrix matrix; /* maps `from` to `to` */
  size_t agreeing;       /* pairs */
  double error;          /* pixels: the root mean square of the distances of these pairs */
} cs_motion_verdict;

/* The motion with which the most pairs agree within `tolerance` pixels. All other pairs are left
 * out; pairs that are farther away weigh less. count: at most CS_MOTION_MOST. False if fewer agree
 * than are needed. */
bool cs_motion_agree(celspan_motion model, cs_motion_pair *pairs, size_t count, double tolerance,
                     cs_motion_verdict *out);

/* The point to which a motion moves a point. False behind the horizon. */
bool cs_motion_apply(const celspan_matrix *matrix, celspan_point point, celspan_point *out);
