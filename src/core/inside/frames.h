/* Compiled frames, for what reads their rows or their layers.
 *
 *     frames/render/frame.h     A frame that is ready to be drawn.
 *     frames/render/compile.h   The layers of a frame.
 *     engine/span/row.h         A row of spans.
 *     engine/span/row_queue.h   Rows that wait.
 *     engine/row/plan.h         What a row is made from.
 *     engine/defocus/defocus.h  Layers that are defocused.
 *     engine/defocus/bands.h    Rows of their grids.
 *     engine/paint/over_row.h   The fold of a row.
 *     engine/compose/stack.h    The stack of layers.
 *     engine/compose/cell.h     The set of layers between two boundaries.
 *     engine/events/visit.h     The boundaries of a drawing.
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
