#include "readers/text/font.h"

#include <string.h>

#include "base/hash.h"
#include "readers/text/font_file.h"
#include "readers/xml/artwork.h"

/* Of the files that are kept when no text is being made. */
#define BUDGET ((size_t)64 << 20)
/* Points of outlines that a font keeps; beyond, it makes them again each time. */
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
  const cs_art_module *module;
  CS_TRY(cs_artwork_module(context, "setting type", &module));
  font->size = wanted->size;
  CS_TRY(cs_font_file_read(context, wanted->file, wanted->size, &font->bytes));
  const celspan_text_desc *desc = wanted->desc;
  CS_TRY(cs_font_file_check(context, wanted->file, font->bytes, font->size, desc->face));
  uint32_t face = cs_font_file_is_collection(font->bytes, font->size) ? desc->face : 0;
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
  CS_TRY(cs_font_file_stat(context, desc->fonts[index], &found));
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

/* An outline that the module is drawing. */
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

/* The outline of a glyph; the lock is held. */
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
