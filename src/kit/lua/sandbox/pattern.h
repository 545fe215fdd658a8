/* Matching of Lua patterns, with counted steps.
 *
 * The patterns are as in the manual of Lua 5.4, section 6.4.1. For some subjects Lua's matcher
 * takes time exponential in the length of the pattern, and cannot be stopped; here every comparison
 * of a character is a step of the guard.
 *
 *   pattern  ( % a + )  =  ( . - ) $       subject  k e y = v a l u e
 *              `------- single characters and their repetitions are matched one after the other,
 *                       with backtracking when the rest does not match
 */
#pragma once

#include <lua.h>
#include <stdbool.h>
#include <stddef.h>

enum { CS_CAPTURES_MOST = 32 };

typedef struct cs_capture {
  const char *begin;
  ptrdiff_t length; /* the length, or one of the two constants below */
} cs_capture;

enum { CS_CAPTURE_OPEN = -1, CS_CAPTURE_PLACE = -2 };

typedef struct cs_match {
  lua_State *L;
  const char *subject, *subject_end;
  const char *pattern_end;
  size_t steps; /* steps that are not charged yet */
  int depth;
  int count; /* the count of captures */
  cs_capture captures[CS_CAPTURES_MOST];
} cs_match;

/* The end of the match that begins at `at`, or NULL. Raises an error for invalid patterns, and when
 * a limit is exceeded. */
const char *cs_pattern_match(cs_match *match, const char *at, const char *pattern);
/* Charges the remaining steps. */
void cs_pattern_end(cs_match *match);
/* Pushes capture i, counted from 0. If there are no captures, capture 0 is the whole match. */
void cs_pattern_push(cs_match *match, int i, const char *begin, const char *end);
/* Pushes all captures, or the whole match if there are none, and returns their number. begin NULL:
 * never the whole match. */
int cs_pattern_push_all(cs_match *match, const char *begin, const char *end);
