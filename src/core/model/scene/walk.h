/* A walk over everything that a rostrum contains, those inside it included.
 *
 *   rostrum: its lights, then cel by cel: lights, objects through booleans to primitives
 *                                                  \-- a rostrum: the same again
 *
 * INVARIANT: the order is that of the lists, back to front; a node that occurs twice is visited
 * twice.
 */
#pragma once

#include "model/scene/scene.h"

typedef struct cs_walk {
  celspan_context *context; /* for the call */
  /* Called for every primitive, as often as it occurs, and for the texture of every light; then
   * primitive is NULL. texture is NULL for procedures. */
  celspan_status (*call)(const struct cs_walk *walk, const cs_primitive_data *primitive,
                         const celspan_texture *texture);
  void *user;
  size_t cels;                  /* cels met so far */
  const celspan_object *object; /* the object that the primitive belongs to */
} cs_walk;

/* Both functions continue until a call fails. */
CELSPAN_CHECKED celspan_status cs_walk_rostrum(cs_walk *walk, const celspan_rostrum *rostrum);
CELSPAN_CHECKED celspan_status cs_walk_cel(cs_walk *walk, const celspan_cel *cel);
CELSPAN_CHECKED celspan_status cs_walk_lights(cs_walk *walk, const cs_light *front,
                                              const cs_light *back);
/* The sizes and times of change of the pictures' files as they are now. */
cs_hash cs_walk_hash_files(const celspan_exposure *exposures, size_t count);
