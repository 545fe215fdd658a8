/* What celspan.pixels, spans and probe are given as argument 1: a film, a rostrum or exposures.
 *
 * INVARIANT: the exposures live as long as the stack on which their owner was left, so that an error
 * at any point leaks nothing.
 */
#ifndef CS_BIND_SUBJECT_H
#define CS_BIND_SUBJECT_H

#include "bind/options.h"

/* Of a film the frame is built that the form's field `frame` names, or the first, and the sizes of
 * *desc that the form leaves out are the film's. Errors: those of the frame function, with the
 * sentence in the context. Raises for wrong arguments. */
CELSPAN_CHECKED celspan_status cs_subject_read(const cs_form *form, celspan_frame_desc *desc);

#endif
