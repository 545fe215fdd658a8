/* Which spec files a run has: files as they are named, and of folders every file whose name ends in
 * _spec.lua, in the order of their names, whatever the file system's order is.
 */
#ifndef CS_CLI_SPEC_LIST_H
#define CS_CLI_SPEC_LIST_H

#include "base/context.h"

typedef struct cs_spec_list {
  char **paths; /* owned */
  size_t count, capacity;
} cs_spec_list;

/* Adds a file, or what is in a folder. Errors: INPUT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_spec_list_add(cs_spec_list *list, celspan_context *context,
                                                const char *path);
void cs_spec_list_finish(cs_spec_list *list, celspan_context *context);

#endif
