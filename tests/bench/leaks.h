/* Light between shapes that abut. Black shapes that cover the whole frame without gap or overlap
 * lie over white; whatever is not black in it has leaked. Antialiasing by area promises none.
 *
 *      fans: 3 to 64 wedges      bars: 2 to 300, half of them upright
 *
 *      +-----\-------/-+          +---|-----\-----\---+
 *      |      \     /  |          |   |      \    |   |
 *      |       \   /___|          |   |       \   |   |
 *      |________\_/    |          |   |        \  |   |
 *      |        / \    |          |   |         \ |   |
 *      +-------/---\---+          +---|----------\|---+
 */
#pragma once

#include "celspan/celspan.h"

typedef enum bench_cover { BENCH_FANS, BENCH_BARS } bench_cover;

/* `rounds` frames for every number of wedges, or of bars: each at a random place, angle and size.
 * Prints the numbers of `frames` and `pixels`, the `worst` light of a pixel in 255ths, and how many
 * pixels are `leaking`. */
void bench_tell_leaks(celspan_context *context, bench_cover cover, int rounds);
