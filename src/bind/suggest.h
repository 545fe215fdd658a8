/* "Did you mean ...?": the known name that is nearest to a mistyped one. */
#ifndef CS_BIND_SUGGEST_H
#define CS_BIND_SUGGEST_H

#include <stddef.h>

/* The nearest of `count` names to a word; NULL when none is near. */
const char *cs_suggest_name(const char *word, const char *const *names, size_t count);

#endif
