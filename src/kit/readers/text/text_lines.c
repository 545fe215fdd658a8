/* Paragraphs cut into lines, and glyphs put into their places.
 *
 *      tracking after each letter, in the direction of its run
 *        v
 *   |H |e |l |l |o |_|        a line: from the left end of its leftmost letter to the right end of
 *    <------------->          the rightmost, without the spaces at its end
 */
#include "celspan/text.h"
#include "readers/text/layout.h"

#include <math.h>
#include <string.h>

#define HIDDEN_HYPHEN 0x00ad
/* By how much rounding may enlarge the advances of a line, as a share of the width. */
#define SLACK 1e-9
/* How often a line is shortened and shaped again because its new end made it longer than it was
 * measured. */
#define RETRIES 8

/* ---------------------------------------------------------------- measuring */

/* Whether a space is removed at the end of a line: all are, except those that keep words
 * together. */
static bool is_space(uint32_t c) {
  return c == ' ' || c == 0x1680 || (c >= 0x2000 && c <= 0x200a && c != 0x2007) || c == 0x205f ||
         c == 0x3000;
}

static size_t visible_end(const cs_layout *layout, size_t begin, size_t end) {
  while (end > begin && is_space(layout->characters[end - 1]))
    end--;
  return end;
}

static double scale_of(const cs_layout *layout, const cs_font *font) {
  return layout->desc->size / (double)font->info.units;
}

static double tracking_of(const cs_layout *layout) {
  return layout->desc->size * layout->desc->tracking / 1000;
}

/* The first glyph after the letter that begins with glyph `first`. */
static size_t letter_end(const cs_layout *layout, size_t first) {
  const cs_text_shaped *shaped = layout->shaped;
  size_t end = first + 1;
  while (end < layout->shaped_count && shaped[end].glyph.character == shaped[first].glyph.character)
    end++;
  return end;
}

static double letter_advance(const cs_layout *layout, size_t first, size_t end) {
  double advance = 0;
  for (size_t i = first; i < end; i++)
    advance += (double)layout->shaped[i].glyph.advance * scale_of(layout, layout->shaped[i].font);
  return advance;
}

/* Fills layout->advances for the characters that were just shaped. */
static void measure(cs_layout *layout, size_t begin, size_t end) {
  memset(layout->advances + begin, 0, (end - begin) * sizeof *layout->advances);
  for (size_t i = 0, next; i < layout->shaped_count; i = next) {
    next = letter_end(layout, i);
    layout->advances[layout->shaped[i].glyph.character] =
        letter_advance(layout, i, next) + tracking_of(layout);
  }
}

/* ---------------------------------------------------------------- placing */

typedef struct extent {
  double left, right;
} extent;

/* Places a letter, whose glyphs have been shaped, at *x, and moves *x to its end. */
static celspan_status place_letter(cs_layout *layout, size_t first, size_t end, double *x) {
  celspan_context *context = layout->context;
  CS_TRY(CS_ARRAY_RESERVE(context, layout->letters, layout->letter_count + 1));
  CS_TRY(CS_ARRAY_RESERVE(context, layout->glyphs, layout->glyph_count + (end - first)));
  cs_text_letter *letter = &layout->letters[layout->letter_count++];
  *letter = (cs_text_letter){.begin = layout->shaped[first].glyph.character,
                             .glyph = layout->glyph_count,
                             .glyph_count = end - first,
                             .x = *x,
                             .line = layout->line};
  for (size_t i = first; i < end; i++) {
    const cs_text_shaped *shaped = &layout->shaped[i];
    double scale = scale_of(layout, shaped->font);
    layout->glyphs[layout->glyph_count++] =
        (cs_text_glyph){shaped->font, shaped->glyph.glyph,
                        *x + (letter->advance + (double)shaped->glyph.x_offset * scale),
                        -(double)shaped->glyph.y_offset * scale};
    letter->advance += (double)shaped->glyph.advance * scale;
  }
  *x += letter->advance;
  return CELSPAN_OK;
}

/* Places the shaped glyphs side by side from 0 on. visible: where the spaces at the end of the line
 * begin. */
static celspan_status place_letters(cs_layout *layout, size_t visible, extent *out) {
  double x = 0, tracking = tracking_of(layout);
  *out = (extent){HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0, next; i < layout->shaped_count; i = next) {
    next = letter_end(layout, i);
    bool is_leftward = layout->shaped[i].is_leftward;
    x += is_leftward ? tracking : 0;
    CS_TRY(place_letter(layout, i, next, &x));
    const cs_text_letter *letter = &layout->letters[layout->letter_count - 1];
    if (letter->begin < visible) {
      out->left = fmin(out->left, letter->x);
      out->right = fmax(out->right, letter->x + letter->advance);
    }
    x += is_leftward ? 0 : tracking;
  }
  if (out->left > out->right)
    *out = (extent){0, 0};
  return CELSPAN_OK;
}

/* How far a line with this extent must be moved. */
static double alignment(const celspan_text_desc *desc, extent line) {
  double left = desc->at.x, right = desc->at.x + (desc->has_width ? desc->width : 0);
  if (desc->align == CELSPAN_ALIGN_LEFT)
    return left - line.left;
  if (desc->align == CELSPAN_ALIGN_RIGHT)
    return right - line.right;
  return 0.5 * (left + right) - 0.5 * (line.left + line.right);
}

static void move_line(cs_layout *layout, size_t letter, size_t glyph, double dx) {
  const celspan_text_desc *desc = layout->desc;
  double baseline = desc->at.y + layout->line * desc->leading * desc->size;
  for (; letter < layout->letter_count; letter++) {
    layout->letters[letter].x += dx;
    layout->letters[letter].y = baseline;
  }
  for (; glyph < layout->glyph_count; glyph++) {
    layout->glyphs[glyph].x += dx;
    layout->glyphs[glyph].y += baseline;
  }
}

/* ---------------------------------------------------------------- lines */

/* Shapes characters as a separate line. A soft hyphen at its end becomes a hyphen. */
static celspan_status shape_line(cs_layout *layout, uint8_t base, size_t begin, size_t end) {
  if (end > begin)
    memcpy(layout->directions + begin, layout->embeddings + begin, end - begin);
  if (layout->type->end_line(layout->characters, begin, end, base, layout->directions) !=
      CELSPAN_OK)
    return cs_fail_memory(layout->context);
  size_t visible = visible_end(layout, begin, end);
  bool is_hyphenated = visible > begin && layout->characters[visible - 1] == HIDDEN_HYPHEN;
  if (is_hyphenated)
    layout->characters[visible - 1] = '-';
  celspan_status status = cs_shaping_make(layout, begin, end);
  if (is_hyphenated)
    layout->characters[visible - 1] = HIDDEN_HYPHEN;
  return status;
}

/* Where a line that begins at `begin` ends at the latest: after all words that fit, and at least
 * one. limit: the first character that is too far right to be in the line. */
static size_t fitting_end(const cs_layout *layout, size_t begin, size_t limit, size_t end) {
  double most = layout->desc->width * (1 + SLACK) + tracking_of(layout), x = 0, visible = 0;
  size_t found = begin;
  for (size_t i = begin; i < end; i++) {
    x += layout->advances[i];
    visible = is_space(layout->characters[i]) ? visible : x;
    if (i + 1 < end && layout->breaks[i] == CS_TYPE_NO_BREAK)
      continue;
    if (found > begin && (visible > most || i + 1 >= limit))
      break;
    found = i + 1;
  }
  return found;
}

static celspan_status add_line(cs_layout *layout, size_t begin, size_t end, double *width) {
  size_t letter = layout->letter_count, glyph = layout->glyph_count;
  extent line;
  CS_TRY(place_letters(layout, visible_end(layout, begin, end), &line));
  *width = line.right - line.left;
  move_line(layout, letter, glyph, alignment(layout->desc, line));
  return CELSPAN_OK;
}

static void end_line(cs_layout *layout, double width) {
  layout->width = fmax(layout->width, width);
  layout->line++;
}

/* Adds the next line of a paragraph that wraps. *at: the first character of this line; then the
 * first character of the next line. A break may change the measures, because it separates joined
 * letters. */
static celspan_status wrap_line(cs_layout *layout, uint8_t base, size_t *at, size_t end) {
  size_t letter = layout->letter_count, glyph = layout->glyph_count, limit = end + 1;
  for (int retry = 0;; retry++) {
    size_t last = fitting_end(layout, *at, limit, end);
    CS_TRY(shape_line(layout, base, *at, last));
    layout->letter_count = letter;
    layout->glyph_count = glyph;
    double width;
    CS_TRY(add_line(layout, *at, last, &width));
    bool is_short = width <= layout->desc->width * (1 + SLACK);
    if (is_short || retry == RETRIES || fitting_end(layout, *at, last, end) >= last) {
      end_line(layout, width);
      *at = last;
      return CELSPAN_OK;
    }
    limit = last;
  }
}

/* Marks, digits and punctuation have the script of the letters before them; if there are none, the
 * script of the first letter after them. */
static void resolve_scripts(cs_layout *layout, size_t begin, size_t end) {
  uint32_t *scripts = layout->scripts, script = CS_TYPE_COMMON;
  size_t first = end;
  for (size_t i = begin; i < end; i++) {
    bool is_own = scripts[i] != CS_TYPE_COMMON && scripts[i] != CS_TYPE_INHERITED &&
                  scripts[i] != CS_TYPE_UNKNOWN;
    first = is_own && first == end ? i : first;
    script = is_own ? scripts[i] : script;
    scripts[i] = script;
  }
  for (size_t i = begin; i < first && first < end; i++)
    scripts[i] = scripts[first];
}

celspan_status cs_lines_add_paragraph(cs_layout *layout, size_t begin, size_t end) {
  const celspan_text_desc *desc = layout->desc;
  const uint32_t *characters = layout->characters + begin;
  uint8_t base;
  if (layout->type->embeddings(characters, end - begin, desc->direction, layout->embeddings + begin,
                               &base) != CELSPAN_OK)
    return cs_fail_memory(layout->context);
  layout->type->scripts(characters, end - begin, layout->scripts + begin);
  resolve_scripts(layout, begin, end);
  CS_TRY(shape_line(layout, base, begin, end));
  double width;
  if (!desc->has_width || begin == end) {
    CS_TRY(add_line(layout, begin, end, &width));
    end_line(layout, width);
    return CELSPAN_OK;
  }
  measure(layout, begin, end);
  if (layout->type->breaks(characters, end - begin, desc->language, layout->breaks + begin) !=
      CELSPAN_OK)
    return cs_fail_memory(layout->context);
  while (begin < end)
    CS_TRY(wrap_line(layout, base, &begin, end));
  return CELSPAN_OK;
}
