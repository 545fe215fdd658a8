/* "Did you mean ...?": the known name that is nearest to a mistyped one. */
#pragma once

#include <stddef.h>

/* Edits (insert, delete, replace, swap of neighbours) from a to b; 99 for very long words. */
int cs_suggest_distance(const char *a, const char *b);
/* The nearest of `count` names to a word; NULL when none is near. */
const char *cs_suggest_name(const char *word, const char *const *names, size_t count);
