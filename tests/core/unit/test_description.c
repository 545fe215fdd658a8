/* Descriptions of hosts that were built with another header: which sizes are accepted, and what the
 * fields are that they do not have. */
#include <stdlib.h>
#include <string.h>

#include "base/description.h"
#include "tests/support/check.h"

enum { BEYOND = 64 };

#define LIST(type) &cs_##type##_description,
static const cs_description *const all[] = {CS_DESCRIPTIONS(LIST)};
#undef LIST

/* A description of one size, all of it in memory of exactly that size; 0x40 in what it has. */
static celspan_status read_one(celspan_context *context, const cs_description *kind, size_t size,
                               unsigned char beyond, unsigned char *out) {
  size_t room = size < sizeof size ? sizeof size : size;
  unsigned char *given = malloc(room);
  memset(given, 0x40, room);
  if (size > kind->size)
    memset(given + kind->size, beyond, size - kind->size);
  memcpy(given, &size, sizeof size);
  celspan_status status = cs_description_read(context, "noun", kind, given, out);
  free(given);
  return status;
}

/* A description whose byte `at` of `more` beyond the last field is not zero. */
static celspan_status read_beyond(celspan_context *context, const cs_description *kind, size_t more,
                                  size_t at) {
  size_t size = kind->size + more;
  unsigned char *given = calloc(size, 1), *out = malloc(kind->size);
  memcpy(given, &size, sizeof size);
  given[kind->size + at] = 1;
  celspan_status status = cs_description_read(context, "noun", kind, given, out);
  free(given);
  free(out);
  return status;
}

static void check_kind(celspan_context *context, const cs_description *kind) {
  unsigned char *out = malloc(kind->size);
  const unsigned char *defaults = kind->defaults;
  for (size_t size = 0; size < kind->size + BEYOND; size++) {
    bool is_good = size % 8 == 0 && size >= kind->needed;
    celspan_status status = read_one(context, kind, size, 0, out);
    if (!CHECK(status == (is_good ? CELSPAN_OK : CELSPAN_BAD_ARGUMENT)))
      fprintf(stderr, "  %s: %zu\n", kind->type, size);
    if (status != CELSPAN_OK)
      continue;
    size_t whole;
    memcpy(&whole, out, sizeof whole);
    CHECK(whole == kind->size);
    for (size_t i = sizeof whole; i < kind->size; i++)
      CHECK(out[i] == (i < size ? 0x40 : defaults[i]));
  }
  for (size_t more = 8; more <= BEYOND; more += 8)
    for (size_t at = 0; at < more; at++)
      CHECK(read_beyond(context, kind, more, at) == CELSPAN_BAD_ARGUMENT);
  free(out);
}

/* The largest size of all; of a larger one nothing is read. */
static void check_largest(celspan_context *context) {
  static unsigned char given[4096];
  celspan_rect_desc out;
  size_t size = sizeof given;
  memcpy(given, &size, sizeof size);
  CHECK(cs_description_read(context, "noun", &cs_celspan_rect_desc_description, given, &out) ==
        CELSPAN_OK);
  size += sizeof size;
  memcpy(given, &size, sizeof size);
  CHECK(cs_description_read(context, "noun", &cs_celspan_rect_desc_description, given, &out) ==
        CELSPAN_BAD_ARGUMENT);
}

typedef struct mark {
  size_t struct_size;
  const char *name;
  int64_t first, last;
} mark;

/* Results for hosts that know less, or more. */
static void check_results(celspan_context *context) {
  const struct {
    mark mark;
    uint64_t after[2]; /* are not of the result */
  } full = {{.struct_size = sizeof(mark), .name = "a", .first = 3, .last = 4}, {1, 1}};
  struct {
    mark mark;
    uint64_t more[2];
  } room;
  for (size_t size = 0; size <= sizeof room; size++) {
    bool is_good = size >= 8 && size % 8 == 0;
    memset(&room, 0x7f, sizeof room);
    room.mark.struct_size = size;
    celspan_status status = CS_RESULT(context, "noun", mark, &full.mark, &room);
    CHECK(status == (is_good ? CELSPAN_OK : CELSPAN_BAD_ARGUMENT));
    CHECK(room.mark.struct_size == size);
    CHECK((room.mark.first == 3) == (is_good && size >= offsetof(mark, last)));
    CHECK((room.mark.last == 4) == (is_good && size >= sizeof full.mark));
    CHECK((room.more[0] == 0) == (is_good && size >= sizeof full.mark + 8));
    CHECK((room.more[1] == 0) == (is_good && size == sizeof room));
  }
  room.mark.struct_size = (size_t)1 << 40; /* not filled */
  CHECK(CS_RESULT(NULL, "noun", mark, &full.mark, &room) == CELSPAN_BAD_ARGUMENT);
}

static void check_messages(celspan_context *context) {
  celspan_object *object = NULL;
  celspan_rect_desc rect = CELSPAN_RECT_DESC;
  CHECK(celspan_object_create_rect(context, NULL, &object) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(context), "rect: the description is missing");
  rect.struct_size = 0;
  CHECK(celspan_object_create_rect(context, &rect, &object) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(context),
             "rect: struct_size is 0, which no description has: begin with the defaults that "
             "celspan_rect_desc_default sets, or set it to sizeof(celspan_rect_desc), which is 56");
  rect.struct_size = (size_t)1 << 40; /* not read */
  CHECK(celspan_object_create_rect(context, &rect, &object) == CELSPAN_BAD_ARGUMENT);
  rect.struct_size = offsetof(celspan_rect_desc, height);
  CHECK(celspan_object_create_rect(context, &rect, &object) == CELSPAN_BAD_ARGUMENT);
  CHECK(strstr(celspan_context_error(context), "fields are missing that it needs"));
  CHECK(!object);
}

/* A host that was built before rectangles had corners and textures. */
static void check_shorter(celspan_context *context) {
  celspan_object *object = NULL;
  celspan_rect_desc rect = CELSPAN_RECT_DESC;
  celspan_box box;
  rect.width = 3;
  rect.height = 2;
  rect.radius = -1;
  rect.texture = (celspan_texture *)&rect;
  rect.struct_size = offsetof(celspan_rect_desc, radius);
  CHECK(celspan_object_create_rect(context, &rect, &object) == CELSPAN_OK);
  CHECK(celspan_object_bounds(object, &box) && box.width == 3 && box.height == 2);
  celspan_object_unref(object);
}

/* The defaults for a host that knows less, or more. */
static void check_defaults(void) {
  struct {
    celspan_glow_desc glow;
    uint64_t more[2];
  } room;
  memset(&room, 0x7f, sizeof room);
  celspan_glow_desc_default(&room.glow, offsetof(celspan_glow_desc, gain));
  CHECK(room.glow.struct_size == offsetof(celspan_glow_desc, gain) && room.glow.radius == 0);
  CHECK(room.glow.gain != 1);
  celspan_glow_desc_default(&room.glow, sizeof room);
  CHECK(room.glow.struct_size == sizeof room && room.glow.gain == 1 && room.more[1] == 0);
}

int main(void) {
  celspan_context *context = NULL;
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    check_kind(context, all[i]);
  check_largest(context);
  check_results(context);
  check_messages(context);
  check_shorter(context);
  check_defaults();
  celspan_context_destroy(context);
  return check_done();
}
