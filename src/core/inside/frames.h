/* Compiled frames, for what reads their rows, their layers or their borders.
 *
 *   frames/render/frame.h      a compiled frame does not change, and row workers share it
 *   frames/render/compile.h    a rostrum becomes a plan
 *   engine/row/plan.h          a plan never changes, and borrows the values of its rostrum
 *   engine/span/row.h          spans are sorted, disjoint, without gaps, and equal neighbours are
 *                              one
 *   engine/span/row_queue.h    rows that are read later
 *   engine/compose/stack.h     layers from the rear to the camera, with their groups
 *   engine/compose/cell.h      a cell depends on its set of layers alone
 *   engine/paint/over_row.h    the fold of a program over a run of pixels
 *   engine/events/visit.h      the parts of boundaries between different cells
 *   engine/defocus/defocus.h   a defocused layer, as far as it is read
 *   engine/defocus/bands.h     its rows, kept from frame to frame
 */
#pragma once

#include "engine/compose/cell.h"
#include "engine/compose/stack.h"
#include "engine/defocus/bands.h"
#include "engine/defocus/defocus.h"
#include "engine/events/visit.h"
#include "engine/paint/over_row.h"
#include "engine/row/plan.h"
#include "engine/span/row.h"
#include "engine/span/row_queue.h"
#include "frames/render/compile.h"
#include "frames/render/frame.h"
