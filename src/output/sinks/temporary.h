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

enum { CS_TEMPORARY_EXTRA = 16 }; /* bytes that a temporary name has more than the final one */

/* Writes the temporary name of a file; the low 16 bits of the number are XXXX, and a very long NAME
 * is cut. */
void cs_temporary_name(const char *path, unsigned number, char *out, size_t size);
/* Locks a temporary file that was just opened. false: another process removed it, or has locked it
 * to do so. */
bool cs_temporary_claim(int descriptor);
/* Removes a temporary file that this process has created but could not claim. */
void cs_temporary_drop(int descriptor, const char *path);
/* Removes files that were left behind in the folder of `pattern`, of names for which `matches` is
 * true. A file that cannot be removed stays, without an error. */
void cs_temporary_sweep(const char *pattern,
                        bool (*matches)(const char *pattern, const char *name));
/* Removes every temporary file that this process has open, which must then not continue. Safe in a
 * signal handler. */
void cs_temporary_abandon(void);
