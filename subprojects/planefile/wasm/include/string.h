/* For modules: see ../libc.c. The module's own instructions copy and fill memory, but where the
 * size is known and small a few registers are faster: engines call a function for these.
 */
#pragma once
#include <stddef.h>

enum { REGISTER = 16 /* bytes */, FEW = 4 /* registers */ };
typedef long long wasm_register __attribute__((vector_size(REGISTER), aligned(1), may_alias));

#define IS_FEW(size)                                                                               \
  (__builtin_constant_p(size) && (size) % REGISTER == 0 && (size) <= FEW * REGISTER)
#define UNROLLED_FEW(i, size)                                                                      \
  _Pragma("clang loop unroll(full)") for (size_t i = 0; i < FEW; i++) if (i < (size) / REGISTER)

static inline void *wasm_copy(void *out, const void *in, size_t size) {
  wasm_register *to = out;
  const wasm_register *from = in;
  UNROLLED_FEW(i, size)
  to[i] = from[i];
  return out;
}

static inline void *wasm_clear(void *out, size_t size) {
  wasm_register *to = out;
  UNROLLED_FEW(i, size)
  to[i] = (wasm_register){0};
  return out;
}

#define memcpy(out, in, size)                                                                      \
  (IS_FEW(size) ? wasm_copy(out, in, size) : __builtin_memcpy(out, in, size))
#define memset(out, byte, size)                                                                    \
  (IS_FEW(size) && __builtin_constant_p(byte) && (byte) == 0 ? wasm_clear(out, size)               \
                                                             : __builtin_memset(out, byte, size))
int memcmp(const void *first, const void *second, size_t size);
size_t strlen(const char *text); /* only what writes calls it, which no module has */
