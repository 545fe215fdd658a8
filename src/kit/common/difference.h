/* A picture of the places where two pictures differ: the first picture in pale grey, for
 * orientation, and differing pixels in red, the darker the larger the difference.
 *
 *   grey  255 - 2/5 of the darkness over white        red  255..165, 150..0, 75..0 for 0..1
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* pixels: RGBA of 8 bits, sRGB, alpha straight; changed in place. */
void cs_difference_pale(uint8_t *pixels, size_t count);
/* distance: between coded values, 0..1; greater values count as 1. */
void cs_difference_mark(double distance, uint8_t *pixels, size_t count);
