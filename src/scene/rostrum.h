/* Rostrums made of others: for tools that show a part of a frame, or show it before another ground.
 */
#ifndef CS_SCENE_ROSTRUM_H
#define CS_SCENE_ROSTRUM_H

#include "scene/scene.h"

/* *out: new; like `from`, name and line included, with these cels, which are kept, and this back
 * light, both right already. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_rostrum_change(celspan_context *context,
                                                 const celspan_rostrum *from,
                                                 celspan_cel *const *cels, size_t cel_count,
                                                 celspan_light back, celspan_rostrum **out);

#endif
