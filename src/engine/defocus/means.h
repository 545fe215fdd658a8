/* Bands of means over pixels, which shifted cels read (shifted.h).
 *
 *     plan --row--> spans: | single | array          | gradient |
 *                            ||       ||               ||
 *     band --row--> nodes: o o o o  o o o o o o o o   o o o o      one for each pixel
 *
 * A grid of a cel's own whose kernel is the pixel needs no more than its rows, pixel by pixel.
 */
#pragma once

#include "engine/defocus/defocus.h"

/* From now on the bands of such a grid are made so. */
void cs_means_use(cs_defocus *own);
