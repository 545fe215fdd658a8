/* Reading a drawing: the file, and the drawings that are kept from frame to frame. */
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "inside/description.h"
#include "inside/files.h"
#include "inside/hash.h"
#include "inside/number.h"
#include "inside/scene.h"
#include "inside/sort.h"
#include "readers/svg/document/art.h"
#include "readers/svg/draw/boxes.h"
#include "readers/svg/motion/motion.h"
#include "readers/svg/read.h"

CS_DESCRIBE(celspan_svg_desc, struct_size, .space = CELSPAN_SPACE_SRGB)

#define FILE_BYTES ((size_t)256 << 20)
#define KEPT 64  /* drawings */
#define FONTS 64 /* the most fonts of one drawing */

/* ---------------------------------------------------------------- kept drawings */

/* A file counts as the same if it has the same name, size, time and number. */
typedef struct stored {
  cs_hash key;
  celspan_svg *art; /* NULL: an empty place */
  uint64_t used;    /* when it was last asked for */
} stored;

typedef struct drawing_store {
  cs_service service;
  cs_memory *memory;
  pthread_mutex_t lock;
  stored items[KEPT];
  uint64_t clock;
} drawing_store;

static celspan_status create_store(celspan_context *context, cs_service **out) {
  drawing_store *store;
  CS_TRY(CS_MAKE(context, store, 1));
  store->memory = context->memory;
  pthread_mutex_init(&store->lock, NULL);
  *out = &store->service;
  return CELSPAN_OK;
}

static void trim_store(cs_service *service) {
  drawing_store *store = (drawing_store *)service;
  pthread_mutex_lock(&store->lock);
  for (size_t i = 0; i < KEPT; i++) {
    celspan_svg_unref(store->items[i].art);
    store->items[i] = (stored){.art = NULL};
  }
  pthread_mutex_unlock(&store->lock);
}

static void destroy_store(cs_service *service) {
  drawing_store *store = (drawing_store *)service;
  trim_store(service);
  pthread_mutex_destroy(&store->lock);
  cs_mem_free(store->memory, store, sizeof *store);
}

static const cs_service_kind store_kind = {create_store, destroy_store, trim_store};

/* A reference to the drawing of this key, or NULL. */
static celspan_svg *find_stored(drawing_store *store, cs_hash key) {
  celspan_svg *found = NULL;
  pthread_mutex_lock(&store->lock);
  for (size_t i = 0; i < KEPT && !found; i++) {
    stored *item = &store->items[i];
    if (item->art && item->key.a == key.a && item->key.b == key.b) {
      item->used = ++store->clock;
      found = celspan_svg_ref(item->art);
    }
  }
  pthread_mutex_unlock(&store->lock);
  return found;
}

/* Keeps the drawing, and releases the one that has not been used for the longest time. */
static void keep(drawing_store *store, cs_hash key, celspan_svg *art) {
  pthread_mutex_lock(&store->lock);
  stored *oldest = &store->items[0];
  for (size_t i = 1; i < KEPT; i++)
    if (store->items[i].used < oldest->used)
      oldest = &store->items[i];
  celspan_svg_unref(oldest->art);
  *oldest = (stored){key, celspan_svg_ref(art), ++store->clock};
  pthread_mutex_unlock(&store->lock);
}

/* ---------------------------------------------------------------- reading bytes */

/* Adds notes about names in the document that are not read. */
static celspan_status note_unread(cs_svg_reading *reading) {
  const cs_svg_unread *unread = &reading->document->unread;
  for (size_t i = 0; i < unread->count; i++)
    CS_TRY(cs_svg_skip(reading, &(cs_svg_node){.line = unread->items[i].line}, "%s",
                       unread->items[i].what));
  return CELSPAN_OK;
}

/* In the order of lines; notes about the same line remain in the order in which they were made. */
static int compare_notes(const void *a, const void *b) {
  const cs_svg_skipped *first = a, *second = b;
  int order = CS_SORT_ORDER(first->line, second->line);
  return order ? order : CS_SORT_ORDER(first->number, second->number);
}

static celspan_status copy_notes(cs_svg_reading *reading, celspan_svg *art) {
  celspan_context *context = reading->context;
  CS_TRY(note_unread(reading));
  for (size_t i = 0; i < reading->skipped_count; i++)
    reading->skipped[i].number = i;
  if (reading->skipped_count > 0)
    qsort(reading->skipped, reading->skipped_count, sizeof *reading->skipped, compare_notes);
  art->skipped = cs_arena_take(context, &art->arena, reading->skipped_count * sizeof *art->skipped);
  if (!art->skipped)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < reading->skipped_count; i++) {
    const cs_svg_skipped *entry = &reading->skipped[i];
    art->skipped[i].line = (int32_t)entry->line;
    CS_TRY(cs_svg_text_copy(context, art, entry->what, &art->skipped[i].what));
    art->skipped_count++;
  }
  return CELSPAN_OK;
}

/* The sentence of a failure with the file's name before it, where "line 12: ..." becomes "name:12:
 * ...". */
static celspan_status fail_in(celspan_context *context, const char *name, celspan_status status) {
  char sentence[CS_ERROR_SIZE];
  if (status == CELSPAN_NO_MEMORY)
    return status;
  memcpy(sentence, context->error, sizeof sentence);
  bool has_line = strncmp(sentence, "line ", 5) == 0;
  return cs_fail(context, status == CELSPAN_BAD_ARGUMENT ? CELSPAN_INPUT : status, "%s:%s%s", name,
                 has_line ? "" : " ", sentence + (has_line ? 5 : 0));
}

static celspan_status build(cs_svg_reading *reading, const char *name, celspan_svg **out) {
  celspan_svg *art;
  CS_TRY(cs_svg_art_create(reading->context, &art));
  art->space = reading->space;
  reading->art = art;
  const cs_mark before = reading->context->origin; /* the parts of the drawing have others */
  celspan_status status = cs_svg_move(reading, &art->seconds);
  if (status == CELSPAN_OK)
    status = cs_svg_build(reading, art);
  reading->context->origin = before;
  if (status != CELSPAN_OK)
    status = fail_in(reading->context, name, status);
  if (status == CELSPAN_OK)
    status = copy_notes(reading, art);
  return CS_GIVE(status, art, celspan_svg_unref, out);
}

/* Whether another time may show another drawing: also by a drawing that is an image of it. */
static bool may_move(const cs_svg_reading *reading) {
  return reading->document->animation_count > 0 || reading->document->has_motion ||
         reading->drawings > 0;
}

static celspan_status copy_fonts(celspan_context *context, const cs_svg_source *source,
                                 celspan_svg *art) {
  celspan_svg_font *fonts =
      cs_arena_take(context, &art->arena, (source->font_count + 1) * sizeof *fonts);
  if (!fonts)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < source->font_count; i++) {
    CS_TRY(cs_svg_text_copy(context, art, source->fonts[i].family, &fonts[i].family));
    CS_TRY(cs_svg_text_copy(context, art, source->fonts[i].file, &fonts[i].file));
  }
  art->file->fonts = fonts;
  art->file->font_count = source->font_count;
  return CELSPAN_OK;
}

/* Keeps what the drawing at other times is made from. */
static celspan_status keep_file(const cs_svg_reading *reading, const char *bytes, size_t size,
                                celspan_svg *art) {
  celspan_context *context = reading->context;
  const cs_svg_source *source = reading->source;
  cs_svg_file *file = cs_arena_take(context, &art->arena, sizeof *file);
  char *copy = cs_arena_take(context, &art->arena, size + 1);
  if (!file || !copy)
    return CELSPAN_NO_MEMORY;
  *file = (cs_svg_file){.bytes = memcpy(copy, bytes, size),
                        .size = size,
                        .device = source->device,
                        .number = source->number};
  art->file = file;
  CS_TRY(cs_svg_text_copy(context, art, source->name, &file->name));
  return copy_fonts(context, source, art);
}

static celspan_status finish_reading(const cs_svg_reading *reading, const char *bytes, size_t size,
                                     celspan_svg *art) {
  bool is_kept = reading->clock && !reading->source->outer && may_move(reading);
  return is_kept ? keep_file(reading, bytes, size, art) : CELSPAN_OK;
}

/* reading: the limits, and how to read; its document and notes belong to this drawing until the
 * drawing has been read. */
static celspan_status read_bytes(cs_svg_reading *reading, const char *bytes, size_t size,
                                 celspan_svg **out) {
  celspan_context *context = reading->context;
  const char *name = reading->source->name;
  cs_svg_document document;
  if (size > FILE_BYTES)
    return cs_fail(context, CELSPAN_LIMIT, "%s: the file has %zu bytes; at most %zu are read", name,
                   size, FILE_BYTES);
  reading->document = &document;
  celspan_status status = cs_svg_document_read(context, name, bytes, size, &document);
  celspan_svg *art = NULL;
  if (status == CELSPAN_OK)
    status = build(reading, name, &art);
  if (status == CELSPAN_OK)
    status = finish_reading(reading, bytes, size, art);
  if (status == CELSPAN_OK)
    *out = art;
  else
    celspan_svg_unref(art);
  cs_svg_kept_images_finish(&reading->images, context);
  CS_ARRAYS_FREE(context->memory, reading, skipped, skipped);
  cs_svg_document_finish(&document, context);
  return status;
}

static celspan_status read_inner(cs_svg_reading *outer, const cs_svg_source *source,
                                 const char *bytes, size_t size, celspan_svg **out) {
  cs_svg_reading inner = *outer;
  inner.source = source;
  inner.skipped = NULL;
  inner.skipped_room = (cs_room){0};
  inner.skipped_count = 0;
  inner.images = (cs_svg_kept_images){.count = 0};
  celspan_status status = read_bytes(&inner, bytes, size, out);
  outer->tests = inner.tests;
  outer->drawn = inner.drawn;
  outer->drawings = inner.drawings;
  outer->image_bytes = inner.image_bytes;
  outer->has_other_files = outer->has_other_files || inner.has_other_files;
  outer->has_failed = outer->has_failed || inner.has_failed;
  return status;
}

static cs_svg_reading begin_reading(celspan_context *context, const cs_svg_source *source,
                                    const cs_svg_options *options, double seconds) {
  return (cs_svg_reading){.context = context,
                          .source = source,
                          .read_inner = read_inner,
                          .box_of = cs_svg_box_of,
                          .space = options->space,
                          .clock = options->clock,
                          .seconds = seconds,
                          .tests = CS_SVG_SELECTOR_TESTS};
}

/* ---------------------------------------------------------------- reading files */

static celspan_status fail_file(celspan_context *context, const char *file) {
  return cs_fail(context, CELSPAN_INPUT, "%s: %s", file, strerror(errno));
}

/* Fills `bytes` from the file; less than `size` is a failure. */
static celspan_status fill(celspan_context *context, const char *file, int descriptor, char *bytes,
                           size_t size) {
  ssize_t count = cs_open_read_at(descriptor, bytes, size, 0);
  if (count < 0)
    return fail_file(context, file);
  return (size_t)count == size ? CELSPAN_OK
                               : cs_fail(context, CELSPAN_INPUT,
                                         "%s: the file became shorter while it was read", file);
}

static celspan_status read_open(cs_svg_reading *reading, int descriptor, size_t size,
                                celspan_svg **out) {
  celspan_context *context = reading->context;
  char *bytes = cs_mem_resize(context->memory, NULL, 0, size + 1);
  if (!bytes)
    return cs_fail_memory(context);
  celspan_status status = fill(context, reading->source->name, descriptor, bytes, size);
  if (status == CELSPAN_OK)
    status = read_bytes(reading, bytes, size, out);
  cs_mem_free(context->memory, bytes, size + 1);
  return status;
}

static void hash_about(cs_hash *hash, const struct stat *about) {
  cs_hash_word(hash, (uint64_t)about->st_size);
  cs_hash_word(hash, (uint64_t)about->st_mtim.tv_sec);
  cs_hash_word(hash, (uint64_t)about->st_mtim.tv_nsec);
  cs_hash_word(hash, (uint64_t)about->st_ino);
}

/* A missing font has no facts: an error is reported when a text needs it. */
static void hash_font(cs_hash *hash, const celspan_svg_font *font) {
  struct stat about = {0};
  (void)stat(font->file, &about);
  cs_hash_text(hash, font->family);
  cs_hash_text(hash, font->file);
  hash_about(hash, &about);
}

static cs_hash key_of(const char *file, const struct stat *about, const cs_svg_options *options) {
  cs_hash hash = cs_hash_begin(0x647277u);
  cs_hash_text(&hash, file);
  hash_about(&hash, about);
  cs_hash_word(&hash, options->space);
  cs_hash_word(&hash, options->clock != NULL);
  for (size_t i = 0; i < options->font_count; i++)
    hash_font(&hash, &options->fonts[i]);
  return cs_hash_end(hash);
}

static celspan_status read_or_find(celspan_context *context, const char *file, int descriptor,
                                   const cs_svg_options *options, celspan_svg **out) {
  struct stat about;
  cs_service *service;
  if (fstat(descriptor, &about) != 0)
    return fail_file(context, file);
  if (!S_ISREG(about.st_mode))
    return cs_fail(context, CELSPAN_INPUT, "%s: is not a file", file);
  if ((uint64_t)about.st_size > FILE_BYTES)
    return cs_fail(context, CELSPAN_LIMIT, "%s: the file has %lld bytes; at most %zu are read",
                   file, (long long)about.st_size, FILE_BYTES);
  CS_TRY(cs_context_service(context, &store_kind, &service));
  drawing_store *store = (drawing_store *)service;
  cs_hash key = key_of(file, &about, options);
  *out = find_stored(store, key);
  if (*out)
    return CELSPAN_OK;
  const cs_svg_source source = {.name = file,
                                .file = file,
                                .fonts = options->fonts,
                                .font_count = options->font_count,
                                .device = (uint64_t)about.st_dev,
                                .number = (uint64_t)about.st_ino};
  cs_svg_reading reading = begin_reading(context, &source, options, -1);
  CS_TRY(read_open(&reading, descriptor, (size_t)about.st_size, out));
  if ((*out)->file)
    (*out)->file->key = key;
  if (!reading.has_other_files)
    keep(store, key, *out);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- other times */

static cs_hash key_at(const cs_svg_file *file, double seconds) {
  cs_hash hash = cs_hash_begin(0x647274u);
  cs_hash_word(&hash, file->key.a);
  cs_hash_word(&hash, file->key.b);
  cs_hash_number(&hash, seconds);
  return cs_hash_end(hash);
}

celspan_status cs_svg_at(celspan_context *context, celspan_svg *art,
                         const struct cs_svg_clock *clock, double seconds, celspan_svg **out) {
  const cs_svg_file *file = art->file;
  cs_service *service;
  if (!file) {
    *out = celspan_svg_ref(art);
    return CELSPAN_OK;
  }
  CS_TRY(cs_context_service(context, &store_kind, &service));
  drawing_store *store = (drawing_store *)service;
  const cs_hash key = key_at(file, seconds);
  *out = find_stored(store, key);
  if (*out)
    return CELSPAN_OK;
  const cs_svg_source source = {.name = file->name,
                                .file = file->name,
                                .fonts = file->fonts,
                                .font_count = file->font_count,
                                .device = file->device,
                                .number = file->number};
  const cs_svg_options options = {.space = art->space, .clock = clock};
  cs_svg_reading reading = begin_reading(context, &source, &options, seconds);
  CS_TRY(read_bytes(&reading, file->bytes, file->size, out));
  if (!reading.has_other_files)
    keep(store, key, *out);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the faces */

static celspan_status check_fonts(celspan_context *context, const cs_svg_options *options) {
  CS_TRY(cs_check_list(context, "svg", "fonts", options->fonts, options->font_count, FONTS));
  for (size_t i = 0; i < options->font_count; i++)
    if (!options->fonts[i].family || !options->fonts[i].file)
      return cs_fail(context, CELSPAN_BAD_ARGUMENT, "svg: fonts[%zu] has no family or no file",
                     i + 1);
  return CELSPAN_OK;
}

celspan_status cs_svg_read_file(celspan_context *context, const char *file,
                                const cs_svg_options *options, celspan_svg **out) {
  CS_TRY(check_fonts(context, options));
  int descriptor = cs_open_to_read(file);
  if (descriptor < 0)
    return fail_file(context, file);
  celspan_svg *art = NULL;
  celspan_status status = read_or_find(context, file, descriptor, options, &art);
  close(descriptor);
  if (status == CELSPAN_OK)
    *out = art;
  return status;
}

celspan_status celspan_svg_read(celspan_context *context, const celspan_svg_desc *desc,
                                celspan_svg **out) {
  CS_READ(context, "svg", celspan_svg_desc, desc);
  if (!desc->file == !desc->bytes)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "svg: give a file or bytes, one of them");
  CS_TRY(cs_check_choice(context, "svg", "space", (unsigned)desc->space, CELSPAN_SPACE_SRGB + 1));
  const cs_svg_options options = {
      .fonts = desc->fonts, .font_count = desc->font_count, .space = desc->space};
  if (desc->file)
    return cs_svg_read_file(context, desc->file, &options, out);
  CS_TRY(check_fonts(context, &options));
  const cs_svg_source source = {.name = desc->name ? desc->name : "the drawing",
                                .fonts = desc->fonts,
                                .font_count = desc->font_count};
  cs_svg_reading reading = begin_reading(context, &source, &options, -1);
  celspan_svg *art;
  CS_TRY(read_bytes(&reading, desc->bytes, desc->size, &art));
  *out = art;
  return CELSPAN_OK;
}
