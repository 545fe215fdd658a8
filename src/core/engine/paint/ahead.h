/* Pixels of programs of gradients that over_channels.h has folded, and what it keeps of them.
 *
 * A cell and the windows on both its sides ask for colours one after the other: trials of lines, a
 * few pixels beside an edge, and the pixels between. So the pixels of all of them are folded once,
 * ahead, and kept until two other programs have been folded ahead.
 *
 *      window |    cell    | window
 *     |   /   |            |  /    |
 *         |<----- ahead ----->|
 *
 * Invariant: the pixels depend on the stack, the program's layers and the place alone, so they stay
 * right as long as the stack lives.
 */
#pragma once

#include "engine/compose/cell.h"
#include "engine/paint/over_row.h"
#include "engine/span/run.h"

#define CS_OVER_CHANNELS_ROOM (CS_OVER_ROW_BATCH + 16) /* whole registers are read and written */
#define CS_OVER_CHANNELS_ITEMS 64 /* longer programs, which are rare, are not folded ahead */

typedef struct cs_over_channels {
  float light[3][CS_OVER_CHANNELS_ROOM], through[CS_OVER_CHANNELS_ROOM];
  int32_t count; /* pixels */
  float keep;    /* the share of transparency that the mattes of back lights leave */
} cs_over_channels;

/* The pixels of a run, folded ahead. */
typedef struct cs_over_channels_ahead {
  cs_over_channels pixels;
  uint32_t layers[CS_OVER_CHANNELS_ITEMS]; /* the layers of the program's items */
  uint32_t length;                         /* 0: nothing has been folded */
  cs_run run;
} cs_over_channels_ahead;
