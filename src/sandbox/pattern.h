/* Lua's patterns, matched in steps that are counted.
 *
 * The language is that of the manual of Lua 5.4, section 6.4.1. The library's own matcher takes time
 * exponential in the pattern for some subjects, and nothing can stop it; here every comparison of a
 * single character is a step of the guard.
 *
 *   pattern  ( % a + )  =  ( . - ) $       subject  k e y = v a l u e
 *              `------- what one character must be, and how often: matched one after the other,
 *                       going back when the rest does not match
 */
#ifndef CS_SANDBOX_PATTERN_H
#define CS_SANDBOX_PATTERN_H

#include <lua.h>
#include <stdbool.h>
#include <stddef.h>

enum { CS_CAPTURES_MOST = 32 };

typedef struct cs_capture {
  const char *begin;
  ptrdiff_t length; /* or one of the two below */
} cs_capture;

enum { CS_CAPTURE_OPEN = -1, CS_CAPTURE_PLACE = -2 };

typedef struct cs_match {
  lua_State *L;
  const char *subject, *subject_end;
  const char *pattern_end;
  size_t steps; /* not charged yet */
  int depth;
  int count; /* of captures */
  cs_capture captures[CS_CAPTURES_MOST];
} cs_match;

/* The end of the match that begins at `at`, NULL: there is none. Raises for patterns that are none,
 * and when a limit is hit. */
const char *cs_pattern_match(cs_match *match, const char *at, const char *pattern);
/* Charges what is left. */
void cs_pattern_end(cs_match *match);
/* Pushes capture i from 0; the whole match for 0 when there are no captures. */
void cs_pattern_push(cs_match *match, int i, const char *begin, const char *end);
/* Pushes all captures, or the whole match if there are none; how many. begin NULL: no whole match.
 */
int cs_pattern_push_all(cs_match *match, const char *begin, const char *end);

#endif
