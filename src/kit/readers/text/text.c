/* The public constructors of text: all letters as one primitive, or one primitive a letter. */
#include <math.h>
#include <string.h>

#include "celspan/text.h"
#include "inside/description.h"
#include "inside/scene.h"
#include "readers/text/layout.h"

CS_DESCRIBE(celspan_text_desc, font_count, .size = 48, .leading = 1.2)

struct celspan_glyphs {
  cs_memory *memory;
  CS_ARRAY(celspan_glyph, glyphs);
  CS_ARRAY(char, text); /* a copy, to which the glyphs point */
  size_t count;
};

/* ---------------------------------------------------------------- outlines */

static celspan_status append_glyphs(cs_layout *layout, size_t first, size_t count,
                                    cs_outline *outline) {
  for (size_t i = first; i < first + count; i++) {
    const cs_text_glyph *glyph = &layout->glyphs[i];
    cs_font_place place = {glyph->x, glyph->y,
                           layout->desc->size / (double)glyph->font->info.units};
    CS_TRY(cs_font_append(layout->context, glyph->font, glyph->glyph, place, outline));
    if (outline->point_count > CS_TEXT_POINTS)
      return cs_fail(layout->context, CELSPAN_LIMIT,
                     "%s: the outlines have more than %zu points; split it into several texts",
                     layout->noun, CS_TEXT_POINTS);
  }
  return CELSPAN_OK;
}

/* The box of the whole text: as wide as its lines, from the ascent of the first one to the descent
 * of the last one. */
static celspan_box box_of(const cs_layout *layout) {
  const celspan_text_metrics metrics = cs_typeset_measure(layout);
  const cs_text_letter *letters = layout->letters;
  if (layout->letter_count == 0)
    return (celspan_box){0, 0, 0, 0};
  double left = letters[0].x, right = left;
  for (size_t i = 0; i < layout->letter_count; i++) {
    left = fmin(left, letters[i].x);
    right = fmax(right, letters[i].x + letters[i].advance);
  }
  const double below = letters[0].line * layout->desc->leading * layout->desc->size;
  return (celspan_box){left, letters[0].y - below - metrics.ascent, right - left, metrics.height};
}

/* Replaces a gradient without points by the one that fits the whole text, which is made once. */
static celspan_status fit_texture(cs_layout *layout, celspan_texture **texture) {
  if ((*texture)->variation->fit == CS_TEXTURE_FIT_NONE)
    return CELSPAN_OK;
  if (!layout->fitted) {
    const celspan_box box = box_of(layout);
    celspan_texture *fitted = celspan_texture_ref(*texture);
    celspan_status status = cs_texture_fit(layout->context, &fitted, &box);
    layout->fitted = fitted;
    CS_TRY(status);
  }
  celspan_texture_unref(*texture);
  *texture = celspan_texture_ref(layout->fitted);
  return CELSPAN_OK;
}

/* An object of `count` glyphs from `first` on. */
static celspan_status create_object(cs_layout *layout, size_t first, size_t count,
                                    celspan_object **out) {
  cs_primitive_data *data;
  CS_TRY(cs_primitive_data_create(layout->context, CS_PRIMITIVE_DATA_OUTLINE, layout->desc->texture,
                                  &data));
  data->rule = CELSPAN_RULE_NONZERO;
  celspan_status status = CELSPAN_OK;
  cs_outline outline;
  cs_outline_init(&outline);
  if (layout->desc->size > 0)
    status = append_glyphs(layout, first, count, &outline);
  if (status == CELSPAN_OK)
    status = fit_texture(layout, &data->texture);
  return cs_primitive_data_complete(layout->context, data, &outline, status, out);
}

celspan_status celspan_object_create_text(celspan_context *context, const celspan_text_desc *desc,
                                          celspan_object **out) {
  CS_READ(context, "text", celspan_text_desc, desc);
  cs_layout layout;
  celspan_status status = cs_typeset_make(&layout, context, "text", desc);
  if (status == CELSPAN_OK)
    status = create_object(&layout, 0, layout.glyph_count, out);
  cs_typeset_finish(&layout);
  return status;
}

celspan_status celspan_text_measure(celspan_context *context, const celspan_text_desc *desc,
                                    celspan_text_metrics *out) {
  CS_READ(context, "text", celspan_text_desc, desc);
  cs_layout layout;
  celspan_text_metrics metrics = {0};
  celspan_status status = cs_typeset_make(&layout, context, "text", desc);
  if (status == CELSPAN_OK)
    metrics = cs_typeset_measure(&layout);
  cs_typeset_finish(&layout);
  return status == CELSPAN_OK ? CS_RESULT(context, "text", celspan_text_metrics, &metrics, out)
                              : status;
}

/* ---------------------------------------------------------------- letter by letter */

/* The letters in reading order; also finds the last character of every letter. order[i]: the letter
 * that begins with character i, counted from 1; 0: there is none. */
static void end_letters(cs_layout *layout, uint32_t *order) {
  for (size_t i = 0; i < layout->letter_count; i++)
    order[layout->letters[i].begin] = (uint32_t)i + 1;
  cs_text_letter *before = NULL;
  for (size_t at = 0; at < layout->count; at++) {
    cs_text_letter *letter = order[at] ? &layout->letters[order[at] - 1] : NULL;
    before = letter ? letter : before;
    bool is_end = layout->characters[at] == '\n' || layout->characters[at] == 0x2028 ||
                  layout->characters[at] == 0x2029;
    before = is_end ? NULL : before;
    if (before)
      before->end = (uint32_t)at + 1;
  }
}

static size_t byte_of(const cs_layout *layout, size_t character) {
  return character < layout->count ? layout->places[character] : layout->desc->text_size;
}

static celspan_status add_glyph(cs_layout *layout, const cs_text_letter *letter,
                                celspan_glyphs *glyphs) {
  celspan_glyph *glyph = &glyphs->glyphs[glyphs->count];
  size_t begin = byte_of(layout, letter->begin), end = byte_of(layout, letter->end);
  /* A "\r" before the end of a line does not count as a character. */
  while (end > begin && glyphs->text[end - 1] == '\r')
    end--;
  *glyph = (celspan_glyph){.x = letter->x,
                           .y = letter->y,
                           .advance = letter->advance,
                           .text = glyphs->text + begin,
                           .text_size = end - begin,
                           .line = letter->line + 1};
  CS_TRY(create_object(layout, letter->glyph, letter->glyph_count, &glyph->object));
  glyphs->count++;
  return CELSPAN_OK;
}

static celspan_status fill(cs_layout *layout, celspan_glyphs *glyphs) {
  if (layout->letter_count == 0)
    return CELSPAN_OK;
  uint32_t *order;
  CS_TRY(CS_MAKE(layout->context, order, layout->count));
  end_letters(layout, order);
  celspan_status status = CELSPAN_OK;
  for (size_t at = 0; at < layout->count && status == CELSPAN_OK; at++)
    if (order[at])
      status = add_glyph(layout, &layout->letters[order[at] - 1], glyphs);
  cs_mem_free(glyphs->memory, order, layout->count * sizeof *order);
  return status;
}

/* Glyphs with room for `capacity` of them, and a copy of the text. */
static celspan_status create_glyphs(celspan_context *context, const celspan_text_desc *desc,
                                    size_t capacity, celspan_glyphs **out) {
  celspan_glyphs *glyphs;
  CS_TRY(CS_MAKE(context, glyphs, 1));
  glyphs->memory = cs_memory_ref(context->memory);
  celspan_status status = CS_ARRAY_MAKE(context, glyphs->glyphs, capacity);
  if (status == CELSPAN_OK)
    status = CS_ARRAY_MAKE(context, glyphs->text, desc->text_size);
  if (status == CELSPAN_OK && desc->text_size > 0)
    memcpy(glyphs->text, desc->text, desc->text_size);
  return CS_GIVE(status, glyphs, celspan_glyphs_destroy, out);
}

static celspan_status make_glyphs(cs_layout *layout, celspan_glyphs **out) {
  celspan_glyphs *glyphs = NULL;
  CS_TRY(create_glyphs(layout->context, layout->desc, layout->letter_count, &glyphs));
  celspan_status status = fill(layout, glyphs);
  return CS_GIVE(status, glyphs, celspan_glyphs_destroy, out);
}

celspan_status celspan_glyphs_create(celspan_context *context, const celspan_text_desc *desc,
                                     celspan_glyphs **out) {
  CS_READ(context, "glyphs", celspan_text_desc, desc);
  cs_layout layout;
  celspan_status status = cs_typeset_make(&layout, context, "glyphs", desc);
  if (status == CELSPAN_OK)
    status = make_glyphs(&layout, out);
  cs_typeset_finish(&layout);
  return status;
}

size_t celspan_glyphs_count(const celspan_glyphs *glyphs) { return glyphs->count; }

const celspan_glyph *celspan_glyphs_get(const celspan_glyphs *glyphs, size_t index) {
  return &glyphs->glyphs[index];
}

void celspan_glyphs_destroy(celspan_glyphs *glyphs) {
  if (!glyphs)
    return;
  cs_memory *memory = glyphs->memory;
  for (size_t i = 0; i < glyphs->count; i++)
    celspan_object_unref(glyphs->glyphs[i].object);
  CS_ARRAYS_FREE(memory, glyphs, glyphs, text);
  cs_mem_free(memory, glyphs, sizeof *glyphs);
  cs_memory_unref(memory);
}
