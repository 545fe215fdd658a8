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

/* how many bytes longer than the final name a temporary name is */
enum { CS_TEMPORARY_EXTRA = 16 };

/* Writes the temporary name of a file. XXXX is the low 16 bits of the number; a very long NAME is
 * cut. */
void cs_temporary_name(const char *path, unsigned number, char *out, size_t size);
/* Locks a temporary file that was just opened. false: another process removed the file, or has
 * locked it to remove it. */
bool cs_temporary_claim(int descriptor);
/* Removes a temporary file that this process has created but could not claim. */
void cs_temporary_drop(int descriptor, const char *path);
/* Removes remnants in the folder of `pattern`, of files with names for which `matches` is true. A
 * file that cannot be removed remains, without an error. */
void cs_temporary_sweep(const char *pattern,
                        bool (*matches)(const char *pattern, const char *name));
/* Removes every temporary file that this process has open. The process must not continue after
 * this. Safe in a signal handler. */
void cs_temporary_abandon(void);
