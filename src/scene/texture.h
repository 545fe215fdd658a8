/* Textures inside the scene. Invariants beyond scene.h, so that no reader checks again: a triangle
 * has an area, a linear gradient a length, a radial one a radius, a picture's box (if any) a size,
 * and stops count two or more; what would break them was made FLAT at the door. */
#ifndef CS_SCENE_TEXTURE_H
#define CS_SCENE_TEXTURE_H

#include "scene/scene.h"

/* `texture` kept, or new opaque black when it is NULL. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_texture_or_black(celspan_context *context,
                                                   celspan_texture *texture, celspan_texture **out);

#endif
