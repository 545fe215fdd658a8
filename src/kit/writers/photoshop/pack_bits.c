/* PackBits. */
#include "writers/photoshop/bytes.h"

#include <stdbool.h>
#include <string.h>

/* The most bytes of a run or of single bytes, and the shortest run that is worth its two bytes
 * between single ones. */
enum { MOST = 128, RUN = 3 };

static size_t run_at(const unsigned char *row, size_t left) {
  size_t most = left < MOST ? left : MOST, count = 1;
  while (count < most && row[count] == row[0])
    count++;
  return count;
}

/* How many bytes come before the next run. */
static size_t single_at(const unsigned char *row, size_t left) {
  size_t most = left < MOST ? left : MOST, count = 1;
  while (count < most && run_at(row + count, left - count < RUN ? left - count : RUN) < RUN)
    count++;
  return count;
}

size_t cs_pack_bits(const unsigned char *row, size_t size, unsigned char *out) {
  unsigned char *end = out;
  for (size_t x = 0; x < size;) {
    size_t run = run_at(row + x, size - x);
    bool is_run = run >= RUN;
    size_t count = is_run ? run : single_at(row + x, size - x), stored = is_run ? 1 : count;
    *end++ = (unsigned char)(is_run ? 2 * MOST + 1 - count : count - 1);
    memcpy(end, row + x, stored);
    end += stored;
    x += count;
  }
  return (size_t)(end - out);
}
