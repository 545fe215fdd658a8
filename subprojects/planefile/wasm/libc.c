/* What the decoder uses of the C library, for a module that has none: memory in blocks of powers of
 * two, and texts with %s and PRIu32.
 */
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PAGE = 65536, SMALLEST = 4, CLASSES = 32 };

void *cs_wasm_resize(void *user, void *block, size_t old_size, size_t new_size);
extern unsigned char __heap_base;

typedef struct free_block {
  struct free_block *next;
} free_block;

static free_block *free_blocks[CLASSES]; /* of 2^class bytes */
static uintptr_t top;                    /* from here on nothing has been handed out */

static unsigned class_of(size_t size) {
  unsigned class = SMALLEST;
  while ((size_t)1 << class < size)
    class ++;
  return class;
}

static void *take_new(size_t size) {
  uintptr_t start = top ? top : ((uintptr_t)&__heap_base + 15) & ~(uintptr_t)15;
  uintptr_t room = (uintptr_t)__builtin_wasm_memory_size(0) * PAGE;
  if (size > UINTPTR_MAX - PAGE - start)
    return NULL;
  if (start + size > room &&
      __builtin_wasm_memory_grow(0, (start + size - room + PAGE - 1) / PAGE) == SIZE_MAX)
    return NULL;
  top = start + size;
  return (void *)start;
}

static void *take(size_t size) {
  if (size > SIZE_MAX / 4)
    return NULL;
  unsigned class = class_of(size);
  free_block *block = free_blocks[class];
  if (!block)
    return take_new((size_t)1 << class);
  free_blocks[class] = block->next;
  return block;
}

static void give(void *block, size_t size) {
  unsigned class = class_of(size);
  free_block *freed = block;
  freed->next = free_blocks[class];
  free_blocks[class] = freed;
}

void *cs_wasm_resize(void *user, void *block, size_t old_size, size_t new_size) {
  (void)user;
  if (block && new_size > 0 && class_of(old_size) == class_of(new_size))
    return block;
  void *fresh = new_size > 0 ? take(new_size) : NULL;
  if (block && fresh)
    memcpy(fresh, block, old_size < new_size ? old_size : new_size);
  if (block && (fresh || new_size == 0))
    give(block, old_size);
  return fresh;
}

/* The default of the library, which is never used here. */
void *realloc(void *block, size_t size) {
  (void)block, (void)size;
  return NULL;
}
void free(void *block) { (void)block; }

int memcmp(const void *first, const void *second, size_t size) {
  const unsigned char *a = first, *b = second;
  size_t i = 0;
  while (i < size && a[i] == b[i])
    i++;
  return i < size ? a[i] - b[i] : 0;
}

/* ---------------------------------------------------------------- texts */

typedef struct text {
  char *at;
  size_t left; /* with its zero */
} text;

static void put(text *out, char letter) {
  if (out->left > 1) {
    *out->at++ = letter;
    out->left--;
  }
}

static void put_number(text *out, uint32_t number) {
  if (number > 9)
    put_number(out, number / 10);
  put(out, (char)('0' + number % 10));
}

/* format: of %s and %u. */
int vsnprintf(char *at, size_t size, const char *format, va_list arguments) {
  text out = {at, size};
  for (; *format; format++) {
    if (*format != '%') {
      put(&out, *format);
    } else if (*++format == 'u') {
      put_number(&out, va_arg(arguments, uint32_t));
    } else {
      for (const char *word = va_arg(arguments, const char *); *word; word++)
        put(&out, *word);
    }
  }
  *out.at = 0;
  return (int)(out.at - at);
}

int snprintf(char *at, size_t size, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  int count = vsnprintf(at, size, format, arguments);
  va_end(arguments);
  return count;
}
