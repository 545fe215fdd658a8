/* Type without memory: whichever allocation fails, also one of the libraries for type, text is
 * refused, and the same context then makes it as usual. This program's malloc serves all its
 * libraries.
 */
#include <errno.h>
#include <stdatomic.h>
#include <stdio.h>
#include <unistd.h>

#include "celspan/celspan.h"
#include "celspan/text.h"
#include "tests/support/check.h"

#define OWN TEST_ROOT "/scripts/type/block.ttf"
#define DEJAVU "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"

/* The allocator behind this one; no header declares it. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);

static atomic_long left; /* allocations until one fails; 0: none does */

static bool fails(void) {
  if (left == 0 || --left > 0)
    return false;
  errno = ENOMEM;
  return true;
}

void *malloc(size_t size) { return fails() ? NULL : __libc_malloc(size); }

void *calloc(size_t count, size_t size) { return fails() ? NULL : __libc_calloc(count, size); }

void *realloc(void *block, size_t size) {
  return size > 0 && fails() ? NULL : __libc_realloc(block, size);
}

/* ---------------------------------------------------------------- text */

typedef struct written {
  celspan_status status;
  uint64_t drawing[2];
} written;

static written write_text(celspan_context *context, const char *path) {
  written out = {.status = CELSPAN_OK};
  uint64_t placement[2];
  const char *const font = path;
  celspan_text_desc desc = CELSPAN_TEXT_DESC;
  celspan_object *object = NULL;
  desc.text = "HAVE AT IT";
  desc.text_size = strlen(desc.text);
  desc.fonts = &font;
  desc.font_count = 1;
  out.status = celspan_object_create_text(context, &desc, &object);
  if (out.status == CELSPAN_OK)
    CHECK(celspan_object_hash(object, out.drawing, placement));
  celspan_object_unref(object);
  return out;
}

static bool is_same(written a, written b) {
  return a.status == b.status && memcmp(a.drawing, b.drawing, sizeof a.drawing) == 0;
}

static celspan_context *new_context(void) {
  celspan_context *context = NULL;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  return context;
}

/* Each try uses a fresh font. Returns whether an allocation failed. */
static bool try_allocation(long number, const char *path, written right) {
  celspan_context *context = new_context();
  left = number;
  written starved = write_text(context, path);
  bool has_failed = left == 0;
  left = 0;
  if (!CHECK(starved.status == CELSPAN_NO_MEMORY || is_same(starved, right)) ||
      !CHECK(is_same(write_text(context, path), right)))
    fprintf(stderr, "  allocation %ld: %d, %s\n", number, (int)starved.status,
            celspan_context_error(context));
  celspan_context_destroy(context);
  return has_failed;
}

static void test_font(const char *path) {
  if (access(path, R_OK) != 0) {
    check_skip(path);
    return;
  }
  celspan_context *context = new_context(); /* the module stays in the process */
  written right = write_text(context, path);
  celspan_context_destroy(context);
  CHECK(right.status == CELSPAN_OK);
  long number = 1;
  while (try_allocation(number, path, right))
    number++;
  CHECK(number > 50);
}

int main(void) {
  test_font(OWN);
  test_font(DEJAVU);
  return check_done();
}
