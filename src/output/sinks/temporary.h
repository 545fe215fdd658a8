/* Names and locks of the temporary files of output/sinks/file.h.
 *
 *   folder/ . NAME . XXXX .part       NAME: of the final file; XXXX: four hexadecimal digits
 *
 * INVARIANT: a temporary file is locked as long as the process that writes it lives; so one that
 * can be locked was left behind by a process that is gone.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* Locks a temporary file that was just opened. false: another process removed it, or has locked it
 * to do so. */
bool cs_temporary_claim(int descriptor);
/* Removes files that were left behind in the folder of `pattern`, of names for which `matches` is
 * true. A file that cannot be removed stays, without an error. */
void cs_temporary_sweep(const char *pattern,
                        bool (*matches)(const char *pattern, const char *name));
/* Removes every temporary file that this process has open, which must then not continue. Safe in a
 * signal handler. */
void cs_temporary_abandon(void);
