#include "lua/bind/suggest.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#define LONGEST 32

static int least(int a, int b, int c) {
  int m = a < b ? a : b;
  return m < c ? m : c;
}

int cs_suggest_distance(const char *a, const char *b) {
  size_t m = strlen(a), n = strlen(b);
  if (m > LONGEST || n > LONGEST)
    return 99;
  int d[LONGEST + 1][LONGEST + 1];
  for (size_t i = 0; i <= m; i++)
    d[i][0] = (int)i;
  for (size_t j = 0; j <= n; j++)
    d[0][j] = (int)j;
  for (size_t i = 1; i <= m; i++)
    for (size_t j = 1; j <= n; j++) {
      d[i][j] = least(d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1]));
      bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swap && d[i - 2][j - 2] + 1 < d[i][j])
        d[i][j] = d[i - 2][j - 2] + 1;
    }
  return d[m][n];
}

/* Words of other programs, each with celspan's word, for words that are too different to be found
 * by comparing letters. */
static const char *const others[][2] = {
    {"color", "fill"},       {"colour", "fill"},
    {"paint", "fill"},       {"r", "radius"},
    {"width", "w"},          {"height", "h"},
    {"path", "file"},        {"filename", "file"},
    {"name", "file"},        {"src", "file"},
    {"alpha", "opacity"},    {"alpha", "fade"},
    {"opacity", "fade"},     {"squash", "scale"},
    {"grow", "scale"},       {"flip", "scale"},
    {"spin", "rotate"},      {"turn", "rotate"},
    {"position", "move_to"}, {"anchor", "pivot"},
    {"new", "init"},         {"preview", "watch"},
    {"view", "watch"},       {"export", "render"},
    {"blur", "defocus"},     {"angle", "rotate"},
    {"rotation", "rotate"},  {"background", "back"},
    {"light", "front"},      {"interpolation", "sampling"},
    {"filter", "antialias"}, {"fillrule", "rule"},
    {"fill_rule", "rule"},   {"move", "translate"},
    {"middle", "centre"},    {"linear", "bilinear"},
    {"cubic", "bicubic"},    {"gauss", "gaussian"},
    {"length", "duration"},  {"count", "frames"},
    {"threads", "workers"},  {"plus", "add"},
    {"horizontal", "lie"},   {"labels", "values"},
    {"max", "most"},         {"unit", "format"},
    {"column", "bar"},       {"seconds", "duration"},
    {"draw", "frame"},       {"lerp", "mix"},
    {"line", "stroke"},      {"parallax", "multiplane"},
};

static const char *find(const char *name, const char *const *names, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (strcmp(names[i], name) == 0)
      return names[i];
  return NULL;
}

/* The known name for another program's word. */
static const char *find_other(const char *word, const char *const *names, size_t count) {
  const char *found = NULL;
  for (size_t i = 0; !found && i < sizeof others / sizeof *others; i++)
    if (strcmp(others[i][0], word) == 0)
      found = find(others[i][1], names, count);
  return found;
}

const char *cs_suggest_name(const char *word, const char *const *names, size_t count) {
  const char *other = find_other(word, names, count);
  if (other)
    return other;
  for (size_t i = 0; i < count; i++)
    if (strcasecmp(word, names[i]) == 0)
      return names[i];
  const char *best = NULL;
  /* one mistake in a short word, two in a longer one */
  int best_distance = (int)strlen(word) <= 4 ? 2 : 3;
  for (size_t i = 0; i < count; i++) {
    int d = cs_suggest_distance(word, names[i]);
    if (d < best_distance) {
      best = names[i];
      best_distance = d;
    }
  }
  return best;
}

/* ---------------------------------------------------------------- other spellings */

/* Spellings, which may be parts of a word; the last one is of a whole name of a field. */
static const char *const spellings[][2] = {
    {"center", "centre"}, {"color", "colour"}, {"gray", "grey"}, {"fill", "texture"}};
enum { FIELD = sizeof spellings / sizeof *spellings - 1 };

const char *cs_suggest_own(const char *word, bool is_field, char out[CS_SUGGEST_SIZE]) {
  const char *found = word;
  if (is_field && strcmp(word, spellings[FIELD][0]) == 0)
    return spellings[FIELD][1];
  for (int i = 0; i < FIELD; i++) {
    const char *other = spellings[i][0], *own = spellings[i][1], *at = strstr(found, other);
    if (!at || strlen(word) + strlen(own) >= CS_SUGGEST_SIZE)
      continue;
    const size_t before = (size_t)(at - found), old = strlen(other), new = strlen(own);
    if (found == word)
      snprintf(out, CS_SUGGEST_SIZE, "%s", word);
    memmove(out + before + new, out + before + old, strlen(out + before + old) + 1);
    memcpy(out + before, own, new);
    found = out;
  }
  return found == word ? NULL : found;
}

const char *cs_suggest_shown(const char *field) {
  return strcmp(field, spellings[FIELD][1]) == 0 ? spellings[FIELD][0] : field;
}
