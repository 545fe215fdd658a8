/* Decoding out of the process: the picture module that a context gets where the command line does not
 * say --trust.
 *
 *   core --cs_picture_module--> reader.c, writer.c --> decoder.c --sockets--> decoders
 */
#ifndef CS_CLI_DECODER_PICTURES_H
#define CS_CLI_DECODER_PICTURES_H

#include "cli/decoder/decoder.h"

/* Pictures of this context are decoded by processes from here on. Nothing is started yet. */
void cs_pictures_begin(celspan_context *context, const cs_decoder_limits *limits);
/* Ends these processes, where there are any; the context is gone. */
void cs_pictures_finish(void);

#endif
