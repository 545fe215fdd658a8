#include "bind/suggest.h"

#include <stdbool.h>
#include <string.h>

#define LONGEST 32

static int least(int a, int b, int c) {
  int m = a < b ? a : b;
  return m < c ? m : c;
}

/* Edits (insert, delete, replace, swap of neighbours) from a to b; 99 for very long words. */
static int distance(const char *a, const char *b) {
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

const char *cs_suggest_name(const char *word, const char *const *names, size_t count) {
  const char *best = NULL;
  int best_distance = (int)strlen(word) <= 4 ? 2 : 3; /* one slip in a short word, two in a long */
  for (size_t i = 0; i < count; i++) {
    int d = distance(word, names[i]);
    if (d < best_distance) {
      best = names[i];
      best_distance = d;
    }
  }
  return best;
}
