/* Glyphs and their places, against hb-shape (package libharfbuzz-bin), and outlines, against
 * FreeType, for the fonts that are there: the project's own, and those of Debian's packages. The
 * fonts and programs that are missing are named and counted as skipped. One file, because all tests
 * go through the same fonts.
 */
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "celspan/text.h"
#include "readers/text/layout.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"
#ifdef TEST_FREETYPE
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MULTIPLE_MASTERS_H
#include FT_OUTLINE_H
#endif

#define OWN TEST_ROOT "/scripts/type/block.ttf"
#define DEJAVU "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
#define ARABIC "/usr/share/fonts/truetype/noto/NotoNaskhArabic-Regular.ttf"
#define DEVANAGARI "/usr/share/fonts/truetype/noto/NotoSansDevanagari-Regular.ttf"
#define HEBREW "/usr/share/fonts/truetype/noto/NotoSansHebrew-Regular.ttf"
#define JAPANESE "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc"
#define MOST 4000

static celspan_context *context;

static bool is_there(const char *path) {
  if (access(path, R_OK) == 0)
    return true;
  check_skip(path);
  return false;
}

static celspan_text_desc text_of(const char *text, const char *const *fonts, size_t count) {
  celspan_text_desc desc = CELSPAN_TEXT_DESC;
  desc.text = text;
  desc.text_size = strlen(text);
  desc.fonts = fonts;
  desc.font_count = count;
  return desc;
}

/* ---------------------------------------------------------------- hb-shape */

typedef struct placed {
  unsigned glyph;
  double x, y;
} placed;

/* A part of a line of one direction, script and font. */
typedef struct piece {
  const char *font, *text, *options;
} piece;

/* What hb-shape makes of a piece, "[36=0@5,7+100|...]", from *x on. */
static size_t ask(const piece *wanted, double *x, placed *out) {
  char command[2000], answer[60000];
  snprintf(command, sizeof command, "hb-shape --no-glyph-names --no-clusters %s '%s' '%s'",
           wanted->options, wanted->font, wanted->text);
  FILE *pipe = popen(command, "r");
  if (!pipe)
    return 0;
  size_t size = fread(answer, 1, sizeof answer - 1, pipe), count = 0;
  answer[size] = 0;
  CHECK(pclose(pipe) == 0);
  for (char *at = answer + 1; *at && at[-1] != ']' && count < MOST;) {
    long dx = 0, dy = 0;
    out[count].glyph = (unsigned)strtoul(at, &at, 10);
    if (*at == '@') {
      dx = strtol(at + 1, &at, 10);
      dy = strtol(at + 1, &at, 10);
    }
    out[count].x = *x + (double)dx;
    out[count++].y = -(double)dy;
    *x += (double)strtol(at + 1, &at, 10);
    at++;
  }
  return count;
}

/* The whole text, in the order in which its pieces are seen, against celspan's one line. */
static void check_line(const char *text, const char *const *fonts, size_t font_count, double size,
                       const piece *pieces, size_t piece_count) {
  static placed expected[MOST];
  celspan_text_desc desc = text_of(text, fonts, font_count);
  desc.size = size;
  cs_layout layout;
  double x = 0;
  size_t count = 0;
  for (size_t i = 0; i < piece_count; i++)
    count += ask(&pieces[i], &x, expected + count);
  if (CHECK(cs_typeset_make(&layout, context, "text", &desc) == CELSPAN_OK)) {
    CHECK(count > 0 && layout.glyph_count == count);
    for (size_t i = 0; i < count && i < layout.glyph_count; i++) {
      CHECK(layout.glyphs[i].glyph == expected[i].glyph);
      CHECK_NEAR(layout.glyphs[i].x, expected[i].x, 1e-6);
      CHECK_NEAR(layout.glyphs[i].y, expected[i].y, 1e-6);
    }
  } else {
    fprintf(stderr, "%s\n", celspan_context_error(context));
  }
  cs_typeset_finish(&layout);
}

/* A text of one script in one font whose em has `units`. */
static void check_text_of(const char *font, double units, const char *text, const char *options) {
  const char *const fonts[] = {font};
  const piece whole = {font, text, options};
  if (is_there(font))
    check_line(text, fonts, 1, units, &whole, 1);
}

static bool has_hb_shape(void) {
  bool is_installed = system("hb-shape --version >/dev/null 2>&1") == 0;
  if (!is_installed)
    check_skip("hb-shape");
  return is_installed;
}

static void glyphs_are_those_of_hb_shape(void) {
  if (!has_hb_shape())
    return;
  check_text_of(OWN, 1000, "Hamburgefonts -> AVATAR, \"1234567890\"", "");
  check_text_of(DEJAVU, 2048, "The office of Wolfgang AVATAR: fi fl ffi, To. V. 0123", "");
  check_text_of(DEJAVU, 2048, "Zażółć gęślą jaźń e\xcc\x81\xcc\xa7 \xc3\x85ngstr\xc3\xb6m", "");
  check_text_of(DEJAVU, 2048, "Съешь же ещё этих мягких французских булок", "");
  check_text_of(ARABIC, 1000, "السلام عليكم ورحمة الله", "");
  check_text_of(ARABIC, 1000, "بِسْمِ ٱللَّهِ ٱلرَّحْمَـٰنِ", "");
  check_text_of(DEVANAGARI, 1000, "नमस्ते दुनिया। क्षत्रिय द्वितीय र्कि", "");
  check_text_of(HEBREW, 1000, "בְּרֵאשִׁית בָּרָא", "");
  check_text_of(JAPANESE, 1000, "吾輩は猫である。名前はまだ無い。", "");
  check_text_of(JAPANESE, 1000, "「ガギグゲゴ」、カタカナ", "");
}

/* Lines of several scripts, fonts and directions, whose pieces are written here as they are
 * seen. */
static void mixed_lines_are_those_of_hb_shape(void) {
  bool has_all = has_hb_shape();
  const char *const needed[] = {DEJAVU, ARABIC, DEVANAGARI, JAPANESE};
  for (size_t i = 0; i < 4 && has_all; i++)
    has_all = is_there(needed[i]);
  if (!has_all)
    return;
  /* Hebrew and its digits in a line of Latin. */
  const char *const dejavu[] = {DEJAVU};
  const piece inside[] = {{DEJAVU, "abc ", "--direction=ltr --script=Latn"},
                          {DEJAVU, " גם", "--direction=rtl --script=Hebr"},
                          {DEJAVU, "123", "--direction=ltr --script=Hebr"},
                          {DEJAVU, "שלום ", "--direction=rtl --script=Hebr"},
                          {DEJAVU, " ", "--direction=ltr --script=Hebr"},
                          {DEJAVU, "AVE", "--direction=ltr --script=Latn"}};
  check_line("abc שלום 123 גם AVE", dejavu, 1, 2048, inside, 6);
  /* Latin in a line of Arabic: what comes later lies farther left. */
  const piece around[] = {{DEJAVU, "عليكم", "--direction=rtl --script=Arab"},
                          {DEJAVU, " ", "--direction=rtl --script=Latn"},
                          {DEJAVU, "office", "--direction=ltr --script=Latn"},
                          {DEJAVU, "السلام ", "--direction=rtl --script=Arab"}};
  check_line("السلام office عليكم", dejavu, 1, 2048, around, 4);
  /* Three scripts from three fonts. */
  const char *const others[] = {ARABIC, DEVANAGARI, JAPANESE};
  const piece turned[] = {{DEVANAGARI, "नमस्ते", "--direction=ltr --script=Deva"},
                          {ARABIC, "السلام ", "--direction=rtl --script=Arab"}};
  check_line("السلام नमस्ते", others, 3, 1000, turned, 2);
  const piece joined[] = {{DEVANAGARI, "नमस्ते", "--direction=ltr --script=Deva"},
                          {JAPANESE, "日本", "--direction=ltr --script=Hani"},
                          {JAPANESE, "のねこ", "--direction=ltr --script=Hira"},
                          {ARABIC, "مرحبا", "--direction=rtl --script=Arab"}};
  check_line("नमस्ते日本のねこمرحبا", others, 3, 1000, joined, 4);
}

/* ---------------------------------------------------------------- FreeType */

#ifdef TEST_FREETYPE

/* Places are in 64ths of a pixel, and a font unit is a pixel: not unscaled, because FreeType then
 * rounds rotated, scaled or varied outlines to whole units. */
#define SHIFT 8

typedef struct contours {
  celspan_context *context;
  cs_outline outline;
  double scale;
  bool is_good;
} contours;

static cs_hpoint scaled(const contours *c, const FT_Vector *v) {
  return (cs_hpoint){c->scale * (double)v->x, -c->scale * (double)v->y, 1};
}

static int on_move(const FT_Vector *to, void *user) {
  contours *c = user;
  c->is_good = c->is_good && cs_outline_move(c->context, &c->outline, scaled(c, to)) == CELSPAN_OK;
  return 0;
}

static int add(contours *c, int degree, const cs_hpoint *points) {
  c->is_good =
      c->is_good && cs_outline_piece(c->context, &c->outline, degree, points) == CELSPAN_OK;
  return 0;
}

static int on_line(const FT_Vector *to, void *user) {
  const cs_hpoint point = scaled(user, to);
  return add(user, 1, &point);
}

static int on_conic(const FT_Vector *control, const FT_Vector *to, void *user) {
  const cs_hpoint points[] = {scaled(user, control), scaled(user, to)};
  return add(user, 2, points);
}

static int on_cubic(const FT_Vector *a, const FT_Vector *b, const FT_Vector *to, void *user) {
  const cs_hpoint points[] = {scaled(user, a), scaled(user, b), scaled(user, to)};
  return add(user, 3, points);
}

/* A piece of an outline that is longer than nothing, from `first` on and round the contour. */
static size_t pieces_of(const cs_outline *outline, size_t contour, size_t found[]) {
  size_t end =
      contour + 1 < outline->contour_count ? outline->contours[contour + 1] : outline->piece_count;
  size_t count = 0;
  for (size_t i = outline->contours[contour]; i < end; i++) {
    const cs_hpoint *p = outline->points + outline->starts[i];
    bool is_nothing = outline->degrees[i] == 1 && p[0].x == p[1].x && p[0].y == p[1].y;
    if (!is_nothing && count < MOST)
      found[count++] = i;
  }
  return count;
}

static double distance_of(const cs_outline *a, size_t i, const cs_outline *b, size_t k) {
  double most = a->degrees[i] == b->degrees[k] ? 0 : 1e9;
  for (int n = 0; n <= a->degrees[i] && n <= b->degrees[k]; n++) {
    cs_hpoint p = a->points[a->starts[i] + (uint32_t)n], q = b->points[b->starts[k] + (uint32_t)n];
    most = fmax(most, hypot(p.x - q.x, p.y - q.y));
  }
  return most;
}

/* How far contours lie apart, which may begin at different places: the best of all. */
static double contours_apart(const cs_outline *a, const cs_outline *b, size_t contour) {
  static size_t left[MOST], right[MOST];
  size_t count = pieces_of(a, contour, left);
  if (count == 0 || count != pieces_of(b, contour, right))
    return count == 0 ? 0 : 1e9;
  double best = 1e9;
  for (size_t turn = 0; turn < count && best > 0.01; turn++) {
    double most = 0;
    for (size_t i = 0; i < count && most < best; i++)
      most = fmax(most, distance_of(a, left[i], b, right[(i + turn) % count]));
    best = fmin(best, most);
  }
  return best;
}

static bool draw_by_freetype(FT_Face face, FT_UInt glyph, contours *c) {
  /* Shifted before it finds the middles between control points, which it rounds. */
  const FT_Outline_Funcs functions = {on_move, on_line, on_conic, on_cubic, SHIFT, 0};
  bool is_drawn = FT_Load_Glyph(face, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) == 0 &&
                  FT_Outline_Decompose(&face->glyph->outline, &functions, c) == 0 && c->is_good;
  return is_drawn && cs_outline_close(context, &c->outline) == CELSPAN_OK;
}

/* Every `step`th glyph of a font at size 200. weight: of a variable font, 0: none. */
static void check_outlines(FT_Library library, const char *path, double weight, uint32_t step) {
  const char *const fonts[] = {path};
  const celspan_variation variations[] = {{"wght", weight}};
  celspan_text_desc desc = text_of("", fonts, 1);
  desc.variations = variations;
  desc.variation_count = weight > 0;
  FT_Face face;
  cs_font *font;
  if (!is_there(path) || !CHECK(FT_New_Face(library, path, 0, &face) == 0) ||
      !CHECK(cs_font_acquire(context, &desc, 0, &font) == CELSPAN_OK))
    return;
  FT_Fixed coordinate = (FT_Fixed)(weight * 65536);
  CHECK(weight == 0 || FT_Set_Var_Design_Coordinates(face, 1, &coordinate) == 0);
  unsigned compared = 0;
  double most = 0, scale = 200 / (double)font->info.units;
  CHECK(font->info.units == face->units_per_EM);
  CHECK(FT_Set_Pixel_Sizes(face, 0, font->info.units) == 0);
  for (uint32_t glyph = 0; glyph < font->info.glyphs; glyph += step) {
    contours c = {context, .scale = scale / (64 << SHIFT), .is_good = true};
    cs_outline own;
    cs_outline_init(&c.outline);
    cs_outline_init(&own);
    if (CHECK(draw_by_freetype(face, glyph, &c)) &&
        CHECK(cs_font_append(context, font, glyph, (cs_font_place){0, 0, scale}, &own) ==
              CELSPAN_OK) &&
        CHECK(own.contour_count == c.outline.contour_count))
      for (size_t i = 0; i < own.contour_count; i++, compared++)
        most = fmax(most, contours_apart(&own, &c.outline, i));
    cs_outline_finish(&own, context->memory);
    cs_outline_finish(&c.outline, context->memory);
  }
  printf("%s: %u contours, at most %g pixels apart at size 200\n", path, compared, most);
  CHECK(compared > 100);
  CHECK(most <= 0.01);
  cs_font_release(context, font);
  FT_Done_Face(face);
}

static void outlines_are_those_of_freetype(void) {
  FT_Library library;
  if (!CHECK(FT_Init_FreeType(&library) == 0))
    return;
  check_outlines(library, OWN, 0, 1);
  check_outlines(library, OWN, 900, 1);
  check_outlines(library, OWN, 333, 1);
  check_outlines(library, DEJAVU, 0, 7);
  check_outlines(library, ARABIC, 0, 5);
  check_outlines(library, DEVANAGARI, 0, 3);
  check_outlines(library, JAPANESE, 0, 97);
  FT_Done_FreeType(library);
}

#else

static void outlines_are_those_of_freetype(void) { check_skip("FreeType"); }

#endif

/* ---------------------------------------------------------------- the context */

static void fonts_are_kept_and_let_go(void) {
  const char *const fonts[] = {OWN};
  celspan_text_desc desc = text_of("Again and again", fonts, 1);
  celspan_object *first = NULL, *second = NULL;
  size_t before, after, peak;
  uint64_t allocations, later;
  CHECK(celspan_object_create_text(context, &desc, &first) == CELSPAN_OK);
  celspan_context_memory(context, &before, &peak, &allocations);
  CHECK(celspan_object_create_text(context, &desc, &second) == CELSPAN_OK);
  celspan_context_memory(context, &after, &peak, &later);
  CHECK(later - allocations < 40); /* neither the file nor the outlines of letters are made again */
  celspan_object_unref(second);
  celspan_object_unref(first);
  cs_context_trim(context);
  celspan_context_memory(context, &after, &peak, &later);
  CHECK(after + 50000 < before);
}

/* What is no text is refused with a sentence, and *out stays as it is. */
static void refuse(celspan_text_desc desc, celspan_status status, const char *sentence) {
  celspan_object *object = NULL;
  celspan_glyphs *glyphs = NULL;
  CHECK(celspan_object_create_text(context, &desc, &object) == status && !object);
  if (!CHECK(strstr(celspan_context_error(context), sentence)))
    fprintf(stderr, "%s\n", celspan_context_error(context));
  CHECK(celspan_glyphs_create(context, &desc, &glyphs) == status && !glyphs);
}

static void bad_arguments_are_refused(void) {
  const char *const fonts[17] = {OWN, OWN}, *const none[] = {"/nowhere.ttf"};
  const char *const no_name[] = {NULL}, *const no_font[] = {TEST_ROOT "/meson.build"};
  const celspan_feature feature[] = {{"li", 1}};
  const celspan_variation axis[] = {{"ital", 1}}, not_finite[] = {{"wght", NAN}};
  const celspan_text_desc good = text_of("ab", fonts, 1);
  celspan_text_desc bad = good;
#define REFUSE(change, status, sentence) bad = good, change, refuse(bad, CELSPAN_##status, sentence)
  REFUSE(bad.text = NULL, BAD_ARGUMENT, "text");
  REFUSE((bad.text = "a\tb", bad.text_size = 3), BAD_ARGUMENT, "byte 2");
  REFUSE(bad.text = "\xff\xfe", BAD_ARGUMENT, "UTF-8");
  REFUSE((bad.text = "\xe6\x97\xa5", bad.text_size = 3), BAD_ARGUMENT, "U+65E5");
  REFUSE(bad.fonts = NULL, BAD_ARGUMENT, "font");
  REFUSE(bad.font_count = 0, BAD_ARGUMENT, "font");
  REFUSE(bad.font_count = 17, LIMIT, "16");
  REFUSE(bad.fonts = no_name, BAD_ARGUMENT, "font");
  REFUSE(bad.fonts = none, INPUT, "/nowhere.ttf");
  REFUSE(bad.fonts = no_font, INPUT, "meson.build");
  REFUSE(bad.size = -1, BAD_ARGUMENT, "size");
  REFUSE(bad.size = NAN, BAD_ARGUMENT, "size");
  REFUSE(bad.at.x = INFINITY, BAD_ARGUMENT, "at");
  REFUSE((bad.has_width = true, bad.width = -1), BAD_ARGUMENT, "width");
  REFUSE(bad.leading = NAN, BAD_ARGUMENT, "leading");
  REFUSE(bad.tracking = 1e300, BAD_ARGUMENT, "tracking");
  REFUSE(bad.align = (celspan_align)7, BAD_ARGUMENT, "align");
  REFUSE(bad.direction = (celspan_direction)7, BAD_ARGUMENT, "direction");
  REFUSE((bad.features = feature, bad.feature_count = 1), BAD_ARGUMENT, "li");
  REFUSE((bad.features = NULL, bad.feature_count = 1), BAD_ARGUMENT, "features");
  REFUSE((bad.variations = NULL, bad.variation_count = 1), BAD_ARGUMENT, "variations");
  REFUSE((bad.variations = axis, bad.variation_count = 1), BAD_ARGUMENT, "ital");
  REFUSE((bad.variations = not_finite, bad.variation_count = 1), BAD_ARGUMENT, "wght");
  REFUSE(bad.language = "not a language at all, and far too long for one", BAD_ARGUMENT,
         "language");
  const char *const no_languages[] = {"", "en_GB", "d\xc3\xa9", "@", "[", "{", "/", ":", "`"};
  for (size_t i = 0; i < sizeof no_languages / sizeof *no_languages; i++)
    REFUSE(bad.language = no_languages[i], BAD_ARGUMENT, "language is a tag such as");
  const char *const no_tags[] = {NULL,
                                 "",
                                 "abcde",
                                 " abc",
                                 "ab\x7f"
                                 "c",
                                 "ab\x1f"
                                 "c"};
  for (size_t i = 0; i < sizeof no_tags / sizeof *no_tags; i++) {
    const celspan_feature unnamed = {no_tags[i], 1};
    const celspan_variation nameless = {no_tags[i], 1};
    REFUSE((bad.features = &unnamed, bad.feature_count = 1), BAD_ARGUMENT, "such as \"liga\"");
    REFUSE((bad.variations = &nameless, bad.variation_count = 1), BAD_ARGUMENT, "such as \"wght\"");
  }
  REFUSE((bad.fonts = fonts, bad.font_count = 2, bad.variations = axis, bad.variation_count = 1),
         BAD_ARGUMENT, "none of the fonts has an axis");
#undef REFUSE
}

/* Every choice moves the whole text, by what its measures say. */
static void valign_moves_by_measures(void) {
  const char *const fonts[] = {OWN};
  celspan_text_desc desc = text_of("Hx\nHgHHH", fonts, 1);
  celspan_text_metrics m = CELSPAN_TEXT_METRICS;
  desc.size = 60;
  CHECK(celspan_text_measure(context, &desc, &m) == CELSPAN_OK);
  CHECK(m.lines == 2 && m.ascent > m.cap_height && m.cap_height > m.x_height && m.x_height > 0);
  CHECK_NEAR(m.height, m.ascent + 1.2 * 60 + m.descent, 1e-9);
  CHECK(celspan_text_measure(context, &desc, &(celspan_text_metrics){0}) == CELSPAN_BAD_ARGUMENT);
  const double drops[] = {0, m.ascent, m.cap_height, m.ascent - m.height / 2, m.ascent - m.height};
  for (int i = 0; i <= CELSPAN_VALIGN_BOTTOM; i++) {
    celspan_glyphs *glyphs = NULL;
    celspan_object *text = NULL;
    celspan_box box = {0, 0, 0, 0};
    desc.valign = (celspan_valign)i;
    CHECK(celspan_glyphs_create(context, &desc, &glyphs) == CELSPAN_OK);
    CHECK(celspan_object_create_text(context, &desc, &text) == CELSPAN_OK);
    const celspan_glyph *first = celspan_glyphs_get(glyphs, 0);
    const celspan_glyph *last = celspan_glyphs_get(glyphs, celspan_glyphs_count(glyphs) - 1);
    CHECK_NEAR(first->y, desc.at.y + drops[i], 1e-9);
    CHECK_NEAR(last->y, desc.at.y + drops[i] + 72, 1e-9);
    CHECK_NEAR(last->x + last->advance, desc.at.x + m.width, 1e-9);
    CHECK(celspan_object_bounds(text, &box));
    CHECK_NEAR(box.y, first->y - m.cap_height, 1e-6);
    celspan_object_unref(text);
    celspan_glyphs_destroy(glyphs);
  }
}

/* Letters live as long as somebody keeps them, whatever becomes of the list. */
static void letters_outlive_their_list(void) {
  const char *const fonts[] = {OWN};
  celspan_text_desc desc = text_of("Ab c\nd", fonts, 1);
  celspan_glyphs *glyphs = NULL;
  celspan_box box = {0, 0, 0, 0};
  desc.tracking = 100;
  if (!CHECK(celspan_glyphs_create(context, &desc, &glyphs) == CELSPAN_OK))
    return;
  CHECK(celspan_glyphs_count(glyphs) == 5);
  const celspan_glyph *first = celspan_glyphs_get(glyphs, 0), *last = celspan_glyphs_get(glyphs, 4);
  CHECK(first->text_size == 1 && first->text[0] == 'A' && first->line == 1);
  CHECK(last->text_size == 1 && last->text[0] == 'd' && last->line == 2);
  CHECK_NEAR(celspan_glyphs_get(glyphs, 1)->x, first->x + first->advance + 4.8, 1e-9);
  CHECK_NEAR(last->y - first->y, 1.2 * 48, 1e-9);
  CHECK(!celspan_object_bounds(celspan_glyphs_get(glyphs, 2)->object, &box)); /* a space */
  celspan_object *kept = celspan_object_ref(first->object);
  celspan_glyphs_destroy(glyphs);
  celspan_glyphs_destroy(NULL);
  CHECK(celspan_object_bounds(kept, &box) && box.width > 0);
  celspan_object_unref(kept);
}

/* Whichever allocation fails, alone or with all that follow, the status says so, nothing leaks, and
 * the context stays usable. */
static void every_allocation_may_fail(bool is_for_good) {
  const char *const fonts[] = {OWN, OWN};
  const celspan_variation variations[] = {{"wght", 700}};
  celspan_text_desc desc = text_of("ab שלום, AVE ->\nc d e", fonts, 2);
  desc.has_width = true;
  desc.width = 120;
  desc.variations = variations;
  desc.variation_count = 1;
  bool is_done = false;
  for (size_t n = 1; n < 2000 && !is_done; n++) {
    memory_watch watch = {.fail_at = n, .is_for_good = is_for_good};
    celspan_context *failing = memory_watch_context(&watch);
    if (!failing)
      continue;
    celspan_glyphs *glyphs = NULL;
    celspan_status status = celspan_glyphs_create(failing, &desc, &glyphs);
    is_done = status == CELSPAN_OK;
    CHECK(is_done ? celspan_glyphs_count(glyphs) > 0 : status == CELSPAN_NO_MEMORY && !glyphs);
    watch.fail_at = 0;
    celspan_glyphs *again = NULL;
    CHECK(celspan_glyphs_create(failing, &desc, &again) == CELSPAN_OK);
    celspan_glyphs_destroy(again);
    celspan_glyphs_destroy(glyphs);
    celspan_context_destroy(failing);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  CHECK(is_done);
}

int main(void) {
  if (!CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK))
    return check_done();
  glyphs_are_those_of_hb_shape();
  mixed_lines_are_those_of_hb_shape();
  outlines_are_those_of_freetype();
  fonts_are_kept_and_let_go();
  bad_arguments_are_refused();
  letters_outlive_their_list();
  valign_moves_by_measures();
  every_allocation_may_fail(false);
  every_allocation_may_fail(true);
  celspan_context_destroy(context);
  return check_done();
}
