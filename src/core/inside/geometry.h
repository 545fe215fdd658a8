/* Outlines.
 *
 *     model/geometry/matrix.h   Matrices of two dimensions.
 *     model/geometry/outline.h  An outline is a list of closed chains.
 *     model/stroke/curve.h      Lengths along curves.
 *     model/stroke/outliner.h   The outline of a stroke.
 *     model/stroke/stroke.h     The description of a stroke.
 *     model/warp/bend.h         Bent objects.
 */
#pragma once

#include "model/geometry/matrix.h"
#include "model/geometry/outline.h"
#include "model/stroke/curve.h"
#include "model/stroke/outliner.h"
#include "model/stroke/stroke.h"
#include "model/warp/bend.h"
