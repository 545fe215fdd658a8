#include "program/runs.h"

#include <string.h>

/* The shortest runs: shorter ones cost more time than they save bytes. */
enum { LEAST = 4 };

/* At how many of `most` places a and b are equal, from the first on. */
static size_t equal(const uint32_t *a, const uint32_t *b, size_t most) {
  size_t count = 0;
  for (uint64_t x, y; count + 2 <= most; count += 2) {
    memcpy(&x, a + count, sizeof x);
    memcpy(&y, b + count, sizeof y);
    if (x != y)
      break;
  }
  while (count < most && a[count] == b[count])
    count++;
  return count;
}

static uint32_t head(uint32_t kind, size_t count) { return kind << 30 | (uint32_t)count; }

/* Puts the pixels [from, to) unchanged. Returns the words used. */
static size_t put_literals(const uint32_t *pixels, size_t from, size_t to, uint32_t *out) {
  if (from == to)
    return 0;
  out[0] = head(CS_RUNS_LITERAL, to - from);
  memcpy(out + 1, pixels + from, (to - from) * sizeof *out);
  return to - from + 1;
}

size_t cs_runs_pack(const uint32_t *pixels, size_t count, size_t width, uint32_t *out) {
  size_t used = 0, literal = 0; /* the pixels [literal, at) have not been put */
  for (size_t at = 0; at < count;) {
    size_t above = at >= width ? equal(pixels + at, pixels + at - width, count - at) : 0;
    size_t fill = above < LEAST ? equal(pixels + at + 1, pixels + at, count - at - 1) + 1 : 0;
    size_t run = above > fill ? above : fill;
    if (run < LEAST) {
      at++;
      continue;
    }
    used += put_literals(pixels, literal, at, out + used);
    out[used++] = head(run == above ? CS_RUNS_ABOVE : CS_RUNS_FILL, run);
    if (run != above)
      out[used++] = pixels[at];
    literal = at += run;
  }
  return used + put_literals(pixels, literal, count, out + used);
}
