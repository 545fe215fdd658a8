/* Frames of which only a part is shown: rostrums with other cels, and what some values of a script
 * made.
 */
#pragma once

#include "inside/scene.h"

/* Makes the cel that replaces a cel of a rostrum; NULL: it is left out. */
typedef celspan_status (*cs_remaker)(void *user, const celspan_rostrum *from, size_t i,
                                     celspan_cel **out);

/* *out: new; the rostrum with its cels replaced. Errors: NO_MEMORY; those of `make`. */
CELSPAN_CHECKED celspan_status cs_remake(celspan_context *context, const celspan_rostrum *from,
                                         cs_remaker make, void *user, celspan_rostrum **out);
/* The same for exposures that hold references, as those of a film do. After an error some of them
 * may be changed. */
CELSPAN_CHECKED celspan_status cs_remake_exposures(celspan_context *context,
                                                   celspan_exposure *exposures, size_t count,
                                                   cs_remaker make, void *user);

/* What is kept of a frame: begun with what is asked, all else zero. */
typedef struct cs_made {
  celspan_context *context;
  bool (*is_made)(void *user, cs_mark mark);
  bool (*is_searched)(void *user, const celspan_rostrum *from, size_t i); /* a cel; NULL: all */
  void *user;
  bool is_any;                         /* the answer: something was made */
  CS_ARRAY(celspan_object *, objects); /* of the cel that is searched, in their places; owned */
  size_t count;
} cs_made;

/* Leaves only the objects that is_made chooses, and all of the cels that it chooses, in white
 * light. Errors: NO_MEMORY; those of cs_scene_cel_matrix. */
CELSPAN_CHECKED celspan_status cs_made_keep(cs_made *m, celspan_exposure *exposures, size_t count);
