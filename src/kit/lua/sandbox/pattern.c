#include "lua/sandbox/pattern.h"

#include <ctype.h>
#include <lauxlib.h>
#include <string.h>

#include "lua/sandbox/guard.h"

enum {
  DEEPEST = 200, /* nested matches, as in Lua */
  STEPS_A_CHARGE = 4096
};

static void step(cs_match *m, size_t count) {
  m->steps += count;
  if (m->steps >= STEPS_A_CHARGE)
    cs_pattern_end(m);
}

void cs_pattern_end(cs_match *m) {
  size_t steps = m->steps;
  m->steps = 0;
  cs_guard_charge(m->L, steps);
}

/* ---------------------------------------------------------------- one character */

/* The end of a set, after its ']'; `at` is after its '['. */
static const char *end_of_set(const cs_match *m, const char *at) {
  if (at < m->pattern_end && *at == '^')
    at++;
  do { /* a ']' directly after the '[' is a member of the set */
    if (at >= m->pattern_end)
      luaL_error(m->L, "malformed pattern (missing ']')");
    if (*at++ == '%')
      at++;
  } while (at >= m->pattern_end || *at != ']');
  return at + 1;
}

/* The end of the class or set of a single character. */
static const char *end_of_single(const cs_match *m, const char *at) {
  char first = *at++;
  if (first == '%') {
    if (at >= m->pattern_end)
      luaL_error(m->L, "malformed pattern (ends with '%%')");
    return at + 1;
  }
  return first == '[' ? end_of_set(m, at) : at;
}

static int is_zero(int c) { return c == 0; } /* %z of older versions, which Lua still supports */

static bool is_of_class(int c, int class) {
  static const struct class {
    char letter;
    int (*holds)(int c);
  } classes[] = {{'a', isalpha}, {'c', iscntrl},  {'d', isdigit}, {'g', isgraph},
                 {'l', islower}, {'p', ispunct},  {'s', isspace}, {'u', isupper},
                 {'w', isalnum}, {'x', isxdigit}, {'z', is_zero}};
  for (size_t i = 0; i < sizeof classes / sizeof *classes; i++)
    if (tolower(class) == classes[i].letter)
      return (classes[i].holds(c) != 0) != (isupper(class) != 0);
  return class == c;
}

/* at: after the '['; last: its ']'. */
static bool is_in_set(cs_match *m, int c, const char *at, const char *last) {
  bool answer = *at != '^';
  at += !answer;
  step(m, (size_t)(last - at) / 8);
  while (at < last) {
    unsigned char low = (unsigned char)*at;
    if (low == '%') {
      if (is_of_class(c, (unsigned char)at[1]))
        return answer;
      at += 2;
    } else if (at + 2 < last && at[1] == '-') {
      if (low <= c && c <= (unsigned char)at[2])
        return answer;
      at += 3;
    } else {
      if (low == c)
        return answer;
      at++;
    }
  }
  return !answer;
}

/* Whether the character at s matches the class or set from p to its end. */
static bool is_single(cs_match *m, const char *s, const char *p, const char *end) {
  step(m, 1);
  if (s >= m->subject_end)
    return false;
  int c = (unsigned char)*s;
  switch (*p) {
  case '.':
    return true;
  case '%':
    return is_of_class(c, (unsigned char)p[1]);
  case '[':
    return is_in_set(m, c, p + 1, end - 1);
  default:
    return (unsigned char)*p == c;
  }
}

/* ---------------------------------------------------------------- captures */

static const char *match_rest(cs_match *m, const char *s, const char *p);

static const char *open_capture(cs_match *m, const char *s, const char *p, ptrdiff_t length) {
  if (m->count == CS_CAPTURES_MOST)
    luaL_error(m->L, "too many captures");
  m->captures[m->count++] = (cs_capture){s, length};
  const char *end = match_rest(m, s, p);
  m->count -= !end;
  return end;
}

static const char *close_capture(cs_match *m, const char *s, const char *p) {
  int i = m->count - 1;
  while (i >= 0 && m->captures[i].length != CS_CAPTURE_OPEN)
    i--;
  if (i < 0)
    luaL_error(m->L, "invalid pattern capture");
  m->captures[i].length = s - m->captures[i].begin;
  const char *end = match_rest(m, s, p);
  if (!end)
    m->captures[i].length = CS_CAPTURE_OPEN;
  return end;
}

/* Matches the text of an earlier capture again; returns its end. */
static const char *match_again(cs_match *m, const char *s, int digit) {
  int i = digit - '1';
  if (i < 0 || i >= m->count || m->captures[i].length == CS_CAPTURE_OPEN)
    luaL_error(m->L, "invalid capture index %%%d", i + 1);
  ptrdiff_t length = m->captures[i].length;
  if (length == CS_CAPTURE_PLACE)
    return NULL; /* the capture is a position, which has no text */
  step(m, (size_t)length / 8 + 1);
  bool is = m->subject_end - s >= length && memcmp(m->captures[i].begin, s, (size_t)length) == 0;
  return is ? s + length : NULL;
}

/* ---------------------------------------------------------------- pieces */

/* %bxy, p at its x: the end of the balanced text. */
static const char *match_balanced(cs_match *m, const char *s, const char *p) {
  if (m->pattern_end - p < 2)
    luaL_error(m->L, "malformed pattern (missing arguments to '%%b')");
  if (s >= m->subject_end || *s != p[0])
    return NULL;
  int open = 1;
  for (s++; s < m->subject_end; s++) {
    step(m, 1);
    if (*s == p[1] && --open == 0)
      return s + 1;
    if (*s == p[0] && *s != p[1])
      open++;
  }
  return NULL;
}

/* %f[set], p at its '[': whether the set begins between the character before s and s. */
static bool is_frontier(cs_match *m, const char *s, const char *p, const char *end) {
  int before = s == m->subject ? 0 : (unsigned char)s[-1];
  int after = s == m->subject_end ? 0 : (unsigned char)*s;
  return !is_in_set(m, before, p + 1, end - 1) && is_in_set(m, after, p + 1, end - 1);
}

/* Matches as many characters as possible, then fewer. rest: the rest of the pattern. */
static const char *match_most(cs_match *m, const char *s, const char *p, const char *end,
                              const char *rest) {
  ptrdiff_t count = 0;
  while (is_single(m, s + count, p, end))
    count++;
  for (; count >= 0; count--) {
    const char *found = match_rest(m, s + count, rest);
    if (found)
      return found;
  }
  return NULL;
}

/* Matches as few characters as possible, then more. */
static const char *match_least(cs_match *m, const char *s, const char *p, const char *end,
                               const char *rest) {
  for (;; s++) {
    const char *found = match_rest(m, s, rest);
    if (found || !is_single(m, s, p, end))
      return found;
  }
}

/* ---------------------------------------------------------------- the pattern */

typedef enum outcome { FAILED, CONTINUES, FOUND } outcome;

/* Matches an item that begins with '%' and is not a class. Returns CONTINUES, with *s and *p moved,
 * or FAILED. *p is NULL if the item is a class. */
static bool match_escape(cs_match *m, const char **s, const char **p, outcome *out) {
  const char *at = *p + 1;
  if (at >= m->pattern_end)
    return false;
  if (*at == 'b') {
    *s = match_balanced(m, *s, at + 1);
    *p = at + 3;
  } else if (*at == 'f') {
    if (++at >= m->pattern_end || *at != '[')
      luaL_error(m->L, "missing '[' after '%%f' in pattern");
    const char *end = end_of_single(m, at);
    *s = is_frontier(m, *s, at, end) ? *s : NULL;
    *p = end;
  } else if (isdigit((unsigned char)*at)) {
    *s = match_again(m, *s, (unsigned char)*at);
    *p = at + 1;
  } else {
    return false;
  }
  *out = *s ? CONTINUES : FAILED;
  return true;
}

/* Matches one character and its repetitions. FOUND: the rest was matched too, and *s is the end. */
static outcome match_single(cs_match *m, const char **s, const char **p) {
  const char *end = end_of_single(m, *p), *single = *p;
  char how_often = end < m->pattern_end ? *end : '\0';
  *p = end + (how_often == '?');
  if (how_often == '*' || how_often == '-')
    *s = how_often == '*' ? match_most(m, *s, single, end, end + 1)
                          : match_least(m, *s, single, end, end + 1);
  else if (how_often == '+')
    *s = is_single(m, *s, single, end) ? match_most(m, *s + 1, single, end, end + 1) : NULL;
  if (how_often == '*' || how_often == '-' || how_often == '+')
    return *s ? FOUND : FAILED;
  bool is = is_single(m, *s, single, end);
  if (how_often == '?' && is) {
    const char *found = match_rest(m, *s + 1, *p);
    if (found)
      *s = found;
    return found ? FOUND : CONTINUES;
  }
  *s += is;
  return is || how_often == '?' ? CONTINUES : FAILED;
}

static outcome match_piece(cs_match *m, const char **s, const char **p) {
  const char *at = *p;
  outcome out;
  if (*at == '(') {
    bool is_place = at + 1 < m->pattern_end && at[1] == ')';
    *s = is_place ? open_capture(m, *s, at + 2, CS_CAPTURE_PLACE)
                  : open_capture(m, *s, at + 1, CS_CAPTURE_OPEN);
    return *s ? FOUND : FAILED;
  }
  if (*at == ')') {
    *s = close_capture(m, *s, at + 1);
    return *s ? FOUND : FAILED;
  }
  if (*at == '$' && at + 1 == m->pattern_end)
    return *s == m->subject_end ? FOUND : FAILED;
  if (*at == '%' && match_escape(m, s, p, &out))
    return out;
  return match_single(m, s, p);
}

static const char *match_rest(cs_match *m, const char *s, const char *p) {
  if (++m->depth > DEEPEST)
    luaL_error(m->L, "pattern too complex");
  outcome out = CONTINUES;
  while (out == CONTINUES && p < m->pattern_end) {
    step(m, 1);
    out = match_piece(m, &s, &p);
  }
  m->depth--;
  return out == FAILED ? NULL : s;
}

const char *cs_pattern_match(cs_match *m, const char *at, const char *pattern) {
  m->depth = 0;
  m->count = 0;
  return match_rest(m, at, pattern);
}

void cs_pattern_push(cs_match *m, int i, const char *begin, const char *end) {
  if (i >= m->count) {
    if (i > 0)
      luaL_error(m->L, "invalid capture index %%%d", i + 1);
    lua_pushlstring(m->L, begin, (size_t)(end - begin));
    return;
  }
  const cs_capture *capture = &m->captures[i];
  if (capture->length == CS_CAPTURE_OPEN)
    luaL_error(m->L, "unfinished capture");
  if (capture->length == CS_CAPTURE_PLACE)
    lua_pushinteger(m->L, capture->begin - m->subject + 1);
  else
    lua_pushlstring(m->L, capture->begin, (size_t)capture->length);
}

int cs_pattern_push_all(cs_match *m, const char *begin, const char *end) {
  int count = m->count == 0 && begin ? 1 : m->count;
  luaL_checkstack(m->L, count, "too many captures");
  for (int i = 0; i < count; i++)
    cs_pattern_push(m, i, begin, end);
  return count;
}
