/* What tiles were made of, in 128 bits: equal for a run that would make the same tiles. */
#ifndef CS_CLI_TILES_DIGEST_H
#define CS_CLI_TILES_DIGEST_H

#include "base/hash.h"
#include "cli/request.h"
#include "cli/tiles/pyramid.h"

/* Scenes count by their structure, pictures by name, size and time. A procedure has no structure:
 * where a scene holds one, the bytes of the script and its arguments count instead. is_script: else
 * the operand of the request is a picture. */
cs_hash cs_tile_digest(const cs_request *request, const cs_pyramid *pyramid,
                       const celspan_frame_desc *frame, bool is_script);

#endif
