/* Plane files: a drawing as a plane, which is made, drawn, or of which a tile is drawn.
 *
 *   plane DRAWING SIDE make    the plane is made, which has no size; prints the bytes of its file
 *   plane DRAWING SIDE draw    all of it, to 8-bit pixels in one row that is reused
 *   plane DRAWING SIDE tile    256 x 256 pixels out of its middle
 *   plane DRAWING 0 FILE       nothing is measured; the plane's file is written
 */
#pragma once

#include "frames.h"

void bench_plane(bench_frame_job *job, int count, char **words);
