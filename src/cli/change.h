/* What --cel and --background change of a frame between building it and making it.
 *
 *   --cel NAME     the cels of that name remain, with their lights; the rostrum's own back light does
 *                  not. A frame without one is empty, but some frame must have one
 *   --background   a back light of matte 1 behind everything. Where the rostrum has a back light of
 *                  its own with matte a, the background shines through 1 - a of it; one with a shape
 *                  is added
 *
 * Invariant: without these options, frames stay as they are.
 */
#ifndef CS_CLI_CHANGE_H
#define CS_CLI_CHANGE_H

#include "cli/script.h"
#include "film/sequence.h"

/* Looks for a cel of the name in the frames, then in the rest of the film: they are built one after
 * the other until there is one. OK, also without --cel; or reported, with the names that there are.
 */
cs_exit cs_change_refuse(cs_script *script, const cs_request *request, const cs_sequence *frames);
/* Changes a frame's rostrums. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_change_frame(celspan_context *context, const cs_request *request,
                                               cs_film_frame *frame);

#endif
