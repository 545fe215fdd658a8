#include "readers/svg/document/reading.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "inside/colour.h"
#include "inside/geometry.h"
#include "inside/number.h"
#include "readers/svg/document/shapes.h"
#include "readers/svg/words/transforms.h"

celspan_status cs_svg_skip(cs_svg_reading *reading, const cs_svg_node *node, const char *format,
                           ...) {
  if (reading->skipped_count >= CS_SVG_SKIPPED)
    return CELSPAN_OK;
  CS_TRY(CS_ARRAY_RESERVE(reading->context, reading->skipped, reading->skipped_count + 1));
  cs_svg_skipped *entry = &reading->skipped[reading->skipped_count++];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(entry->what, sizeof entry->what, format, arguments);
  va_end(arguments);
  entry->line = node->line;
  return CELSPAN_OK;
}

celspan_status cs_svg_count_drawn(cs_svg_reading *reading, const cs_svg_node *node) {
  if (++reading->drawn <= CS_SVG_DRAWN)
    return CELSPAN_OK;
  return cs_fail(reading->context, CELSPAN_LIMIT, "line %u: more than %d elements are drawn",
                 node->line, CS_SVG_DRAWN);
}

bool cs_svg_is_open(const cs_svg_open *open, const cs_svg_node *node) {
  for (; open; open = open->outer)
    if (open->node == node)
      return true;
  return false;
}

const cs_svg_node *cs_svg_referred(const cs_svg_reading *reading, cs_svg_reference reference) {
  return reference.size > 0 ? cs_svg_document_find(reading->document, reference.id, reference.size)
                            : NULL;
}

const cs_svg_node *cs_svg_linked(const cs_svg_reading *reading, const cs_svg_node *node) {
  const char *href = cs_svg_node_value(node, CS_SVG_HREF);
  href = href ? cs_svg_skip_space(href) : "";
  size_t size = strcspn(href, " \t\r\n");
  return *href == '#' ? cs_svg_document_find(reading->document, href + 1, size - 1) : NULL;
}

/* ---------------------------------------------------------------- styles and transforms */

/* Recursion: at most as deep as the document, CS_SVG_DEPTH. */
celspan_status cs_svg_style_in_file(cs_svg_reading *reading, const cs_svg_node *node,
                                    cs_svg_style *out) {
  cs_svg_style above = cs_svg_style_initial();
  if (node->parent)
    CS_TRY(cs_svg_style_in_file(reading, node->parent, &above));
  return cs_svg_style_resolve(reading->context, reading->document, node, &above, &reading->tests,
                              out);
}

/* One value of transform-origin: a length, a percentage or a word. */
static double take_origin(const char **text, cs_svg_axis axis, const cs_svg_measure *measure) {
  static const struct {
    const char *word;
    double share;
  } words[] = {{"left", 0}, {"top", 0}, {"center", 0.5}, {"right", 1}, {"bottom", 1}};
  double size = axis == CS_SVG_AXIS_X ? measure->width : measure->height;
  cs_svg_length length;
  *text = cs_svg_skip_space(*text);
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (cs_svg_take_word(text, words[i].word))
      return words[i].share * size;
  return cs_svg_take_length(text, &length) ? cs_svg_resolve(length, axis, measure) : 0.5 * size;
}

static celspan_point origin_of(const char *text, const cs_svg_measure *measure) {
  text = cs_svg_skip_space(text);
  const char *at = text;
  bool begins_with_y = cs_svg_take_word(&at, "top") || cs_svg_take_word(&at, "bottom");
  celspan_point origin;
  if (begins_with_y) {
    origin.y = take_origin(&text, CS_SVG_AXIS_Y, measure);
    origin.x = take_origin(&text, CS_SVG_AXIS_X, measure);
  } else {
    origin.x = take_origin(&text, CS_SVG_AXIS_X, measure);
    origin.y = take_origin(&text, CS_SVG_AXIS_Y, measure);
  }
  return origin;
}

static celspan_matrix about(celspan_matrix matrix, celspan_point origin) {
  matrix = celspan_matrix_then(celspan_matrix_translation(-origin.x, -origin.y), matrix);
  return celspan_matrix_then(matrix, celspan_matrix_translation(origin.x, origin.y));
}

celspan_matrix cs_svg_about_origin(celspan_matrix matrix, const char *text,
                                   const cs_svg_measure *measure) {
  return about(matrix, origin_of(text, measure));
}

static bool has_transform(const cs_svg_style *style) {
  return style->transform || style->scale || style->rotate || style->translate ||
         style->offset.is_there;
}

/* Onto the path of the element, about its origin. Source: Motion Path Module Level 1, 4. */
static celspan_matrix offset_of(const cs_svg_style *style, const cs_svg_measure *measure,
                                const celspan_box *box) {
  const celspan_point none = {0, 0};
  celspan_point at = style->offset.at; /* in user units, also about the element's own box */
  at.x -= box ? box->x : 0;
  at.y -= box ? box->y : 0;
  const char *anchor = style->offset.anchor;
  celspan_point origin =
      style->transform_origin ? origin_of(style->transform_origin, measure) : none;
  celspan_point held = anchor ? origin_of(anchor, measure) : origin;
  celspan_matrix matrix = celspan_matrix_translation(origin.x - held.x, origin.y - held.y);
  matrix = celspan_matrix_then(matrix, cs_matrix_turn(style->offset.degrees, none));
  return celspan_matrix_then(matrix, celspan_matrix_translation(at.x - origin.x, at.y - origin.y));
}

/* Source: CSS Transforms Module Level 2, 7: the functions are applied first. */
celspan_matrix cs_svg_transform_of(const cs_svg_style *style, const cs_svg_measure *measure,
                                   const celspan_box *box) {
  celspan_matrix matrix = celspan_matrix_identity(), step;
  if (style->transform && cs_svg_parse_transform(style->transform, measure, &step))
    matrix = step;
  if (style->offset.is_there)
    matrix = celspan_matrix_then(matrix, offset_of(style, measure, box));
  if (style->scale && cs_svg_parse_scale(style->scale, &step))
    matrix = celspan_matrix_then(matrix, step);
  if (style->rotate && cs_svg_parse_rotate(style->rotate, &step))
    matrix = celspan_matrix_then(matrix, step);
  if (style->translate && cs_svg_parse_translate(style->translate, measure, &step))
    matrix = celspan_matrix_then(matrix, step);
  if (has_transform(style) && style->transform_origin)
    matrix = cs_svg_about_origin(matrix, style->transform_origin, measure);
  if (box)
    matrix = about(matrix, (celspan_point){box->x, box->y});
  return style->motion ? celspan_matrix_then(matrix, *style->motion) : matrix;
}

/* The box of an element, for a viewport of this size and what its texts inherit. It is kept,
 * because the boxes of the elements around it need it again. */
struct cs_svg_own_box {
  celspan_box box;
  double width, height, font_size;
  cs_svg_text_style text;
};

static bool is_box_for(const struct cs_svg_own_box *known, const cs_svg_place *place) {
  const cs_svg_text_style *a = &known->text, *b = &place->style.text;
  return known->width == place->measure.width && known->height == place->measure.height &&
         known->font_size == place->measure.font_size && a->font_family == b->font_family &&
         a->is_italic == b->is_italic && a->is_bold == b->is_bold &&
         a->letter_spacing == b->letter_spacing && a->word_spacing == b->word_spacing &&
         a->anchor == b->anchor && a->dominant == b->dominant && a->raised == b->raised &&
         a->is_leftward == b->is_leftward && a->is_preserved == b->is_preserved;
}

/* Measures an element at `place`, which has its style. */
static celspan_status own_box(cs_svg_reading *reading, const cs_svg_node *node,
                              const cs_svg_place *place, celspan_box *out) {
  const cs_svg_open open = {node, place->open};
  bool is_kept = !place->sizes, is_there = false;
  if (is_kept && node->box && is_box_for(node->box, place)) {
    *out = node->box->box;
    return CELSPAN_OK;
  }
  cs_svg_place own = *place;
  own.matrix = celspan_matrix_identity();
  own.open = &open;
  *out = (celspan_box){0};
  CS_TRY(reading->box_of(reading, node, &own, out, &is_there));
  if (!is_kept)
    return CELSPAN_OK;
  struct cs_svg_own_box *made =
      cs_arena_take(reading->context, &reading->document->arena, sizeof *made);
  if (!made)
    return CELSPAN_NO_MEMORY;
  *made = (struct cs_svg_own_box){*out, place->measure.width, place->measure.height,
                                  place->measure.font_size, place->style.text};
  ((cs_svg_node *)(size_t)node)->box = made;
  return CELSPAN_OK;
}

static celspan_status find_transform(cs_svg_reading *reading, const cs_svg_node *node,
                                     const cs_svg_place *place, celspan_matrix *out) {
  cs_svg_measure measure = place->measure;
  celspan_box box;
  if (!place->style.is_about_box || !has_transform(&place->style)) {
    *out = cs_svg_transform_of(&place->style, &measure, NULL);
    return CELSPAN_OK;
  }
  CS_TRY(own_box(reading, node, place, &box));
  measure.width = box.width;
  measure.height = box.height;
  *out = cs_svg_transform_of(&place->style, &measure, &box);
  return CELSPAN_OK;
}

celspan_status cs_svg_enter(cs_svg_reading *reading, const cs_svg_node *node, cs_svg_place *place) {
  const cs_svg_style above = place->style;
  CS_TRY(cs_svg_style_resolve(reading->context, reading->document, node, &above, &reading->tests,
                              &place->style));
  if (node->element == CS_SVG_ELEMENT_SYMBOL)
    place->style.transform = NULL; /* the same as in most renderers */
  place->measure.font_size = place->style.font_size;
  if (place->style.transform && cs_svg_is_unfit(place->style.transform))
    return cs_fail(reading->context, CELSPAN_INPUT, "line %u: transform is \"%.40s\"", node->line,
                   place->style.transform);
  celspan_matrix matrix;
  CS_TRY(find_transform(reading, node, place, &matrix));
  place->matrix = celspan_matrix_then(matrix, place->matrix);
  for (int i = 0; i < 9; i++)
    if (!cs_number_is_sane(place->matrix.m[i]))
      return cs_fail(reading->context, CELSPAN_INPUT,
                     "line %u: the transforms so far go beyond 1e12", node->line);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- colours */

celspan_paint cs_svg_paint_of(const cs_svg_reading *reading, const cs_svg_colour *colour,
                              double opacity) {
  float rgb[3];
  for (int c = 0; c < 3; c++) {
    rgb[c] = (float)cs_number_clamp(colour->rgb[c], 0, 1);
    if (!reading->is_coded)
      rgb[c] = cs_number_clampf(cs_transfer_decode(CELSPAN_TRANSFER_SRGB, rgb[c]), 0, 1);
  }
  return celspan_paint_rgb(rgb[0], rgb[1], rgb[2],
                           (float)cs_number_clamp(colour->alpha * opacity, 0, 1));
}

/* ---------------------------------------------------------------- images */

static cs_hash key_of(const void *element, bool is_coded) {
  cs_hash hash = cs_hash_begin(0x696d67u);
  cs_hash_word(&hash, (uint64_t)(uintptr_t)element);
  cs_hash_word(&hash, is_coded);
  return cs_hash_end(hash);
}

bool cs_svg_kept_image_find(const cs_svg_reading *reading, const void *element,
                            cs_svg_kept_image *out) {
  const cs_svg_kept_images *list = &reading->images;
  size_t place;
  if (!cs_hash_table_find(&list->places, key_of(element, reading->is_coded), &place))
    return false;
  *out = list->items[place];
  return true;
}

celspan_status cs_svg_kept_image_add(cs_svg_reading *reading, const void *element,
                                     cs_svg_kept_image image) {
  celspan_context *context = reading->context;
  cs_svg_kept_images *list = &reading->images;
  celspan_status status = CS_RESERVE(context, list->items, list->capacity, list->count + 1);
  if (status == CELSPAN_OK)
    status =
        cs_hash_table_add(&list->places, context, key_of(element, reading->is_coded), list->count);
  if (status == CELSPAN_OK)
    list->items[list->count++] = image;
  else
    celspan_object_unref(image.object);
  return status;
}

void cs_svg_kept_images_finish(cs_svg_kept_images *list, celspan_context *context) {
  for (size_t i = 0; i < list->count; i++)
    celspan_object_unref(list->items[i].object);
  cs_mem_free(context->memory, list->items, list->capacity * sizeof *list->items);
  cs_hash_table_finish(&list->places, context);
}
