/* The client of the zygote (zygote.h) in the program: it starts the zygote when the first worker is
 * needed, and asks it to start and end workers. Any thread.
 *
 * INVARIANT: after cs_client_finish the zygote and all workers have ended.
 */
#pragma once

#include "common/roots.h"
#include "plugins/isolate/message.h"

/* Starts the zygote now, because a confined program could not start it later. Workers will only be
 * allowed to read files below the roots. false: it could not be started; errno has the reason. */
bool cs_client_confine(const cs_roots *roots);

/* Starts a worker. memory: the descriptor of the shared memory. Errors: INPUT (OUTPUT for a
 * writer); NO_MEMORY; CANCELLED. */
celspan_status cs_client_start(const cs_message_start *start, int memory, int *socket,
                               uint32_t *number, cs_picture_failure *failure);
/* Returns the failure of a worker that cannot be started, with the reason in errno. Errors:
 * NO_MEMORY, and `other`. */
celspan_status cs_client_refuse(int error, celspan_status other, cs_picture_failure *failure);
/* Ends a worker. Returns the status of waitpid; -1: the zygote itself has ended, and with it the
 * worker. */
int cs_client_end(uint32_t number);
void cs_client_finish(void);
