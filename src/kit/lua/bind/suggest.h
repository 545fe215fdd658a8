/* "Did you mean ...?": the known name that is nearest to a mistyped one, and other spellings of
 * celspan's own words.
 *
 *   center, color, gray     centre, colour, grey, also inside a longer word: colors
 *   fill                    the field texture, which pages call fill
 *
 * INVARIANT: values keep celspan's spelling of their fields, so that nothing else knows the others.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* Edits (insert, delete, replace, swap of neighbours) from a to b; 99 for very long words. */
int cs_suggest_distance(const char *a, const char *b);
/* The nearest of `count` names to a word; NULL when none is near. */
const char *cs_suggest_name(const char *word, const char *const *names, size_t count);

#define CS_SUGGEST_SIZE 64

/* celspan's spelling of a word, which may be written to `out`; NULL: it has no other one. is_field:
 * it is the name of a field. */
const char *cs_suggest_own(const char *word, bool is_field, char out[CS_SUGGEST_SIZE]);
/* The name by which pages call a field. */
const char *cs_suggest_shown(const char *field);
