/* Argument 1 of celspan.pixels, spans and probe: a film, a rostrum or exposures.
 *
 * INVARIANT: the exposures live as long as the stack that holds their owner, so that an error at
 * any point leaks nothing.
 */
#pragma once

#include "lua/nouns/options.h"

/* Reads argument 2, the options of the noun, and argument 1 as the exposures of options->desc. For
 * a film, gives the exposures of the frame options->frame, or of the first frame; sizes that were
 * not given are those of the film. Errors: the errors of the frame function, with the message in
 * the context. Raises an error for wrong arguments. */
CELSPAN_CHECKED celspan_status cs_subject_read(lua_State *L, const cs_noun *noun,
                                               cs_options *options);
