#include "readers/text/runs.h"

/* Limits the time for shaping, which grows with the square of the number of marks of one letter. */
#define LONGEST 4096

/* The end of the run that begins at `begin`. */
static size_t run_end(const cs_run_characters *text, size_t begin, size_t end) {
  size_t at = begin + 1, most = end - begin < LONGEST ? end : begin + LONGEST;
  while (at < most && text->embeddings[at] == text->embeddings[begin] &&
         text->scripts[at] == text->scripts[begin])
    at++;
  if (at < most || at == end)
    return at;
  while (at > begin && text->characters[at - 1] != ' ')
    at--;
  return at > begin ? at : most;
}

size_t cs_runs_find(const cs_run_characters *text, size_t begin, size_t end, cs_text_run *runs) {
  size_t count = 0;
  for (size_t at = begin, next; at < end; at = next, count++) {
    next = run_end(text, at, end);
    if (runs)
      runs[count] = (cs_text_run){at, next, text->embeddings[at]};
  }
  return count;
}

static void reverse(cs_text_run *runs, size_t begin, size_t end) {
  for (; begin + 1 < end; begin++, end--) {
    cs_text_run other = runs[begin];
    runs[begin] = runs[end - 1];
    runs[end - 1] = other;
  }
}

/* Rule L2 of the bidirectional algorithm (Unicode Standard Annex 9): from the highest embedding to
 * the lowest odd one, every sequence of runs at this embedding or above is reversed. */
void cs_runs_reorder(cs_text_run *runs, size_t count) {
  unsigned highest = 0;
  for (size_t i = 0; i < count; i++)
    highest = runs[i].embedding > highest ? runs[i].embedding : highest;
  for (unsigned embedding = highest; embedding >= 1; embedding--)
    for (size_t i = 0; i < count; i++) {
      size_t begin = i;
      while (i < count && runs[i].embedding >= embedding)
        i++;
      reverse(runs, begin, i);
    }
}
