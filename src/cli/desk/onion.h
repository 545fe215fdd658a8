/* render --onion BEFORE,AFTER: the film of a script under onion skin (onion.lua), in its place. */
#ifndef CS_CLI_DESK_ONION_H
#define CS_CLI_DESK_ONION_H

#include "cli/script.h"

/* Puts the film of skins in the place of the script's, which it keeps. frame: the size of the output.
 * OK, also without --onion; or reported. */
cs_exit cs_onion_lay(cs_script *script, const cs_request *request, const celspan_frame_desc *frame);

#endif
