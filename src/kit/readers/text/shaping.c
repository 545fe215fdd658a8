/* A line's characters as glyphs: its runs shaped one by one, each letter by the first font that has
 * it.
 *
 *   first font    A ? ? C ?      glyphs that are missing
 *   second font     b ?   E      a letter is taken from one font, with its marks
 *   third font        d
 */
#include "readers/text/layout.h"

#include <string.h>

#include "celspan/text.h"
#include "readers/text/runs.h"
#include "readers/text/utf8.h"

#define GLYPHS ((size_t)1 << 20)

/* ---------------------------------------------------------------- shaping a run */

typedef struct shaping {
  cs_layout *layout;
  size_t line_begin, line_end;
  const cs_text_run *run;
} shaping;

/* Glyphs that one font has made for a part of a run, before the next font replaces missing
 * glyphs. */
typedef struct part {
  shaping *shaping;
  size_t begin, end;
  size_t font;
  celspan_status status;
} part;

static bool take(void *user, const cs_type_glyph *glyph) {
  part *p = user;
  cs_layout *layout = p->shaping->layout;
  if (layout->shaped_count == GLYPHS) {
    p->status = cs_fail(layout->context, CELSPAN_LIMIT, "%s: a line of more than %zu glyphs",
                        layout->noun, GLYPHS);
    return false;
  }
  p->status = CS_ARRAY_RESERVE(layout->context, layout->shaped, layout->shaped_count + 1);
  if (p->status != CELSPAN_OK)
    return false;
  cs_text_shaped *shaped = &layout->shaped[layout->shaped_count++];
  *shaped = (cs_text_shaped){layout->fonts[p->font], *glyph, p->shaping->run->embedding & 1};
  shaped->glyph.character += (uint32_t)p->shaping->line_begin;
  return true;
}

static celspan_status shape_part(part *p) {
  const shaping *s = p->shaping;
  cs_layout *layout = s->layout;
  const celspan_text_desc *desc = layout->desc;
  const cs_type_run wanted = {.characters = layout->characters + s->line_begin,
                              .count = s->line_end - s->line_begin,
                              .begin = p->begin - s->line_begin,
                              .end = p->end - s->line_begin,
                              .script = layout->scripts[p->begin],
                              .is_leftward = s->run->embedding & 1,
                              .language = desc->language,
                              .features = desc->features,
                              .feature_count = desc->feature_count};
  p->status = CELSPAN_OK;
  celspan_status status = layout->type->shape(layout->fonts[p->font]->font, &wanted, take, p);
  CS_TRY(p->status);
  return status == CELSPAN_OK ? CELSPAN_OK : cs_fail_memory(layout->context);
}

/* ---------------------------------------------------------------- other fonts */

/* The first character of the part that no font has. If each character has a font, but the
 * characters of a letter do not share one, the first character. */
static size_t first_missing(const part *p) {
  const cs_layout *layout = p->shaping->layout;
  for (size_t i = p->begin; i < p->end; i++) {
    bool is_there = false;
    for (size_t f = 0; f < layout->font_count && !is_there; f++)
      is_there = layout->type->has(layout->fonts[f]->font, layout->characters[i]);
    if (!is_there)
      return i;
  }
  return p->begin;
}

static celspan_status fail_missing(const part *p) {
  const cs_layout *layout = p->shaping->layout;
  size_t at = first_missing(p);
  uint32_t character = layout->characters[at];
  bool is_one = layout->font_count == 1;
  return cs_fail(layout->context, CELSPAN_BAD_ARGUMENT,
                 "%s: %s has %s glyph for \"%s\" (U+%04X) at byte %u%s", layout->noun,
                 is_one ? layout->desc->fonts[0] : "none of the fonts", is_one ? "no" : "a",
                 cs_utf8_encode(character).text, character, layout->places[at] + 1,
                 is_one ? "; name another font after it, { file, other }" : "");
}

/* Returns the end of the letter that begins with glyph `first`. */
static size_t letter_end(const cs_text_shaped *glyphs, size_t first, size_t count) {
  size_t end = first + 1;
  while (end < count && glyphs[end].glyph.character == glyphs[first].glyph.character)
    end++;
  return end;
}

static bool is_missing(const cs_text_shaped *glyphs, size_t first, size_t end) {
  for (size_t i = first; i < end; i++)
    if (glyphs[i].glyph.glyph == 0)
      return true;
  return false;
}

/* Glyphs that were shaped and are put back into the line one by one. */
typedef struct queue {
  cs_text_shaped *glyphs;
  size_t count, next;
} queue;

static celspan_status append(cs_layout *layout, const cs_text_shaped *glyphs, size_t count) {
  CS_TRY(CS_ARRAY_RESERVE(layout->context, layout->shaped, layout->shaped_count + count));
  memcpy(layout->shaped + layout->shaped_count, glyphs, count * sizeof *glyphs);
  layout->shaped_count += count;
  return CELSPAN_OK;
}

/* The next neighbouring letters, from q->next on, that the part's font lacks, as a part for the
 * next font. Their characters are those between the letters on both sides. */
static part missing_part(const part *p, queue *q) {
  bool is_leftward = p->shaping->run->embedding & 1;
  size_t first = q->next, end = first;
  do
    end = letter_end(q->glyphs, end, q->count);
  while (end < q->count && is_missing(q->glyphs, end, letter_end(q->glyphs, end, q->count)));
  q->next = end;
  part rest = *p;
  rest.font++;
  if (is_leftward) {
    rest.begin = q->glyphs[end - 1].glyph.character;
    rest.end = first > 0 ? q->glyphs[first - 1].glyph.character : p->end;
  } else {
    rest.begin = q->glyphs[first].glyph.character;
    rest.end = end < q->count ? q->glyphs[end].glyph.character : p->end;
  }
  return rest;
}

static celspan_status make_part(part *p);

static celspan_status fill_gaps(const part *p, queue *q) {
  while (q->next < q->count) {
    size_t end = letter_end(q->glyphs, q->next, q->count);
    if (is_missing(q->glyphs, q->next, end)) {
      part rest = missing_part(p, q);
      CS_TRY(make_part(&rest));
    } else {
      CS_TRY(append(p->shaping->layout, q->glyphs + q->next, end - q->next));
      q->next = end;
    }
  }
  return CELSPAN_OK;
}

/* Removes the glyphs that were appended from `first` on, and appends them again with the gaps
 * between them filled. */
static celspan_status complete(const part *p, size_t first) {
  cs_layout *layout = p->shaping->layout;
  queue q = {.count = layout->shaped_count - first};
  if (!is_missing(layout->shaped, first, layout->shaped_count))
    return CELSPAN_OK;
  if (p->font + 1 == layout->font_count) {
    part gap = *p;
    q.glyphs = layout->shaped + first;
    while (!is_missing(q.glyphs, q.next, letter_end(q.glyphs, q.next, q.count)))
      q.next = letter_end(q.glyphs, q.next, q.count);
    gap = missing_part(p, &q);
    return fail_missing(&gap);
  }
  CS_TRY(CS_MAKE(layout->context, q.glyphs, q.count));
  memcpy(q.glyphs, layout->shaped + first, q.count * sizeof *q.glyphs);
  layout->shaped_count = first;
  celspan_status status = fill_gaps(p, &q);
  cs_mem_free(layout->context->memory, q.glyphs, q.count * sizeof *q.glyphs);
  return status;
}

/* The recursion ends at the last font. */
static celspan_status make_part(part *p) {
  size_t first = p->shaping->layout->shaped_count;
  CS_TRY(shape_part(p));
  return complete(p, first);
}

/* ---------------------------------------------------------------- a line */

static celspan_status shape_runs(cs_layout *layout, const cs_text_run *runs, size_t count,
                                 size_t begin, size_t end) {
  for (size_t i = 0; i < count; i++) {
    shaping s = {layout, begin, end, &runs[i]};
    part whole = {&s, runs[i].begin, runs[i].end, 0, CELSPAN_OK};
    CS_TRY(make_part(&whole));
  }
  return CELSPAN_OK;
}

celspan_status cs_shaping_make(cs_layout *layout, size_t begin, size_t end) {
  layout->shaped_count = 0;
  const cs_run_characters text = {layout->characters, layout->scripts, layout->directions};
  size_t count = cs_runs_find(&text, begin, end, NULL);
  if (count == 0)
    return CELSPAN_OK;
  cs_text_run *runs;
  CS_TRY(CS_MAKE(layout->context, runs, count));
  cs_runs_find(&text, begin, end, runs);
  cs_runs_reorder(runs, count);
  celspan_status status = shape_runs(layout, runs, count, begin, end);
  cs_mem_free(layout->context->memory, runs, count * sizeof *runs);
  return status;
}
