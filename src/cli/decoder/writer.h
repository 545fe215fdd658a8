/* Writing through decoders: the functions of cs_picture_module that write, as the core calls them. Each
 * writer has a process of its own, without limits, for what it writes is our own.
 *
 *   rows --shared memory--> module --bytes--> shared memory --> put --> the core's file
 *
 * INVARIANT: what happens to that process is a failure of the file that was written; the file itself
 * is the core's, which removes what is not complete.
 */
#ifndef CS_CLI_DECODER_WRITER_H
#define CS_CLI_DECODER_WRITER_H

#include "pictures/module.h"

celspan_status cs_writer_open(const cs_picture_output *output, cs_picture_writer **out,
                              cs_picture_failure *failure);
celspan_status cs_writer_rows(cs_picture_writer *writer, int32_t y, int32_t count, const void *rows,
                              cs_picture_failure *failure);
celspan_status cs_writer_complete(cs_picture_writer *writer, cs_picture_failure *failure);
void cs_writer_abandon(cs_picture_writer *writer);

#endif
