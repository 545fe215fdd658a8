/* The holes of a peg bar in a page, and how the page lies on them.
 *
 *   blots darker or brighter than the paper --> every pair of them, as every pair of the wanted
 *   holes --> the pair for which most other holes are where they must be --> the middle of each
 *   hole, by how much of each pixel it covers --> the turn, the scale and the place that fit best
 *
 *      [====]            ( )            [====]     ACME: slots of 12.7 x 3.2 mm, 101.6 mm apart
 *                                                  from a round hole of 6.35 mm
 *
 * INVARIANT: all holes are found at any scale from 1/8 to 8, so that a wrong `dpi` can be named; a
 * part of them at the right scale alone. The turn is at most about 15 degrees to each side.
 */
#pragma once

#include "tools/scan/rough.h"

/* Millimetres, x to the right and y down; x, y: of the middle. Round where width = height. */
typedef struct cs_hole {
  double x, y, width, height;
} cs_hole;

typedef struct cs_pegs {
  int32_t found; /* holes; the rest has a meaning only if all were found */
  double scale;  /* of the drawing: 1 if `dpi` is right */
  double turn;   /* radians clockwise, of the holes */
  double x, y;   /* pixels: where the origin of the holes is */
  double error;  /* millimetres: the greatest distance of a hole from its place */
} cs_pegs;

/* count: 2..CS_ROUGH_HOLES. Keeps in the page where the holes are. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_holes_find(cs_rough *page, double dpi, const cs_hole *holes,
                                             size_t count, cs_pegs *out);
