/* Gradients that repeat, as far as they can be seen: unrolled to longer ones that hold.
 *
 *   one period    0 ---- 1                          places of stops
 *   unrolled      0 ---- 1/3 ---- 2/3 ---- 1        from the first period to the last one
 *                 ^ ---- from' ---------- to' ^     so many times as long
 *
 * Invariant: inside the box the unrolled gradient shows the same as the repeating one.
 */
#pragma once

#include "model/scene/texture.h"

#define CS_UNROLL_STOPS 4096

/* Where *texture repeats, replaces it by a texture that does not, and releases it. box: around the
 * object with this texture, in the object's units; NULL: the texture of a light, which may be
 * anywhere. Errors: NO_MEMORY; LIMIT for more than CS_UNROLL_STOPS. */
CELSPAN_CHECKED celspan_status cs_texture_unroll(celspan_context *context,
                                                 celspan_texture **texture, const celspan_box *box);
