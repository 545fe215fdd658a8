/* The objects and cels at a point of a frame, from front to back. Each follows its own parts, which
 * are deeper.
 */
#pragma once

#include "inside/scene.h"

typedef struct cs_hit {
  cs_mark mark;
  double opacity;
  int depth;
  double share;                 /* of the exposures that show it */
  const char *part;             /* its shot in a cut; "" or NULL: none */
  const celspan_object *object; /* NULL: it is a cel */
  const cs_light *light;        /* the front light of a cel; the paint of an object at the point, in
                                   white light, straight */
} cs_hit;

typedef struct cs_hits_wanted {
  celspan_context *context;
  const celspan_frame_desc *frame; /* its exposures, its size in film units and its space count */
  celspan_point point;             /* film units */
  bool is_cut;                     /* one shot is searched after the other */
  void (*found)(void *user, const cs_hit *hit);
  void *user;
} cs_hits_wanted;

/* Calls `found` for each. Errors: those of celspan_probe. */
CELSPAN_CHECKED celspan_status cs_hits_find(const cs_hits_wanted *wanted);
