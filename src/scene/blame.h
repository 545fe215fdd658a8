/* Which part of a scene a message is about, in words that people know:
 *
 *   cel 3 'hand' (shot.lua:12)
 *   cel 3 'hand' (shot.lua:12), image 'ring' (shot.lua:7)
 */
#ifndef CS_SCENE_BLAME_H
#define CS_SCENE_BLAME_H

#include "scene/scene.h"

typedef struct cs_blame_text {
  char text[2 * sizeof(cs_mark_text) + 64];
} cs_blame_text;

/* A cel by its number, from 1, and its mark. */
cs_blame_text cs_blame_cel(size_t number, cs_mark cel);
/* An object of it: the innermost one, whose texture's mark counts where it has no name. */
cs_blame_text cs_blame_object(size_t number, cs_mark cel, const celspan_object *object);

/* Puts the place of the picture that an INPUT failure is about before the context's sentence, which
 * begins with the picture's file: of the first object in the exposures that shows it. Returns
 * status. */
celspan_status cs_blame_picture(celspan_context *context, const celspan_exposure *exposures,
                                size_t count, celspan_status status);

#endif
