#include "readers/text/font.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/bytes.h"
#include "inside/context.h"
#include "inside/files.h"
#include "inside/hash.h"
#include "readers/type/letters.h"
#include "readers/type/type_module.h"

/* ---------------------------------------------------------------- files */

/* Files of fonts: read as a whole, and looked over before a library sees them.
 *
 *   0 or 1 'ttcf' --> offset of the first font
 *   font: 'OTTO' or 0x00010000, count, then for each table: tag, checksum, offset, length
 *
 * INVARIANT: every table of a font that was accepted lies inside the file, and it has outlines, and
 * no colours.
 * Source: OpenType 1.9, "Organization of an OpenType Font" (all numbers are big-endian).
 */

#define FILE_BYTES ((size_t)256 << 20)

/* What helps when a font is missing: its name may be a family's, or an installed font's
 * file without the folder. */
static const char *hint_at(const char *file) {
  const char *slash = strrchr(file, '/');
  if (!strchr(slash ? slash : file, '.'))
    return "; a font is given by its file, such as \"arial.ttf\" beside the script, or one of the "
           "system's with --allow-system-fonts";
  if (slash)
    return "";
  return "; a font of the system is given by its whole path, such as "
         "\"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf\", with --allow-system-fonts";
}

static celspan_status fail_missing(celspan_context *context, const char *file, int error) {
  const char *tried = cs_tried_find(context, file);
  char text[CS_ERROR_TEXT_SIZE];
  return cs_fail(context, CELSPAN_INPUT, "%s: %s%s%s%s", file, cs_error_text(error, text),
                 tried ? "; also looked for at " : "", tried ? tried : "", hint_at(file));
}

/* Errors: INPUT when it is missing, unreadable or no file. */
static celspan_status find_file(celspan_context *context, const char *file, struct stat *out) {
  if (stat(file, out) != 0)
    return fail_missing(context, file, errno);
  if (!S_ISREG(out->st_mode))
    return cs_fail(context, CELSPAN_INPUT, "%s: is not a file; a font must be one", file);
  if (out->st_size > (off_t)FILE_BYTES)
    return cs_fail(context, CELSPAN_LIMIT, "%s: the font has %lld bytes; the limit is %zu", file,
                   (long long)out->st_size, FILE_BYTES);
  return CELSPAN_OK;
}

/* Reads `size` bytes. Returns 0, or an errno: ENODATA if the file ends before. */
static int read_all(int descriptor, uint8_t *bytes, size_t size) {
  for (size_t done = 0; done < size;) {
    ssize_t got = read(descriptor, bytes + done, size - done);
    if (got == 0)
      return ENODATA;
    if (got < 0 && errno != EINTR)
      return errno;
    done += got > 0 ? (size_t)got : 0;
  }
  return 0;
}

static int read_file(const char *file, uint8_t *bytes, size_t size) {
  int descriptor = cs_open_to_read(file);
  if (descriptor < 0)
    return errno;
  int error = read_all(descriptor, bytes, size);
  close(descriptor);
  return error;
}

/* *bytes: new, of `size` bytes, the size that was determined above. Errors: NO_MEMORY, INPUT,
 * LIMIT. */
static celspan_status load_file(celspan_context *context, const char *file, size_t size,
                                uint8_t **bytes) {
  char text[CS_ERROR_TEXT_SIZE];
  uint8_t *made = size > 0 ? cs_mem_resize(context->memory, NULL, 0, size) : NULL;
  if (!made && size > 0)
    return cs_fail_memory(context);
  int error = read_file(file, made, size);
  if (error) {
    cs_mem_free(context->memory, made, size);
    return cs_fail(context, CELSPAN_INPUT, "%s: %s", file, cs_error_text(error, text));
  }
  *bytes = made;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- checking a file */

typedef struct font_bytes {
  celspan_context *context;
  const char *file;
  const uint8_t *bytes;
  size_t size;
  size_t directory; /* offset of the font's directory */
} font_bytes;

static uint32_t number_at(const font_bytes *font, size_t at) {
  return cs_bytes_big32(font->bytes + at);
}

static celspan_status fail_format(const font_bytes *font) {
  bool is_web = font->size >= 3 && memcmp(font->bytes, "wOF", 3) == 0;
  return cs_fail(font->context, CELSPAN_INPUT,
                 is_web ? "%s: the font is compressed for the web (WOFF); convert it to .ttf or "
                          ".otf"
                        : "%s: this is not a TrueType or OpenType font",
                 font->file);
}

static celspan_status fail_cut(const font_bytes *font, size_t wanted) {
  return cs_fail(font->context, CELSPAN_INPUT, "%s: the font is truncated: it has %zu bytes of %zu",
                 font->file, font->size, wanted);
}

static bool is_collection(const uint8_t *bytes, size_t size) {
  return size >= 4 && memcmp(bytes, "ttcf", 4) == 0;
}

/* In a collection, a table of offsets from byte 12 on leads to the directories of its fonts. */
static celspan_status find_face(font_bytes *font, uint32_t face) {
  uint32_t count = number_at(font, 8);
  if (count == 0)
    return fail_format(font);
  if (face >= count)
    return cs_fail(font->context, CELSPAN_BAD_ARGUMENT,
                   "%s: face %" PRIu64 " is not in the collection, which has 1 to %" PRIu32,
                   font->file, (uint64_t)face + 1, count);
  size_t entry = 12 + 4 * (size_t)face;
  if (entry + 4 > font->size)
    return fail_cut(font, entry + 4);
  font->directory = number_at(font, entry);
  return font->directory > font->size - 12 ? fail_cut(font, font->directory + 12) : CELSPAN_OK;
}

static celspan_status find_directory(font_bytes *font, uint32_t face) {
  if (font->size < 12)
    return fail_format(font);
  if (is_collection(font->bytes, font->size))
    CS_TRY(find_face(font, face));
  uint32_t kind = number_at(font, font->directory);
  bool is_known = kind == 0x00010000 || kind == CS_TYPE_TAG('O', 'T', 'T', 'O') ||
                  kind == CS_TYPE_TAG('t', 'r', 'u', 'e');
  return is_known ? CELSPAN_OK : fail_format(font);
}

static const uint32_t outlines[] = {CS_TYPE_TAG('g', 'l', 'y', 'f'),
                                    CS_TYPE_TAG('C', 'F', 'F', ' '),
                                    CS_TYPE_TAG('C', 'F', 'F', '2'), 0};
static const uint32_t colours[] = {CS_TYPE_TAG('C', 'O', 'L', 'R'), CS_TYPE_TAG('C', 'B', 'D', 'T'),
                                   CS_TYPE_TAG('s', 'b', 'i', 'x'), CS_TYPE_TAG('S', 'V', 'G', ' '),
                                   0};

static bool is_among(uint32_t tag, const uint32_t *tags) {
  while (*tags && *tags != tag)
    tags++;
  return *tags;
}

/* face: the number of the font in a collection; any number for a file of one font. Errors: INPUT
 * for a file that is not a font or is incomplete; BAD_ARGUMENT for fonts of bitmaps or colours, and
 * a face that the collection does not have. */
static celspan_status check_file(celspan_context *context, const char *file, const uint8_t *bytes,
                                 size_t size, uint32_t face) {
  font_bytes font = {context, file, bytes, size, 0};
  CS_TRY(find_directory(&font, face));
  size_t count = number_at(&font, font.directory + 4) >> 16, end = font.directory + 12 + 16 * count;
  if (end > size)
    return fail_cut(&font, end);
  bool has_outlines = false, has_colours = false;
  for (size_t i = 0; i < count; i++) {
    size_t entry = font.directory + 12 + 16 * i;
    uint32_t tag = number_at(&font, entry);
    uint64_t last = (uint64_t)number_at(&font, entry + 8) + number_at(&font, entry + 12);
    if (last > size)
      return fail_cut(&font, last);
    has_outlines = has_outlines || is_among(tag, outlines);
    has_colours = has_colours || is_among(tag, colours);
  }
  if (has_colours)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: the font has coloured glyphs; use a font of plain outlines", file);
  if (!has_outlines)
    return cs_fail(context, CELSPAN_INPUT, "%s: the font has no outlines", file);
  return CELSPAN_OK;
}

/* Bytes of font files that are kept while no text is being made. */
#define BUDGET ((size_t)64 << 20)
/* Points of outlines that a font keeps; further outlines are made again each time. */
#define KEPT_POINTS ((size_t)4 << 20)
/* The farthest that a point of an outline may lie from its origin, in font units. */
#define FARTHEST 1e9

/* ---------------------------------------------------------------- the store */

static void drop_outlines(cs_font *font, cs_memory *memory) {
  for (size_t i = 0; font->glyphs && i < font->info.glyphs; i++)
    if (font->glyphs[i]) {
      cs_outline_finish(font->glyphs[i], memory);
      cs_mem_free(memory, font->glyphs[i], sizeof *font->glyphs[i]);
      font->glyphs[i] = NULL;
    }
  font->points = 0;
}

static void clear_font(cs_cache_entry *entry, cs_memory *memory) {
  cs_font *font = (cs_font *)entry;
  if (font->font) {
    font->type->close(font->font);
    pthread_mutex_destroy(&font->lock);
  }
  drop_outlines(font, memory);
  cs_mem_free(memory, font->glyphs, font->info.glyphs * sizeof *font->glyphs);
  cs_mem_free(memory, font->bytes, font->size);
}

static celspan_status create_store(celspan_context *context, cs_service **out) {
  return cs_cache_service_create(context, sizeof(cs_font), clear_font, BUDGET, out);
}

static const cs_service_kind store_kind = {create_store, cs_cache_service_destroy,
                                           cs_cache_service_trim};

/* ---------------------------------------------------------------- a font */

typedef struct request {
  const celspan_text_desc *desc;
  const char *file;
  size_t size;
} request;

static celspan_status open_font(celspan_context *context, const request *wanted, cs_font *font) {
  const cs_type_module *module;
  CS_TRY(cs_type_module_load(context, "setting type", &module));
  font->size = wanted->size;
  CS_TRY(load_file(context, wanted->file, wanted->size, &font->bytes));
  const celspan_text_desc *desc = wanted->desc;
  CS_TRY(check_file(context, wanted->file, font->bytes, font->size, desc->face));
  uint32_t face = is_collection(font->bytes, font->size) ? desc->face : 0;
  font->type = module->type;
  cs_type_font *opened;
  if (font->type->open(font->bytes, font->size, face, desc->variations, desc->variation_count,
                       &font->info, &opened) != CELSPAN_OK)
    return cs_fail_memory(context);
  font->font = opened;
  pthread_mutex_init(&font->lock, NULL);
  if (font->info.glyphs == 0)
    return cs_fail(context, CELSPAN_INPUT, "%s: the font has no glyphs", wanted->file);
  return CS_MAKE(context, font->glyphs, font->info.glyphs);
}

static celspan_status make_font(void *user, celspan_context *context, cs_cache_entry *entry) {
  const request *wanted = user;
  entry->bytes = wanted->size;
  return open_font(context, wanted, (cs_font *)entry);
}

/* Two fonts are the same if they have the same files with the same known properties, the same faces
 * and the same variations. */
static cs_cache_key key_of(const request *wanted, const struct stat *found) {
  cs_hash hash = cs_hash_begin(0);
  cs_hash_text(&hash, wanted->file);
  cs_hash_word(&hash, (uint64_t)found->st_ino);
  cs_hash_word(&hash, (uint64_t)found->st_dev);
  cs_hash_word(&hash, (uint64_t)found->st_mtim.tv_sec);
  cs_hash_word(&hash, (uint64_t)found->st_mtim.tv_nsec);
  cs_hash_word(&hash, wanted->desc->face);
  for (size_t i = 0; i < wanted->desc->variation_count; i++) {
    cs_hash_text(&hash, wanted->desc->variations[i].tag);
    cs_hash_number(&hash, wanted->desc->variations[i].value);
  }
  hash = cs_hash_end(hash);
  return (cs_cache_key){hash.a, hash.b, (uint64_t)found->st_size};
}

celspan_status cs_font_acquire(celspan_context *context, const celspan_text_desc *desc,
                               size_t index, cs_font **out) {
  struct stat found;
  CS_TRY(find_file(context, desc->fonts[index], &found));
  request wanted = {desc, desc->fonts[index], (size_t)found.st_size};
  cs_service *service;
  CS_TRY(cs_context_service(context, &store_kind, &service));
  cs_cache_entry *entry;
  CS_TRY(cs_cache_acquire(cs_cache_of(service), context, key_of(&wanted, &found), make_font,
                          &wanted, &entry));
  *out = (cs_font *)entry;
  return CELSPAN_OK;
}

void cs_font_release(celspan_context *context, cs_font *font) {
  cs_service *store = cs_context_find_service(context, &store_kind);
  if (font)
    cs_cache_unpin(cs_cache_of(store), &font->entry);
}

/* ---------------------------------------------------------------- outlines */

/* An outline that the module draws. */
typedef struct drawing {
  celspan_context *context;
  cs_outline *outline;
  celspan_status status;
  bool is_open, is_broken;
} drawing;

static cs_hpoint point_of(drawing *d, celspan_point point) {
  bool is_near =
      point.x >= -FARTHEST && point.x <= FARTHEST && point.y >= -FARTHEST && point.y <= FARTHEST;
  d->is_broken = d->is_broken || !is_near;
  return (cs_hpoint){point.x, -point.y, 1};
}

static void on_move(void *user, celspan_point to) {
  drawing *d = user;
  cs_hpoint point = point_of(d, to);
  if (d->status == CELSPAN_OK && !d->is_broken)
    d->status = cs_outline_move(d->context, d->outline, point);
  d->is_open = true;
}

static void add_piece(drawing *d, int degree, const cs_hpoint *points) {
  if (d->status == CELSPAN_OK && !d->is_broken && d->is_open)
    d->status = cs_outline_piece(d->context, d->outline, degree, points);
}

static void on_line(void *user, celspan_point to) {
  const cs_hpoint point = point_of(user, to);
  add_piece(user, 1, &point);
}

static void on_conic(void *user, celspan_point control, celspan_point to) {
  const cs_hpoint points[] = {point_of(user, control), point_of(user, to)};
  add_piece(user, 2, points);
}

static void on_cubic(void *user, celspan_point control, celspan_point control2, celspan_point to) {
  const cs_hpoint points[] = {point_of(user, control), point_of(user, control2),
                              point_of(user, to)};
  add_piece(user, 3, points);
}

static celspan_status draw(celspan_context *context, cs_font *font, uint32_t glyph,
                           cs_outline *outline) {
  drawing d = {.context = context, .outline = outline, .status = CELSPAN_OK};
  const cs_type_outliner outliner = {on_move, on_line, on_conic, on_cubic, &d};
  celspan_status status = font->type->outline(font->font, glyph, &outliner);
  CS_TRY(d.status);
  if (status != CELSPAN_OK)
    return cs_fail_memory(context);
  if (d.is_broken)
    return cs_fail(context, CELSPAN_INPUT, "the outline of glyph %u of a font goes beyond %g units",
                   glyph, FARTHEST);
  return cs_outline_close(context, outline);
}

/* The outline of a glyph. The caller has locked the lock. */
static celspan_status find_outline(celspan_context *context, cs_font *font, uint32_t glyph,
                                   const cs_outline **out) {
  if (!font->glyphs[glyph]) {
    if (font->points > KEPT_POINTS)
      drop_outlines(font, context->memory);
    cs_outline *made;
    CS_TRY(CS_MAKE(context, made, 1));
    cs_outline_init(made);
    celspan_status status = draw(context, font, glyph, made);
    if (status != CELSPAN_OK) {
      cs_outline_finish(made, context->memory);
      cs_mem_free(context->memory, made, sizeof *made);
      return status;
    }
    font->glyphs[glyph] = made;
    font->points += made->point_count;
  }
  *out = font->glyphs[glyph];
  return CELSPAN_OK;
}

static cs_hpoint placed(cs_hpoint point, cs_font_place place) {
  return (cs_hpoint){place.x + place.scale * point.x, place.y + place.scale * point.y, 1};
}

/* Appends one contour: pieces from `first` to before `end`. */
static celspan_status append_contour(celspan_context *context, const cs_outline *from, size_t first,
                                     size_t end, cs_font_place place, cs_outline *outline) {
  CS_TRY(cs_outline_move(context, outline, placed(from->points[from->starts[first]], place)));
  for (size_t i = first; i < end; i++) {
    cs_hpoint points[3];
    for (int k = 0; k < from->degrees[i]; k++)
      points[k] = placed(from->points[from->starts[i] + 1 + (uint32_t)k], place);
    CS_TRY(cs_outline_piece(context, outline, from->degrees[i], points));
  }
  return cs_outline_close(context, outline);
}

celspan_status cs_font_append(celspan_context *context, cs_font *font, uint32_t glyph,
                              cs_font_place place, cs_outline *outline) {
  if (glyph >= font->info.glyphs)
    return CELSPAN_OK;
  const cs_outline *from = NULL;
  pthread_mutex_lock(&font->lock);
  celspan_status status = find_outline(context, font, glyph, &from);
  for (size_t i = 0; status == CELSPAN_OK && i < from->contour_count; i++) {
    size_t end = i + 1 < from->contour_count ? from->contours[i + 1] : from->piece_count;
    status = append_contour(context, from, from->contours[i], end, place, outline);
  }
  pthread_mutex_unlock(&font->lock);
  return status;
}
