/* The log of --log: a file to which each message is added with the time and the name of the
 * machine, so that a farm finds out which machine said what.
 *
 *   2026-11-27T09:30:00.125Z node7 celspan[4711] error: frame 12: ...
 *
 * INVARIANT: a line is added with one call, so that several processes may share a file. A file that
 * can no longer be written ends the log, not the run.
 */
#pragma once

#include <stdbool.h>

typedef enum cs_log_kind { CS_LOG_NOTE, CS_LOG_ERROR } cs_log_kind;

/* Opens the file, or reports why not with its errno. It stays open until the program ends. */
bool cs_log_open(const char *path);
/* Adds a message, as it is shown on a terminal; nothing without a log. Returns false once, when
 * the log ends by a failure, which is in errno. */
bool cs_log_add(cs_log_kind kind, const char *text);
/* The present time in this form. out: at least CS_LOG_TIME bytes. */
enum { CS_LOG_TIME = 32 };
void cs_log_time(char out[CS_LOG_TIME]);
/* The name of this machine; "localhost" if it has none. */
const char *cs_log_host(void);
