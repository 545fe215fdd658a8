/* If HarfBuzz lacks memory, it continues with empty tables and keeps them, so text would be wrong
 * from then on. A failed allocation sets errno, which is checked after each call. If an allocation
 * has failed, the font is dropped, and the next call makes the font again. */
#include "plugins/type/parts.h"

#include <errno.h>
#include <hb-ot.h>
#include <hb.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#define SETTINGS 64

struct cs_type_font {
  const void *bytes; /* borrowed */
  size_t size;
  uint32_t face;
  hb_variation_t settings[SETTINGS];
  unsigned setting_count;
  /* protects the members below: parts of a font are made when they are needed */
  pthread_mutex_t lock;
  hb_font_t *font; /* NULL: it lacked memory */
  hb_draw_funcs_t *functions;
};

/* ---------------------------------------------------------------- outlines */

static void on_move(hb_draw_funcs_t *functions, void *data, hb_draw_state_t *state, float x,
                    float y, void *user) {
  (void)functions, (void)state, (void)user;
  const cs_type_outliner *outliner = data;
  outliner->move(outliner->user, (celspan_point){(double)x, (double)y});
}

static void on_line(hb_draw_funcs_t *functions, void *data, hb_draw_state_t *state, float x,
                    float y, void *user) {
  (void)functions, (void)state, (void)user;
  const cs_type_outliner *outliner = data;
  outliner->line(outliner->user, (celspan_point){(double)x, (double)y});
}

static void on_conic(hb_draw_funcs_t *functions, void *data, hb_draw_state_t *state, float cx,
                     float cy, float x, float y, void *user) {
  (void)functions, (void)state, (void)user;
  const cs_type_outliner *outliner = data;
  outliner->conic(outliner->user, (celspan_point){(double)cx, (double)cy},
                  (celspan_point){(double)x, (double)y});
}

static void on_cubic(hb_draw_funcs_t *functions, void *data, hb_draw_state_t *state, float cx,
                     float cy, float dx, float dy, float x, float y, void *user) {
  (void)functions, (void)state, (void)user;
  const cs_type_outliner *outliner = data;
  outliner->cubic(outliner->user, (celspan_point){(double)cx, (double)cy},
                  (celspan_point){(double)dx, (double)dy}, (celspan_point){(double)x, (double)y});
}

static hb_draw_funcs_t *create_functions(void) {
  hb_draw_funcs_t *functions = hb_draw_funcs_create();
  hb_draw_funcs_set_move_to_func(functions, on_move, NULL, NULL);
  hb_draw_funcs_set_line_to_func(functions, on_line, NULL, NULL);
  hb_draw_funcs_set_quadratic_to_func(functions, on_conic, NULL, NULL);
  hb_draw_funcs_set_cubic_to_func(functions, on_cubic, NULL, NULL);
  return functions;
}

/* ---------------------------------------------------------------- memory */

static bool lacks_process; /* the memory that HarfBuzz keeps as long as the process lives */

/* Makes everything that HarfBuzz makes only once, so that later failures belong to a font. */
static void make_for_process(void) {
  errno = 0;
  hb_unicode_funcs_get_default();
  hb_shape_list_shapers();
  hb_font_destroy(hb_font_create(hb_face_get_empty()));
  lacks_process = errno == ENOMEM;
}

static void drop(cs_type_font *font) {
  hb_font_destroy(font->font);
  hb_draw_funcs_destroy(font->functions);
  font->font = NULL;
  font->functions = NULL;
}

/* Makes the font, for the first time or again. The caller has locked the lock. */
static void make(cs_type_font *font) {
  hb_blob_t *blob =
      hb_blob_create(font->bytes, (unsigned)font->size, HB_MEMORY_MODE_READONLY, NULL, NULL);
  hb_face_t *face = hb_face_create(blob, font->face);
  font->font = hb_font_create(face);
  font->functions = create_functions();
  hb_font_set_variations(font->font, font->settings, font->setting_count);
  hb_font_make_immutable(font->font);
  hb_draw_funcs_make_immutable(font->functions);
  hb_face_destroy(face);
  hb_blob_destroy(blob);
}

/* Before calls that use the font, and after them. */
static void enter(cs_type_font *font) {
  pthread_mutex_lock(&font->lock);
  errno = 0;
  if (!font->font)
    make(font);
}

static celspan_status leave(cs_type_font *font) {
  bool is_starved = errno == ENOMEM;
  if (is_starved)
    drop(font);
  pthread_mutex_unlock(&font->lock);
  return is_starved ? CELSPAN_NO_MEMORY : CELSPAN_OK;
}

/* ---------------------------------------------------------------- opening */

static void close_font(cs_type_font *font) {
  if (!font)
    return;
  drop(font);
  pthread_mutex_destroy(&font->lock);
  free(font);
}

static hb_tag_t tag_of(const char *text) { return hb_tag_from_string(text, -1); }

static void set_variations(cs_type_font *font, const celspan_variation *variations, size_t count) {
  font->setting_count = (unsigned)(count < SETTINGS ? count : SETTINGS);
  for (size_t i = 0; i < font->setting_count; i++)
    font->settings[i] = (hb_variation_t){tag_of(variations[i].tag), (float)variations[i].value};
}

/* Bit i: the font has the axis of variation i. */
static uint64_t find_axes(const cs_type_font *font) {
  uint64_t axes = 0;
  hb_ot_var_axis_info_t axis;
  for (unsigned i = 0; i < font->setting_count; i++)
    if (hb_ot_var_find_axis_info(hb_font_get_face(font->font), font->settings[i].tag, &axis))
      axes |= (uint64_t)1 << i;
  return axes;
}

/* A height from the tables of the font; if they lack it, the height of the letter `letter`; if the
 * font lacks this letter, `other`. */
static int32_t find_height(const cs_type_font *font, hb_ot_metrics_tag_t tag, uint32_t letter,
                           int32_t other) {
  hb_position_t height;
  hb_codepoint_t glyph;
  hb_glyph_extents_t extents;
  if (hb_ot_metrics_get_position(font->font, tag, &height) && height > 0)
    return height;
  bool is_there = hb_font_get_nominal_glyph(font->font, letter, &glyph) &&
                  hb_font_get_glyph_extents(font->font, glyph, &extents);
  return is_there ? extents.y_bearing : other;
}

/* Fonts without a line height have lines of an em. */
static void read_info(const cs_type_font *font, cs_type_font_info *info) {
  hb_face_t *face = hb_font_get_face(font->font);
  hb_font_extents_t extents;
  bool is_told =
      hb_font_get_h_extents(font->font, &extents) && extents.ascender > extents.descender;
  uint32_t units = hb_face_get_upem(face);
  *info = (cs_type_font_info){.units = units,
                              .ascent = is_told ? extents.ascender : (int32_t)units,
                              .descent = is_told ? -extents.descender : 0,
                              .glyphs = hb_face_get_glyph_count(face),
                              .variation = find_axes(font)};
  info->cap_height = find_height(font, HB_OT_METRICS_TAG_CAP_HEIGHT, 'H', info->ascent);
  info->x_height = find_height(font, HB_OT_METRICS_TAG_X_HEIGHT, 'x', info->cap_height);
}

static celspan_status open_font(const void *bytes, size_t size, uint32_t face,
                                const celspan_variation *variations, size_t variation_count,
                                cs_type_font_info *info, cs_type_font **out) {
  static pthread_once_t once = PTHREAD_ONCE_INIT;
  pthread_once(&once, make_for_process);
  cs_type_font *made = lacks_process ? NULL : calloc(1, sizeof *made);
  if (!made)
    return CELSPAN_NO_MEMORY;
  made->bytes = bytes;
  made->size = size;
  made->face = face;
  set_variations(made, variations, variation_count);
  pthread_mutex_init(&made->lock, NULL);
  enter(made);
  read_info(made, info);
  celspan_status status = leave(made);
  if (status == CELSPAN_OK)
    *out = made;
  else
    close_font(made);
  return status;
}

/* ---------------------------------------------------------------- glyphs */

static hb_buffer_t *make_buffer(const cs_type_run *run) {
  hb_buffer_t *buffer = hb_buffer_create();
  hb_buffer_add_utf32(buffer, run->characters, (int)run->count, (unsigned)run->begin,
                      (int)(run->end - run->begin));
  hb_buffer_set_direction(buffer, run->is_leftward ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
  hb_buffer_set_script(buffer, hb_script_from_iso15924_tag(run->script));
  if (run->language)
    hb_buffer_set_language(buffer, hb_language_from_string(run->language, -1));
  return buffer;
}

static celspan_status
take_glyphs(hb_buffer_t *buffer, bool (*take)(void *user, const cs_type_glyph *glyph), void *user) {
  unsigned count, places;
  const hb_glyph_info_t *infos = hb_buffer_get_glyph_infos(buffer, &count);
  const hb_glyph_position_t *positions = hb_buffer_get_glyph_positions(buffer, &places);
  for (unsigned i = 0; i < count; i++) {
    const cs_type_glyph glyph = {infos[i].codepoint, infos[i].cluster, positions[i].x_advance,
                                 positions[i].x_offset, positions[i].y_offset};
    if (!take(user, &glyph))
      return CELSPAN_CANCELLED;
  }
  return CELSPAN_OK;
}

static celspan_status shape(cs_type_font *font, const cs_type_run *run,
                            bool (*take)(void *user, const cs_type_glyph *glyph), void *user) {
  hb_feature_t features[SETTINGS];
  size_t feature_count = run->feature_count < SETTINGS ? run->feature_count : SETTINGS;
  for (size_t i = 0; i < feature_count; i++)
    features[i] = (hb_feature_t){tag_of(run->features[i].tag), run->features[i].value,
                                 HB_FEATURE_GLOBAL_START, HB_FEATURE_GLOBAL_END};
  enter(font);
  hb_buffer_t *buffer = make_buffer(run);
  bool is_shaped = hb_buffer_allocation_successful(buffer) &&
                   hb_shape_full(font->font, buffer, features, (unsigned)feature_count, NULL);
  celspan_status status = leave(font);
  if (status == CELSPAN_OK)
    status = is_shaped ? take_glyphs(buffer, take, user) : CELSPAN_NO_MEMORY;
  hb_buffer_destroy(buffer);
  return status;
}

static celspan_status outline(cs_type_font *font, uint32_t glyph,
                              const cs_type_outliner *outliner) {
  enter(font);
  hb_font_get_glyph_shape(font->font, glyph, font->functions, (void *)outliner);
  return leave(font);
}

static bool has(cs_type_font *font, uint32_t character) {
  hb_codepoint_t glyph;
  enter(font);
  bool is_there = hb_font_get_nominal_glyph(font->font, character, &glyph);
  return leave(font) == CELSPAN_OK && is_there;
}

static void scripts(const uint32_t *characters, size_t count, uint32_t *out) {
  hb_unicode_funcs_t *unicode = hb_unicode_funcs_get_default();
  for (size_t i = 0; i < count; i++)
    out[i] = hb_script_to_iso15924_tag(hb_unicode_script(unicode, characters[i]));
}

static const cs_type_functions type_functions = {
    .open = open_font,
    .close = close_font,
    .shape = shape,
    .outline = outline,
    .has = has,
    .embeddings = cs_order_embeddings,
    .end_line = cs_order_end_line,
    .breaks = cs_order_breaks,
    .scripts = scripts,
};

const void *celspan_type_module(void) {
  static const cs_type_module table = {
      .version = CS_TYPE_MODULE_VERSION,
      .parse_xml = cs_xml_parse_bytes,
      .type = &type_functions,
  };
  return &table;
}
