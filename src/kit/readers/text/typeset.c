/* The checked settings of a text, with its fonts, characters and paragraphs, before the text is
 * shaped. */
#include "readers/text/layout.h"

#include <string.h>

#include "celspan/text.h"
#include "inside/scene.h"
#include "readers/text/utf8.h"

#define LANGUAGE_BYTES 64

/* ---------------------------------------------------------------- what is asked for */

static celspan_status check_numbers(celspan_context *context, const char *noun,
                                    const celspan_text_desc *desc) {
  CS_TRY(cs_check_size(context, noun, "size", desc->size));
  CS_TRY(cs_check_point(context, noun, "at", 0, desc->at));
  CS_TRY(cs_check_number(context, noun, "leading", desc->leading));
  CS_TRY(cs_check_number(context, noun, "tracking", desc->tracking));
  if (desc->has_width)
    CS_TRY(cs_check_size(context, noun, "width", desc->width));
  CS_TRY(cs_check_choice(context, noun, "align", (unsigned)desc->align, CELSPAN_ALIGN_RIGHT + 1));
  CS_TRY(
      cs_check_choice(context, noun, "valign", (unsigned)desc->valign, CELSPAN_VALIGN_BOTTOM + 1));
  return cs_check_choice(context, noun, "direction", (unsigned)desc->direction,
                         CELSPAN_DIRECTION_RTL + 1);
}

/* A tag of a font is four printable characters of ASCII; the last ones may be blanks. */
static celspan_status check_tag(celspan_context *context, const char *noun, const char *field,
                                const char *tag) {
  size_t length = tag ? strnlen(tag, 5) : 0;
  bool is_good = length == 4 && tag[0] != ' ';
  for (size_t i = 0; i < length && is_good; i++)
    is_good = tag[i] >= ' ' && tag[i] <= '~';
  if (is_good)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "%s: the names of %s are four letters or digits, such as \"%s\", got \"%.32s\"",
                 noun, field, field[0] == 'f' ? "liga" : "wght", tag ? tag : "");
}

static celspan_status check_settings(celspan_context *context, const char *noun,
                                     const celspan_text_desc *desc) {
  CS_TRY(cs_check_list(context, noun, "features", desc->features, desc->feature_count,
                       CS_TEXT_SETTINGS));
  for (size_t i = 0; i < desc->feature_count; i++)
    CS_TRY(check_tag(context, noun, "features", desc->features[i].tag));
  CS_TRY(cs_check_list(context, noun, "variations", desc->variations, desc->variation_count,
                       CS_TEXT_SETTINGS));
  for (size_t i = 0; i < desc->variation_count; i++) {
    CS_TRY(check_tag(context, noun, "variations", desc->variations[i].tag));
    CS_TRY(cs_check_range(context, noun, desc->variations[i].tag, desc->variations[i].value, -1e6,
                          1e6));
  }
  return CELSPAN_OK;
}

static celspan_status check_language(celspan_context *context, const char *noun,
                                     const char *language) {
  size_t length = language ? strnlen(language, LANGUAGE_BYTES) : 0;
  bool is_good = !language || (length > 0 && length < LANGUAGE_BYTES);
  for (size_t i = 0; i < length && is_good; i++) {
    char c = language[i];
    is_good =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
  }
  if (is_good)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "%s: language is a tag such as \"en\" or \"zh-Hant\", got \"%.32s\"", noun,
                 language);
}

static celspan_status check(celspan_context *context, const char *noun,
                            const celspan_text_desc *desc) {
  CS_TRY(check_numbers(context, noun, desc));
  CS_TRY(check_settings(context, noun, desc));
  CS_TRY(check_language(context, noun, desc->language));
  if (desc->text_size > 0)
    CS_TRY(cs_check_given(context, noun, "text", desc->text));
  if (desc->font_count == 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "%s: font is missing: give the file of a font",
                   noun);
  CS_TRY(cs_check_list(context, noun, "fonts", desc->fonts, desc->font_count, CS_TEXT_FONTS));
  for (size_t i = 0; i < desc->font_count; i++)
    CS_TRY(cs_check_given(context, noun, "font", desc->fonts[i]));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- fonts */

static celspan_status acquire_fonts(cs_layout *layout) {
  const celspan_text_desc *desc = layout->desc;
  bool is_one = desc->font_count == 1;
  uint64_t known = 0;
  for (size_t i = 0; i < desc->font_count; i++) {
    CS_TRY(cs_font_acquire(layout->context, desc, i, &layout->fonts[i]));
    layout->font_count = i + 1;
    known |= layout->fonts[i]->info.variation;
  }
  for (size_t i = 0; i < desc->variation_count; i++)
    if (!(known >> i & 1))
      return cs_fail(layout->context, CELSPAN_BAD_ARGUMENT, "%s: %s has %s axis \"%s\"",
                     layout->noun, is_one ? desc->fonts[0] : "none of the fonts",
                     is_one ? "no" : "an", desc->variations[i].tag);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- characters */

static celspan_status make_room(cs_layout *layout) {
  celspan_context *context = layout->context;
  /* so that memory is allocated even for an empty text */
  size_t room = layout->desc->text_size + 1;
  CS_TRY(CS_ARRAY_MAKE(context, layout->characters, room));
  CS_TRY(CS_ARRAY_MAKE(context, layout->places, room));
  CS_TRY(CS_ARRAY_MAKE(context, layout->scripts, room));
  CS_TRY(CS_ARRAY_MAKE(context, layout->embeddings, room));
  CS_TRY(CS_ARRAY_MAKE(context, layout->directions, room));
  CS_TRY(CS_ARRAY_MAKE(context, layout->breaks, room));
  return CS_ARRAY_MAKE(context, layout->advances, room);
}

static celspan_status read_characters(cs_layout *layout) {
  celspan_context *context = layout->context;
  const celspan_text_desc *desc = layout->desc;
  size_t most = CS_TEXT_CHARACTERS;
  /* A character has at most four bytes, so a text with more bytes is too long, and need not be
   * counted. */
  if (desc->text_size <= 4 * most) {
    CS_TRY(make_room(layout));
    CS_TRY(cs_utf8_decode(context, layout->noun, desc->text, desc->text_size, layout->characters,
                          layout->places, &layout->count));
  }
  if (desc->text_size > 4 * most || layout->count > most)
    return cs_fail(context, CELSPAN_LIMIT,
                   "%s: the text has more than %zu characters; split it into several texts",
                   layout->noun, most);
  return CELSPAN_OK;
}

static bool ends_line(uint32_t character) {
  return character == '\n' || character == 0x2028 || character == 0x2029;
}

static celspan_status add_paragraphs(cs_layout *layout) {
  for (size_t begin = 0; begin <= layout->count;) {
    size_t end = begin;
    while (end < layout->count && !ends_line(layout->characters[end]))
      end++;
    CS_TRY(cs_lines_add_paragraph(layout, begin, end));
    begin = end + 1;
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- heights */

celspan_text_metrics cs_typeset_measure(const cs_layout *layout) {
  const cs_type_font_info *info = &layout->fonts[0]->info;
  double size = layout->desc->size, unit = size / info->units;
  celspan_text_metrics metrics = {.ascent = unit * info->ascent,
                                  .descent = unit * info->descent,
                                  .cap_height = unit * info->cap_height,
                                  .x_height = unit * info->x_height,
                                  .width = layout->width,
                                  .lines = layout->line};
  metrics.height =
      metrics.ascent + (layout->line - 1) * layout->desc->leading * size + metrics.descent;
  return metrics;
}

/* The distance from at.y down to the first baseline. */
static double drop(const cs_layout *layout) {
  celspan_text_metrics metrics = cs_typeset_measure(layout);
  switch (layout->desc->valign) {
  case CELSPAN_VALIGN_TOP:
    return metrics.ascent;
  case CELSPAN_VALIGN_CAP:
    return metrics.cap_height;
  case CELSPAN_VALIGN_MIDDLE:
    return metrics.ascent - 0.5 * metrics.height;
  case CELSPAN_VALIGN_BOTTOM:
    return metrics.ascent - metrics.height;
  default:
    return 0;
  }
}

static void align_vertically(cs_layout *layout) {
  double dy = drop(layout);
  for (size_t i = 0; i < layout->letter_count; i++)
    layout->letters[i].y += dy;
  for (size_t i = 0; i < layout->glyph_count; i++)
    layout->glyphs[i].y += dy;
}

/* ---------------------------------------------------------------- the layout */

celspan_status cs_typeset_make(cs_layout *layout, celspan_context *context, const char *noun,
                               const celspan_text_desc *desc) {
  *layout = (cs_layout){.context = context, .noun = noun, .desc = desc};
  CS_TRY(check(context, noun, desc));
  CS_TRY(acquire_fonts(layout));
  layout->type = layout->fonts[0]->type;
  CS_TRY(read_characters(layout));
  CS_TRY(add_paragraphs(layout));
  align_vertically(layout);
  return CELSPAN_OK;
}

void cs_typeset_finish(cs_layout *layout) {
  celspan_texture_unref(layout->fitted);
  for (size_t i = 0; i < layout->font_count; i++)
    cs_font_release(layout->context, layout->fonts[i]);
  CS_ARRAYS_FREE(layout->context->memory, layout, characters, letters);
}
