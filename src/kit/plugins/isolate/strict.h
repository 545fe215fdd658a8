/* Strict confinement: the kernel restricts the process from now on, even if it is taken over.
 *
 *   Landlock     files: read below some folders, write below others; start one program or none;
 *                no TCP
 *   seccomp      no other programs, no sockets, no access to other processes
 *   limits       no core file
 *
 * INVARIANT: it cannot be undone, and applies to all threads and programs that are started later;
 * so it is entered before the first one starts.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "common/roots.h"

/* The rights that the process keeps. It may always read the libraries of the system. */
typedef struct cs_strict_rights {
  const cs_roots *read, *write; /* folders; NULL: none */
  /* A process with a program may read only this program, which it may also start, and one file,
   * instead of folders. Both NULL: it may start no program. */
  const char *program, *file;
} cs_strict_rights;

/* Returns NULL, or the reason of a failure: the process may then be partly confined, and must
 * end. */
const char *cs_strict_enter(const cs_strict_rights *rights);

/* Closes all descriptors from the first on. */
void cs_strict_close(int first);
