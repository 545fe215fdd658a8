/* Any bytes as a layered painting: no fault, no memory beyond a bound, no leak, and every refusal
 * with a sentence. One target for each format, chosen by FUZZ_KIND:
 *
 *   zip, psd   the bytes are the file
 *   ora, kra   the file is an archive made around them: the first two bytes are the size of
 *              stack.xml (maindoc.xml); then comes the picture "a.png" (the tiles "f/layers/a")
 */
#include "tests/fuzz/target.h"

#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

#include "celspan/layers.h"

#include "model/pictures/surface.h"
#include "tests/fuzz/meter.h"

#define ZIP 1
#define PSD 2
#define ORA 3
#define KRA 4

#define MOST_BYTES ((size_t)256 << 20)
#define MOST_PIXELS ((int64_t)1 << 18)

/* ---------------------------------------------------------------- the file */

static int descriptor = -1;
static size_t written;

static void put(const void *bytes, size_t size) {
  demand(write(descriptor, bytes, size) == (ssize_t)size, "the file cannot be written");
  written += size;
}

#if FUZZ_KIND == ORA || FUZZ_KIND == KRA
static void put_number(uint32_t number, size_t bytes) { put(&number, bytes); }

typedef struct member {
  const char *name;
  const uint8_t *bytes;
  size_t size, at;
} member;

static void put_facts(const member *m) {
  put_number(0, 4); /* flags, method: stored */
  put_number(0, 4);
  put_number((uint32_t)crc32_z(0, m->bytes, m->size), 4);
  put_number((uint32_t)m->size, 4);
  put_number((uint32_t)m->size, 4);
  put_number((uint32_t)strlen(m->name), 2);
}

static void put_archive(member *members, size_t count) {
  for (size_t i = 0; i < count; i++) {
    members[i].at = written;
    put("PK\3\4\24", 6);
    put_facts(&members[i]);
    put_number(0, 2);
    put(members[i].name, strlen(members[i].name));
    put(members[i].bytes, members[i].size);
  }
  size_t table = written;
  for (size_t i = 0; i < count; i++) {
    put("PK\1\2\24\0\24", 8);
    put_facts(&members[i]);
    for (int k = 0; k < 6; k++)
      put_number(0, 2);
    put_number((uint32_t)members[i].at, 4);
    put(members[i].name, strlen(members[i].name));
  }
  size_t end = written;
  put("PK\5\6\0\0\0", 8);
  put_number((uint32_t)count, 2);
  put_number((uint32_t)count, 2);
  put_number((uint32_t)(end - table), 4);
  put_number((uint32_t)table, 4);
  put_number(0, 2);
}

static void put_file(const uint8_t *data, size_t size) {
  size_t told = size >= 2 ? (size_t)data[0] | (size_t)data[1] << 8 : 0;
  const uint8_t *bytes = data + (size >= 2 ? 2 : 0);
  size_t left = size >= 2 ? size - 2 : 0, document = told < left ? told : left;
  member members[] = {
      {FUZZ_KIND == ORA ? "stack.xml" : "maindoc.xml", bytes, document, 0},
      {FUZZ_KIND == ORA ? "a.png" : "f/layers/a", bytes + document, left - document, 0},
      {"f/layers/a.defaultpixel", (const uint8_t *)"\1\2\3\377", 4, 0}};
  put_archive(members, FUZZ_KIND == ORA ? 2 : 3);
}
#else
static void put_file(const uint8_t *data, size_t size) { put(data, size); }
#endif

/* ---------------------------------------------------------------- tries */

static size_t fail_at;     /* the allocation of this number fails; 0: none */
static size_t allocations; /* of the latest run */

static bool is_expected(celspan_status status) {
  return status == CELSPAN_INPUT || status == CELSPAN_LIMIT ||
         (status == CELSPAN_NO_MEMORY && fail_at > 0);
}

/* Reads like the store of pictures: strips from top to bottom, and one of them once more. */
static void read_pixels(celspan_context *context, const celspan_painting_layer *layer) {
  int32_t strip = layer->height < 64 ? layer->height : 64;
  if ((int64_t)layer->width * layer->height > MOST_PIXELS || (int64_t)layer->width * strip > 65536)
    return;
  float *rgba = malloc((size_t)layer->width * (size_t)strip * 4 * sizeof *rgba);
  celspan_status status = CELSPAN_OK;
  for (int32_t y = 0; y + strip <= layer->height && status == CELSPAN_OK; y += strip) {
    const celspan_rectangle rectangle = {0, y, layer->width, strip};
    status = cs_surface_read(context, layer->surface, &rectangle, rgba);
  }
  const celspan_rectangle first = {layer->width / 2, 0, 1, 1};
  if (status == CELSPAN_OK)
    status = cs_surface_read(context, layer->surface, &first, rgba);
  demand(status == CELSPAN_OK || celspan_context_error(context)[0], "a failure has no sentence");
  demand(status == CELSPAN_OK || is_expected(status), "a failure of another kind");
  free(rgba);
}

/* Begins in a context that is destroyed before reading the pixels continues. */
static void read_in_two_contexts(celspan_context *context, const celspan_painting_layer *layer) {
  celspan_context *other = NULL;
  float rgba[4];
  const celspan_rectangle first = {0, 0, 1, 1}, last = {0, layer->height - 1, 1, 1};
  if (layer->height > 1024 || layer->width > 1024)
    return;
  demand(celspan_context_create(NULL, &other) == CELSPAN_OK, "no other context");
  celspan_status status = cs_surface_read(other, layer->surface, &first, rgba);
  celspan_context_destroy(other);
  if (status == CELSPAN_OK)
    status = cs_surface_read(context, layer->surface, &last, rgba);
  demand(status == CELSPAN_OK || is_expected(status), "a failure of another kind");
}

static void check_layers(celspan_context *context, const celspan_painting *painting) {
  size_t count = celspan_painting_layer_count(painting), at;
  celspan_painting_layer layer = CELSPAN_PAINTING_LAYER;
  for (size_t i = 0; celspan_painting_layer_at(painting, i, &layer); i++) {
    demand(layer.parent > i && layer.parent <= count, "a group comes before its layers");
    demand(layer.opacity >= 0 && layer.opacity <= 1, "an opacity beyond 0 to 1");
    demand(!layer.surface || !layer.is_group, "a group has pixels");
    if (layer.surface && i < 16) {
      read_pixels(context, &layer);
      read_in_two_contexts(context, &layer);
    }
  }
  for (size_t i = 0; celspan_painting_note_at(painting, i, &at); i++)
    demand(at <= count, "a note on no layer");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  char path[64];
  if (descriptor < 0)
    descriptor = memfd_create("painting", 0);
  demand(descriptor >= 0 && ftruncate(descriptor, 0) == 0 && lseek(descriptor, 0, SEEK_SET) == 0,
         "the file cannot be made");
  written = 0;
  put_file(data, size);
  snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
  meter m = {{.fail_at = fail_at}, 0, SIZE_MAX};
  celspan_context *context = meter_context(&m);
  if (context) {
    celspan_painting *painting = NULL;
    celspan_status status = celspan_painting_read(context, path, &painting);
    if (status == CELSPAN_OK)
      check_layers(context, painting);
    else
      demand(is_expected(status), "a refusal of another kind");
    if (status == CELSPAN_INPUT || status == CELSPAN_LIMIT)
      demand(strncmp(celspan_context_error(context), path, strlen(path)) == 0,
             "a refusal without the file's name");
    celspan_painting_unref(painting);
    celspan_context_destroy(context);
  }
  allocations = m.watch.allocations;
  meter_close(&m);
  demand(m.peak <= MOST_BYTES, "memory that nothing pays for");
  return 0;
}

#ifdef REPLAY_MAIN
#define REPLAY_FAILURES
#include "tests/fuzz/replay.h"
#endif
