/* The manual page, celspan(1), made from the tables that the help is made from.
 *
 * INVARIANT  Every verb and every option of the tables is in it, and nothing that they lack.
 */
#ifndef CS_CLI_MANUAL_H
#define CS_CLI_MANUAL_H

#include "cli/request.h"

/* The page, for man(1). */
void cs_manual_print(const cs_verb *verbs, size_t count, FILE *stream);
/* The exit codes, as the help shows them. */
void cs_manual_exit_codes(FILE *stream);

#endif
