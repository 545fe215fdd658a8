/* The program's side of the keeper (keeper.h): starts it when the first decoder is needed, and asks it
 * for decoders and for their end. Any thread.
 *
 * INVARIANT: after cs_keeping_finish neither the keeper nor a decoder is left.
 */
#ifndef CS_CLI_DECODER_KEEPING_H
#define CS_CLI_DECODER_KEEPING_H

#include "cli/decoder/message.h"
#include "sandbox/roots.h"

/* Starts the keeper now, for decoders that the kernel is to hold to reading below the roots alone: a
 * confined program could not start it any more. false, and errno: it could not be started. */
bool cs_keeping_confine(const cs_roots *roots);

/* memory: what is shared with the decoder. Errors: INPUT, of a writer OUTPUT, NO_MEMORY, CANCELLED. */
celspan_status cs_keeping_start(const cs_message_start *start, int memory, int *socket,
                                uint32_t *number, cs_picture_failure *failure);
/* The failure that a decoder cannot be started for want of what this errno tells. Errors: NO_MEMORY,
 * and `other`. */
celspan_status cs_keeping_refuse(int error, celspan_status other, cs_picture_failure *failure);
/* Ends a decoder. How it ended, as waitpid tells it; -1: the keeper itself is gone, and the decoder
 * with it. */
int cs_keeping_end(uint32_t number);
void cs_keeping_finish(void);

#endif
