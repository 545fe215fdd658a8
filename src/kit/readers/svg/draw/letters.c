#include "readers/svg/draw/letters.h"

#include <math.h>

#include "celspan/text.h"
#include "inside/number.h"
#include "readers/text/layout.h"

/* Letters that are larger than this draw nothing. */
#define LARGEST 1e6
#define PI 3.14159265358979323846
#define EX 0.5 /* the unit ex: the height of an x, as a share of the size */

/* ---------------------------------------------------------------- runs */

/* Shapes a run; without fonts the run remains empty. */
static celspan_status shape(cs_svg_reading *reading, const cs_svg_written *written,
                            const cs_svg_style *style, const cs_svg_faces *faces, cs_svg_run *run) {
  static const celspan_feature apart[] = {{"liga", 0}, {"clig", 0}};
  size_t byte = written->characters[run->begin].byte;
  size_t end = run->end < written->count ? written->characters[run->end].byte : written->size;
  celspan_text_desc desc = CELSPAN_TEXT_DESC;
  desc.text = written->bytes + byte;
  desc.text_size = end - byte;
  desc.fonts = faces->fonts;
  desc.font_count = faces->count;
  desc.size = style->font_size;
  desc.tracking = 1000 * (style->text.letter_spacing / style->font_size);
  desc.features = apart;
  desc.feature_count = style->text.letter_spacing != 0 ? 2 : 0;
  desc.direction = style->text.is_leftward ? CELSPAN_DIRECTION_RTL : CELSPAN_DIRECTION_LTR;
  celspan_status status = cs_typeset_make(&run->layout, reading->context, "text", &desc);
  run->layout.desc = NULL; /* the description is no longer valid here */
  return status;
}

static celspan_status note_faces(cs_svg_reading *reading, const cs_svg_node *node,
                                 const cs_svg_style *style, const cs_svg_faces *faces) {
  const char *family = style->text.font_family ? style->text.font_family : "no family";
  bool is_bold = style->text.is_bold, is_italic = style->text.is_italic;
  if (faces->count == 0)
    return cs_svg_skip(reading, node, "text in %.60s, for which no font is given", family);
  if (faces->is_plain)
    return cs_svg_skip(reading, node, "%s%s%s of text in %.60s, for which that font is not given",
                       is_bold ? "bold" : "", is_bold && is_italic ? " " : "",
                       is_italic ? "italic" : "", family);
  return CELSPAN_OK;
}

/* A run that cannot be shaped is reported and not drawn. */
static celspan_status fill_run(cs_svg_reading *reading, const cs_svg_written *written,
                               const cs_svg_text_node *text, cs_svg_run *run) {
  const cs_svg_style *style = &text->place.style;
  cs_svg_faces faces;
  if (!(style->font_size > 0) || style->font_size > LARGEST)
    return CELSPAN_OK;
  cs_svg_faces_find(reading->source, style, &faces);
  CS_TRY(note_faces(reading, text->node, style, &faces));
  if (faces.count == 0)
    return CELSPAN_OK;
  celspan_status status = shape(reading, written, style, &faces, run);
  if (status != CELSPAN_BAD_ARGUMENT)
    return status;
  run->layout.letter_count = 0;
  return cs_svg_skip(reading, text->node, "%s", reading->context->error);
}

static celspan_status add_run(cs_svg_reading *reading, const cs_svg_written *written, size_t first,
                              size_t end, cs_svg_letters *out) {
  const cs_svg_text_node *nodes = written->nodes;
  CS_TRY(CS_ARRAY_RESERVE(reading->context, out->runs, out->run_count + 1));
  cs_svg_run *run = &out->runs[out->run_count++];
  *run = (cs_svg_run){.begin = nodes[first].begin,
                      .end = nodes[end - 1].end,
                      .size = nodes[first].place.style.font_size,
                      .layout = {.context = reading->context}};
  return fill_run(reading, written, &nodes[first], run);
}

static celspan_status add_runs(cs_svg_reading *reading, const cs_svg_written *written,
                               cs_svg_letters *out) {
  const cs_svg_text_node *nodes = written->nodes;
  for (size_t i = 0, next; i < written->node_count; i = next) {
    next = i + 1;
    while (next < written->node_count &&
           cs_svg_faces_are_same(&nodes[i].place.style, &nodes[next].place.style))
      next++;
    CS_TRY(add_run(reading, written, i, next, out));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- one line */

/* The text node of a character. The search begins at *at, the node that was found before. */
static const cs_svg_text_node *node_of(const cs_svg_written *written, size_t character,
                                       size_t *at) {
  while (*at > 0 && written->nodes[*at].begin > character)
    --*at;
  while (written->nodes[*at].end <= character)
    ++*at;
  return &written->nodes[*at];
}

static bool is_word_end(const cs_svg_written *written, size_t character) {
  const char *text = written->bytes + written->characters[character].byte;
  bool is_fixed_space = character + 1 < written->count && text[0] == '\xc2' && text[1] == '\xa0';
  return text[0] == ' ' || is_fixed_space;
}

/* Appends a run's letters, from 0 on, and finds its width. */
static void append_letters(const cs_svg_written *written, size_t index, cs_svg_letters *out) {
  cs_svg_run *run = &out->runs[index];
  const cs_layout *layout = &run->layout;
  double left = HUGE_VAL, right = -HUGE_VAL, widened = 0;
  size_t at = 0;
  for (size_t i = 0; i < layout->letter_count; i++)
    left = fmin(left, layout->letters[i].x);
  for (size_t i = 0; i < layout->letter_count; i++) {
    const cs_text_letter *from = &layout->letters[i];
    size_t character = run->begin + from->begin;
    const cs_svg_style *style = &node_of(written, character, &at)->place.style;
    double x = from->x - left + widened;
    double wider = is_word_end(written, character) ? style->text.word_spacing : 0;
    out->letters[out->count++] =
        (cs_svg_letter){index, from->glyph, from->glyph_count,     character, from->x, from->y,
                        x,     0,           from->advance + wider, 1,         0};
    widened += wider;
    right = fmax(right, x + from->advance + wider + style->text.letter_spacing);
  }
  run->width = layout->letter_count > 0 ? right : 0;
}

static celspan_status make_room(const cs_svg_written *written, cs_svg_letters *out) {
  size_t count = 0;
  for (size_t i = 0; i < out->run_count; i++)
    count += out->runs[i].layout.letter_count;
  out->order_count = written->count;
  CS_TRY(CS_ARRAY_MAKE(out->context, out->letters, count));
  return CS_ARRAY_MAKE(out->context, out->order, written->count);
}

/* Puts the letters side by side on a line that begins at 0, run after run; from the right if the
 * text runs to the left. */
static celspan_status make_line(const cs_svg_written *written, bool is_leftward,
                                cs_svg_letters *out) {
  double x = 0;
  CS_TRY(make_room(written, out));
  for (size_t i = 0; i < out->run_count; i++) {
    size_t run = is_leftward ? out->run_count - 1 - i : i, first = out->count;
    append_letters(written, run, out);
    for (size_t k = first; k < out->count; k++)
      out->letters[k].x += x;
    x += out->runs[run].width;
  }
  for (size_t i = 0; i < out->count; i++)
    out->order[out->letters[i].character] = (uint32_t)i + 1;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- lengths */

typedef struct extent {
  double left, right;
  size_t count; /* letters */
} extent;

static bool is_within(const cs_svg_letter *letter, const cs_svg_text_length *wanted) {
  return letter->character >= wanted->begin && letter->character < wanted->end;
}

static extent extent_of(const cs_svg_letters *letters, const cs_svg_text_length *wanted) {
  extent found = {HUGE_VAL, -HUGE_VAL, 0};
  for (size_t i = 0; i < letters->count; i++) {
    const cs_svg_letter *letter = &letters->letters[i];
    if (!is_within(letter, wanted))
      continue;
    found.left = fmin(found.left, letter->x);
    found.right = fmax(found.right, letter->x + letter->advance);
    found.count++;
  }
  return found;
}

/* Moves the letters apart, or widens them, until they have the wanted length; the letters after
 * them are moved, too. */
static void set_length(cs_svg_letters *letters, const cs_svg_text_length *wanted) {
  extent found = extent_of(letters, wanted);
  double width = found.right - found.left, longer = wanted->length - width;
  if (found.count == 0 || !(width > 0))
    return;
  double factor = wanted->stretches_glyphs ? wanted->length / width : 1;
  double gap = wanted->stretches_glyphs || found.count < 2 ? 0 : longer / (double)(found.count - 1);
  size_t passed = 0;
  for (size_t i = 0; i < letters->count; i++) {
    cs_svg_letter *letter = &letters->letters[i];
    if (is_within(letter, wanted)) {
      letter->x = found.left + (letter->x - found.left) * factor + (double)passed++ * gap;
      letter->advance *= factor;
      letter->scale *= factor;
    } else if (letter->x >= found.right) {
      letter->x += longer;
    }
  }
}

/* ---------------------------------------------------------------- places */

/* The place of the letters of a chunk. */
typedef struct chunk {
  size_t begin, end; /* characters */
  double x;          /* the x to which the chunk is anchored */
} chunk;

static cs_svg_letter *letter_at(const cs_svg_letters *letters, size_t character) {
  uint32_t place = letters->order[character];
  return place > 0 ? &letters->letters[place - 1] : NULL;
}

static void anchor_chunk(const cs_svg_written *written, const chunk *part, cs_svg_letters *letters,
                         size_t *at) {
  double left = HUGE_VAL, right = -HUGE_VAL;
  for (size_t i = part->begin; i < part->end; i++) {
    const cs_svg_letter *letter = letter_at(letters, i);
    left = letter ? fmin(left, letter->x) : left;
    right = letter ? fmax(right, letter->x + letter->advance) : right;
  }
  if (left > right)
    return;
  const cs_svg_style *style = &node_of(written, part->begin, at)->place.style;
  bool is_left = (style->text.anchor == CS_SVG_ANCHOR_START) != style->text.is_leftward;
  double from = style->text.anchor == CS_SVG_ANCHOR_MIDDLE ? 0.5 * (left + right)
                : is_left                                  ? left
                                                           : right;
  for (size_t i = part->begin; i < part->end; i++) {
    cs_svg_letter *letter = letter_at(letters, i);
    if (letter)
      letter->x += part->x - from;
  }
}

/* How far the baseline of a letter is below its place, because of the line that is wanted there. */
static double lowered(const cs_svg_letters *letters, const cs_svg_letter *letter,
                      const cs_svg_text_style *style) {
  const cs_svg_run *run = &letters->runs[letter->run];
  if (letter->count == 0)
    return 0;
  const cs_type_font_info *info = &run->layout.glyphs[letter->first].font->info;
  double em = run->size / (double)info->units;
  double ascent = em * info->ascent, descent = em * info->descent;
  switch (style->own) {
  case CS_SVG_BASELINE_MIDDLE:
    return 0.5 * EX * run->size - style->raised;
  case CS_SVG_BASELINE_CENTRAL:
    return 0.5 * (ascent - descent) - style->raised;
  case CS_SVG_BASELINE_HANGING:
    return 0.8 * ascent - style->raised;
  case CS_SVG_BASELINE_MATHEMATICAL:
    return 0.5 * ascent - style->raised;
  case CS_SVG_BASELINE_BOTTOM:
    return -descent - style->raised;
  case CS_SVG_BASELINE_TOP:
    return ascent - style->raised;
  default:
    return -style->raised;
  }
}

/* Moves all letters from the line to their places, chunk by chunk. */
static void place_letters(const cs_svg_written *written, cs_svg_letters *letters) {
  chunk part = {0, 0, 0};
  double dx = 0, y = 0, shift = 0, line = 0;
  size_t at = 0, node = 0;
  bool is_first = true;
  for (size_t i = 0; i < written->count; i++) {
    const cs_svg_character *said = &written->characters[i];
    cs_svg_letter *letter = letter_at(letters, i);
    bool begins = is_first || !isnan(said->x) || !isnan(said->y);
    dx = (isnan(said->x) ? dx : 0) + (isnan(said->dx) ? 0 : said->dx);
    y = isnan(said->y) ? y : said->y;
    y += isnan(said->dy) ? 0 : said->dy;
    if (!letter)
      continue;
    if (begins) {
      /* A chunk that has no x begins where the previous chunk ends. */
      double x = !isnan(said->x) ? said->x : is_first ? 0 : line + (letter->x - shift);
      part.end = i;
      anchor_chunk(written, &part, letters, &at);
      part = (chunk){i, i, x + dx};
      line = x;
      shift = letter->x;
      is_first = false;
    }
    letter->x += dx;
    letter->y = y + lowered(letters, letter, &node_of(written, i, &node)->place.style.text);
  }
  part.end = written->count;
  anchor_chunk(written, &part, letters, &at);
}

/* ---------------------------------------------------------------- along lines */

/* Moves a letter from its distance along a line and across the line to its place. */
static void bend(const cs_svg_text_path *path, cs_svg_letter *letter) {
  const double half = 0.5 * letter->advance, middle = letter->x + half;
  if (!(middle >= 0 && middle <= path->way.length)) {
    letter->count = 0;
    return;
  }
  const celspan_point at = cs_svg_way_at(&path->way, middle, &letter->turn);
  const celspan_matrix turn =
      celspan_matrix_rotation(letter->turn * (PI / 180), (celspan_point){0, 0});
  const double y = letter->y;
  letter->x = at.x - turn.m[0] * half + turn.m[1] * y;
  letter->y = at.y - turn.m[3] * half + turn.m[4] * y;
}

static void bend_letters(const cs_svg_written *written, cs_svg_letters *letters) {
  for (size_t i = 0; i < written->path_count; i++)
    for (size_t k = written->paths[i].begin; k < written->paths[i].end; k++) {
      cs_svg_letter *letter = letter_at(letters, k);
      if (letter)
        bend(&written->paths[i], letter);
    }
}

/* Letters with numbers that are too large for the geometry draw nothing. */
static void drop_unfit(cs_svg_letters *letters) {
  for (size_t i = 0; i < letters->count; i++) {
    cs_svg_letter *letter = &letters->letters[i];
    if (!cs_number_is_sane(letter->x) || !cs_number_is_sane(letter->y) ||
        !cs_number_is_sane(letter->scale * letter->advance))
      letter->count = 0;
  }
}

celspan_status cs_svg_letters_make(cs_svg_reading *reading, const cs_svg_node *node,
                                   const cs_svg_written *written, cs_svg_letters *out) {
  *out = (cs_svg_letters){.context = reading->context};
  if (written->is_too_long)
    return cs_svg_skip(reading, node, "text of more than %d characters", CS_TEXT_CHARACTERS);
  if (written->count == 0)
    return CELSPAN_OK;
  CS_TRY(add_runs(reading, written, out));
  CS_TRY(make_line(written, written->nodes[0].place.style.text.is_leftward, out));
  for (size_t i = 0; i < written->length_count; i++)
    set_length(out, &written->lengths[i]);
  place_letters(written, out);
  bend_letters(written, out);
  drop_unfit(out);
  return CELSPAN_OK;
}

void cs_svg_letters_finish(cs_svg_letters *letters) {
  for (size_t i = 0; i < letters->run_count; i++)
    cs_typeset_finish(&letters->runs[i].layout);
  CS_ARRAYS_FREE(letters->context->memory, letters, runs, order);
}

/* The angle by which a letter is turned, in degrees. */
static double turn_of(const cs_svg_letter *letter, const cs_svg_written *written) {
  double own = written->characters[letter->character].rotate;
  return letter->turn + (isnan(own) ? 0 : own);
}

/* ---------------------------------------------------------------- outlines */

/* Widens and turns the points from `first` on about (0, 0), and moves them to the letter's
 * place. */
static void place_points(cs_outline *outline, size_t first, const cs_svg_letter *letter,
                         double degrees) {
  const celspan_point origin = {0, 0};
  celspan_matrix turn = celspan_matrix_rotation(degrees * (PI / 180), origin);
  for (size_t i = first; i < outline->point_count; i++) {
    cs_hpoint *point = &outline->points[i];
    double x = point->x * letter->scale, y = point->y;
    point->x = turn.m[0] * x + turn.m[1] * y + letter->x;
    point->y = turn.m[3] * x + turn.m[4] * y + letter->y;
  }
}

static celspan_status append_letter(const cs_svg_letters *letters, const cs_svg_letter *letter,
                                    double degrees, cs_outline *outline) {
  const cs_svg_run *run = &letters->runs[letter->run];
  size_t first = outline->point_count;
  for (size_t i = letter->first; i < letter->first + letter->count; i++) {
    const cs_text_glyph *glyph = &run->layout.glyphs[i];
    const cs_font_place place = {glyph->x - letter->origin_x, glyph->y - letter->origin_y,
                                 run->size / (double)glyph->font->info.units};
    CS_TRY(cs_font_append(letters->context, glyph->font, glyph->glyph, place, outline));
    if (outline->point_count > CS_TEXT_POINTS)
      return cs_fail(letters->context, CELSPAN_LIMIT,
                     "the outlines of a text have more than %zu points", CS_TEXT_POINTS);
  }
  place_points(outline, first, letter, degrees);
  return CELSPAN_OK;
}

celspan_status cs_svg_letters_outline(const cs_svg_letters *letters, const cs_svg_written *written,
                                      size_t begin, size_t end, cs_outline *outline) {
  for (size_t i = begin; i < end && i < letters->order_count; i++) {
    const cs_svg_letter *letter = letter_at(letters, i);
    if (letter)
      CS_TRY(append_letter(letters, letter, turn_of(letter, written), outline));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- boxes */

typedef struct bounds {
  double left, top, right, bottom;
} bounds;

/* A corner of a letter's box. Its position is given relative to the left end of the unturned letter
 * on the baseline. */
static void add_corner(const cs_svg_letter *letter, double degrees, double x, double y,
                       bounds *whole) {
  celspan_matrix turn = celspan_matrix_rotation(degrees * (PI / 180), (celspan_point){0, 0});
  double to_x = letter->x + turn.m[0] * x + turn.m[1] * y;
  double to_y = letter->y + turn.m[3] * x + turn.m[4] * y;
  whole->left = fmin(whole->left, to_x);
  whole->right = fmax(whole->right, to_x);
  whole->top = fmin(whole->top, to_y);
  whole->bottom = fmax(whole->bottom, to_y);
}

static void add_letter(const cs_svg_letters *letters, const cs_svg_letter *letter, double degrees,
                       bounds *whole) {
  const cs_svg_run *run = &letters->runs[letter->run];
  const cs_type_font_info *info = &run->layout.glyphs[letter->first].font->info;
  double em = run->size / (double)info->units;
  for (int i = 0; i < 4; i++)
    add_corner(letter, degrees, i & 1 ? letter->advance : 0,
               i & 2 ? em * info->descent : -em * info->ascent, whole);
}

bool cs_svg_letters_box(const cs_svg_letters *letters, const cs_svg_written *written,
                        celspan_box *out) {
  bounds whole = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; i < letters->count; i++) {
    const cs_svg_letter *letter = &letters->letters[i];
    if (letter->count > 0)
      add_letter(letters, letter, turn_of(letter, written), &whole);
  }
  *out = (celspan_box){whole.left, whole.top, whole.right - whole.left, whole.bottom - whole.top};
  return whole.left <= whole.right;
}
