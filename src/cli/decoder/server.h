/* A decoder: the process in which the picture module looks at the files of strangers.
 *
 *   keeper --fork--> confined: no other program, no network, nothing written, bounded memory
 *                       `--> message, module, answer, message, ...
 *
 * It ends with the program, whose end of the socket closes then, and with the keeper.
 */
#ifndef CS_CLI_DECODER_SERVER_H
#define CS_CLI_DECODER_SERVER_H

#include "cli/decoder/message.h"
#include "sandbox/roots.h"

/* How a decoder and the keeper end by a fault when an allocation has failed. */
#define CS_SERVER_NO_MEMORY 33
/* How the system's loader ends a process: the libraries are there, for the program has them, so it has
 * no memory. */
#define CS_SERVER_NOT_LOADED 127

/* Whether a process that ended so, as waitpid tells it, had no memory. Without memory the system ends
 * processes by SIGKILL, and GLib, which libraries behind OpenImageIO use, its own by SIGTRAP. */
bool cs_server_is_starved(int ending);

typedef struct cs_server_desc {
  const cs_picture_module *module;
  const cs_roots
      *roots; /* what may be read, where the kernel must hold the process to it; NULL: all
                            files, and a kernel that cannot confine is let pass */
  cs_message_start start;
  int keeper;         /* its process */
  int socket, memory; /* to the program; the shared memory */
} cs_server_desc;

/* Makes faults, SIGALRM and libraries that end this process after a failed allocation end it with
 * CS_SERVER_NO_MEMORY. */
void cs_server_watch_faults(void);
/* Serves in this process until the other side is gone. */
_Noreturn void cs_server_run(const cs_server_desc *desc);

#endif
