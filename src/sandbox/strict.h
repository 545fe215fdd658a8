/* strict: what the kernel lets the process do from here on, whatever it is made to do.
 *
 *   Landlock     files: read below some folders, write below others; no TCP
 *   seccomp      no other program, no sockets, no look into other processes
 *   limits       no core file
 *
 * INVARIANT: it is for ever and for all threads that are made later; so it is entered before there
 * are any.
 */
#ifndef CS_SANDBOX_STRICT_H
#define CS_SANDBOX_STRICT_H

#include <stdbool.h>
#include <stddef.h>

#include "sandbox/roots.h"

/* NULL, or why it could not be entered: the process may then be confined in part, and must end. */
const char *cs_strict_enter(const cs_roots *read, const cs_roots *write);

#endif
