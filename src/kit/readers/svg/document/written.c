#include "readers/svg/document/written.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "inside/number.h"
#include "readers/svg/document/shapes.h"
#include "readers/svg/document/shown.h"
#include "readers/text/layout.h"

/* ---------------------------------------------------------------- the lines of texts */

/* The line in the units of the element that refers to it. */
static celspan_status read_line(cs_svg_reading *reading, const cs_svg_node *path,
                                const cs_svg_measure *measure, bool is_placed,
                                cs_svg_text_path *out) {
  cs_svg_style style;
  cs_svg_line line;
  CS_TRY(cs_svg_style_in_file(reading, path, &style));
  const celspan_matrix matrix =
      is_placed ? cs_svg_transform_of(&style, measure, NULL) : celspan_matrix_identity();
  celspan_status status = cs_svg_line_init(reading->context, path, measure, &line);
  if (status == CELSPAN_OK && cs_svg_outline_map(&line.outline, &matrix)) {
    out->way.outline = line.outline;
    cs_outline_init(&line.outline);
  }
  cs_svg_line_finish(&line, reading->context);
  return status;
}

/* Percentages refer to the length of the line. Numbers are units; the path may say how many units
 * it is long. */
static celspan_status read_start(cs_svg_reading *reading, const cs_svg_node *node,
                                 const cs_svg_node *path, const cs_svg_place *place,
                                 cs_svg_text_path *out) {
  const cs_svg_length none = {0, CS_SVG_UNIT_NUMBER};
  cs_svg_measure measure = place->measure;
  double declared; /* the length that the path declares */
  CS_TRY(cs_svg_number_of(reading->context, path, CS_SVG_PATH_LENGTH, CS_SVG_AXIS_BOTH, &measure,
                          &declared));
  measure.width = declared > 0 ? declared : out->way.length;
  CS_TRY(cs_svg_length_of(reading->context, node, CS_SVG_START_OFFSET, CS_SVG_AXIS_X, &measure,
                          none, &out->start));
  out->start *= out->way.length / measure.width;
  return CELSPAN_OK;
}

celspan_status cs_svg_text_path_of(cs_svg_reading *reading, const cs_svg_node *path,
                                   const cs_svg_measure *measure, bool is_placed,
                                   cs_svg_text_path *out) {
  *out = (cs_svg_text_path){.begin = 0};
  cs_outline_init(&out->way.outline);
  if (!path || !cs_svg_is_shape(path))
    return CELSPAN_OK;
  CS_TRY(read_line(reading, path, measure, is_placed, out));
  return cs_svg_way_measure(reading->context, &out->way);
}

celspan_status cs_svg_text_path_make(cs_svg_reading *reading, const cs_svg_node *node,
                                     const cs_svg_place *place, cs_svg_text_path *out,
                                     bool *is_there) {
  *is_there = false;
  const cs_svg_node *path = cs_svg_linked(reading, node);
  CS_TRY(cs_svg_text_path_of(reading, path, &place->measure, true, out));
  *is_there = out->way.length > 0 && cs_number_is_sane(out->way.length);
  if (*is_there)
    CS_TRY(read_start(reading, node, path, place, out));
  return CELSPAN_OK;
}

void cs_svg_text_path_finish(cs_svg_text_path *path, cs_memory *memory) {
  cs_svg_way_finish(&path->way, memory);
}

/* ---------------------------------------------------------------- characters */

static celspan_status append_character(cs_svg_written *w, const char *bytes, size_t size) {
  celspan_context *context = w->reading->context;
  if (w->count == CS_TEXT_CHARACTERS) {
    w->is_too_long = true;
    return CELSPAN_OK;
  }
  CS_TRY(CS_ARRAY_RESERVE(context, w->bytes, w->size + size));
  CS_TRY(CS_ARRAY_APPEND(context, w->characters, w->count,
                         (cs_svg_character){(uint32_t)w->size, NAN, NAN, NAN, NAN, NAN}));
  memcpy(w->bytes + w->size, bytes, size);
  w->size += size;
  return CELSPAN_OK;
}

/* The bytes of the first character of a text: expat gives well-formed UTF-8. */
static size_t character_size(const char *text) {
  size_t size = 1;
  while (((unsigned char)text[size] & 0xc0) == 0x80)
    size++;
  return size;
}

/* Ends of lines and control characters count as spaces: DEL, U+0080 to U+009F, U+2028 and
 * U+2029. */
static bool is_space(const char *text) {
  const unsigned char *at = (const unsigned char *)text;
  return at[0] <= ' ' || at[0] == 0x7f || (at[0] == 0xc2 && at[1] < 0xa0) ||
         (at[0] == 0xe2 && at[1] == 0x80 && (at[2] == 0xa8 || at[2] == 0xa9));
}

/* Source: CSS Text Module Level 3, 4.1.1: spaces after another one collapse, also between elements.
 */
static celspan_status add_characters(cs_svg_written *w, const char *text, bool is_preserved) {
  for (size_t size; *text && !w->is_too_long; text += size) {
    size = character_size(text);
    bool is_blank = is_space(text), collapses = is_blank && !is_preserved;
    if (collapses && w->ends_in_space)
      continue;
    w->ends_in_space = collapses;
    CS_TRY(append_character(w, is_blank ? " " : text, is_blank ? 1 : size));
  }
  return CELSPAN_OK;
}

static celspan_status add_text_node(cs_svg_written *w, const cs_svg_node *node,
                                    const cs_svg_place *place) {
  size_t begin = w->count;
  CS_TRY(add_characters(w, node->text, place->style.text.is_preserved));
  if (w->count == begin)
    return CELSPAN_OK;
  return CS_ARRAY_APPEND(w->reading->context, w->nodes, w->node_count,
                         (cs_svg_text_node){node, *place, begin, w->count});
}

/* ---------------------------------------------------------------- what is said of them */

static celspan_status fail_unfit(cs_svg_written *w, const cs_svg_node *node, cs_svg_name name,
                                 const char *value) {
  return cs_fail(w->reading->context, CELSPAN_INPUT,
                 "line %u: %s is \"%.40s\"; it must be finite numbers within 1e12", node->line,
                 cs_svg_name_text(name), value);
}

/* The number at `offset` of a character. */
static double *value_of(cs_svg_written *w, size_t i, size_t offset) {
  return (double *)((char *)&w->characters[i] + offset);
}

/* Gives the values of a list to the characters from `begin` on that have no value yet: the values
 * of inner elements win. The last value of a rotation is also used for all remaining characters. */
static celspan_status give_list(cs_svg_written *w, const cs_svg_node *node, cs_svg_name name,
                                size_t offset, cs_svg_axis axis, const cs_svg_measure *measure,
                                size_t begin) {
  const char *at = cs_svg_node_value(node, name);
  double value = NAN;
  for (size_t i = begin; at && i < w->count; i++) {
    cs_svg_length length;
    at = i == begin ? cs_svg_skip_space(at) : cs_svg_skip_comma(at);
    bool is_taken = cs_svg_take_length(&at, &length);
    if (!is_taken && cs_svg_is_unfit(at))
      return fail_unfit(w, node, name, at);
    if (!is_taken && name != CS_SVG_ROTATE)
      break;
    value = is_taken ? cs_svg_resolve(length, axis, measure) : value;
    if (is_taken && !cs_number_is_sane(value))
      return fail_unfit(w, node, name, at);
    if (isnan(*value_of(w, i, offset)))
      *value_of(w, i, offset) = value;
  }
  return CELSPAN_OK;
}

static celspan_status add_length(cs_svg_written *w, const cs_svg_node *node,
                                 const cs_svg_measure *measure, size_t begin) {
  const cs_svg_length none = {-1, CS_SVG_UNIT_NUMBER};
  double length;
  CS_TRY(cs_svg_length_of(w->reading->context, node, CS_SVG_TEXT_LENGTH, CS_SVG_AXIS_X, measure,
                          none, &length));
  if (length < 0 || w->count == begin)
    return CELSPAN_OK;
  if (w->length_count == CS_SVG_TEXT_LENGTHS)
    return cs_svg_skip(w->reading, node, "textLength: a text has more than %d",
                       CS_SVG_TEXT_LENGTHS);
  w->lengths[w->length_count++] = (cs_svg_text_length){
      begin, w->count, length, cs_svg_node_says(node, CS_SVG_LENGTH_ADJUST, "spacingAndGlyphs")};
  return CELSPAN_OK;
}

static celspan_status give_values(cs_svg_written *w, const cs_svg_node *node,
                                  const cs_svg_measure *measure, size_t begin) {
  static const struct {
    cs_svg_name name;
    size_t offset;
    cs_svg_axis axis;
  } lists[] = {{CS_SVG_X, offsetof(cs_svg_character, x), CS_SVG_AXIS_X},
               {CS_SVG_Y, offsetof(cs_svg_character, y), CS_SVG_AXIS_Y},
               {CS_SVG_DX, offsetof(cs_svg_character, dx), CS_SVG_AXIS_X},
               {CS_SVG_DY, offsetof(cs_svg_character, dy), CS_SVG_AXIS_Y},
               {CS_SVG_ROTATE, offsetof(cs_svg_character, rotate), CS_SVG_AXIS_X}};
  for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
    CS_TRY(give_list(w, node, lists[i].name, lists[i].offset, lists[i].axis, measure, begin));
  return add_length(w, node, measure, begin);
}

/* ---------------------------------------------------------------- elements */

/* Adds the contents of an element that was entered. Recursion: CS_SVG_DEPTH. */
static celspan_status add_content(cs_svg_written *w, const cs_svg_node *node,
                                  const cs_svg_place *place);

/* Notes properties that only affect a text as a whole. */
static celspan_status note_effects(cs_svg_written *w, const cs_svg_node *node,
                                   const cs_svg_style *style) {
  const struct {
    bool is_given;
    const char *name;
  } effects[] = {{style->has_clip_path, "clip-path"},
                 {style->has_mask, "mask"},
                 {style->filter, "filter"},
                 {style->blend != CELSPAN_BLEND_NORMAL, "mix-blend-mode"}};
  for (size_t i = 0; i < sizeof effects / sizeof *effects; i++)
    if (effects[i].is_given)
      CS_TRY(cs_svg_skip(w->reading, node, "%s of %.40s", effects[i].name, node->tag));
  return CELSPAN_OK;
}

static celspan_status add_inner(cs_svg_written *w, const cs_svg_node *node, cs_svg_place place) {
  CS_TRY(cs_svg_enter(w->reading, node, &place));
  CS_TRY(note_effects(w, node, &place.style));
  return place.style.is_displayed ? add_content(w, node, &place) : CELSPAN_OK;
}

/* Along a line that does not exist, nothing is drawn. */
static celspan_status add_path(cs_svg_written *w, const cs_svg_node *node,
                               const cs_svg_place *place) {
  bool is_there;
  if (w->path_count == CS_SVG_TEXT_PATHS)
    return cs_svg_skip(w->reading, node, "textPath: a text has more than %d", CS_SVG_TEXT_PATHS);
  if (cs_svg_node_says(node, CS_SVG_SIDE, "right"))
    CS_TRY(cs_svg_skip(w->reading, node, "side of textPath"));
  cs_svg_text_path *path = &w->paths[w->path_count++];
  const size_t begin = w->count;
  CS_TRY(cs_svg_text_path_make(w->reading, node, place, path, &is_there));
  if (is_there)
    CS_TRY(add_inner(w, node, *place));
  else
    CS_TRY(cs_svg_skip(w->reading, node, "textPath without a path"));
  path->begin = begin;
  path->end = w->count;
  if (path->begin == path->end)
    cs_svg_text_path_finish(&w->paths[--w->path_count], w->reading->context->memory);
  return CELSPAN_OK;
}

static celspan_status add_child(cs_svg_written *w, const cs_svg_node *node,
                                const cs_svg_place *place) {
  switch (node->element) {
  case CS_SVG_ELEMENT_CHARACTERS:
    return add_text_node(w, node, place);
  case CS_SVG_ELEMENT_TSPAN:
  case CS_SVG_ELEMENT_A:
    return cs_svg_is_shown(node, NULL) ? add_inner(w, node, *place) : CELSPAN_OK;
  case CS_SVG_ELEMENT_TEXT_PATH:
    return cs_svg_is_shown(node, NULL) ? add_path(w, node, place) : CELSPAN_OK;
  case CS_SVG_ELEMENT_TITLE:
  case CS_SVG_ELEMENT_DESC:
    return CELSPAN_OK;
  default:
    return node->element == CS_SVG_ELEMENT_OTHER /* this was noted when it was read */
               ? CELSPAN_OK
               : cs_svg_skip(w->reading, node, "%.40s in text", node->tag);
  }
}

static celspan_status add_content(cs_svg_written *w, const cs_svg_node *node,
                                  const cs_svg_place *place) {
  size_t begin = w->count;
  for (const cs_svg_node *child = node->first; child; child = child->next)
    CS_TRY(add_child(w, child, place));
  return give_values(w, node, &place->measure, begin);
}

/* Removes the space at the end of a text, because it is not shown. */
static void drop_last(cs_svg_written *w) {
  w->count--;
  w->size = w->characters[w->count].byte;
  for (size_t i = 0; i < w->length_count; i++)
    w->lengths[i].end = w->lengths[i].end > w->count ? w->count : w->lengths[i].end;
  cs_svg_text_path *path = w->path_count > 0 ? &w->paths[w->path_count - 1] : NULL;
  if (path && path->end > w->count)
    path->end = w->count;
  if (path && path->begin == path->end)
    cs_svg_text_path_finish(&w->paths[--w->path_count], w->reading->context->memory);
  cs_svg_text_node *last = &w->nodes[w->node_count - 1];
  last->end = w->count;
  if (last->begin == last->end)
    w->node_count--;
}

/* Along a line, x is counted from the place where its first letter begins, and y from the line.
 * After it, the text continues at the line's end, or along the next line. */
static void enter_paths(cs_svg_written *w) {
  for (size_t i = 0; i < w->path_count; i++) {
    const cs_svg_text_path *path = &w->paths[i];
    cs_svg_character *first = &w->characters[path->begin], *behind = &w->characters[path->end];
    double degrees;
    const celspan_point end = cs_svg_way_at(&path->way, path->way.length, &degrees);
    for (size_t k = path->begin; k < path->end; k++) {
      w->characters[k].x += path->start;
      w->characters[k].y = NAN;
    }
    first->x = isnan(first->x) ? path->start : first->x;
    first->y = 0;
    bool is_last = i + 1 == w->path_count || w->paths[i + 1].begin > path->end;
    if (path->end < w->count && is_last) {
      behind->x = isnan(behind->x) ? end.x : behind->x;
      behind->y = isnan(behind->y) ? end.y : behind->y;
    }
  }
}

celspan_status cs_svg_written_read(cs_svg_reading *reading, const cs_svg_node *node,
                                   const cs_svg_place *place, cs_svg_written *out) {
  *out = (cs_svg_written){.reading = reading, .ends_in_space = true};
  CS_TRY(add_content(out, node, place));
  if (out->count > 0 && out->ends_in_space)
    drop_last(out);
  enter_paths(out);
  return CELSPAN_OK;
}

void cs_svg_written_finish(cs_svg_written *w) {
  cs_memory *memory = w->reading->context->memory;
  for (size_t i = 0; i < w->path_count; i++)
    cs_svg_text_path_finish(&w->paths[i], memory);
  CS_ARRAYS_FREE(memory, w, bytes, nodes);
}
