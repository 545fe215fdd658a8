/* Outlines.
 *
 *   model/geometry/matrix.h    matrices of 3 x 3, and whether they can be inverted
 *   model/geometry/outline.h   contours are closed to the bit, and their pieces share their joints
 *   model/stroke/curve.h       lengths along a curve, and the place at a length
 *   model/stroke/outliner.h    the outline of a line, with errors below a given one
 *   model/stroke/stroke.h      a stroke as a description, with its dashes and tapers
 *   model/warp/bend.h          an outline that a map has bent
 */
#pragma once

#include "model/geometry/matrix.h"
#include "model/geometry/outline.h"
#include "model/stroke/curve.h"
#include "model/stroke/outliner.h"
#include "model/stroke/stroke.h"
#include "model/warp/bend.h"
