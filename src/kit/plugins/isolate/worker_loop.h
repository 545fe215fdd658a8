/* A worker: a process in which a module reads and writes files, or reads colour profiles.
 *
 *   zygote --fork--> confined: no other programs, no network, no written files, bounded memory
 *                       `--> message, module, answer, message, ...
 *
 * It ends when the program's end of the socket is closed, and when the zygote ends.
 */
#pragma once

#include "plugins/isolate/message.h"
#include "plugins/isolate/strict.h"

/* The exit code of a worker or the zygote that crashed after a failed allocation. */
#define CS_WORKER_NO_MEMORY 33
/* The exit code of the system's loader. The libraries exist, because the program has loaded them.
 * So the reason is a lack of memory. */
#define CS_WORKER_NOT_LOADED 127

/* Whether a process with this status of waitpid had no memory. A system without memory ends
 * processes by SIGKILL; GLib, which libraries behind OpenImageIO use, ends its own process by
 * SIGTRAP. */
bool cs_worker_loop_is_starved(int ending);

typedef struct cs_worker_desc {
  const cs_picture_module *module; /* for all tasks except SAMPLES */
  const cs_colour_module *colour;  /* the colour of SAMPLES */
  /* the files that may be read, which the kernel must enforce; NULL: all files, and the process
   * need not be confined */
  const cs_roots *roots;
  cs_message_start start;
  int zygote;         /* process number */
  int socket, memory; /* socket: to the program; memory: the descriptor of START */
} cs_worker_desc;

/* From now on, if this process ends by a crash, SIGALRM or a library after a failed allocation, it
 * ends with CS_WORKER_NO_MEMORY. */
void cs_worker_loop_watch_faults(void);
/* Binds this process to the zygote, and confines it to its limits and these rights. Ends the
 * process if this is required and not possible. */
void cs_worker_loop_confine(const cs_worker_desc *desc, const cs_strict_rights *rights);
/* Handles messages in this process until the other side has ended. */
_Noreturn void cs_worker_loop_run(const cs_worker_desc *desc);
