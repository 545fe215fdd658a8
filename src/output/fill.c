#include "output/fill.h"

#include <stdint.h>
#include <string.h>

typedef uint64_t wide __attribute__((vector_size(CS_FILL_BLOCK)));

/* The first and the last block lie where the run begins and ends, those between on the lines of the
 * cache, which halves their cost; they may overlap. */
static inline __attribute__((always_inline)) void
fill_blocks(unsigned char *out, size_t size, size_t pixel_size, const unsigned char *block) {
  wide pattern;
  memcpy(&pattern, block, sizeof pattern);
  unsigned char *last = out + size - CS_FILL_BLOCK;
  uintptr_t over = (uintptr_t)out % CS_FILL_BLOCK;
  memcpy(out, &pattern, sizeof pattern);
  out += (over & (pixel_size - 1)) == 0 ? CS_FILL_BLOCK - over : CS_FILL_BLOCK;
  for (; out < last; out += CS_FILL_BLOCK)
    memcpy(out, &pattern, sizeof pattern);
  memcpy(last, &pattern, sizeof pattern);
}

static void fill_anywhere(unsigned char *out, size_t size, size_t pixel_size,
                          const unsigned char *block) {
  fill_blocks(out, size, pixel_size, block);
}

#ifdef __x86_64__

__attribute__((target("avx2"))) static void
fill_avx2(unsigned char *out, size_t size, size_t pixel_size, const unsigned char *block) {
  fill_blocks(out, size, pixel_size, block);
}

__attribute__((target("avx512f"))) static void
fill_avx512(unsigned char *out, size_t size, size_t pixel_size, const unsigned char *block) {
  fill_blocks(out, size, pixel_size, block);
}

cs_fill cs_fill_choose(void) {
  return __builtin_cpu_supports("avx512f") ? fill_avx512
         : __builtin_cpu_supports("avx2")  ? fill_avx2
                                           : fill_anywhere;
}

#else

cs_fill cs_fill_choose(void) { return fill_anywhere; }

#endif
