/* Strict confinement: the kernel restricts the process from now on, even if it is taken over.
 *
 *   Landlock     files: read below some folders, write below others; no TCP
 *   seccomp      no other programs, no sockets, no access to other processes
 *   limits       no core file
 *
 * INVARIANT: it cannot be undone, and applies to all threads that are started later; so it is
 * entered before the first one starts.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "plugins/isolate/roots.h"

/* NULL, or the reason of a failure: the process may then be partly confined, and must end. */
const char *cs_strict_enter(const cs_roots *read, const cs_roots *write);
