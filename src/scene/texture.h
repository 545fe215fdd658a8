/* Textures inside the scene. Invariants beyond scene.h, so that no reader checks again: a triangle
 * has an area, a linear gradient a length, a radial one a radius, a picture's box (if any) a size,
 * and stops count two or more; what would break them was made FLAT at the door. */
#ifndef CS_SCENE_TEXTURE_H
#define CS_SCENE_TEXTURE_H

#include "scene/scene.h"

/* `texture` kept, or new opaque black when it is NULL. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_texture_or_black(celspan_context *context,
                                                   celspan_texture *texture, celspan_texture **out);

/* Whether every colour of the texture is opaque, and whether every one lets the three channels
 * through alike. A picture is never known to be opaque here; it is grey unless it is a gel. */
bool cs_texture_is_opaque(const celspan_texture *texture);
bool cs_texture_is_grey(const celspan_texture *texture);

#endif
