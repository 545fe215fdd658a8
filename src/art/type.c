#include "art/type.h"

#include <hb-ot.h>
#include <hb.h>
#include <stdlib.h>
#include <string.h>

#include "art/order.h"

#define SETTINGS 64

struct cs_type_font {
  hb_font_t *font;
  hb_draw_funcs_t *functions;
};

/* ---------------------------------------------------------------- opening */

static hb_tag_t tag_of(const char *text) { return hb_tag_from_string(text, -1); }

static void set_variations(hb_face_t *face, hb_font_t *font, const celspan_variation *variations,
                           size_t count, cs_type_font_info *info) {
  hb_variation_t settings[SETTINGS];
  count = count < SETTINGS ? count : SETTINGS;
  for (size_t i = 0; i < count; i++) {
    hb_ot_var_axis_info_t axis;
    settings[i] = (hb_variation_t){tag_of(variations[i].tag), (float)variations[i].value};
    if (hb_ot_var_find_axis_info(face, settings[i].tag, &axis))
      info->variation |= (uint64_t)1 << i;
  }
  hb_font_set_variations(font, settings, (unsigned)count);
}

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

static void close_font(cs_type_font *font) {
  if (!font)
    return;
  hb_font_destroy(font->font);
  hb_draw_funcs_destroy(font->functions);
  free(font);
}

/* Fonts that do not tell how high their lines are have lines of an em. */
static void read_lines(hb_font_t *font, cs_type_font_info *info) {
  hb_font_extents_t extents;
  bool is_told = hb_font_get_h_extents(font, &extents) && extents.ascender > extents.descender;
  info->ascent = is_told ? extents.ascender : (int32_t)info->units;
  info->descent = is_told ? -extents.descender : 0;
}

static celspan_status open_font(const void *bytes, size_t size, uint32_t index,
                                const celspan_variation *variations, size_t variation_count,
                                cs_type_font_info *info, cs_type_font **out) {
  cs_type_font *made = calloc(1, sizeof *made);
  if (!made)
    return CELSPAN_NO_MEMORY;
  hb_blob_t *blob = hb_blob_create(bytes, (unsigned)size, HB_MEMORY_MODE_READONLY, NULL, NULL);
  hb_face_t *face = hb_face_create(blob, index);
  made->font = hb_font_create(face);
  made->functions = create_functions();
  *info =
      (cs_type_font_info){.units = hb_face_get_upem(face), .glyphs = hb_face_get_glyph_count(face)};
  if (variation_count > 0)
    set_variations(face, made->font, variations, variation_count, info);
  read_lines(made->font, info);
  hb_face_destroy(face);
  hb_blob_destroy(blob);
  /* Without memory HarfBuzz makes empty objects, which cannot be changed. */
  if (hb_font_is_immutable(made->font) || hb_draw_funcs_is_immutable(made->functions)) {
    close_font(made);
    return CELSPAN_NO_MEMORY;
  }
  hb_font_make_immutable(made->font);
  hb_draw_funcs_make_immutable(made->functions);
  *out = made;
  return CELSPAN_OK;
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
  hb_buffer_t *buffer = make_buffer(run);
  celspan_status status = CELSPAN_NO_MEMORY;
  if (hb_buffer_allocation_successful(buffer) &&
      hb_shape_full(font->font, buffer, features, (unsigned)feature_count, NULL))
    status = take_glyphs(buffer, take, user);
  hb_buffer_destroy(buffer);
  return status;
}

static void outline(cs_type_font *font, uint32_t glyph, const cs_type_outliner *outliner) {
  hb_font_get_glyph_shape(font->font, glyph, font->functions, (void *)outliner);
}

static bool has(cs_type_font *font, uint32_t character) {
  hb_codepoint_t glyph;
  return hb_font_get_nominal_glyph(font->font, character, &glyph);
}

static void scripts(const uint32_t *characters, size_t count, uint32_t *out) {
  hb_unicode_funcs_t *unicode = hb_unicode_funcs_get_default();
  for (size_t i = 0; i < count; i++)
    out[i] = hb_script_to_iso15924_tag(hb_unicode_script(unicode, characters[i]));
}

const cs_type_functions cs_art_type = {
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
