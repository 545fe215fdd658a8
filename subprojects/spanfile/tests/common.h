/* What the tests of span files and plane files share: checks, files in memory, memory that is
 * measured, and random numbers. */
#pragma once

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int check_count, check_failures;

static inline bool check(bool holds, const char *file, int line, const char *text) {
  check_count++;
  if (!holds && ++check_failures <= 20)
    fprintf(stderr, "%s:%d: %s\n", file, line, text);
  return holds;
}
#define CHECK(holds) check((holds), __FILE__, __LINE__, #holds)

static inline int check_done(void) {
  if (check_failures)
    printf("%d of %d checks failed\n", check_failures, check_count);
  else
    printf("%d checks passed\n", check_count);
  return check_failures != 0;
}

/* ---------------------------------------------------------------- files in memory */

typedef struct memory_file {
  unsigned char *bytes;
  size_t size, capacity;
} memory_file;

static inline bool memory_write(void *user, const void *bytes, size_t size) {
  memory_file *file = user;
  if (file->size + size > file->capacity) {
    file->capacity = 2 * (file->size + size);
    file->bytes = realloc(file->bytes, file->capacity);
  }
  if (size > 0)
    memcpy(file->bytes + file->size, bytes, size);
  file->size += size;
  return true;
}

static inline bool memory_read(void *user, uint64_t offset, void *bytes, size_t size) {
  const memory_file *file = user;
  if (offset > file->size || size > file->size - offset)
    return false;
  memcpy(bytes, file->bytes + offset, size);
  return true;
}

static inline bool memory_is_same(const memory_file *a, const memory_file *b) {
  return a->size == b->size && memcmp(a->bytes, b->bytes, a->size) == 0;
}

/* A file in a folder; first: a byte before its bytes, or -1. */
static inline void put_file(const char *folder, const char *name, int first, const void *bytes,
                            size_t size) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *file = fopen(path, "wb");
  if (!CHECK(file != NULL))
    return;
  if (first >= 0)
    fputc(first, file);
  CHECK(fwrite(bytes, 1, size, file) == size);
  CHECK(fclose(file) == 0);
}

static inline void put_numbered(const char *folder, int number, const char *ending, int first,
                                const void *bytes, size_t size) {
  char name[64];
  snprintf(name, sizeof name, "%d%s", number, ending);
  put_file(folder, name, first, bytes, size);
}

/* ---------------------------------------------------------------- measured memory */

typedef struct meter {
  size_t bytes, peak, least; /* in use: now, at the most, and at the least */
  size_t given;              /* by all calls together */
  int fail_at;               /* the call that fails, from 1; 0: none */
} meter;

static inline void *metered(void *user, void *block, size_t old_size, size_t new_size) {
  meter *m = user;
  if (new_size > 0 && m->fail_at > 0 && --m->fail_at == 0)
    return NULL;
  m->given += new_size;
  m->bytes += new_size - old_size;
  m->peak = m->bytes > m->peak ? m->bytes : m->peak;
  m->least = m->bytes < m->least ? m->bytes : m->least;
  if (new_size > 0)
    return realloc(block, new_size);
  free(block);
  return NULL;
}

/* Writes nothing, and fails after as many bytes as *user says. */
static inline bool failing_write(void *user, const void *bytes, size_t size) {
  size_t *left = user;
  (void)bytes;
  bool fits = size <= *left;
  *left -= fits ? size : 0;
  return fits;
}

/* ---------------------------------------------------------------- random numbers */

typedef struct random_state {
  uint64_t state;
} random_state;

static inline uint32_t random_next(random_state *random) { /* splitmix64 */
  uint64_t z = random->state += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return (uint32_t)((z ^ z >> 31) >> 16);
}
static inline uint32_t random_below(random_state *random, uint32_t limit) {
  return (uint32_t)((uint64_t)random_next(random) * limit >> 32);
}
