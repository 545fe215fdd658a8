/* Reading through decoders: the functions of cs_picture_module that read, as the core calls them.
 *
 *   open    file --descriptor--> decoder --header--> checked
 *   read    rectangle --> decoder --pixels in shared memory--> copied
 *
 * INVARIANT: what a picture does to its decoder is a failure that names the picture. A picture that
 * ended one is refused from then on (refusal.h); the others that were open there are opened again
 * where they are read next.
 */
#ifndef CS_CLI_DECODER_READER_H
#define CS_CLI_DECODER_READER_H

#include "pictures/module.h"

celspan_status cs_reader_open(const cs_picture_request *request, cs_picture_reader **out,
                              cs_picture_header *header, cs_picture_failure *failure);
celspan_status cs_reader_read(cs_picture_reader *reader, int32_t x, int32_t y, int32_t width,
                              int32_t height, float *rgba, cs_picture_failure *failure);
celspan_status cs_reader_list(cs_picture_reader *reader,
                              bool (*put)(void *user, const cs_picture_part *part), void *user,
                              cs_picture_failure *failure);
void cs_reader_close(cs_picture_reader *reader);

#endif
