/* For each pixel the seed that is nearest to it.
 *
 * By the exact distance: first within its column, then by the lower envelope of the parabolas that
 * these make in its row (Meijster, Roerdink and Hesselink, "A general algorithm for computing
 * distance transforms in linear time", 2000).
 */
#pragma once

#include "inside/context.h"

#define CS_NEAREST_NONE UINT32_MAX /* there is no seed at all */

/* Seeds are the bytes of that value in a plane whose sides are at most 16,384. nearest: the place
 * of a seed for each pixel. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_nearest_find(celspan_context *context, const unsigned char *plane,
                                               unsigned char seed, int32_t width, int32_t height,
                                               uint32_t *nearest);
