/* What is hidden: the layers of a plan as the cull needs to know them.
 *
 *   layer   the most that it lets through     a bound (render/through.h), the same that cuts the
 *                                             programs of the composer: where a tile is dead, the
 *                                             fold of colours has stopped before
 *                                             (of a picture by its header, which is read for it)
 *   group   faded, or lit by a light with a shape
 *   tree    where its layers are certain to be painted (compose/tree_certain.h)
 */
#ifndef CS_RENDER_HIDDEN_H
#define CS_RENDER_HIDDEN_H

#include "render/compiler.h"

/* Culls the boundaries of a plan, which are in their final order, if that pays. Errors: NO_MEMORY.
 */
CELSPAN_CHECKED celspan_status cs_hidden_cull(cs_compiler *c);

#endif
